/**
 * Copies of the worker's script and of the wasm as JavaScript, for bundles without the files: esbuild
 * and Rollup leave `new URL('./file', import.meta.url)` as it is, and the file behind. They follow
 * `import()`. Where the files are brought along the copies stay out of the bundle: webpack and
 * Turbopack are told so by the comments, Parcel by `alias` in package.json, and Vite drops what a
 * constant of its builds excludes.
 */

/** @typedef {'solver' | 'files' | 'images' | 'meshes' | 'fitmesh' | 'unroll' | 'patterns'} WasmName */
/** @typedef {() => Promise<{ default: string }>} Packed gzipped, in base64 */

// @ts-ignore Vite looks for exactly this, and nobody else has it.
const isViteBuild = import.meta.env?.PROD;

/** @type {Packed} */
const worker = () => import(/* webpackIgnore: true */ /* turbopackIgnore: true */ './inline/worker.js');

/** @type {Record<WasmName, Packed>} */
const wasm = {
  solver: () => import(/* webpackIgnore: true */ /* turbopackIgnore: true */ './inline/solver.js'),
  files: () => import(/* webpackIgnore: true */ /* turbopackIgnore: true */ './inline/files.js'),
  images: () => import(/* webpackIgnore: true */ /* turbopackIgnore: true */ './inline/images.js'),
  meshes: () => import(/* webpackIgnore: true */ /* turbopackIgnore: true */ './inline/meshes.js'),
  fitmesh: () => import(/* webpackIgnore: true */ /* turbopackIgnore: true */ './inline/fitmesh.js'),
  unroll: () => import(/* webpackIgnore: true */ /* turbopackIgnore: true */ './inline/unroll.js'),
  patterns: () => import(/* webpackIgnore: true */ /* turbopackIgnore: true */ './inline/patterns.js'),
};

/** The worker's script, if the bundle has a copy. */
export const workerCopy = () => unpacked(isViteBuild ? undefined : worker);

/** @type {(name: WasmName) => Promise<Uint8Array<ArrayBuffer> | undefined>} */
let supply = (name) => unpacked(isViteBuild ? undefined : wasm[name]);

/**
 * A wasm file, if the bundle has a copy.
 * @param {WasmName} name
 */
export const wasmCopy = (name) => supply(name);

/**
 * For a script that is a copy itself, with nothing beside it: where to get the others.
 * @param {typeof supply} source
 */
export function takeCopiesFrom(source) {
  supply = source;
}

/**
 * @param {Packed} [load]
 * @returns {Promise<Uint8Array<ArrayBuffer> | undefined>}
 */
async function unpacked(load) {
  const copy = await load?.().catch(() => undefined);
  // Parcel has an empty module in its place.
  if (typeof copy?.default !== 'string') return undefined;
  const bytes = Uint8Array.from(atob(copy.default), (char) => char.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
