/** The wasm files: the solver, and what else there is, which not everybody needs. */
import { Instance } from './instance.js';
import * as filesGlue from './wasm/files.js';
import * as imagesGlue from './wasm/images.js';
import * as meshesGlue from './wasm/meshes.js';
import * as patternsGlue from './wasm/patterns.js';
import * as solverGlue from './wasm/solver.js';
import * as unrollGlue from './wasm/unroll.js';

export const solver = new Instance(
  solverGlue,
  new URL('./wasm/solver_bg.wasm', import.meta.url),
  'init()',
);

export const files = new Instance(
  filesGlue,
  new URL('./wasm/files_bg.wasm', import.meta.url),
  'initFiles()',
);

export const images = new Instance(
  imagesGlue,
  new URL('./wasm/images_bg.wasm', import.meta.url),
  'initImages()',
);

export const meshes = new Instance(
  meshesGlue,
  new URL('./wasm/meshes_bg.wasm', import.meta.url),
  'initMeshes()',
);

export const sheets = new Instance(
  unrollGlue,
  new URL('./wasm/unroll_bg.wasm', import.meta.url),
  'initUnroll()',
);

export const patterns = new Instance(
  patternsGlue,
  new URL('./wasm/patterns_bg.wasm', import.meta.url),
  'initPatterns()',
);
