/** Plots of the objective, the dual bound and the duality gap during a run. */
import { oncePerFrame, element, matchDevicePixels } from '../dom.js';
import { count, percentAtMost, seconds } from '../format.js';
import { drawAxes, drawCurve, drawLegend, drawLevel } from '../plot.js';

/** @import {Progress, Report} from '../api.js' */
/** @import {Session} from '../session.js' */
/** @import {Axes, Curve} from '../plot.js' */

/** @typedef {Pick<Progress, 'level' | 'iteration' | 'elapsed' | 'objective' | 'dualBound' | 'gap'>} Moment */

/** Margins around a plot, in CSS pixels. */
const PLOT_MARGIN = { left: 54, right: 10, top: 22, bottom: 38 };
/** Minimum width of the canvas for two plots side by side, in CSS pixels. */
const MIN_SIDE_BY_SIDE_WIDTH_PX = 600;
/** Range of the energies that are plotted, as a factor of the final value upwards and downwards. */
const ENERGY_RANGE_FACTOR = 4;

/** @param {Session} session */
export function curvePanel(session) {
  const canvas = element('curve-canvas', HTMLCanvasElement);
  const axis = element('curve-axis', HTMLSelectElement);
  /** @type {Moment[]} */
  let moments = [];
  let target = session.settings.gap;

  const draw = () => drawPlots(canvas, moments, axis.value === 'iteration' ? 'iteration' : 'elapsed', target);
  const drawSoon = oncePerFrame(draw);
  /** @param {Moment} moment */
  const add = (moment) => {
    if (Number.isFinite(moment.objective) && moment.objective > 0) moments.push(moment);
    drawSoon();
  };
  const clear = () => {
    moments = [];
    canvas.setAttribute('aria-label', 'No run yet');
    drawSoon();
  };

  session.on('start', (settings) => {
    clear();
    target = settings.gap;
  });
  session.on('cleared', clear);
  session.on('progress', add);
  session.on('result', ({ surface: { report } }) => {
    add(finalMoment(report));
    canvas.setAttribute('aria-label', gapsInWords(moments));
  });
  axis.addEventListener('change', drawSoon);
  matchDevicePixels(canvas, draw);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', drawSoon);
}

/** @param {Report} report @returns {Moment} */
function finalMoment({ iterations, objective, dualBound, gap, seconds: { total } }) {
  return { level: 0, iteration: iterations, elapsed: total, objective, dualBound, gap };
}

/** The plots as a sentence, for screen readers. @param {readonly Moment[]} moments */
function gapsInWords(moments) {
  const certified = moments.filter((moment) => moment.level === 0);
  const [first, last] = [certified[0], certified[certified.length - 1]];
  if (!first) return 'Nothing to show';
  return `Gap from ${percentAtMost(first.gap)} to ${percentAtMost(last.gap)} in ${count(last.iteration)} iterations, ${seconds(last.elapsed)}`;
}

/**
 * @param {HTMLCanvasElement} canvas
 * @param {readonly Moment[]} moments
 * @param {'iteration' | 'elapsed'} along
 * @param {number} target
 */
function drawPlots(canvas, moments, along, target) {
  const context = canvas.getContext('2d');
  if (!context) return;
  const ratio = canvas.width / canvas.clientWidth;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  const { clientWidth: width, clientHeight: height } = canvas;
  context.clearRect(0, 0, width, height);

  const style = getComputedStyle(canvas);
  const colour = (/** @type {string} */ name) => style.getPropertyValue(name).trim();
  context.font = `12px ${style.fontFamily}`;
  const palette = { ink: colour('--ink'), muted: colour('--muted'), line: colour('--line') };

  const last = moments[moments.length - 1];
  const xMax = Math.max(last?.[along] ?? 0, along === 'iteration' ? 10 : 0.01);
  const isSideBySide = width >= MIN_SIDE_BY_SIDE_WIDTH_PX;
  const cell = { width: isSideBySide ? width / 2 : width, height: isSideBySide ? height : height / 2 };
  /** @param {number} col @param {number} row */
  const box = (col, row) => ({
    left: col * cell.width + PLOT_MARGIN.left,
    top: row * cell.height + PLOT_MARGIN.top,
    width: cell.width - PLOT_MARGIN.left - PLOT_MARGIN.right,
    height: cell.height - PLOT_MARGIN.top - PLOT_MARGIN.bottom,
  });
  const sharedAxes = { xMax, palette, xLabel: along === 'iteration' ? 'iterations' : 'seconds' };
  // Energies of coarser lattices are not comparable with the final ones, but their gaps are.
  const finest = moments.filter((moment) => moment.level === 0);
  /** @type {(some: readonly Moment[], key: 'objective' | 'dualBound') => [number, number][]} */
  const points = (some, key) => some.map((m) => [m[along], m[key]]);

  /** @type {Axes} */
  const energy = {
    ...sharedAxes, title: 'Energy', yRange: energyRange(finest), box: box(0, 0),
  };
  /** @type {Curve[]} */
  const bounds = [
    { label: 'objective', colour: colour('--curve-objective'), points: points(finest, 'objective') },
    { label: 'dual bound', colour: colour('--curve-bound'), points: points(finest, 'dualBound') },
  ];
  drawAxes(context, energy);
  drawLegend(context, energy, bounds);
  for (const curve of bounds) drawCurve(context, energy, curve);

  const minGap = Math.min(target, ...finest.map((m) => m.gap ?? 0).filter((gap) => gap > 0));
  /** @type {Axes} */
  const gap = {
    ...sharedAxes, title: 'Gap in %', yRange: [50 * minGap, 150],
    box: isSideBySide ? box(1, 0) : box(0, 1),
  };
  const coarse = { label: 'on coarser lattices', colour: colour('--edge'), points: gapsByLevel(moments, along, false) };
  drawAxes(context, gap);
  if (coarse.points.length > 0) drawLegend(context, gap, [coarse]);
  drawLevel(context, gap, 100 * target, 'wanted');
  drawCurve(context, gap, coarse);
  drawCurve(context, gap, { label: 'gap', colour: colour('--curve-gap'), points: gapsByLevel(moments, along, true) });
}

/**
 * Gaps in percent on the finest lattice, or on the others, with a break wherever the solve comes from another lattice.
 * @param {readonly Moment[]} moments
 * @param {'iteration' | 'elapsed'} along
 * @param {boolean} finest
 * @returns {[number, number][]}
 */
export function gapsByLevel(moments, along, finest) {
  /** @type {[number, number][]} */
  const points = [];
  let level = NaN;
  for (const moment of moments) {
    const begins = moment.level !== level;
    level = moment.level;
    if ((level === 0) !== finest) continue;
    if (points.length > 0 && begins) points.push([moment[along], NaN]);
    points.push([moment[along], 100 * (moment.gap ?? NaN)]);
  }
  return points;
}

/**
 * The range of energies around the last objective: the first ones may be so much larger that the last ones would look equal.
 * @param {readonly Moment[]} moments
 * @returns {[number, number]}
 */
function energyRange(moments) {
  const last = moments[moments.length - 1];
  if (!last) return [1, 10];
  const { objective } = last;
  const highest = Math.max(...moments.map((m) => m.objective));
  const lowest = Math.min(...moments.map((m) => m.dualBound).filter((bound) => bound > 0), objective);
  return [
    Math.max(lowest, objective / ENERGY_RANGE_FACTOR) / 1.2,
    Math.min(highest, objective * ENERGY_RANGE_FACTOR) * 1.2,
  ];
}
