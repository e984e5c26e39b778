/**
 * Designs: pins and curves in space through which the surface passes; it is free everywhere else. Figs. 18 and 19 of the
 * paper show such surfaces.
 */

import { clampToUnit } from './surface/relief.js';

/** @import {Energy} from './api.js' */
/** @import {Input, Settings} from './session.js' */

/** @typedef {{ x: number, y: number, z: number }} Pin coordinates in sides of the square; x and y from 0 to 1, y up */

/**
 * @typedef {object} Design
 * @property {readonly Pin[]} pins
 * @property {readonly (readonly Pin[])[]} curves smooth curves, each through two pins or more
 * @property {boolean} clamped whether the border of the square has height 0
 */

/** @typedef {{ curve: number | null, index: number }} Handle address of a pin; `curve` is null for a pin of no curve */

/** Side of a design, in pixels. */
const DESIGN_SIDE_PIXELS = 100;
/** Number of samples on a curve between two of its pins, per pixel of the side. */
const CURVE_SAMPLES_PER_PIXEL = 2;
/** λ of a design with automatic λ: its input has no noise from which λ could be chosen. */
const DESIGN_LAMBDA = 1e6;

/** @param {number} x @param {number} y @param {number} z @returns {Pin} */
const pin = (x, y, z) => ({ x, y, z });
/** Five pins along an edge of the square. @param {(x: number) => number} height @param {(x: number, z: number) => Pin} place */
const edgePins = (height, place) => [0, 0.25, 0.5, 0.75, 1].map((x) => place(x, height(x)));
/** Curves along all four edges of the square, of the same heights. @param {(x: number) => number} height */
const borderCurves = (height) => [
  ...[0, 1].map((y) => edgePins(height, (x, z) => pin(x, y, z))),
  ...[0, 1].map((x) => edgePins(height, (y, z) => pin(x, y, z))),
];

/** Designs to start from. @type {Record<string, Design>} */
export const START_DESIGNS = {
  flat: { pins: [pin(0.5, 0.5, 0)], curves: [], clamped: true },
  tent: {
    pins: [pin(0.5, 0.5, 0.45)],
    curves: borderCurves((t) => 0.08 * Math.sin(Math.PI * t)),
    clamped: false,
  },
  roof: {
    pins: [],
    curves: borderCurves((t) => 0.3 * Math.sin(Math.PI * t)),
    clamped: false,
  },
  canopy: {
    pins: [pin(0, 0.5, 0.1), pin(1, 0.5, 0), pin(0.5, 0.55, 0.3)],
    curves: [
      edgePins((x) => 0.24 * Math.sin(Math.PI * x), (x, z) => pin(x, 0, z)),
      edgePins((x) => 0.1 * Math.sin(2 * Math.PI * x) + 0.05, (x, z) => pin(x, 1, z)),
    ],
    clamped: false,
  },
};

/** The input of a design. @param {Design} [designShape] @returns {Input} */
export function designInput(designShape = START_DESIGNS.canopy) {
  return { name: 'design', width: DESIGN_SIDE_PIXELS, height: DESIGN_SIDE_PIXELS, data: constraintsOf(designShape), pixelSize: 1, heightScale: 1, design: true, designShape };
}

/**
 * The constraints of a design, as an image of heights.
 * @param {Design} design
 * @returns {Float64Array} heights in pixels, NaN where there is no constraint
 */
export function constraintsOf({ pins, curves, clamped }) {
  const constraints = new Float64Array(DESIGN_SIDE_PIXELS * DESIGN_SIDE_PIXELS).fill(NaN);
  /** @param {Pin} pin */
  const constrain = ({ x, y, z }) => {
    const [col, row] = [Math.round(x * (DESIGN_SIDE_PIXELS - 1)), Math.round((1 - y) * (DESIGN_SIDE_PIXELS - 1))];
    constraints[row * DESIGN_SIDE_PIXELS + col] = z * DESIGN_SIDE_PIXELS;
  };
  if (clamped) {
    for (let i = 0; i < DESIGN_SIDE_PIXELS; i++) {
      const t = i / (DESIGN_SIDE_PIXELS - 1);
      for (const [x, y] of [[t, 0], [t, 1], [0, t], [1, t]]) constrain({ x, y, z: 0 });
    }
  }
  for (const curve of curves) for (const place of curvePlaces(curve, CURVE_SAMPLES_PER_PIXEL * DESIGN_SIDE_PIXELS)) constrain(place);
  for (const one of pins) constrain(one);
  return constraints;
}

