/** A solve in wasm from where an earlier one has left the solver. */
import { Solver } from '../../pkg/direct.js';
import { optionsOf } from './task.mjs';

/** @typedef {import('./task.mjs').Settings} Settings */

/**
 * @param {ConstructorParameters<typeof Solver>[0]} input
 * @param {Settings} from
 * @param {Settings} to
 */
export function restart(input, from, to) {
  const solver = new Solver(input, optionsOf(from));
  try {
    while (solver.advance(50));
    const start = performance.now();
    solver.restart(optionsOf(to));
    while (solver.advance(50));
    const surface = solver.surface();
    return { surface, seconds: (performance.now() - start) / 1000 };
  } finally {
    solver.dispose();
  }
}
