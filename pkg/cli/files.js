/** Reading files, and writing them whole or not at all. */
import { constants } from 'node:fs';
import { access, open, readFile, realpath, rename, rm, stat } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { messageOf } from '../errors.js';
import { Problem, status } from './problem.js';

/**
 * @param {string} path
 * @returns {Promise<Uint8Array>}
 */
export async function readBytes(path) {
  try {
    return await readFile(path);
  } catch (error) {
    throw failed(`cannot read ${path}`, error);
  }
}

/**
 * Whether a file can be put here: better known before the work than after it.
 * @param {string} path
 */
export async function checkPlace(path) {
  const target = await followed(path);
  try {
    await access(dirname(target), constants.W_OK);
  } catch (error) {
    throw failed(`cannot write ${path}`, error);
  }
  const there = await stat(target).catch(() => undefined);
  if (there && !there.isFile()) {
    throw new Problem(status.input, `cannot write ${path}: it is there and no file`);
  }
}

/**
 * Writes all of these files, or none: each into a file of another name in the same folder, down
 * to the disk, and only then over what was there.
 * @param {{ path: string, bytes: Uint8Array }[]} files
 * @param {AbortSignal} signal
 */
export async function writeWhole(files, signal) {
  /** @type {{ path: string, target: string, draft: string }[]} */
  const drafts = [];
  try {
    for (const [i, { path, bytes }] of files.entries()) {
      const target = await followed(path);
      // Not made from the target's name, which may be as long as a name can be.
      const draft = join(dirname(target), `.developable-${process.pid}-${i}.tmp`);
      drafts.push({ path, target, draft });
      await write(path, draft, bytes);
    }
    signal.throwIfAborted();
    for (const { path, target, draft } of drafts) {
      await rename(draft, target).catch((error) => {
        throw failed(`cannot write ${path}`, error);
      });
    }
  } catch (error) {
    await Promise.all(drafts.map(({ draft }) => rm(draft, { force: true })));
    throw error;
  }
}

/**
 * @param {string} path
 * @param {string} draft
 * @param {Uint8Array} bytes
 */
async function write(path, draft, bytes) {
  try {
    const file = await open(draft, 'w');
    try {
      await file.writeFile(bytes);
      await file.sync();
    } finally {
      await file.close();
    }
  } catch (error) {
    throw failed(`cannot write ${path}`, error);
  }
}

/**
 * The file itself where the path is a link, which is to stay one.
 * @param {string} path
 */
function followed(path) {
  return realpath(path).catch(() => path);
}

/**
 * @param {string} what
 * @param {unknown} error
 */
function failed(what, error) {
  const { code } = /** @type {NodeJS.ErrnoException} */ (error);
  /** @type {Record<string, string>} */
  const reasons = {
    ENOENT: 'there is no such file or folder',
    EISDIR: 'it is a folder',
    ENOTDIR: 'a part of the path is no folder',
    EACCES: 'permission denied',
    EPERM: 'not permitted',
    EROFS: 'the file system is read-only',
    ENOSPC: 'the disk is full',
    ENAMETOOLONG: 'the name is too long',
  };
  return new Problem(status.input, `${what}: ${reasons[code ?? ''] ?? messageOf(error)}`);
}
