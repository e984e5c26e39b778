/**
 * Designs: pins and curves in space that a surface is to pass through, free everywhere else. In the way of
 * the paper's Figs. 18 and 19, where curves and points are given and the surface finds its folds.
 */

/** @import {Energy} from './api.js' */
/** @import {Input, Settings} from './session.js' */

/** @typedef {{ x: number, y: number, z: number }} Pin in sides of the square; x and y from 0 to 1, y up */

/**
 * @typedef {object} Design
 * @property {readonly Pin[]} pins
 * @property {readonly (readonly Pin[])[]} curves smooth, through two pins or more
 * @property {boolean} clamped whether its edge lies on the ground
 */

/** @typedef {{ curve: number | null, index: number }} Handle one of the pins, or one that a curve goes through */

/** Pixels along a side. */
const SIZE = 100;
/** Places on a curve between two of its pins, for each pixel along a side. */
const DENSE = 2;

/** @param {number} x @param {number} y @param {number} z @returns {Pin} */
const pin = (x, y, z) => ({ x, y, z });
/** @param {(x: number) => number} height @param {(x: number, z: number) => Pin} place */
const along = (height, place) => [0, 0.25, 0.5, 0.75, 1].map((x) => place(x, height(x)));
/** The same over all four edges. @param {(x: number) => number} height */
const around = (height) => [
  ...[0, 1].map((y) => along(height, (x, z) => pin(x, y, z))),
  ...[0, 1].map((x) => along(height, (y, z) => pin(x, y, z))),
];

/** To start from. @type {Record<string, Design>} */
export const STARTS = {
  flat: { pins: [pin(0.5, 0.5, 0)], curves: [], clamped: true },
  tent: {
    pins: [pin(0.5, 0.5, 0.45)],
    curves: around((t) => 0.08 * Math.sin(Math.PI * t)),
    clamped: false,
  },
  roof: {
    pins: [],
    curves: around((t) => 0.3 * Math.sin(Math.PI * t)),
    clamped: false,
  },
  canopy: {
    pins: [pin(0, 0.5, 0.1), pin(1, 0.5, 0), pin(0.5, 0.55, 0.3)],
    curves: [
      along((x) => 0.24 * Math.sin(Math.PI * x), (x, z) => pin(x, 0, z)),
      along((x) => 0.1 * Math.sin(2 * Math.PI * x) + 0.05, (x, z) => pin(x, 1, z)),
    ],
    clamped: false,
  },
};

/** @param {Design} [drawn] @returns {Input} */
export function designInput(drawn = STARTS.canopy) {
  return { name: 'design', width: SIZE, height: SIZE, data: constraintsOf(drawn), pixelSize: 1, heightScale: 1, design: true, drawn };
}

/**
 * The pixels through which the surface passes.
 * @param {Design} design
 * @returns {Float64Array} heights in pixels, NaN where the surface is free
 */
export function constraintsOf({ pins, curves, clamped }) {
  const constraints = new Float64Array(SIZE * SIZE).fill(NaN);
  /** @param {Pin} pin */
  const hold = ({ x, y, z }) => {
    const [col, row] = [Math.round(x * (SIZE - 1)), Math.round((1 - y) * (SIZE - 1))];
    constraints[row * SIZE + col] = z * SIZE;
  };
  if (clamped) {
    for (let i = 0; i < SIZE; i++) {
      const t = i / (SIZE - 1);
      for (const [x, y] of [[t, 0], [t, 1], [0, t], [1, t]]) hold({ x, y, z: 0 });
    }
  }
  for (const curve of curves) for (const place of curvePlaces(curve, DENSE * SIZE)) hold(place);
  for (const one of pins) hold(one);
  return constraints;
}

/**
 * Places on the smooth curve through pins (Catmull and Rom's).
 * @param {readonly Pin[]} pins
 * @param {number} steps between two of them
 */
export function curvePlaces(pins, steps) {
  const places = [];
  for (let i = 0; i + 1 < pins.length; i++) {
    const [b, c] = [pins[i], pins[i + 1]];
    const [a, d] = [pins[i - 1] ?? mirrored(c, b), pins[i + 2] ?? mirrored(b, c)];
    for (let k = 0; k <= steps; k++) {
      const t = k / steps;
      /** @param {'x' | 'y' | 'z'} axis */
      const at = (axis) => b[axis] + 0.5 * t * (c[axis] - a[axis]
        + t * (2 * a[axis] - 5 * b[axis] + 4 * c[axis] - d[axis] + t * (3 * (b[axis] - c[axis]) + d[axis] - a[axis])));
      places.push({ x: clamp(at('x')), y: clamp(at('y')), z: at('z') });
    }
  }
  return places;
}

/** Beyond an end. @param {Pin} of @param {Pin} at @returns {Pin} */
function mirrored(of, at) {
  return { x: 2 * at.x - of.x, y: 2 * at.y - of.y, z: 2 * at.z - of.z };
}

/** @param {number} value */
function clamp(value) {
  return Math.min(1, Math.max(0, value));
}

/** @param {Design} design @returns {Handle[]} */
export function handlesOf({ pins, curves }) {
  return [
    ...pins.map((_, index) => ({ curve: null, index })),
    ...curves.flatMap((curve, i) => curve.map((_, index) => ({ curve: i, index }))),
  ];
}

/** @param {Design} design @param {Handle} handle */
export function pinAt({ pins, curves }, { curve, index }) {
  return (curve === null ? pins : curves[curve])[index];
}

/**
 * The design with one of its pins elsewhere, or without it.
 * @param {Design} design
 * @param {Handle} handle
 * @param {Partial<Pin> | null} change
 * @returns {Design}
 */
export function changed(design, { curve, index }, change) {
  /** @param {readonly Pin[]} pins */
  const renewed = (pins) => pins.flatMap((one, i) => (i !== index ? [one] : change === null ? [] : [{ ...one, ...change }]));
  if (curve === null) return { ...design, pins: renewed(design.pins) };
  const curves = design.curves.map((pins, i) => (i === curve ? renewed(pins) : pins));
  // One pin alone is no curve.
  return { ...design, curves: curves.filter((pins) => pins.length > 1) };
}

/**
 * The energy of a solve: the one that was chosen, or the input's default, which the solver has as well.
 * @param {Pick<Input, 'design'> | null} input
 * @param {Settings['energy']} chosen
 * @returns {Energy}
 */
export function energyFor(input, chosen) {
  return chosen ?? (input?.design ? 'nuclear' : 'huber');
}

/**
 * The settings of a solve: a design has no noise to find λ by, and the paper's schedule stops on residuals instead of a gap.
 * @param {Pick<Input, 'design'>} input
 * @param {Settings} settings
 * @returns {Omit<Settings, 'gap'> & { energy: Energy, gap?: number }}
 */
export function settingsFor(input, settings) {
  const { lambda, schedule, gap } = settings;
  return {
    ...settings,
    energy: energyFor(input, settings.energy),
    lambda: input.design && lambda === 'auto' ? 1e6 : lambda,
    gap: schedule === 'paper' ? undefined : gap,
  };
}
