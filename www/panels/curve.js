/** Plot of the duality gap during a run. */
import { oncePerFrame, element, matchDevicePixels } from '../dom.js';
import { count, percentAtMost, seconds } from '../format.js';
import { drawAxes, drawCurve, drawLegend, drawLevel } from '../plot.js';

/** @import {Progress, Report} from '../api.js' */
/** @import {Session} from '../session.js' */
/** @import {Axes} from '../plot.js' */

/** @typedef {Pick<Progress, 'level' | 'iteration' | 'elapsed' | 'gap'>} Moment */

/** Margins around the plot, in CSS pixels. */
const PLOT_MARGIN = { left: 54, right: 10, top: 22, bottom: 38 };
/** @param {Session} session */
export function curvePanel(session) {
  const canvas = element('curve-canvas', HTMLCanvasElement);
  const axis = element('curve-axis', HTMLSelectElement);
  /** @type {Moment[]} */
  let moments = [];
  let target = session.settings.gap;

  const draw = () => drawPlot(canvas, moments, axis.value === 'iteration' ? 'iteration' : 'elapsed', target);
  const drawSoon = oncePerFrame(draw);
  /** @param {Moment} moment */
  const add = (moment) => {
    moments.push(moment);
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
function finalMoment({ iterations, gap, seconds: { total } }) {
  return { level: 0, iteration: iterations, elapsed: total, gap };
}

/** The plot as a sentence, for screen readers. @param {readonly Moment[]} moments */
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
function drawPlot(canvas, moments, along, target) {
  const context = canvas.getContext('2d');
  if (!context) return;
  const ratio = canvas.width / canvas.clientWidth;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  const { clientWidth: width, clientHeight: height } = canvas;
  context.clearRect(0, 0, width, height);
  const style = getComputedStyle(canvas);
  const colour = (/** @type {string} */ name) => style.getPropertyValue(name).trim();
  context.font = `12px ${style.fontFamily}`;
  const { left, top, right, bottom } = PLOT_MARGIN;
  const minGap = Math.min(target, ...moments.filter(({ level }) => level === 0).map(({ gap }) => gap ?? 0).filter((gap) => gap > 0));
  /** @type {Axes} */
  const axes = {
    xMax: Math.max(moments.at(-1)?.[along] ?? 0, along === 'iteration' ? 10 : 0.01),
    yRange: [50 * minGap, 150],
    title: 'Gap in %',
    xLabel: along === 'iteration' ? 'iterations' : 'seconds',
    palette: { ink: colour('--ink'), muted: colour('--muted'), line: colour('--line') },
    box: { left, top, width: width - left - right, height: height - top - bottom },
  };
  const coarse = { label: 'on coarser lattices', colour: colour('--edge'), points: gapsByLevel(moments, along, false) };
  drawAxes(context, axes);
  if (coarse.points.length > 0) drawLegend(context, axes, coarse);
  drawLevel(context, axes, 100 * target, 'wanted');
  drawCurve(context, axes, coarse);
  drawCurve(context, axes, { label: 'gap', colour: colour('--curve-gap'), points: gapsByLevel(moments, along, true) });
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
