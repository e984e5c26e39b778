/** Reads a file of heights as an input, with the photo that belongs to it. */
import { runInWorker } from './worker-task.js';
import { stemOf } from './file-kinds.js';
import { readPicture } from './pixels.js';
import { callWorker } from './surface/worker-client.js';
import { noDataOptions } from './import-interpretation.js';

/**
 * Reads a file of heights as an input.
 * @param {Api} api
 * @param {File} file
 * @param {AbortSignal} signal
 * @param {{ array?: string, noData?: NoData }} [reading] name of the array to read, for an NPZ file with several, and what is no data
 * @param {File} [photoFile]
 * @returns {Promise<Input>}
 */
export async function readInput(api, file, signal, { array, noData } = {}, photoFile = undefined) {
  const { names, read } = await runInWorker(api, signal, async (reader) => {
    const names = await heightArrayNames(reader, file);
    const options = { name: file.name, array: names.length > 1 ? array ?? names[0] : undefined, ...noDataOptions(noData) };
    return { names, read: await reader.read(file, options) };
  });
  const { format, dataType, assumptions } = read;
  const photo = photoFile && { name: photoFile.name, image: await readPicture(photoFile) };
  const { transfer } = await import('../pkg/wire.js');
  const input = await callWorker('interpretFile', transfer(read, [read.data.buffer]), noData);
  return {
    ...input,
    name: stemOf(file) || 'heights',
    file: file.name,
    kind: `${format.toUpperCase()}, ${numberTypeInWords(dataType)}`,
    dataType,
    assumptions,
    photo,
    array: names.length > 1 ? { file, names, name: array ?? names[0] } : undefined,
  };
}

/** Names of the arrays of an NPZ file that may be images; an empty list for other files. @param {PackageWorker} reader @param {File} file */
async function heightArrayNames(reader, file) {
  if (!/\.npz$/i.test(file.name)) return [];
  const arrays = await reader.npzArrays(file);
  return arrays.filter(({ mayBeImage }) => mayBeImage).map(({ name }) => name);
}

/** @param {string} type such as `u16` */
function numberTypeInWords(type) {
  const [, letter, bits] = /^([a-z]+)(\d+)$/.exec(type) ?? [];
  const name = { u: 'integers', i: 'signed integers', f: 'floats' }[letter];
  return name ? `${bits}-bit ${name}` : type;
}
