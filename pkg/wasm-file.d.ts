import type { WasmModule } from './types.js';

/**
 * What an import of one of the wasm files gives depends on the tool: its address (Vite with `?url`,
 * webpack's `asset/resource`, esbuild's loader `file`), its bytes (esbuild's loader `binary`,
 * `with { type: 'bytes' }`) or a module. Each is what `init` and `WorkerOptions` take.
 */
declare const file: string | Uint8Array | WasmModule;
export default file;
