/** What files that were opened together are: photos of pages, a mesh with its textures, or heights and depths with their photo and camera. */
import { isMesh, kindByName } from './file-kinds.js';

/**
 * @typedef {object} FileRoles
 * @property {File} [mesh]
 * @property {File} [depths]
 * @property {File} [photo]
 * @property {File} [camera]
 * @property {File[]} others files without a role
 */

/**
 * @typedef {object} FileRoute
 * @property {'photos' | 'heights'} to photos of pages; heights, depths or a mesh, or what is none of these
 * @property {File[]} files the files that are opened
 * @property {File[]} left the files that do not belong to them
 */

/** Length of a mesh file's beginning that is searched for the names of its materials and textures, in bytes. */
const SEARCHED_MESH_BYTES = 1e6;
/** Side of the reduced picture whose colours are looked at, in pixels. */
const SAMPLE_SIDE_PIXELS = 64;
/** Minimum difference between the channels of a pixel in colour, of 255. */
const MIN_CHANNEL_DIFFERENCE = 12;

/**
 * Decides what files are, and which of them belong together.
 * @param {readonly File[]} files
 * @param {boolean} inPhotoMode whether photos of pages are shown now, where a grey picture is a photo, too
 * @returns {Promise<FileRoute>}
 */
export async function routeFiles(files, inPhotoMode) {
  const without = (/** @type {readonly File[]} */ taken) => files.filter((file) => !taken.includes(file));
  const mesh = files.find(({ name }) => isMesh(name));
  if (mesh) {
    const taken = [mesh, ...await filesNamedBy(mesh, without([mesh]))];
    return { to: 'heights', files: taken, left: without(taken) };
  }
  const roles = await fileRoles(files, inPhotoMode);
  if (roles.depths) return { to: 'heights', files: without(roles.others), left: roles.others };
  const pictures = files.filter((file) => kindByName(file) === 'picture');
  if (pictures.length > 0) {
    // Heights that are kept as a picture are a grey PNG.
    const arePhotos = inPhotoMode || pictures.length > 1 || !/\.png$/i.test(pictures[0].name) || await hasFewLevels(pictures[0]) || await isInColour(pictures[0]);
    return { to: arePhotos ? 'photos' : 'heights', files: pictures, left: without(pictures) };
  }
  const first = [files.find(kindByName) ?? files[0]];
  return { to: 'heights', files: first, left: without(first) };
}

/**
 * Finds the role of each file, by its name and, for a PNG, by its header.
 * @param {readonly File[]} files
 * @param {boolean} [inPhotoMode] whether photos of pages are shown now: then a grey picture beside one in colour is a page, too
 * @returns {Promise<FileRoles>}
 */
export async function fileRoles(files, inPhotoMode = false) {
  /** @type {FileRoles} */
  const roles = { others: [] };
  for (const file of files) {
    const role = await roleOf(file);
    if (role && !roles[role]) roles[role] = file;
    else roles.others.push(file);
  }
  // A grey PNG that was opened together with one photo in colour holds its depths.
  if (!inPhotoMode && !roles.depths && !roles.mesh) {
    const pictures = files.filter((file) => file === roles.photo || (roles.others.includes(file) && kindByName(file) === 'picture'));
    const grey = await Promise.all(pictures.map((file) => isGreyPng(file)));
    if (pictures.length === 2 && grey[0] !== grey[1]) {
      [roles.depths, roles.photo] = grey[0] ? pictures : pictures.toReversed();
      roles.others = files.filter((file) => !Object.values(roles).includes(file));
    }
  }
  return roles;
}

/** @param {File} file @returns {Promise<Exclude<keyof FileRoles, 'others'> | null>} */
async function roleOf(file) {
  const { name } = file;
  if (isMesh(name)) return 'mesh';
  const kind = kindByName(file);
  if (kind === 'camera') return 'camera';
  if (kind === 'heights') return 'depths';
  if ((/\.png$/i.test(name) && /depth/i.test(name)) || await isGreyPng(file, true)) return 'depths';
  return kind === 'picture' ? 'photo' : null;
}

/**
 * Whether a file is a grey PNG, with transparency or without.
 * @param {File} file
 * @param {boolean} [isDeep] whether it has to have 16 bits per pixel and no transparency, as depth cameras write it
 */
async function isGreyPng(file, isDeep = false) {
  if (!/\.png$/i.test(file.name)) return false;
  const [bits, colour] = new Uint8Array(await file.slice(24, 26).arrayBuffer());
  return isDeep ? bits === 16 && colour === 0 : colour === 0 || colour === 4;
}

/** Whether a PNG has 16 levels at most, as scans of letters in black and white have, and heights have not. @param {File} file */
const hasFewLevels = async (file) => new Uint8Array(await file.slice(24, 25).arrayBuffer())[0] < 8;

/**
 * Whether a picture has a pixel in colour. Those that the browser cannot decode are taken for photos in colour unless they are
 * PNGs, whose readers say what is wrong with them.
 * @param {File} file
 */
export async function isInColour(file) {
  const bitmap = await createImageBitmap(file, { resizeWidth: SAMPLE_SIDE_PIXELS, resizeHeight: SAMPLE_SIDE_PIXELS }).catch(() => null);
  const context = new OffscreenCanvas(SAMPLE_SIDE_PIXELS, SAMPLE_SIDE_PIXELS).getContext('2d', { willReadFrequently: true });
  if (!bitmap || !context) return !/\.png$/i.test(file.name);
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  const { data } = context.getImageData(0, 0, SAMPLE_SIDE_PIXELS, SAMPLE_SIDE_PIXELS);
  for (let i = 0; i < data.length; i += 4) {
    const [low, high] = [Math.min(data[i], data[i + 1], data[i + 2]), Math.max(data[i], data[i + 1], data[i + 2])];
    if (high - low >= MIN_CHANNEL_DIFFERENCE) return true;
  }
  return false;
}

/** The files that a mesh refers to by their names, directly or in its materials. @param {File} mesh @param {readonly File[]} others */
async function filesNamedBy(mesh, others) {
  const materials = others.filter(({ name }) => /\.mtl$/i.test(name));
  const texts = await Promise.all([/\.gltf$/i.test(mesh.name) ? mesh : mesh.slice(0, SEARCHED_MESH_BYTES), ...materials].map((part) => part.text()));
  const text = texts.join('\n').toLowerCase();
  return others.filter((file) => materials.includes(file) || text.includes(file.name.toLowerCase()) || text.includes(encodeURI(file.name).toLowerCase()));
}
