import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../../../', import.meta.url));
export const pkg = fileURLToPath(new URL('../../../pkg/', import.meta.url));
export const wasmFile = fileURLToPath(new URL('../../../pkg/wasm/solver_bg.wasm', import.meta.url));
export const filesWasmFile = fileURLToPath(new URL('../../../pkg/wasm/files_bg.wasm', import.meta.url));
export const imagesWasmFile = fileURLToPath(new URL('../../../pkg/wasm/images_bg.wasm', import.meta.url));
