/** Every comparison there is, and the documents that show them. */
import { accuracy } from './comparisons/accuracy.mjs';
import { conic } from './comparisons/conic.mjs';
import { dewarping } from './comparisons/dewarping.mjs';
import { flattening } from './comparisons/flattening.mjs';
import { gaps } from './comparisons/gaps.mjs';
import { meshes } from './comparisons/meshes.mjs';
import { memory } from './comparisons/memory.mjs';
import { nativeAndWasm } from './comparisons/native-and-wasm.mjs';
import { phone } from './comparisons/phone.mjs';
import { phoneCommand } from './comparisons/phone-command.mjs';
import { photoAlone } from './comparisons/photo-alone.mjs';
import { pymeshlab } from './comparisons/pymeshlab.mjs';
import { restarts } from './comparisons/restarts.mjs';
import { schedules } from './comparisons/schedules.mjs';
import { sizes } from './comparisons/sizes.mjs';
import { verdicts } from './comparisons/verdicts.mjs';

/** @typedef {(bench: import('./bench.mjs').Bench) => Promise<import('./text.mjs').Table>} Comparison */

/**
 * Documents that the tables are written to.
 * @type {Record<string, { title: string, tables: Record<string, Comparison> }>}
 */
export const documents = {
  'benches/README.md': {
    title: 'Benchmarks',
    tables: {
      schedules,
      conic,
      'native-and-wasm': nativeAndWasm,
      sizes,
      memory,
      meshes,
      gaps,
      accuracy,
      restarts,
    },
  },
  'benches/dewarping.md': {
    title: 'Pages made flat, measured',
    tables: {
      dewarping,
      flattening,
      phone,
      'photo-alone': photoAlone,
      'phone-command': phoneCommand,
    },
  },
};

/**
 * Every comparison there is, by the name that chooses it.
 * @type {Record<string, Comparison>}
 */
export const tables = { ...documents['benches/README.md'].tables, ...documents['benches/dewarping.md'].tables, verdicts, pymeshlab };

/** Comparisons with other programs: the authors' algorithm, a conic solver, and filters of pymeshlab. */
export const peers = ['schedules', 'conic', 'pymeshlab'];
