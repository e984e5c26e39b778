/** Folders that are there for a while, or made anew in one step. */
import { chmod, mkdtemp, rename, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/**
 * Does something with a temporary folder.
 * @template T
 * @param {(folder: string) => Promise<T>} work
 */
export async function inTemporaryFolder(work) {
  const folder = await mkdtemp(join(tmpdir(), 'developable-'));
  try {
    return await work(folder);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

/**
 * Writes a folder anew, beside the old one, so that who reads there finds one or the other.
 * @param {string} folder
 * @param {(draft: string) => Promise<void>} write
 */
export async function replaceFolder(folder, write) {
  const draft = await mkdtemp(`${folder}-draft-`);
  try {
    await write(draft);
    // `mkdtemp` lets nobody else in.
    await chmod(draft, 0o755);
    await rm(folder, { recursive: true, force: true });
    await rename(draft, folder);
  } finally {
    await rm(draft, { recursive: true, force: true });
  }
}
