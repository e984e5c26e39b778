/** Edges of pages as they were traced in a photo: checked as far as JS has to. */
import { DevelopableError } from './errors.js';
import { count, tuple, typed } from './input.js';
import { optionsOf } from './options.js';
import { isRecord, reading, record, refuseUnknown, show } from './values.js';

/**
 * @typedef {{ beziers: boolean, points: Float64Array }} TraceInput
 * @typedef {{ sideways: boolean, edges: number, traces: TraceInput[], open: boolean }} EdgesInput `traces`: so many edges, then
 *   lines of text; `open`: nothing is said of these
 * @typedef {import('./types.js').DewarpPageOptions} Options
 */

const SIDES = /** @type {const} */ (['top', 'bottom', 'left', 'right']);

/** Most points of one edge, and most lines of text, as in Rust: to be refused before they are copied. */
const [MOST, LINES] = [100_000, 500];

/**
 * The edges of one page, or of the two pages of a spread.
 * @param {unknown} given
 * @returns {EdgesInput[]}
 */
export function asEdges(given) {
  const pages = reading('INPUT', 'the edges', () => (Array.isArray(given) ? given.slice(0, 3) : [given]));
  if (pages.length !== 1 && pages.length !== 2) {
    throw new DevelopableError('INPUT', 'the edges must be those of one page, or a list of the edges of both pages of a spread');
  }
  return pages.map(asPair);
}

/**
 * @param {unknown} given
 * @returns {EdgesInput}
 */
function asPair(given) {
  if (!isRecord(given)) {
    throw new DevelopableError('INPUT', `the edges must be { top, bottom } or { left, right }, but are ${show(given)}`);
  }
  refuseUnknown('INPUT', 'edge', given, [...SIDES, 'lines']);
  const { lines, ...edges } = record('INPUT', 'the edges', given, [...SIDES, 'lines']);
  const told = SIDES.filter((side) => edges[side] !== undefined);
  if (!['top bottom', 'left right', SIDES.join(' ')].includes(told.join(' '))) {
    throw new DevelopableError('INPUT', 'the edges must be `top` and `bottom`, or `left` and `right`: the two that are bent; or all four');
  }
  const sides = told.map((side) => asTrace(`the ${side} edge`, edges[side]));
  return { sideways: told[0] === 'left', edges: sides.length, traces: [...sides, ...(lines === undefined ? [] : asLines(lines))], open: lines === undefined };
}

/**
 * @param {unknown} given
 * @returns {TraceInput[]}
 */
function asLines(given) {
  if (!Array.isArray(given)) throw new DevelopableError('INPUT', '`lines` must be a list of lines of text, each a list of points [x, y]');
  const found = reading('INPUT', 'the lines of text', () => given.slice(0, LINES + 1));
  if (found.length > LINES) throw new DevelopableError('TOO_LARGE', `there are more than ${LINES} lines of text, which is the limit`);
  return found.map((line, number) => asTrace(`line ${number} of the text`, line));
}

/**
 * @param {string} what
 * @param {unknown} given
 * @returns {TraceInput}
 */
function asTrace(what, given) {
  return reading('INPUT', what, () => {
    if (Array.isArray(given)) return { beziers: false, points: pointsOf(what, given) };
    refuseUnknown('INPUT', `property of ${what}`, given, ['beziers']);
    return { beziers: true, points: pointsOf(what, record('INPUT', what, given, ['beziers']).beziers) };
  });
}

/**
 * @param {string} what
 * @param {unknown} list
 */
