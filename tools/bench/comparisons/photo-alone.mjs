/** How true pages are made flat by their edges in one photo. */
import { DevelopableError, dewarpPage, init, load, readPhoto, writePhoto } from '../../../pkg/direct.js';
import { depthCamera, finer, poses, project, seenFrom, view } from '../phone/camera.mjs';
import { layouts } from '../phone/layouts.mjs';
import { pages, upright } from '../phone/pages.mjs';
import { prints } from '../phone/print.mjs';
import { normal, photograph, shaded, smoothRow } from '../phone/sensor.mjs';
import { measure, placesOf } from '../phone/truth.mjs';
import { digits, percent } from '../text.mjs';

/**
 * @typedef {import('../phone/pages.mjs').Page} Page
 * @typedef {[number, number][]} Trace
 */

/** 12 megapixels, as the depths' camera. */
const camera = finer(depthCamera, 15.75);
/** How wrong traced points are, in pixels in each direction, and over how many of them that goes on. */
const [WRONG, SMOOTH] = [2, 2];
/** Along each edge of a page. */
const POINTS = 40;
/** Lines of text on a page, and points along each. */
const [LINES, LETTERS] = [24, 20];
/** Most displacement, in widths of a page. */
const target = 0.003;

/** What is known of a page: its edges alone, lines that are traced, too, or that are found in its photo. */
const WAYS = /** @type {const} */ (['edges', 'and lines', 'lines found', 'found in shadow']);

/** @param {{ quick: boolean }} bench */
export async function photoAlone({ quick }) {
  await init();
  await load('files', 'images', 'unroll');
  const printed = { ...await layouts(['text', 'columns']), spread: (await prints()).spread.fine };
  const { width, height } = camera;
  const blank = { width, height, data: new Uint8ClampedArray(4 * width * height) };
  /** @param {import('../phone/camera.mjs').View} seen @param {Page} page @param {typeof WAYS[number]} by */
  const photoOf = (seen, page, by) => {
    const rough = by === 'found in shadow';
    const photo = photograph(seen, printed[page.name === 'spread' ? 'spread' : rough ? 'columns' : 'text'], page);
    return rough ? readPhoto(writePhoto(shaded(photo), { format: 'jpeg', quality: 60 })) : photo;
  };
  const rows = [];
  for (const page of [upright, ...pages]) {
    const ofThisKind = page === upright || page.name === 'spread';
    const views = poses.map((pose) => ({ pose, seen: view(page, pose, camera) }));
    for (const { pose, seen } of views) for (const by of WAYS) {
      const photo = by === 'edges' || by === 'and lines' ? blank : photoOf(seen, page, by);
      const leaves = page.name === 'spread' ? 2 : 1;
      const results = Array.from({ length: quick ? 2 : 10 }, (_, seed) => {
        const edges = traced(page, pose, leaves, seed).map((own, leaf) => ({ ...own, lines: by === 'and lines' ? lined(page, pose, leaf, leaves, seed) : [] }));
        const format = /** @type {[number, number]} */ ([(1000 * page.width) / leaves, 1000 * page.height]);
        const options = { focalLength: camera.fx, centre: /** @type {[number, number]} */ ([camera.cx, camera.cy]) };
        try {
          const flat = dewarpPage(photo, edges, { ...options, page: format, dots: 2, findLines: photo !== blank });
          const { error, errorBound, verdict, lines, linesFound } = flat.report;
          return { word: verdict, error, errorBound, lines: Math.max(lines, linesFound), rms: leaves * measure(flat, placesOf(flat, seen), page).rms };
        } catch (problem) {
          if (!(problem instanceof DevelopableError && problem.code === 'EDGES')) throw problem;
          return { word: 'refused', error: NaN, errorBound: NaN, lines: NaN, rms: NaN };
        }
      });
      const made = results.filter(({ word }) => word !== 'refused');
      /** Root of the mean square. @param {number[]} values */
      const mean = (values) => Math.sqrt(values.reduce((sum, value) => sum + value * value, 0) / values.length);
      const rms = mean(made.map((one) => one.rms));
      const worst = Math.max(...made.map((one) => one.rms));
      const within = made.filter((one) => 100 * one.rms <= one.errorBound).length;
      /** @type {Map<string, number>} */
      const words = new Map();
      for (const { word } of results) words.set(word, (words.get(word) ?? 0) + 1);
      const figures = made.length === 0 ? ['-', '-', '-', '-', '-'] : [
        String(made.map((one) => one.lines).sort((a, b) => a - b)[made.length >> 1]),
        percent(rms), percent(worst), `${digits(mean(made.map(({ error }) => error)))} %`,
        `${within} of ${made.length}`,
      ];
      rows.push([
        page.name, pose.name.replace(/, (in|on).*/, ''), by, ...figures,
        [...words].map(([verdict, times]) => (words.size === 1 ? verdict : `${verdict} (${times})`)).join(', '),
        ofThisKind ? (rms > target ? 'RMS' : worst > target ? 'worst' : 'none') : (words.has('flat') || words.has('unrolled') ? 'verdict' : 'none'),
      ]);
      console.log(`  ${rows[rows.length - 1].join(', ')}`);
    }
  }
  return {
    title: 'Pages from a photo alone',
    text: `By ${POINTS} points along each of a page's bent edges in a photo of ${width} × ${height} pixels, which are wrong by ${WRONG} pixels in each direction, `
      + `smoothly along the edge, ${quick ? 2 : 10} times; with focal length and format known; and with ${LINES} lines of text besides, traced likewise by ${LETTERS} points each, the print turned by a fifth of a degree; or with lines that are found in the photo of a printed page: of text in one column, or of two columns with headings, a picture and a table, in shadow, with noise and as a JPEG file of low quality (a spread has text in both cases). Of these the number is that of the try in the middle. A page curled about upright rulings, and a spread of two pages, `
      + 'are of the kind that this is for; a page that is curled at a slant, a folded and a crumpled one are not. Displacement after the best similarity over all that is '
      + 'shown, in widths of a page (root mean square over all tries, and of the worst), what the report expects, in how many its bound of 95 % holds, and its verdict, or that it refuses the edges. '
      + 'Targets: 0.3 % for the pages of this kind; no word that the others are right.',
    columns: ['page', 'pose', 'by', 'lines', 'RMS', 'worst', 'expected', 'within bound', 'verdict', 'missed'],
    rows,
  };
}

