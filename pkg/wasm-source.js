/** From whatever says where the wasm is to a compiled module. */
import { wasmCopy } from './copies.js';
import { messageOf } from './errors.js';
import { builtin } from './platform.js';

/** @typedef {import('./types.js').InitInput} InitInput */

/**
 * @param {InitInput} input
 * @returns {Promise<WebAssembly.Module>}
 */
export async function compile(input) {
  const source = await input;
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) {
    return WebAssembly.compile(/** @type {BufferSource} */ (source));
  }
  if (typeof Response === 'function' && source instanceof Response) return compileResponse(source);
  if (typeof source === 'string' || source instanceof URL) {
    const url = locate(source);
    const files = url.protocol === 'file:' ? builtin('node:fs/promises') : undefined;
    // Node's fetch does not read files.
    return files
      ? WebAssembly.compile(/** @type {BufferSource} */ (await files.readFile(url)))
      : compileResponse(await fetch(url));
  }
  throw new TypeError('expected a URL, a Response, bytes, a WebAssembly.Module or a promise of one');
}

/**
 * One of the package's own files: the one beside its modules, or else the copy that a bundle has.
 * @param {import('./copies.js').WasmName} name
 * @param {() => URL} place
 * @returns {Promise<WebAssembly.Module>}
 */
export async function compileOwn(name, place) {
  try {
    return await compile(place());
  } catch (cause) {
    const found = await inSources(name) ?? await wasmCopy(name);
    if (found) return WebAssembly.compile(found);
    throw new Error(
      `${messageOf(cause)}; if ${name}_bg.wasm is at another place, pass its address (see "Bundlers" in the README)`,
      { cause },
    );
  }
}

/**
 * In a server's bundle that has other places in mind: the file in the package's own folder.
 * @param {string} name
 */
async function inSources(name) {
  const files = builtin('node:fs/promises');
  try {
    return files && new Uint8Array(await files.readFile(new URL(import.meta.url.replace(/[^/]*$/, `wasm/${name}_bg.wasm`))));
  } catch {
    return undefined;
  }
}

/**
 * An absolute URL; relative ones count from the page, in Node from the current folder.
 * @param {string | URL} place
 * @returns {URL}
 */
export function locate(place) {
  if (place instanceof URL) return place;
  const base = globalThis.document?.baseURI ?? globalThis.location?.href;
  if (base !== undefined) return new URL(place, base);
  // A drive letter is no scheme.
  if (URL.canParse(place) && !/^[a-z]:[\\/]/i.test(place)) return new URL(place);
  const url = builtin('node:url');
  return url ? url.pathToFileURL(place) : new URL(place);
}

/**
 * @param {Response} response
 * @returns {Promise<WebAssembly.Module>}
 */
async function compileResponse(response) {
  if (!response.ok) throw new Error(`${response.url || 'the server'} answered ${response.status}`);
  // Streaming insists on the media type, which not every server sends.
  const type = response.headers.get('content-type') ?? '';
  return type.startsWith('application/wasm') && WebAssembly.compileStreaming !== undefined
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}
