/** The view of the photo of heights, the textures of a mesh, or their colours. */
import { gridOf } from '../surface/lattice.js';
import { canvasFromImage, canvasFromPixels } from '../surface/layer.js';
import { callWorker } from '../surface/worker-client.js';

/** Minimum length of a layer's longer side, in pixels. */
const MIN_LAYER_PIXELS = 900;

/** Whether an input has a photo or colours. @param {Input} input */
export function hasColours({ photo, lattice }) {
  return (photo !== undefined && lattice?.uvs !== undefined) || lattice?.colors !== undefined;
}

/**
 * The view of the photo of heights, or of their colours.
 * @param {Input} input
 * @returns {Promise<ViewContent>}
 */
export async function photo({ lattice, ...input }) {
  if (!lattice) return {};
  const coarse = gridOf({ ...input, lattice });
  const finer = Math.max(1, Math.ceil(MIN_LAYER_PIXELS / Math.max(coarse.width, coarse.height)));
  const grid = { ...coarse, width: coarse.width * finer, height: coarse.height * finer, pixelSize: coarse.pixelSize / finer };
  const { rows, cols, spacing, origin, uvs, colors } = lattice;
  const image = input.photo?.image;
  const seen = image && uvs ? { image: { width: image.width, height: image.height, data: image.data }, uvs } : { colors };
  const layer = { image: canvasFromPixels(grid, await callWorker('photoPixels', { rows, cols, spacing, origin }, seen, grid)) };
  return { layers: [layer, layer] };
}

/**
 * The view of the textures or colours of a mesh.
 * @param {Mesh} mesh
 * @param {Mesh} surface its result
 * @returns {Promise<ViewContent>}
 */
export async function photoOfMesh({ positions, triangles, uvs, colors, textures, textureOf }, surface) {
  const look = uvs && textures ? { uvs, textureOf, textures: await Promise.all(textures.map(canvasOf)) } : { colors };
  return { layers: [{ surface: { positions, triangles, ...look } }, { surface: { positions: surface.positions, triangles, ...look } }] };
}

/** A canvas with a picture. @param {NonNullable<Mesh['textures']>[number]} picture */
async function canvasOf(picture) {
  if ('data' in picture) return canvasFromImage(new ImageData(Uint8ClampedArray.from(picture.data), picture.width));
  const bitmap = await createImageBitmap(new Blob([new Uint8Array(picture)]));
  const canvas = Object.assign(document.createElement('canvas'), { width: bitmap.width, height: bitmap.height });
  canvas.getContext('2d')?.drawImage(bitmap, 0, 0);
  return canvas;
}
