/** The promise API: one worker for all who do not want one of their own. Documented in `index.d.ts`. */
import { CALLS } from './calls.js';
import { DevelopableWorker } from './client.js';
import { optionsOf } from './options.js';
import { reading } from './values.js';

export { parseCamera } from './camera-file.js';
export { DevelopableError } from './errors.js';
export { describePage } from './page-words.js';
export { DevelopableWorker };

/** @typedef {import('./types.js').InitInput} InitInput */

/** @type {DevelopableWorker | undefined} */
let shared;

const worker = () => (shared ??= new DevelopableWorker());

/** @type {typeof import('./index.js').init} */
export async function init(options) {
  const places = isInitInput(options) ? { wasm: options } : optionsOf('worker', options);
  if (options !== undefined && !shared?.connected) shared = new DevelopableWorker(places);
  return worker().init();
}

/** Calls that the worker has besides those of `CALLS`. */
const OTHERS = /** @type {const} */ (['fit', 'open', 'fitMesh', 'paint', 'draw', 'explorePattern']);

/** The calls of the worker that all share. */
const forwarded = Object.fromEntries([...Object.keys(CALLS), ...OTHERS].map((name) => {
  const call = (/** @type {unknown[]} */ ...given) => {
    const shared = /** @type {Record<string, (...given: unknown[]) => unknown>} */ (/** @type {unknown} */ (worker()));
    return shared[name](...given);
  };
  return [name, Object.defineProperty(call, 'name', { value: name })];
}));

export const {
  fit, open, occlusions, read, formatOf, npzArrays, writeImage, writeObj, writeMtl, writePly, writeStl,
  writeGlb, readMesh, sampleMesh, fitMesh, backProject, recognizeMesh, paint, analyze,
  patches, picture, draw, rulings, fitCylinder, unroll, pattern, explorePattern, writeSvg, writePdf,
  writeDxf, dewarp, dewarpPage, flattenPhoto, findPage, readPhoto, writePhoto, writeBook, example,
} = /** @type {typeof import('./index.js')} */ (/** @type {unknown} */ (forwarded));

/** @type {typeof import('./index.js').dispose} */
export function dispose() {
  shared?.dispose();
  shared = undefined;
}

/**
 * @param {import('./index.js').WorkerOptions | InitInput | undefined} options
 * @returns {options is InitInput}
 */
function isInitInput(options) {
  return reading('OPTION', 'the options', () => (
    typeof options === 'string' ||
    options instanceof URL ||
    options instanceof ArrayBuffer ||
    ArrayBuffer.isView(options) ||
    options instanceof WebAssembly.Module ||
    (typeof Response === 'function' && options instanceof Response) ||
    (typeof options === 'object' && options !== null && 'then' in options)
  ));
}
