/** Reading files, and writing them whole or not at all. */
import { randomBytes } from 'node:crypto';
import { constants } from 'node:fs';
import { access, copyFile, link, open, readFile, readlink, realpath, rename, rm, stat } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { codeOf, failed, reasons } from './system-errors.js';
import { print, readStandardInput, streams } from './terminal.js';

/**
 * @typedef {import('node:fs').Stats} Stats
 * @typedef {object} Place where a file is to be put
 * @property {string} path as the user gave it
 * @property {string} target the file itself, where the path is a link
 * @property {Stats} [there] what is there already
 * @typedef {{ target: string, kept?: string }} Replaced a file, and under what name its last state is kept, if it had one
 */

/**
 * @param {string} path
 * @returns {Promise<Uint8Array>}
 */
export async function readBytes(path) {
  if (path === '-') return readStandardInput();
  const { kept } = streams();
  if (kept?.path === path) return kept.bytes;
  try {
    return await readFile(path);
  } catch (error) {
    throw failed(`cannot read ${path}`, error);
  }
}

/**
 * Whether files can be put here: better known before the work than after it.
 * @param {string[]} paths
 */
export async function checkPlaces(...paths) {
  for (const path of paths) if (path !== '-') await placeOf(path);
}

/**
 * Writes all of these files, or none: each into a draft in the same folder, down to the disk, and only then over what
 * was there, which is put back if the next one cannot be written. What is for `-` goes to standard output last.
 * @param {{ path: string, bytes: Uint8Array }[]} files
 * @param {AbortSignal} signal
 */
export async function writeWhole(files, signal) {
  /** @type {(Place & { draft: string })[]} */
  const drafts = [];
  /** @type {Replaced[]} */
  const replaced = [];
  try {
    for (const { path, bytes } of files.filter(({ path }) => path !== '-')) {
      const place = await placeOf(path);
      const draft = beside(place.target);
      drafts.push({ ...place, draft });
      await writing(path, () => write(draft, bytes, place.there));
    }
    signal.throwIfAborted();
    for (const [i, { path, target, there, draft }] of drafts.entries()) {
      // After the last one nothing can fail any more.
      const kept = there && i + 1 < drafts.length ? beside(target) : undefined;
      await writing(path, () => replace(target, draft, kept));
      replaced.push({ target, kept });
    }
    for (const { kept } of replaced) if (kept !== undefined) await remove(kept);
  } catch (error) {
    for (const { target, kept } of replaced.reverse()) {
      await (kept === undefined ? remove(target) : rename(kept, target).catch(() => {}));
    }
    throw error;
  } finally {
    await Promise.all(drafts.map(({ draft }) => remove(draft)));
  }
  for (const { path, bytes } of files) if (path === '-') await print(bytes);
}

/**
 * Where a file is to be put; an error where that is not possible.
 * @param {string} path
 * @returns {Promise<Place>}
 */
async function placeOf(path) {
  return writing(path, async () => {
    if (path.includes('\ufffd')) throw new Refusal(reasons.NOT_UTF8);
    const target = await followed(path);
    const folder = dirname(target);
    if (!(await stat(folder)).isDirectory()) throw new Refusal(reasons.ENOTDIR);
    const there = await stat(target).catch((error) => {
      if (error.code !== 'ENOENT') throw error;
      return undefined;
    });
    if (there && !there.isFile()) throw new Refusal(there.isDirectory() ? reasons.EISDIR : 'it is there and no file');
    // To root every file is writable, but one without any such permission is meant to stay.
    if (there && ((there.mode & 0o222) === 0 || !(await writable(target)))) throw new Refusal('it is read-only');
    await access(folder, constants.W_OK | constants.X_OK);
    return { path, target, there };
  });
}

/** @param {string} path */
async function writable(path) {
  return access(path, constants.W_OK).then(() => true, () => false);
}

/**
 * The file itself where the path is a link, which is to stay one, also where the file is not there yet.
 * @param {string} path
 * @returns {Promise<string>}
 */
async function followed(path) {
  try {
    return await realpath(path);
  } catch (error) {
    if (codeOf(error) !== 'ENOENT') throw error;
    const next = await readlink(path).catch(() => undefined);
    return next === undefined ? path : followed(resolve(dirname(path), next));
  }
}

/**
 * A name in the same folder that nobody can foresee: a link might be waiting there. Not made from the file's own name,
 * which may be as long as a name can be.
 * @param {string} target
 */
function beside(target) {
  return join(dirname(target), `.developable-${randomBytes(12).toString('hex')}.tmp`);
}

/**
 * A new file, with the owner and the permissions of the one that it is to replace.
 * @param {string} draft
 * @param {Uint8Array} bytes
 * @param {Stats | undefined} there
 */
async function write(draft, bytes, there) {
  const file = await open(draft, 'wx', there ? there.mode & 0o777 : 0o666);
  try {
    if (there) {
      // Only root can give files away.
      await file.chown(there.uid, there.gid).catch(() => {});
      await file.chmod(there.mode & 0o777);
    }
    await file.writeFile(bytes);
    await file.sync();
  } finally {
    await file.close();
  }
}

/**
 * Puts a draft in the place of a file.
 * @param {string} target
 * @param {string} draft
 * @param {string} [kept] a name under which the file is to be kept
 */
async function replace(target, draft, kept) {
  try {
    // Not every file system gives a file two names.
    if (kept !== undefined) await link(target, kept).catch(() => copyFile(target, kept, constants.COPYFILE_EXCL));
    await rename(draft, target);
  } catch (error) {
    if (kept !== undefined) await remove(kept);
    throw error;
  }
}

/** Removes a file of our own; where that fails, it is no reason to hide how the rest went. @param {string} file */
async function remove(file) {
  await rm(file, { force: true }).catch(() => {});
}

/** Why a file is not written, in words of our own. */
class Refusal extends Error {}

/**
 * Says of what goes wrong which file it is about.
 * @template T
 * @param {string} path
 * @param {() => Promise<T>} run
 */
async function writing(path, run) {
  try {
    return await run();
  } catch (error) {
    throw failed(`cannot write ${path}`, error);
  }
}
