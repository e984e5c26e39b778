/** Every comparison there is, and the document that shows them. */
import { accuracy } from './comparisons/accuracy.mjs';
import { conic } from './comparisons/conic.mjs';
import { gaps } from './comparisons/gaps.mjs';
import { meshes } from './comparisons/meshes.mjs';
import { memory } from './comparisons/memory.mjs';
import { pymeshlab } from './comparisons/pymeshlab.mjs';
import { restarts } from './comparisons/restarts.mjs';
import { schedules } from './comparisons/schedules.mjs';
import { sizes } from './comparisons/sizes.mjs';
import { verdicts } from './comparisons/verdicts.mjs';

/** @typedef {(bench: import('./bench.mjs').Bench) => Promise<import('./text.mjs').Table>} Comparison */

/** The document that the tables below are written to, and its title. */
export const document = { path: 'benches/README.md', title: 'Benchmarks' };

/** @type {Record<string, Comparison>} */
export const documentTables = {
  schedules,
  conic,
  sizes,
  memory,
  meshes,
  gaps,
  accuracy,
  restarts,
};

/** Every comparison there is, by the name that chooses it. @type {Record<string, Comparison>} */
export const tables = { ...documentTables, verdicts, pymeshlab };

/** Comparisons with other programs: the authors' algorithm, a conic solver, and filters of pymeshlab. */
export const peers = ['schedules', 'conic', 'pymeshlab'];
