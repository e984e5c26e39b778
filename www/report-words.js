/** Explanations of the rows of the report. */
import { count } from './format.js';

/** Explanations, by the quantity of the row. */
export const REPORT_WORDS = {
  gap: 'No surface has an energy that is lower by more than this share.',
  noGap: 'The energy is almost zero, so a share of it would say nothing.',
  objective: 'The energy of the result: fidelity and bending together.',
  fidelity: 'How far the result is from the input: λ times the squared distances.',
  nuclearNorm: 'How much the result bends and creases.',
  dualBound: 'The proof: no surface at all has a lower energy.',
  interior: 'These vertices have all six neighbours. Curvature is measured there.',
  boundary: 'These vertices lie at the border.',
  omitted: 'These vertices have too few neighbours. Their heights follow from the nearest ones.',
  torn: 'The surface is torn here, so its curvature is not measured.',
  held: 'You fixed these heights.',
  free: 'These heights follow from the surface around them.',
  parts: 'The surface has unconnected parts. Each was solved by itself.',
  lambda: 'The detail that is kept: a larger λ stays closer to the input.',
  /** @param {number} passes */
  creases: (passes) => `These vertices lie on creases, which were sharpened ${passes === 1 ? 'once' : `${count(passes)} times`}. The proof is about the last time.`,
  /** @param {number} finest */
  iterations: (finest) => `Steps of the solver (ADMM), ${count(finest)} of them on the finest lattice.`,
  heights: 'Root mean square distance from the true surface, in the example’s unit.',
};
