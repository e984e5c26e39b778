/** The view of the photo of heights, the textures of a mesh, or their colours. */
import { interpolatorOf } from '../surface/lattice.js';
import { canvasFromImage } from '../surface/layer.js';

/** Whether an input has a photo or colours. @param {Input} input */
export function hasColours({ photo, lattice }) {
  return (photo !== undefined && lattice?.uvs !== undefined) || lattice?.colors !== undefined;
}

/** The view of the photo of heights, or of their colours. @param {Input} input @returns {ViewContent} */
export function photo({ lattice, photo }) {
  if (!lattice) return {};
  const textures = photo && lattice.uvs && [canvasFromImage(photo.image)];
  /** Numbers of the lattice at the vertices of a surface. @param {ArrayLike<number>} values @param {number} stride numbers for each vertex @param {Float64Array | Float32Array} positions */
  const atVertices = (values, stride, positions) => {
    const parts = Array.from({ length: stride }, (_, part) => interpolatorOf(lattice, values, { stride, part }));
    return Float32Array.from({ length: (stride * positions.length) / 3 }, (_, i) => parts[i % stride](positions[3 * Math.floor(i / stride)], positions[3 * Math.floor(i / stride) + 1]));
  };
  /** @type {import('../surface/layer.js').Layer} */
  const layer = { surface: (plain) => ({ ...plain, ...(textures ? { textures, uvs: atVertices(lattice.uvs ?? [], 2, plain.positions) } : { colors: atVertices(lattice.colors ?? [], 3, plain.positions) }) }) };
  return { layers: [layer, layer] };
}

/** The view of the textures or colours of a mesh. @param {Mesh} mesh @returns {Promise<ViewContent>} */
export async function photoOfMesh({ uvs, colors, textures, textureOf }) {
  const look = uvs && textures ? { uvs, textureOf, textures: await Promise.all(textures.map(canvasOf)) } : { colors };
  const layer = { surface: (/** @type {import('../surface/scene.js').Surface} */ plain) => ({ ...plain, ...look }) };
  return { layers: [layer, layer] };
}

/** A canvas with a picture. @param {NonNullable<Mesh['textures']>[number]} picture */
async function canvasOf(picture) {
  if ('data' in picture) return canvasFromImage(new ImageData(Uint8ClampedArray.from(picture.data), picture.width));
  const bitmap = await createImageBitmap(new Blob([new Uint8Array(picture)]));
  const canvas = Object.assign(document.createElement('canvas'), { width: bitmap.width, height: bitmap.height });
  canvas.getContext('2d')?.drawImage(bitmap, 0, 0);
  return canvas;
}
