/** Kinds of files, by the ending of their names. */

/** Endings of mesh files. */
const MESH_ENDING = /\.(obj|ply|stl|glb|gltf|3mf|off)$/i;
const MATERIAL_ENDING = /\.mtl$/i;
const HEIGHTS_ENDING = /\.(tiff?|exr|pfm|npy|npz)$/i;
const PICTURE_ENDING = /\.(png|jpe?g|webp|avif|hei[cf]|gif|bmp)$/i;
const CAMERA_ENDING = /\.(json|csv|txt|ya?ml|xml|conf|ini)$/i;
/** Cameras of COLMAP; other `.bin` files of it are depths. */
const COLMAP_CAMERAS = /^cameras\b[^.]*\.bin$/i;
/** Names of the formats of meshes, which contents tell. */
const MESH_FORMATS = ['obj', 'ply', 'stl', 'gltf', '3mf', 'off', 'xyz'];

/** A file's name without its ending. @param {{ name: string }} file */
export const stemOf = ({ name }) => name.replace(/\.[^.]*$/, '');

/** The ending of a file's name in lower case. @param {{ name: string }} file */
export const endingOf = ({ name }) => name.toLowerCase().split('.').pop();

/** Whether a file is a PDF, whose pages are pictures. @param {{ name: string, type: string }} file */
export const isPdf = ({ name, type }) => /\.pdf$/i.test(name) || type === 'application/pdf';

/** Whether a file is a photo as iPhones write it. @param {{ name: string, type: string }} file */
export const isHeic = ({ name, type }) => /\.hei[cf]$/i.test(name) || /^image\/hei[cf]$/.test(type);

/** Whether a file is a mesh. @param {string} name */
export const isMesh = (name) => MESH_ENDING.test(name);

/** Whether the name of a format is that of a mesh. @param {string} [format] */
export const isMeshFormat = (format) => format !== undefined && MESH_FORMATS.includes(format);

/** @typedef {'mesh' | 'heights' | 'picture' | 'camera'} FileKind */

/** @param {{ name: string }} file @returns {FileKind | null} null if the name does not tell */
export function kindByName({ name }) {
  if (isMesh(name) || MATERIAL_ENDING.test(name)) return 'mesh';
  if (HEIGHTS_ENDING.test(name)) return 'heights';
  if (PICTURE_ENDING.test(name)) return 'picture';
  return CAMERA_ENDING.test(name) || COLMAP_CAMERAS.test(name) ? 'camera' : null;
}
