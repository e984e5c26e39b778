import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../../../', import.meta.url));
export const pkg = fileURLToPath(new URL('../../../pkg/', import.meta.url));
export const wasmFile = fileURLToPath(new URL('../../../pkg/wasm/developable_bg.wasm', import.meta.url));
