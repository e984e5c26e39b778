/** What a file is, by its name, and which part of the page takes it. */

/** Endings of what the page reads. */
export const MESH = /\.(obj|ply|stl|glb|gltf)$/i;
const MATERIAL = /\.mtl$/i;
const HEIGHTS = /\.(tiff?|exr|pfm|npy|npz)$/i;
const PICTURE = /\.(png|jpe?g|webp|avif|heic|gif|bmp)$/i;
const CAMERA = /\.(json|csv|txt)$/i;

/** What else people drop, in words. @type {readonly (readonly [RegExp, string])[]} */
const OTHERS = [
  [/\.(docx?|odt|rtf|pages)$/i, 'a text document'],
  [/\.(xlsx?|ods|numbers)$/i, 'a spreadsheet'],
  [/\.(pptx?|odp|key)$/i, 'a presentation'],
  [/\.pdf$/i, 'a PDF; take a photo of its page, or save the page as a PNG'],
  [/\.(txt|md|html?|xml|ya?ml|log)$/i, 'a text'],
  [/\.(zip|rar|7z|gz|tar)$/i, 'an archive; unpack it first'],
  [/\.(mp4|mov|avi|mkv|webm)$/i, 'a video'],
  [/\.(mp3|wav|m4a|flac)$/i, 'a sound'],
  [/\.(dxf|dwg|svg|ai|eps)$/i, 'a drawing'],
  [/\.(step|stp|iges|igs|fbx|dae|blend|skp|usdz?)$/i, 'a 3D file of a kind that is not read; export it as OBJ, STL, PLY or GLB'],
];

/** @param {string} name of a file */
export function isMesh(name) {
  return MESH.test(name);
}

/** @typedef {'mesh' | 'heights' | 'picture' | 'camera' | 'other'} FileKind */

/** @param {{ name: string }} file @returns {FileKind | null} nothing where its name does not tell */
export function kindByName({ name }) {
  if (isMesh(name) || MATERIAL.test(name)) return 'mesh';
  if (HEIGHTS.test(name)) return 'heights';
  if (PICTURE.test(name)) return 'picture';
  if (CAMERA.test(name)) return 'camera';
  return OTHERS.some(([ending]) => ending.test(name)) ? 'other' : null;
}

/** What a file is that the page does not read. @param {{ name: string }} file */
export function otherInWords({ name }) {
  return OTHERS.find(([ending]) => ending.test(name))?.[1] ?? 'of a kind that is not read';
}
