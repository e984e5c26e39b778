/** The wasm files: the solver, and what else there is, which not everybody needs. */
import { DevelopableError } from './errors.js';
import { Instance } from './instance.js';
import { unknownName } from './nearest.js';

// Bundlers look for exactly such imports and URLs.

export const solver = new Instance(
  'solver',
  () => import('./wasm/solver.js'),
  () => new URL('./wasm/solver_bg.wasm', import.meta.url),
);

export const files = new Instance(
  'files',
  () => import('./wasm/files.js'),
  () => new URL('./wasm/files_bg.wasm', import.meta.url),
);

export const images = new Instance(
  'images',
  () => import('./wasm/images.js'),
  () => new URL('./wasm/images_bg.wasm', import.meta.url),
);

export const meshes = new Instance(
  'meshes',
  () => import('./wasm/meshes.js'),
  () => new URL('./wasm/meshes_bg.wasm', import.meta.url),
);

export const meshFits = new Instance(
  'fitmesh',
  () => import('./wasm/fitmesh.js'),
  () => new URL('./wasm/fitmesh_bg.wasm', import.meta.url),
);

export const surfaces = new Instance(
  'unroll',
  () => import('./wasm/unroll.js'),
  () => new URL('./wasm/unroll_bg.wasm', import.meta.url),
);

export const patterns = new Instance(
  'patterns',
  () => import('./wasm/patterns.js'),
  () => new URL('./wasm/patterns_bg.wasm', import.meta.url),
);

/** All of them but the solver, by the names that `load` takes. */
const parts = { files, images, meshes, fitmesh: meshFits, unroll: surfaces, patterns };

/** @typedef {keyof typeof parts} PartName */

/**
 * @param {string} name
 * @returns {Instance<any>}
 */
export function partOf(name) {
  if (Object.hasOwn(parts, name)) return parts[/** @type {PartName} */ (name)];
  throw new DevelopableError('OPTION', unknownName('part', name, Object.keys(parts)));
}