/**
 * Samples the smooth curve through pins (Catmull-Rom spline).
 * @param {readonly Pin[]} pins
 * @param {number} steps number of samples between two pins
 */
export function curvePlaces(pins, steps) {
  const places = [];
  for (let i = 0; i + 1 < pins.length; i++) {
    const [b, c] = [pins[i], pins[i + 1]];
    const [a, d] = [pins[i - 1] ?? pointReflection(c, b), pins[i + 2] ?? pointReflection(b, c)];
    for (let k = 0; k <= steps; k++) {
      const t = k / steps;
      /** @param {'x' | 'y' | 'z'} axis */
      const at = (axis) => b[axis] + 0.5 * t * (c[axis] - a[axis]
        + t * (2 * a[axis] - 5 * b[axis] + 4 * c[axis] - d[axis] + t * (3 * (b[axis] - c[axis]) + d[axis] - a[axis])));
      places.push({ x: clampToUnit(at('x')), y: clampToUnit(at('y')), z: at('z') });
    }
  }
  return places;
}

/** The reflection of a pin in another, which extends a curve beyond its end. @param {Pin} pin @param {Pin} centre @returns {Pin} */
function pointReflection(pin, centre) {
  return { x: 2 * centre.x - pin.x, y: 2 * centre.y - pin.y, z: 2 * centre.z - pin.z };
}

/** The handles of all pins. @param {Design} design @returns {Handle[]} */
export function handlesOf({ pins, curves }) {
  return [
    ...pins.map((_, index) => ({ curve: null, index })),
    ...curves.flatMap((curve, i) => curve.map((_, index) => ({ curve: i, index }))),
  ];
}

/** The pin of a handle. @param {Design} design @param {Handle} handle */
export function pinAt({ pins, curves }, { curve, index }) {
  return (curve === null ? pins : curves[curve])[index];
}

/**
 * A copy of the design with one pin changed or removed.
 * @param {Design} design
 * @param {Handle} handle
 * @param {Partial<Pin> | null} change null removes the pin
 * @returns {Design}
 */
export function withPin(design, { curve, index }, change) {
  /** @param {readonly Pin[]} pins */
  const changePin = (pins) => pins.flatMap((one, i) => (i !== index ? [one] : change === null ? [] : [{ ...one, ...change }]));
  if (curve === null) return { ...design, pins: changePin(design.pins) };
  const curves = design.curves.map((pins, i) => (i === curve ? changePin(pins) : pins));
  // A curve with a single pin is removed.
  return { ...design, curves: curves.filter((pins) => pins.length > 1) };
}

/**
 * The energy of a solve: the one that was chosen, or the default for the input, which is also the package's.
 * @param {Pick<Input, 'design'> | null} input
 * @param {Settings['energy']} chosen
 * @returns {Energy}
 */
export function energyFor(input, chosen) {
  return chosen ?? (input?.design ? 'nuclear' : 'huber');
}

/**
 * The settings of a solve: a fixed λ replaces the automatic one of a design, and the paper's schedule has no gap, since it stops on residuals.
 * @param {Pick<Input, 'design'>} input
 * @param {Settings} settings
 * @returns {Omit<Settings, 'gap'> & { energy: Energy, gap?: number }}
 */
export function settingsFor(input, settings) {
  const { lambda, schedule, gap } = settings;
  return {
    ...settings,
    energy: energyFor(input, settings.energy),
    lambda: input.design && lambda === 'auto' ? DESIGN_LAMBDA : lambda,
    gap: schedule === 'paper' ? undefined : gap,
  };
}