function pointsOf(what, list) {
  if (!Array.isArray(list)) {
    throw new DevelopableError('INPUT', `${what} must be a list of points [x, y], or { beziers } with such a list`);
  }
  if (list.length > MOST) {
    throw new DevelopableError('TOO_LARGE', `${what} has ${list.length} points, more than the limit of ${MOST}`);
  }
  const points = new Float64Array(2 * list.length);
  for (let i = 0; i < list.length; i += 1) {
    const point = list[i];
    const [x, y] = Array.isArray(point) && point.length === 2 ? point : [];
    if (typeof x !== 'number' || typeof y !== 'number') {
      throw new DevelopableError('INPUT', `point ${i} of ${what} must be two numbers [x, y], but is ${show(point)}`);
    }
    points.set([x, y], 2 * i);
  }
  return points;
}

/**
 * The same in the caller's form, as copies.
 * @param {EdgesInput[]} pages
 * @returns {import('./types.js').PageEdges[]}
 */
export function plainEdges(pages) {
  /** @type {(trace: TraceInput) => import('./types.js').EdgeTrace} */
  const plain = ({ beziers, points }) => {
    const list = Array.from({ length: points.length / 2 }, (_, i) =>
      /** @type {[number, number]} */ ([points[2 * i], points[2 * i + 1]]));
    return beziers ? { beziers: list } : list;
  };
  return pages.map(({ sideways, edges, traces, open }) => {
    const own = traces.slice(0, edges).map((trace, i) => [SIDES[sideways ? i + 2 : i], plain(trace)]);
    const all = { ...Object.fromEntries(own), ...(!open && { lines: traces.slice(edges).map(plain) }) };
    return /** @type {import('./types.js').PageEdges} */ (/** @type {unknown} */ (all));
  });
}

/**
 * What is needed of a page that was found in a photo, to flatten another photo of the same picture by it.
 * @param {unknown} given
 * @returns {Pick<import('./types.js').FlatPage, 'size' | 'unit'> & { warp: import('./types.js').PageWarp }}
 */
export function asFoundPage(given) {
  const { size, unit, warp } = record('INPUT', 'the page', given, ['size', 'unit', 'warp']);
  if ((unit !== 'mm' && unit !== 'page') || !isRecord(warp)) {
    throw new DevelopableError('INPUT', 'the page must be what `dewarpPage` has returned: { size, unit, warp }');
  }
  const { columns, rows, places } = record('INPUT', 'the warp of the page', warp, ['columns', 'rows', 'places']);
  return {
    size: /** @type {[number, number]} */ (tuple('size of the page', 2, size)),
    unit,
    warp: { columns: count('columns of the warp', columns), rows: count('rows of the warp', rows), places: typed(Float32Array, 'places of the warp', places) },
  };
}

/**
 * The options, with the focal length that the photo's file has told if none is given.
 * @param {unknown} photo
 * @param {Options & import('./index.js').HandOver} [given]
 * @returns {Partial<Options & import('./index.js').HandOver>}
 */
export function pageOptions(photo, given) {
  const { ruler, ...options } = optionsOf('dewarpPage', given);
  const { film35 } = record('INPUT', 'the photo', photo, ['film35']);
  const told = options.focalLength ?? options.fieldOfView ?? options.film35;
  return {
    ...options,
    ...(told === undefined && typeof film35 === 'number' && { film35 }),
    ...(ruler !== undefined && { ruler: asRuler(ruler) }),
  };
}

/**
 * @param {unknown} given
 * @returns {NonNullable<Options['ruler']>}
 */
function asRuler(given) {
  const { from, to, length } = record('OPTION', 'option `ruler`', given, ['from', 'to', 'length']);
  return reading('OPTION', 'option `ruler`', () => {
    const ends = [from, to].map((end) => {
      const [x, y] = Array.isArray(end) ? end : [];
      return /** @type {[number, number]} */ ([x, y]);
    });
    if ([...ends.flat(), length].some((value) => typeof value !== 'number')) {
      throw new DevelopableError(
        'OPTION', 'option `ruler` must be { from: [x, y], to: [x, y], length }: two places in the photo, and millimetres');
    }
    return { from: ends[0], to: ends[1], length: /** @type {number} */ (length) };
  });
}
