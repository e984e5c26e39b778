/** How true pages are that a phone has seen, by its depths. */
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { DevelopableError, init, load, writePhoto } from '../../../pkg/direct.js';
import { depthCamera, finer, outline, poses, view } from '../phone/camera.mjs';
import { errorRate, missingReader, read } from '../phone/characters.mjs';
import { pages } from '../phone/pages.mjs';
import { DPI, prints } from '../phone/print.mjs';
import { photograph, sensed } from '../phone/sensor.mjs';
import { sampled, ways } from '../phone/surfaces.mjs';
import { alike, byItsShape, greyOf, rgba, turned } from '../phone/truth.mjs';
import { digits, percent } from '../text.mjs';

/** @typedef {import('../phone/print.mjs').Print} Print */

/** The surface that cannot be better. */
const shape = 'its own shape';

/** Least coverage, most errors for each by the page's own shape; so few that they may be chance. */
const target = { coverage: 0.95, errors: 1.5, few: 0.001 };
const most = (/** @type {string} */ page) => (page === 'crumpled' ? 0.008 : 0.005);

/** Share of the characters. @param {number} value */
const rate = (value) => (value === 0 ? '0 %' : percent(value));

/** Pixels of the photo for each of the depths, in each direction. */
const TIMES = 12;
const photoCamera = finer(depthCamera, TIMES);

/** Poses and standard deviations of noise, in millimetres. */
const conditions = [[0, 1], [0, 3], [1, 1], [1, 3]];

/** @param {{ quick: boolean }} bench */
export async function phone({ quick }) {
  await init();
  await load('files', 'images', 'meshes', 'unroll');
  const missing = await missingReader();
  if (missing) console.log(missing);
  const folder = await mkdtemp(join(tmpdir(), 'developable-phone-'));
  /** Errors of the OCR program in an image. @param {import('../phone/sensor.mjs').Grey} image @param {Print} print */
  const errors = async (image, { text }) =>
    (missing ? NaN : errorRate(await read(folder, writePhoto(rgba(image)), DPI), text));
  const rows = [];
  try {
    const { sheet, spread } = await prints();
    /** Shares of wrong characters over all scenes, by surface. @type {Map<string, number[]>} */
    const all = new Map();
    for (const page of quick ? pages.slice(0, 1) : pages) {
      const print = page.name === 'spread' ? spread : sheet;
      for (const [number, noise] of quick ? conditions.slice(0, 1) : conditions) {
        const pose = poses[number];
        const seen = view(page, pose, photoCamera);
        const photo = photograph(seen, print.fine, page);
        const scene = { page, seen, photo, crop: outline(page, pose, photoCamera) };
        const best = byItsShape(greyOf(photo), print.original, page, pose, photoCamera);
        const least = await errors(best, print);
        all.set(shape, [...all.get(shape) ?? [], least]);
        rows.push([page.name, pose.name, `${noise} mm`, shape, ...Array(4).fill(''), digits(alike(best, print.original)), missing ? '-' : rate(least), '']);
        const field = sampled(sensed(page, pose, depthCamera, noise), depthCamera, scene);
        let oracle = Infinity;
        for (const [name, way] of Object.entries(ways)) {
          const result = attempt(() => way(field, scene));
          if (typeof result === 'string') {
            rows.push([page.name, pose.name, `${noise} mm`, name, ...Array(6).fill('-'), result]);
            continue;
          }
          const { flat, truth } = result;
          const image = turned(greyOf(flat), print.original, page, truth.place);
          const found = await errors(image, print);
          all.set(name, [...all.get(name) ?? [], found]);
          const similar = alike(image, print.original);
          if (name === 'smoothed by the truth') oracle = truth.rms;
          const ours = name.startsWith('fitted') || name.startsWith('as the command');
          rows.push([
            page.name, pose.name, `${noise} mm`, name, percent(truth.rms), percent(truth.anisotropy),
            percent(truth.strain), percent(truth.coverage), Number.isNaN(similar) ? 'none' : digits(similar),
            missing ? '-' : rate(found), ours ? missed(truth, page.name, oracle, found, least) : '',
          ]);
          console.log(`  ${rows[rows.length - 1].join(', ')}`);
        }
      }
    }
    return table(rows, all, missing);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

/**
 * What there is, or the code of the error by which the library refuses it.
 * @template T
 * @param {() => T} make
 */
function attempt(make) {
  try {
    return make();
  } catch (problem) {
    if (problem instanceof DevelopableError) return problem.code;
    throw problem;
  }
}

/**
 * Which of the targets are missed.
 * @param {import('../phone/truth.mjs').Truth} truth
 * @param {string} page
 * @param {number} oracle displacement by the smoothed depths
 * @param {number} found share of characters that are wrong
 * @param {number} least the same by the page's own shape
 */
function missed({ rms, coverage }, page, oracle, found, least) {
  return Object.entries({
    RMS: rms > most(page),
    coverage: coverage < target.coverage,
    smoothed: rms > oracle,
    characters: found > Math.max(target.few, target.errors * least),
  }).flatMap(([name, is]) => (is ? [name] : [])).join(', ') || 'none';
}

/**
 * @param {string[][]} rows
 * @param {Map<string, number[]>} all
 * @param {string | undefined} missing
 */
function table(rows, all, missing) {
  const mean = (/** @type {number[]} */ values) => rate(values.reduce((sum, value) => sum + value, 0) / values.length);
  const flat = missing ? 'no OCR program was there'
    : `over all scenes ${[...all].map(([name, values]) => `${name}: ${mean(values)}`).join(', ')}`;
  return {
    title: "Pages from a phone's depth",
    text: `Printed A4 pages, curled, folded and mildly crumpled, and a spread of two A5 pages with its gutter, seen by a simulated phone: `
      + `a photo of ${photoCamera.width} × ${photoCamera.height} pixels, and depths of ${depthCamera.width} × ${depthCamera.height} in whole `
      + 'millimetres with smooth noise (a Gaussian kernel with a standard deviation of 2 pixels) of 1 or 3 mm, 120 dropouts, and mixtures of the page and a wall '
      + '25 cm behind it, or the table under it, at outlines. The first pose is tilted by 25°, the second by 12°, and turned by 18° and 7°. '
      + 'The page is cropped by 32 points of its outline in the photo. The photo resampled by the shape that the page has, which is the flat original with as many pixels to a letter as the photo has; the photo as it is; the depths unrolled as they are; smoothed by averages of '
      + 'neighbours, as many steps (one at least) as leave the least displacement, which takes knowing the truth; fitted by the '
      + 'nuclear norm at medium λ; by default (the energy `huber` and λ `auto`); and as `developable dewarp` does it: by one profile for all rulings where the depths are those of a cylinder, and else by default. Against the page itself: displacement after the best similarity (root mean square, in widths of the page), how much longer lengths are in '
      + 'one direction than in the other, the mean strain over 2 mm, the share of the page that is shown, the multi-scale structural similarity, and the share of '
      + `characters that the OCR program tesseract gets wrong at ${DPI} dots per inch (${flat}), both after the flat image is turned upright. `
      + 'Targets: 0.5 % of displacement, 0.8 % where crumpled, coverage of 95 %, at most 1.5 times as many characters wrong as by its own shape or 0.1 %, and less displacement '
      + 'than the smoothed depths; the last column has those that are missed.',
    columns: ['page', 'pose', 'noise', 'surface', 'RMS', 'anisotropy', 'strain', 'covered', 'similarity', 'characters', 'missed'],
    rows,
  };
}
