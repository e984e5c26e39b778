/** Cameras from files. */
import { parseCamera } from '../index.js';
import { withFileName } from './explain.js';
import { readBytes } from './files.js';

/**
 * A camera from a file. Numbers that are about another image than the one they are used with need its size; where
 * the file does not say it, it is that of the known image whose middle the axis is nearest to.
 * @param {string} path
 * @param {{ width: number, height: number }[]} images
 * @returns {Promise<import('../types.js').PhotoCamera>}
 */
export async function readCamera(path, images) {
  const bytes = await readBytes(path);
  return withFileName(path, async () => parseCamera(bytes, images));
}