/**
 * The upper and the lower edge of each page.
 * @param {Page} page
 * @param {import('../phone/camera.mjs').Pose} pose
 * @param {number} leaves pages beside each other
 * @param {number} seed
 */
function traced(page, pose, leaves, seed) {
  const space = seenFrom(page, pose);
  const count = leaves * (POINTS - 1) + 1;
  const next = normal(seed + 1);
  const [top, bottom] = [0, page.height].map((v) => {
    const [dx, dy] = [smoothRow(count, SMOOTH, next), smoothRow(count, SMOOTH, next)];
    return Array.from({ length: count }, (_, i) => {
      const [x, y] = project(camera, space((i / (count - 1)) * page.width, v));
      return /** @type {[number, number]} */ ([x + WRONG * dx[i], y + WRONG * dy[i]]);
    });
  });
  /** @param {number} k */
  const leaf = (k) => {
    const part = (/** @type {Trace} */ edge) => edge.slice(k * (POINTS - 1), (k + 1) * (POINTS - 1) + 1);
    return { top: part(top), bottom: part(bottom) };
  };
  return Array.from({ length: leaves }, (_, k) => leaf(k));
}

/**
 * Lines of text on one page, of which every fourth is short.
 * @param {Page} page
 * @param {import('../phone/camera.mjs').Pose} pose
 * @param {number} leaf
 * @param {number} leaves pages beside each other
 * @param {number} seed
 */
function lined(page, pose, leaf, leaves, seed) {
  const space = seenFrom(page, pose);
  const next = normal(1000 * (leaf + 1) + seed);
  const width = page.width / leaves;
  return Array.from({ length: LINES }, (_, line) => {
    const level = (0.1 + (0.8 * line) / (LINES - 1)) * page.height;
    const end = line % 4 === 3 ? 0.6 : 0.88;
    const [dx, dy] = [smoothRow(LETTERS, SMOOTH, next), smoothRow(LETTERS, SMOOTH, next)];
    return Array.from({ length: LETTERS }, (_, i) => {
      const along = (0.1 + ((end - 0.1) * i) / (LETTERS - 1)) * width;
      const [x, y] = project(camera, space(leaf * width + along, level + 0.0035 * (along - width / 2)));
      return /** @type {[number, number]} */ ([x + WRONG * dx[i], y + WRONG * dy[i]]);
    });
  });
}
