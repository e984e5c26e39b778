/** Surfaces from a phone's depths: as they are, smoothed, and fitted. */
import { backProject, dewarp, fit, fitCylinder, sampleMesh } from '../../../pkg/direct.js';
import { DPI } from './print.mjs';
import { measure, placesOf } from './truth.mjs';

/**
 * @typedef {ReturnType<typeof sampleMesh>} Field
 * @typedef {import('../../../pkg/types.js').Photo} Photo
 * @typedef {{ page: import('./pages.mjs').Page, seen: import('./camera.mjs').View, photo: Photo, crop: [number, number][] }} Scene
 * @typedef {Photo & Pick<import('../../../pkg/types.js').Dewarped, 'map'> & Partial<Pick<import('../../../pkg/types.js').Dewarped, 'verdict'>>} Flat
 * @typedef {{ flat: Flat, places: Float32Array, truth: import('./truth.mjs').Truth }} Result
 */

/**
 * What the command makes of depths, in millimetres, for `--crop`.
 * @param {{ width: number, height: number, data: Float64Array }} depths
 * @param {import('./camera.mjs').Camera} camera
 * @param {Pick<Scene, 'photo' | 'crop'>} scene
 * @returns {Field}
 */
export function sampled(depths, { fx, fy, cx, cy }, { photo: { width, height }, crop }) {
  const mesh = backProject({ ...depths, noData: 0 }, { fx, fy, cx, cy, depthScale: 0.001 }, { crop, photo: { width, height } });
  return sampleMesh(mesh, { view: 'best-fit' });
}

/**
 * Each height and the mean of those around it, half each, so many times.
 * @template {{ rows: number, cols: number, heights: Float64Array }} F
 * @param {F} field
 * @param {number} steps
 * @returns {F}
 */
export function smoothed(field, steps) {
  const { rows, cols } = field;
  let heights = field.heights;
  for (let step = 0; step < steps; step += 1) {
    heights = heights.map((z, i) => {
      const [row, col] = [Math.floor(i / cols), i % cols];
      const left = row % 2 === 0 ? col : col - 1;
      const around = [[row, col - 1], [row, col + 1], [row - 1, left], [row - 1, left + 1], [row + 1, left], [row + 1, left + 1]];
      let [sum, count] = [0, 0];
      for (const [r, c] of around) {
        const other = r >= 0 && r < rows && c >= 0 && c < cols ? heights[r * cols + c] : NaN;
        if (Number.isNaN(other)) continue;
        sum += other;
        count += 1;
      }
      return count === 0 ? z : (z + sum / count) / 2;
    });
  }
  return { ...field, heights };
}

/** Pixels to the inch of flat images that are only measured. */
const COARSE = 50;

/**
 * The photo made flat, and how true that is.
 * @param {Parameters<typeof dewarp>[0]} surface
 * @param {Scene} scene
 * @param {number} [dpi]
 * @returns {Result}
 */
export function flattened(surface, { page, seen, photo, crop }, dpi = DPI) {
  const flat = dewarp(surface, photo, { dots: dpi / 0.0254, crop });
  return measured(flat, seen, page);
}

/** @param {Scene} scene @returns {Result} */
export function asItIs({ page, seen, photo, crop }) {
  const [left, top] = [0, 1].map((k) => Math.floor(Math.min(...crop.map((point) => point[k]))));
  const [right, bottom] = [0, 1].map((k) => Math.ceil(Math.max(...crop.map((point) => point[k]))));
  const [width, height] = [right - left + 1, bottom - top + 1];
  const map = new Float32Array(2 * width * height);
  const data = new Uint8ClampedArray(4 * width * height);
  for (let i = 0; i < width * height; i += 1) {
    const [x, y] = [left + (i % width), top + Math.floor(i / width)];
    map.set([x, y], 2 * i);
    const at = 4 * (y * photo.width + x);
    data.set(photo.data.subarray(at, at + 4), 4 * i);
  }
  return measured({ width, height, map, data }, seen, page);
}

/** @param {Flat} flat @param {Scene['seen']} seen @param {Scene['page']} page @returns {Result} */
function measured(flat, seen, page) {
  const places = placesOf(flat, seen);
  return { flat, places, truth: measure(flat, places, page) };
}

/**
 * Every way, by name.
 * @type {Record<string, (field: Field, scene: Scene) => Result>}
 */
export const ways = {
  'photo as it is': (_, scene) => asItIs(scene),
  'raw depth': (field, scene) => flattened(field, scene),
  'smoothed by the truth': (field, scene) => {
    let [best, least, now, done] = [field, Infinity, field, 0];
    for (const steps of [1, 2, 4, 8, 16, 32, 64, 128, 256]) {
      now = smoothed(now, steps - done);
      done = steps;
      const { rms } = flattened(now, scene, COARSE).truth;
      // From here on it only loses shape.
      if (rms > 1.2 * least) break;
      if (rms < least) [best, least] = [now, rms];
    }
    return flattened(best, scene);
  },
  'fitted at medium λ': (field, scene) => flattened(fit(field, { lambda: 'medium' }), scene),
  'fitted by default': (field, scene) => flattened(fit(field), scene),
  'as the command does': (field, scene) => {
    const cylinder = fitCylinder(field);
    return flattened(cylinder.report.verdict === 'cylinder' ? cylinder : fit(field), scene);
  },
};
