/** Kinds of files, by the ending of their names. */

/** Endings of mesh files. */
const MESH_ENDING = /\.(obj|ply|stl|glb|gltf|3mf|off)$/i;
const MATERIAL_ENDING = /\.mtl$/i;
const HEIGHTS_ENDING = /\.(tiff?|exr|pfm|npy|npz)$/i;
const PICTURE_ENDING = /\.(png|jpe?g|webp|avif|heic|gif|bmp)$/i;
const CAMERA_ENDING = /\.(json|csv|txt|ya?ml|xml|conf|ini)$/i;
/** Cameras of COLMAP; other `.bin` files of it are depths. */
const COLMAP_CAMERAS = /^cameras\b[^.]*\.bin$/i;
/** Names of the formats of meshes, which contents tell. */
const MESH_FORMATS = ['obj', 'ply', 'stl', 'gltf', '3mf', 'off', 'xyz'];

/** Endings of files that the page cannot read, with a description for the message. @type {readonly (readonly [RegExp, string])[]} */
const UNREADABLE_KINDS = [
  [/\.(docx?|odt|rtf|pages)$/i, 'a text document'],
  [/\.(xlsx?|ods|numbers)$/i, 'a spreadsheet'],
  [/\.(pptx?|odp|key)$/i, 'a presentation'],
  [/\.(json|ya?ml|csv|xml|conf|ini)$/i, 'a text without heights; if it is a camera, open it together with its depths'],
  [COLMAP_CAMERAS, 'cameras without depths; open it together with them'],
  [/\.(txt|md|html?|log)$/i, 'a text'],
  [/\.(zip|rar|7z|gz|tar)$/i, 'an archive; unpack it first'],
  [/\.(mp4|mov|avi|mkv|webm)$/i, 'a video'],
  [/\.(mp3|wav|m4a|flac)$/i, 'a sound'],
  [/\.(dxf|dwg|svg|ai|eps)$/i, 'a drawing'],
  [/\.(step|stp|iges|igs|fbx|dae|blend|skp|usdz?)$/i, 'a 3D file of a kind that is not read; export it as OBJ, STL, PLY or GLB'],
];

/** A file's name without its ending. @param {{ name: string }} file */
export function stemOf({ name }) {
  return name.replace(/\.[^.]*$/, '');
}

/** Whether a file is a PDF, whose pages are pictures. @param {{ name: string, type: string }} file */
export const isPdf = ({ name, type }) => /\.pdf$/i.test(name) || type === 'application/pdf';

/** Whether a file is a mesh. @param {string} name */
export function isMesh(name) {
  return MESH_ENDING.test(name);
}

/** Whether the name of a format is that of a mesh. @param {string} [format] */
export function isMeshFormat(format) {
  return format !== undefined && MESH_FORMATS.includes(format);
}

/** @typedef {'mesh' | 'heights' | 'picture' | 'camera' | 'other'} FileKind */

/** @param {{ name: string }} file @returns {FileKind | null} null if the name does not tell */
export function kindByName({ name }) {
  if (isMesh(name) || MATERIAL_ENDING.test(name)) return 'mesh';
  if (HEIGHTS_ENDING.test(name)) return 'heights';
  if (PICTURE_ENDING.test(name)) return 'picture';
  if (CAMERA_ENDING.test(name) || COLMAP_CAMERAS.test(name)) return 'camera';
  return UNREADABLE_KINDS.some(([ending]) => ending.test(name)) ? 'other' : null;
}

/** A description of a file that the page cannot read. @param {{ name: string }} file */
export function unreadableKindInWords({ name }) {
  return UNREADABLE_KINDS.find(([ending]) => ending.test(name))?.[1] ?? 'of a kind that is not read';
}
