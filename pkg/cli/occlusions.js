/** `developable occlusions`. */
import * as developable from '../index.js';
import { checkPlaces, writeWhole } from './files.js';
import { readInput } from './inputs.js';
import { print, succeed } from './terminal.js';

/**
 * Prints how many vertices there are, and writes where.
 * @param {import('./task.js').Task} task
 * @param {AbortSignal} signal
 */
export async function occlusions(task, signal) {
  await checkPlaces(...task.written);
  const input = await readInput(task);
  const { threshold, normalize, spacing } = task;
  const options = task.lattice !== 'square' ? { threshold, normalize } : { threshold, normalize, spacing };
  const { rows, cols, vertices, image, count } = await developable.occlusions(input, options);
  const flags = image ?? vertices;
  const width = 'width' in input && image ? input.width : cols;
  const height = 'height' in input && image ? input.height : rows;
  // A picture, in which black is no missing data as it is in heights: white where the surface is torn.
  const bytes = task.extension === '.png'
    ? await developable.writePhoto({ width, height, data: Uint8Array.from({ length: 4 * flags.length }, (_, i) => (i % 4 === 3 || flags[i >> 2] ? 255 : 0)) })
    : await developable.writeImage({ width, height, data: flags });
  await writeWhole([{ path: task.output, bytes }], signal);
  succeed(task.output, `${count} vertices where the surface is torn`);
  if (task.output !== '-') await print(`${count}\n`);
}
