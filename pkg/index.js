/** The promise API: one worker for all who do not want one of their own. Documented in `index.d.ts`. */
import { DevelopableWorker } from './client.js';
import { optionsOf } from './options.js';
import { reading } from './values.js';

export { parseCamera } from './camera-file.js';
export { DevelopableError } from './errors.js';
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

/** @type {typeof import('./index.js').fit} */
export const fit = (input, options) => worker().fit(input, options);
/** @type {typeof import('./index.js').open} */
export const open = (input, options) => worker().open(input, options);
/** @type {typeof import('./index.js').occlusions} */
export const occlusions = (input, options) => worker().occlusions(input, options);
/** @type {typeof import('./index.js').read} */
export const read = (bytes, options) => worker().read(bytes, options);
/** @type {typeof import('./index.js').writeNpy} */
export const writeNpy = (input) => worker().writeNpy(input);
/** @type {typeof import('./index.js').writePng} */
export const writePng = (input) => worker().writePng(input);
/** @type {typeof import('./index.js').npzArrays} */
export const npzArrays = (bytes) => worker().npzArrays(bytes);
/** @type {typeof import('./index.js').writeTiff} */
export const writeTiff = (input) => worker().writeTiff(input);
/** @type {typeof import('./index.js').writeExr} */
export const writeExr = (input) => worker().writeExr(input);
/** @type {typeof import('./index.js').writeObj} */
export const writeObj = (input, options) => worker().writeObj(input, options);
/** @type {typeof import('./index.js').writeMtl} */
export const writeMtl = (picture) => worker().writeMtl(picture);
/** @type {typeof import('./index.js').writePly} */
export const writePly = (input) => worker().writePly(input);
/** @type {typeof import('./index.js').writeStl} */
export const writeStl = (input) => worker().writeStl(input);
/** @type {typeof import('./index.js').writeGlb} */
export const writeGlb = (input, options) => worker().writeGlb(input, options);
/** @type {typeof import('./index.js').readMesh} */
export const readMesh = (bytes, options) => worker().readMesh(bytes, options);
/** @type {typeof import('./index.js').sampleMesh} */
export const sampleMesh = (mesh, options) => worker().sampleMesh(mesh, options);
/** @type {typeof import('./index.js').fitMesh} */
export const fitMesh = (mesh, options) => worker().fitMesh(mesh, options);
/** @type {typeof import('./index.js').backProject} */
export const backProject = (input, camera, options) => worker().backProject(input, camera, options);
/** @type {typeof import('./index.js').analyzeMesh} */
export const analyzeMesh = (mesh, options) => worker().analyzeMesh(mesh, options);
/** @type {typeof import('./index.js').meshRulings} */
export const meshRulings = (mesh, options) => worker().meshRulings(mesh, options);
/** @type {typeof import('./index.js').unrollMesh} */
export const unrollMesh = (mesh, options) => worker().unrollMesh(mesh, options);
/** @type {typeof import('./index.js').patternMesh} */
export const patternMesh = (mesh, options) => worker().patternMesh(mesh, options);
/** @type {typeof import('./index.js').paint} */
export const paint = (input, picture, options) => worker().paint(input, picture, options);
/** @type {typeof import('./index.js').analyze} */
export const analyze = (input, options) => worker().analyze(input, options);
/** @type {typeof import('./index.js').patches} */
export const patches = (input, options) => worker().patches(input, options);
/** @type {typeof import('./index.js').picture} */
export const picture = (input, options) => worker().picture(input, options);
/** @type {typeof import('./index.js').draw} */
export const draw = (canvas, input, options) => worker().draw(canvas, input, options);
/** @type {typeof import('./index.js').rulings} */
export const rulings = (input, options) => worker().rulings(input, options);
/** @type {typeof import('./index.js').fitCylinder} */
export const fitCylinder = (input) => worker().fitCylinder(input);
/** @type {typeof import('./index.js').unroll} */
export const unroll = (input, options) => worker().unroll(input, options);
/** @type {typeof import('./index.js').pattern} */
export const pattern = (input, options) => worker().pattern(input, options);
/** @type {typeof import('./index.js').explorePattern} */
export const explorePattern = (input, options) => worker().explorePattern(input, options);
/** @type {typeof import('./index.js').explorePatternMesh} */
export const explorePatternMesh = (mesh, options) => worker().explorePatternMesh(mesh, options);
/** @type {typeof import('./index.js').writeSvg} */
export const writeSvg = (drawing) => worker().writeSvg(drawing);
/** @type {typeof import('./index.js').writePdf} */
export const writePdf = (drawing, options) => worker().writePdf(drawing, options);
/** @type {typeof import('./index.js').writeDxf} */
export const writeDxf = (drawing) => worker().writeDxf(drawing);
/** @type {typeof import('./index.js').dewarp} */
export const dewarp = (input, photo, options) => worker().dewarp(input, photo, options);
/** @type {typeof import('./index.js').dewarpPage} */
export const dewarpPage = (photo, edges, options) => worker().dewarpPage(photo, edges, options);
/** @type {typeof import('./index.js').readPhoto} */
export const readPhoto = (bytes) => worker().readPhoto(bytes);
/** @type {typeof import('./index.js').writePhoto} */
export const writePhoto = (photo, options) => worker().writePhoto(photo, options);
/** @type {typeof import('./index.js').example} */
export const example = (name, options) => worker().example(name, options);

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
