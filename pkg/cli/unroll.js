/** `developable unroll`. */
import * as developable from '../index.js';
import { checkPlaces, writeWhole } from './files.js';
import { flattened, reported } from './flattened.js';
import { during, percent, succeed } from './terminal.js';
import { flatObj, json, plainArrays } from './texts.js';

/**
 * @param {import('./task.js').Task} task
 * @param {AbortSignal} signal
 */
export async function unroll(task, signal) {
  await checkPlaces(...task.written);
  const { surface, options } = await flattened(task, signal);
  const sheet = await during('laying it flat', (watched) => developable.unroll(surface, { ...options, ...watched }));
  const bytes = task.extension === '.obj' ? flatObj(sheet) : json(plainArrays(sheet));
  await writeWhole([{ path: task.output, bytes }, ...reported(task, sheet)], signal);
  succeed(task.output, `${sheet.triangles.length / 3} triangles laid flat, strained by ${percent(sheet.report.distortion.rms, 2)}`);
}
