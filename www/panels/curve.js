/** Plot of the duality gap during a run: linear across, logarithmic up. */
import { oncePerFrame, element } from '../dom.js';
import { count, number, percentAtMost, seconds } from '../format.js';

/** @import {Progress, Report} from '../api.js' */
/** @import {Session} from '../session.js' */
/** @typedef {Pick<Progress, 'level' | 'iteration' | 'elapsed' | 'gap'>} Moment */

/** The plot's frame in the picture of `index.html`, in its units. */
const FRAME = { left: 54, top: 10, right: 592, bottom: 190 };
/** Maximum number of labels along each axis. */
const MAX_TICKS = 8;

/** @param {Session} session */
export function curvePanel(session) {
  const picture = element('curve-picture', SVGSVGElement);
  /** @type {Moment[]} */
  let moments = [];
  let target = session.settings.gap;
  const drawSoon = oncePerFrame(() => {
    picture.innerHTML = plot(moments, target);
  });
  /** @param {Moment} moment */
  const add = (moment) => {
    moments.push(moment);
    drawSoon();
  };
  const clear = () => {
    moments = [];
    picture.setAttribute('aria-label', 'No run yet');
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
    picture.setAttribute('aria-label', gapsInWords(moments));
  });
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
 * The elements of the plot.
 * @param {readonly Moment[]} moments
 * @param {number} target
 */
function plot(moments, target) {
  const { left, top, right, bottom } = FRAME;
  const end = Math.max(moments.at(-1)?.elapsed ?? 0, 0.01);
  const lowest = Math.min(target, ...moments.map(({ gap }) => gap ?? 0).filter((gap) => gap > 0));
  const [low, high] = [Math.floor(Math.log10(100 * lowest)), 2];
  /** @param {number} value */
  const x = (value) => (left + (value / end) * (right - left)).toFixed(1);
  /** @param {number} percent */
  const y = (percent) => (bottom - ((Math.log10(percent) - low) / (high - low)) * (bottom - top)).toFixed(1);
  /** @param {[number, number][]} points a value of NaN interrupts the line; a point alone is a dot */
  const path = (points) => points.map(([at, percent], i) => (Number.isNaN(percent) ? '' : `${i === 0 || Number.isNaN(points[i - 1][1]) ? 'M' : 'L'}${x(at)} ${y(percent)}h0`)).join('');
  const powers = Array.from({ length: high - low + 1 }, (_, i) => 10 ** (low + i)).filter((_, i) => i % Math.ceil((high - low + 1) / MAX_TICKS) === 0);
  return [
    ...powers.map((power) => `<path class="tick" d="M${left} ${y(power)}H${right}"/><text x="${left - 6}" y="${y(power)}" class="up">${number(power)} %</text>`),
    ...linearTicks(end, MAX_TICKS).map((tick) => `<text x="${x(tick)}" y="${bottom + 16}" class="across">${number(tick)}</text>`),
    `<path class="wanted" d="M${left} ${y(100 * target)}H${right}"/>`,
    `<path class="coarse" d="${path(gapsByLevel(moments, false))}"/>`,
    `<path class="finest" d="${path(gapsByLevel(moments, true))}"/>`,
  ].join('');
}

/**
 * Gaps in percent on the finest lattice, or on the others, with a break wherever the solve comes from another lattice.
 * @param {readonly Moment[]} moments
 * @param {boolean} finest
 * @returns {[number, number][]}
 */
export function gapsByLevel(moments, finest) {
  /** @type {[number, number][]} */
  const points = [];
  let level = NaN;
  for (const moment of moments) {
    const begins = moment.level !== level;
    level = moment.level;
    if ((level === 0) !== finest) continue;
    if (points.length > 0 && begins) points.push([moment.elapsed, NaN]);
    points.push([moment.elapsed, 100 * (moment.gap || NaN)]);
  }
  return points;
}

/**
 * Ticks of a linear axis: multiples of a round step from 0 on.
 * @param {number} max end of the axis
 * @param {number} maxCount approximate maximum number of ticks
 */
export function linearTicks(max, maxCount) {
  const minStep = max / Math.max(1, maxCount);
  const power = 10 ** Math.floor(Math.log10(minStep));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= minStep) ?? minStep;
  const ticks = [];
  for (let k = 0; k * step <= max * (1 + 1e-9); k++) ticks.push(k * step);
  return ticks;
}
