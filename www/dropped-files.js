/** The role of each of several files that were opened together: a mesh with its textures, or depths with their photo, camera and masks. */
import { isMesh, kindByName } from './file-kinds.js';

/**
 * @typedef {object} FileRoles
 * @property {File} [mesh]
 * @property {File} [depths]
 * @property {File} [photo]
 * @property {File} [camera]
 * @property {File} [confidence] confidence of the depths
 * @property {File} [mask] mask of the depths, or one that was drawn on the photo
 * @property {File[]} others files without a role
 */

/** Whether a file's name is that of a text with camera intrinsics. @param {File} file */
export function isCameraFile(file) {
  return kindByName(file) === 'camera';
}

/**
 * Finds the role of each file, by its name and, for a PNG, by its header.
 * @param {readonly File[]} files
 * @returns {Promise<FileRoles>}
 */
export async function fileRoles(files) {
  /** @type {FileRoles} */
  const roles = { others: [] };
  for (const file of files) {
    const role = await roleOf(file);
    if (role && !roles[role]) roles[role] = file;
    else roles.others.push(file);
  }
  // A grey picture that was opened together with a coloured one holds its depths.
  if (!roles.depths && !roles.mesh) {
    const pictures = files.filter((file) => file === roles.photo || (roles.others.includes(file) && kindByName(file) === 'picture'));
    const grey = pictures.length > 1 ? await findAsync(pictures, isGreyPng) : undefined;
    if (grey) {
      roles.depths = grey;
      if (grey === roles.photo) roles.photo = pictures.find((file) => file !== grey);
      roles.others = files.filter((file) => !Object.values(roles).includes(file));
    }
  }
  return roles;
}

/**
 * @param {File} file
 * @returns {Promise<Exclude<keyof FileRoles, 'others'> | null>}
 */
async function roleOf(file) {
  const { name } = file;
  if (isMesh(name)) return 'mesh';
  const kind = kindByName(file);
  if (kind === 'camera') return 'camera';
  if (kind === 'heights' || kind === 'picture') {
    if (/conf/i.test(name)) return 'confidence';
    if (/mask|matte|segment/i.test(name)) return 'mask';
  }
  if (kind === 'heights') return 'depths';
  if ((/\.png$/i.test(name) && /depth/i.test(name)) || await isGrey16Png(file)) return 'depths';
  return kind === 'picture' ? 'photo' : null;
}

/** Whether a file is a grey PNG with 16 bits per pixel, as depth cameras write it. @param {File} file */
export async function isGrey16Png(file) {
  const { bits, colour } = await pngHeader(file);
  return /\.png$/i.test(file.name) && bits === 16 && colour === 0;
}

/** Whether a file is a grey PNG, with transparency or without. @param {File} file */
async function isGreyPng(file) {
  const { colour } = await pngHeader(file);
  return /\.png$/i.test(file.name) && (colour === 0 || colour === 4);
}

/** Bit depth and colour type of a PNG. @param {File} file */
async function pngHeader(file) {
  const header = new Uint8Array(await file.slice(0, 26).arrayBuffer());
  return { bits: header[24], colour: header[25] };
}

/**
 * The first file that satisfies an asynchronous test.
 * @param {readonly File[]} files
 * @param {(file: File) => Promise<boolean>} test
 */
async function findAsync(files, test) {
  for (const file of files) if (await test(file)) return file;
  return undefined;
}
