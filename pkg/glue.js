/**
 * The glue of all wasm files at once: for workers, whose bundle would have to be split otherwise (which not every bundler
 * does for a worker), and to load wasm synchronously.
 */
import { files, images, meshFits, meshes, patterns, solver, surfaces } from './instances.js';
import * as filesGlue from './wasm/files.js';
import * as fitmeshGlue from './wasm/fitmesh.js';
import * as imagesGlue from './wasm/images.js';
import * as meshesGlue from './wasm/meshes.js';
import * as patternsGlue from './wasm/patterns.js';
import * as solverGlue from './wasm/solver.js';
import * as unrollGlue from './wasm/unroll.js';

/** Lets all instances do without an import of their own. */
export function useGlue() {
  solver.use(solverGlue);
  files.use(filesGlue);
  images.use(imagesGlue);
  meshes.use(meshesGlue);
  meshFits.use(fitmeshGlue);
  surfaces.use(unrollGlue);
  patterns.use(patternsGlue);
}
