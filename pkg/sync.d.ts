/**
 * The synchronous API (`developable/direct`) with a synchronous start, from bytes that are there already.
 * @module developable/sync
 */
import type { PartName } from './direct.js';
import type { WasmModule } from './types.js';
export * from './direct.js';

/** Compiles the solver's wasm once. It may be repeated after a failure. */
export function initSync(input: ArrayBuffer | ArrayBufferView | WasmModule): void;
/** Compiles the wasm of other parts once each: `loadSync({ files: bytes })`. */
export function loadSync(inputs: Partial<Record<PartName, ArrayBuffer | ArrayBufferView | WasmModule>>): void;
