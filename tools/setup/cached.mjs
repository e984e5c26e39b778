/** Entries of the cache: whole or not there, whatever is interrupted and however many make them. */
import { existsSync } from 'node:fs';
import { mkdir, readdir, rename, rm } from 'node:fs/promises';
import { join } from 'node:path';
import { cache } from '../util/paths.mjs';

/**
 * The folder of an entry. Where it is missing it is made in a folder of its own and renamed.
 * @param {string} name
 * @param {(folder: string) => Promise<void>} make
 */
export async function cached(name, make) {
  const folder = entry(name);
  if (existsSync(folder)) return folder;
  await mkdir(cache, { recursive: true });
  await sweep();
  const draft = `${folder}.draft-${process.pid}`;
  try {
    await rm(draft, { recursive: true, force: true });
    await mkdir(draft);
    await make(draft);
    await rename(draft, folder).catch((error) => {
      // Somebody else was faster, and theirs is as good.
      if (!existsSync(folder)) throw error;
    });
  } finally {
    await rm(draft, { recursive: true, force: true });
  }
  return folder;
}

/** @param {string} name */
export const entry = (name) => join(cache, name);

/** Removes the drafts of set-ups that were interrupted. */
async function sweep() {
  for (const name of await readdir(cache)) {
    const maker = /\.draft-(\d+)$/.exec(name)?.[1];
    if (maker && !isRunning(Number(maker))) await rm(join(cache, name), { recursive: true, force: true });
  }
}

/** @param {number} pid */
function isRunning(pid) {
  try {
    process.kill(pid, 0);
    return true;
  } catch (error) {
    return error instanceof Error && 'code' in error && error.code === 'EPERM';
  }
}
