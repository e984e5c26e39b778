/** Which of several files is what: a mesh and what it names, or depths with what is known of them. */
import { isMesh, kindByName } from './file-kinds.js';

/**
 * @typedef {object} Together
 * @property {File} [mesh]
 * @property {File} [depths]
 * @property {File} [photo]
 * @property {File} [camera]
 * @property {File} [confidence] of the depths
 * @property {File} [mask] of the depths, or drawn on the photo
 * @property {File[]} others
 */

/** Whether it is a text with the numbers of a camera, by its name. @param {File} file */
export function isCamera(file) {
  return kindByName(file) === 'camera';
}

/**
 * @param {readonly File[]} files
 * @returns {Promise<Together>}
 */
export async function together(files) {
  /** @type {Together} */
  const found = { others: [] };
  for (const file of files) {
    const kind = await kindOf(file);
    if (kind && !found[kind]) found[kind] = file;
    else found.others.push(file);
  }
  // A grey picture beside one in colour is what that shows.
  if (!found.depths && !found.mesh) {
    const pictures = files.filter((file) => file === found.photo || (found.others.includes(file) && kindByName(file) === 'picture'));
    const grey = pictures.length > 1 ? await firstOf(pictures, isGrey) : undefined;
    if (grey) {
      found.depths = grey;
      if (grey === found.photo) found.photo = pictures.find((file) => file !== grey);
      found.others = files.filter((file) => !Object.values(found).includes(file));
    }
  }
  return found;
}

/**
 * @param {File} file
 * @returns {Promise<Exclude<keyof Together, 'others'> | null>}
 */
async function kindOf(file) {
  const { name } = file;
  if (isMesh(name)) return 'mesh';
  const kind = kindByName(file);
  if (kind === 'camera') return 'camera';
  if (kind === 'heights' || kind === 'picture') {
    if (/conf/i.test(name)) return 'confidence';
    if (/mask|matte|segment/i.test(name)) return 'mask';
  }
  if (kind === 'heights') return 'depths';
  if ((/\.png$/i.test(name) && /depth/i.test(name)) || await isGrey16(file)) return 'depths';
  return kind === 'picture' ? 'photo' : null;
}

/** Whether it is a PNG of 16 bits of grey, as depth cameras write it. @param {File} file */
export async function isGrey16(file) {
  const { bits, colour } = await headOf(file);
  return /\.png$/i.test(file.name) && bits === 16 && colour === 0;
}

/** Whether it is a PNG without colours. @param {File} file */
async function isGrey(file) {
  const { colour } = await headOf(file);
  return /\.png$/i.test(file.name) && (colour === 0 || colour === 4);
}

/** What a PNG's header says. @param {File} file */
async function headOf(file) {
  const head = new Uint8Array(await file.slice(0, 26).arrayBuffer());
  return { bits: head[24], colour: head[25] };
}

/**
 * @param {readonly File[]} files
 * @param {(file: File) => Promise<boolean>} is
 */
async function firstOf(files, is) {
  for (const file of files) if (await is(file)) return file;
  return undefined;
}
