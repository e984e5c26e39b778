/** A file of heights as the input, with what else is known of it. */
import { apart } from './worker-task.js';
import { pixelsOf } from './pixels.js';
import { keepLook } from './surface/known.js';
import { handOver } from './surface/work.js';
import { takenOver } from './import-interpretation.js';

/** @import {Api} from './api.js' */
/** @import {Worker} from './worker-task.js' */
/** @import {Beside, Input} from './session.js' */
/** @import {Together} from './dropped-files.js' */

/** A picture in colour is a photo, and no heights. */
export class InColour extends Error {
  constructor() {
    super('it is in colour, and no heights follow from that. A photo alone is made flat under “A photo of a page”; with its depths, open both together');
  }
}

/**
 * @param {Api} api
 * @param {File} file
 * @param {AbortSignal} signal it is given up
 * @param {string} [wanted] array of it
 * @param {Pick<Together, 'photo' | 'confidence' | 'mask'>} [others] that go with it
 * @returns {Promise<Input>}
 */
export async function inputOf(api, file, signal, wanted, { photo: picture, ...others } = {}) {
  const { names, read, beside } = await apart(api, signal, async (reader) => {
    const names = await arraysOf(reader, file);
    const options = names.length > 1 ? { array: wanted ?? names[0] } : undefined;
    const read = await reader.read(file, options).catch((error) => {
      throw error instanceof Error && /colour/.test(error.message) ? new InColour() : error;
    });
    return { names, read, beside: await besideOf(reader, others) };
  });
  const { format, dataType } = read;
  const photo = picture && { name: picture.name, image: await pixelsOf(picture) };
  const { look, ...through } = await handOver('lookedThrough', [read.data], read, file.name);
  const found = takenOver(through);
  keepLook(found, look);
  return {
    ...found,
    name: file.name.replace(/\.[^.]*$/, '') || 'heights',
    kind: `${format.toUpperCase()}, ${typeInWords(dataType)}`,
    dataType,
    photo,
    beside,
    array: names.length > 1 ? { file, names, name: wanted ?? names[0] } : undefined,
  };
}

/**
 * The names of the arrays of an NPZ that may be heights; other files have none.
 * @param {Worker} reader
 * @param {File} file
 */
async function arraysOf(reader, file) {
  if (!/\.npz$/i.test(file.name)) return [];
  const arrays = await reader.npzArrays(file);
  return arrays.filter(({ shape, dataType }) => shape.length === 2 && /^[uif]\d+$/.test(dataType)).map(({ name }) => name);
}

/**
 * What is known of depths besides, as it is stored.
 * @param {Worker} reader
 * @param {Pick<Together, 'confidence' | 'mask'>} files
 * @returns {Promise<Beside | undefined>}
 */
async function besideOf(reader, { confidence, mask }) {
  /** @param {File} [file] */
  const read = async (file) => {
    if (!file) return undefined;
    try {
      const { width, height, data, dataType } = await reader.read(file);
      // Whole numbers are levels, or shares of the largest.
      if (dataType === 'u8') return { width, height, data: Uint8Array.from(data, (value) => value || 0) };
      if (dataType === 'u16') return { width, height, data: Uint16Array.from(data, (value) => value || 0) };
      return { width, height, data };
    } catch (error) {
      throw new Error(`its “${file.name}” could not be read: ${error instanceof Error ? error.message : error}`);
    }
  };
  const names = [confidence, mask].flatMap((file) => (file ? [file.name] : []));
  return names.length === 0 ? undefined : { confidence: await read(confidence), mask: await read(mask), names };
}

/** @param {string} type such as u16 */
function typeInWords(type) {
  const [, letter, bits] = /^([a-z]+)(\d+)$/.exec(type) ?? [];
  /** @type {Record<string, string>} */
  const names = { u: 'integers', i: 'signed integers', f: 'floats' };
  return names[letter] ? `${bits}-bit ${names[letter]}` : type;
}
