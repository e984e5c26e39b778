/**
 * Fingerprints of what a batch has made, so that a file is skipped only if the same version made it of the same input by the
 * same options. Each has a file of its own, so that several processes can work on one folder.
 */
import { createHash } from 'node:crypto';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { basename, dirname, join } from 'node:path';
import { version } from './version.js';

/** @typedef {Pick<import('./batch.js').BatchItem, 'args' | 'read' | 'written'>} Made */

/** Folder of the fingerprints, beside the outputs. */
const FOLDER = '.developable';

/**
 * Whether all outputs are there as an earlier run with the same options, inputs and version has left them.
 * @param {Made} item
 * @returns {Promise<boolean>}
 */
export async function isRecorded(item) {
  if (item.written.length === 0) return false;
  const [before, now] = await Promise.all([readFile(placeOf(item), 'utf8').catch(() => undefined), fingerprintOf(item)]);
  return now !== undefined && before?.trim() === now;
}

/**
 * Records that outputs were made. That it cannot be recorded only means that they are made again.
 * @param {Made} item
 */
export async function record(item) {
  const fingerprint = await fingerprintOf(item);
  if (fingerprint === undefined || item.written.length === 0) return;
  const place = placeOf(item);
  await mkdir(dirname(place), { recursive: true }).then(() => writeFile(place, `${fingerprint}\n`)).catch(() => {});
}

/** @param {Made} item */
function placeOf({ written: [first] }) {
  return join(dirname(first), FOLDER, `${basename(first)}.sha256`);
}

/**
 * A digest of version, options and the contents of all files; nothing where one of these is not there.
 * @param {Made} item
 */
async function fingerprintOf({ args, read, written }) {
  const hash = createHash('sha256').update(JSON.stringify([version, args]));
  try {
    for (const path of [...read, ...written]) hash.update(createHash('sha256').update(await readFile(path)).digest());
  } catch {
    return undefined;
  }
  return hash.digest('hex');
}
