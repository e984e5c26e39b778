/** All options: what each call takes. What they are, the modules in `schema/` say. */
import * as file from './schema/file.js';
import * as fit from './schema/fit.js';
import {
  address, anything, callback, choice, flag, optionsIn, readOptions, several, signal, text, whole,
} from './schema/kinds.js';
import * as sheets from './schema/pattern.js';
import * as photo from './schema/photo.js';
import * as shape from './schema/shape.js';

const handOver = { transfer: { kind: flag, default: false } };
const progress = { onProgress: { kind: callback } };
const control = { signal: { kind: signal }, onAbort: { kind: choice('reject', 'keep') }, ...progress };
const exploration = {
  lambdas: { kind: several }, smallest: { kind: several }, sheets: { kind: whole }, signal: { kind: signal }, onPlan: { kind: callback },
};

/** The options of each call, by name. @satisfies {Record<string, import('./schema/kinds.js').Options>} */
export const OPTIONS = {
  solver: fit.solver,
  directFit: { ...fit.solver, ...progress },
  fit: { ...fit.solver, ...control, ...handOver },
  openFit: { ...fit.solver, ...control },
  meshSolver: fit.meshSolver,
  directFitMesh: { ...fit.meshSolver, ...progress },
  fitMesh: { ...fit.meshSolver, ...control },
  handOver,
  occlusions: fit.occlusions,
  analyze: shape.analyze,
  analyzeMesh: shape.analyzeMesh,
  patches: shape.patches,
  patchesMesh: shape.patchesMesh,
  picture: shape.picture,
  rulings: shape.rulings,
  rulingsMesh: shape.rulingsMesh,
  unroll: { ...shape.unroll, ...progress },
  ...file,
  ...photo,
  dewarp: { ...photo.dewarp, ...handOver },
  dewarpPage: { ...photo.dewarpPage, ...handOver, ...progress },
  flattenPhoto: { ...photo.flattenPhoto, ...handOver },
  writePhoto: { ...photo.writePhoto, ...handOver },
  pattern: { ...sheets.pattern, ...progress },
  unrollMesh: { ...sheets.unrollMesh, ...progress },
  patternMesh: { ...sheets.patternMesh, ...progress },
  recognizeMesh: {},
  writeSvg: sheets.writeSvg,
  writePdf: sheets.writePdf,
  explorePattern: { ...exploration, solver: { kind: optionsIn(fit.solver) }, pattern: { kind: optionsIn(sheets.pattern) } },
  explorePatternMesh: { ...exploration, solver: { kind: optionsIn(fit.meshSolver) }, pattern: { kind: optionsIn(sheets.patternMesh) } },
  writeObj: { materials: { kind: text } },
  writeGlb: { texture: { kind: anything } },
  worker: {
    ...fit.threading,
    workerUrl: { kind: address },
    wasm: { kind: anything },
    filesWasm: { kind: anything },
    imagesWasm: { kind: anything },
    meshesWasm: { kind: anything },
    fitmeshWasm: { kind: anything },
    unrollWasm: { kind: anything },
    patternsWasm: { kind: anything },
  },
};

/**
 * The options of a call, as a plain object without anything that is undefined.
 * @template {object} T
 * @param {keyof typeof OPTIONS} call
 * @param {T | undefined} given
 * @returns {Partial<T>}
 */
export function optionsOf(call, given) {
  return readOptions(OPTIONS[call], given);
}
