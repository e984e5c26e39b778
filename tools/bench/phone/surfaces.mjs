/** Surfaces from a phone's depths. */
import { backProject, dewarp, fit, fitCylinder, sampleMesh } from '../../../pkg/direct.js';
import { displacement, placesOf } from './truth.mjs';

/**
 * @typedef {ReturnType<typeof sampleMesh>} Field
 * @typedef {import('../../../pkg/types.js').Photo} Photo
 * @typedef {{ page: import('./pages.mjs').Page, seen: import('./camera.mjs').View, photo: Photo, crop: [number, number][] }} Scene
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

/** Dots to the inch of flat images. */
const DPI = 150;

/**
 * The photo made flat as the command does it, and how far what it shows is displaced.
 * @param {Field} field
 * @param {Scene} scene
 */
export function flattened(field, { page, seen, photo, crop }) {
  const cylinder = fitCylinder(field);
  const surface = cylinder.report.verdict === 'cylinder' ? cylinder : fit(field);
  const flat = dewarp(surface, photo, { dots: DPI / 0.0254, crop });
  const places = placesOf(flat, seen);
  return { flat, places, displacement: displacement(flat, places, page) };
}
