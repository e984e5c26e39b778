/** Which of the two wasm files for images knows a file, by its format's name or its first bytes. */
import { DevelopableError } from './errors.js';

/** First bytes of the files that the wasm of the images reads, as Latin-1; a `?` stands for any byte. It is not loaded for any other. */
const MAGIC = [
  'II*\0', 'MM\0*', 'II+\0', 'MM\0+', '\x76\x2f\x31\x01', 'Pf\n', 'PF\n', 'PK\x03\x04', 'PK\x05\x06', 'RIFF????WEBP', 'GIF8',
  'BM????\0\0\0\0',
];

/** First bytes of a JPEG file, of which that wasm reads heights, and the other one photos. */
const JPEG = '\xff\xd8\xff';

/**
 * Whether the wasm of the images is to read this file. What nobody knows is left to the other one,
 * which says so.
 * @param {Uint8Array} bytes
 * @param {unknown} [options] those of `read`
 */
export function isImage(bytes, options) {
  const { format } = Object(options);
  if (format !== undefined) return format !== 'png' && format !== 'npy';
  return isText(bytes) || isColmap(bytes) || beginsWith(bytes, JPEG) || isImagePhoto(bytes);
}

/** Whether a file is a depth map of COLMAP: `width&height&channels&` comes first. @param {Uint8Array} bytes */
const isColmap = (bytes) => /^\d+&\d+&\d+&/.test(String.fromCharCode(...bytes.subarray(0, 32)));

/** Whether a file begins with text that has digits, as grids of numbers do. @param {Uint8Array} bytes */
function isText(bytes) {
  const head = bytes.subarray(0, 256);
  return head.some((byte) => byte >= 0x30 && byte <= 0x39) && head.every((byte) => byte === 9 || byte === 10 || byte === 13 || byte >= 32);
}

/**
 * Whether the wasm of the images is to read this photo.
 * @param {Uint8Array} bytes
 */
export const isImagePhoto = (bytes) => MAGIC.some((magic) => beginsWith(bytes, magic));

/** Whether a file begins with these letters, of which a `?` stands for any byte. @param {Uint8Array} bytes @param {string} magic */
const beginsWith = (bytes, magic) => [...magic].every((letter, i) => letter === '?' || bytes[i] === letter.charCodeAt(0));

/** How mesh files begin; for an OBJ, its first line that is no comment. */
const MESHES = { PLY: /^ply\s/, STL: /^solid\b/, GLB: /^glTF/, glTF: /^\{/, OFF: /^OFF\s/, OBJ: /^(v|vn|vt|vp|f|o|g|s|mtllib|usemtl)\s/ };

/**
 * Says of a mesh's file that another function reads it.
 * @param {Uint8Array} bytes
 * @param {{ format?: string }} options those of `read`
 */
export function refuseMesh(bytes, options) {
  const name = options.format === undefined ? meshFormat(bytes) : undefined;
  if (name) throw new DevelopableError('UNSUPPORTED', `this is a mesh (${name}), and no image of heights: readMesh reads it`);
}

/**
 * The kind of a mesh's file; nothing of other files.
 * @param {Uint8Array} bytes
 */
function meshFormat(bytes) {
  if ((isImage(bytes) && !isText(bytes)) || bytes[0] >= 0x80) return undefined;
  const lines = String.fromCharCode(...bytes.subarray(0, 2000)).split('\n').map((line) => line.trim());
  const first = lines.find((line) => line !== '' && !line.startsWith('#')) ?? '';
  return Object.entries(MESHES).find(([, start]) => start.test(`${first} `))?.[0] ?? (isBinaryStl(bytes) ? 'STL' : undefined);
}

/** First bytes of photos, by the ending of their files. */
const PHOTOS = { '.png': '\x89PNG', '.jpg': '\xff\xd8\xff', '.webp': 'RIFF????WEBP', '.gif': 'GIF8', '.bmp': 'BM' };

/**
 * The ending that a file's name would have, of photos and meshes; an empty one of all others.
 * @param {Uint8Array} bytes
 */
export function endingOf(bytes) {
  const photo = Object.entries(PHOTOS).find(([, magic]) => beginsWith(bytes, magic));
  const mesh = meshFormat(bytes);
  return photo?.[0] ?? (mesh === undefined ? '' : `.${mesh.toLowerCase()}`);
}

/** A binary STL says nothing of itself but how many triangles it has. @param {Uint8Array} bytes */
function isBinaryStl(bytes) {
  if (bytes.length < 84) return false;
  const triangles = new DataView(bytes.buffer, bytes.byteOffset).getUint32(80, true);
  return bytes.length === 84 + 50 * triangles;
}
