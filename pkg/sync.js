/** The synchronous API with a synchronous start. Documented in `sync.d.ts`. */
import { DevelopableError } from './errors.js';
import { useGlue } from './glue.js';
import { partOf, solver } from './instances.js';
import { isRecord, reading, show } from './values.js';

export * from './direct.js';

/** @type {typeof import('./sync.js').initSync} */
export function initSync(input) {
  useGlue();
  solver.initSync(input);
}

/** @type {typeof import('./sync.js').loadSync} */
export function loadSync(inputs) {
  if (!isRecord(inputs)) {
    throw new DevelopableError('OPTION', `loadSync takes an object of bytes, as { files: bytes }, not ${show(inputs)}`);
  }
  useGlue();
  for (const [name, input] of reading('OPTION', 'the parts to load', () => Object.entries(inputs))) {
    partOf(name).initSync(input);
  }
}
