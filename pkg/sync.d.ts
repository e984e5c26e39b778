/** The synchronous API (`developable/direct`) with a synchronous start, from bytes that are there already. */
import type { PartName } from './direct.js';
export * from './direct.js';

/** Compiles the solver's wasm, once; may be repeated after a failure. */
export function initSync(input: ArrayBuffer | ArrayBufferView | WebAssembly.Module): void;
/** The same for other parts: `loadSync({ files: bytes })`. */
export function loadSync(inputs: Partial<Record<PartName, ArrayBuffer | ArrayBufferView | WebAssembly.Module>>): void;
