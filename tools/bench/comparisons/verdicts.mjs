/** How often the verdict on a flat image is true, over captures at random. */
import { DevelopableError, init, load } from '../../../pkg/direct.js';
import { depthCamera, finer, view } from '../phone/camera.mjs';
import { capture } from '../phone/captures.mjs';
import { photograph } from '../phone/sensor.mjs';
import { flattened, sampled } from '../phone/surfaces.mjs';

const photoCamera = finer(depthCamera, 4);

/** Displacement above which a flat image is wrong, in widths of the page. */
const MAX_RIGHT_DISPLACEMENT = 0.01;

/** Share of a flat image beside the page above which it is wrong. */
const MAX_RIGHT_SHARE_BESIDE = 0.05;

/** Lines of print on a page, with a margin; the photo's outline is found by the paper. */
function print() {
  const [width, height] = [840, 1188];
  const data = Uint8Array.from({ length: width * height }, (_, i) => {
    const [x, y] = [i % width, Math.floor(i / width)];
    const inked = x > 90 && x < 750 && y > 90 && y < 1000 && y % 24 < 9 && (x + 37 * Math.floor(y / 24)) % 60 < 48;
    return inked ? 60 : 235;
  });
  return { width, height, data };
}

/**
 * The share of a flat image that shows what is no page.
 * @param {Float32Array} map the place in the photo of each pixel
 * @param {Float32Array} places the place on the page of each pixel
 */
function shareBeside(map, places) {
  let [shown, beside] = [0, 0];
  for (let i = 0; i < places.length; i += 2) {
    if (Number.isNaN(map[i])) continue;
    shown += 1;
    beside += Number(Number.isNaN(places[i]));
  }
  return beside / shown;
}

/** @param {number[]} values */
const median = (values) => values.filter(Number.isFinite).sort((a, b) => a - b)[values.length >> 1];

/** @typedef {{ number: number, kind: string, crop: string, verdict: string, wrong: boolean, displacement: number }} Outcome */

/** @param {number} number @param {ReturnType<typeof print>} paper @param {boolean} isLidar @returns {Outcome} */
function outcome(number, paper, isLidar) {
  const { page, pose, crop, corners, depths } = capture(number, photoCamera, isLidar);
  const seen = view(page, pose, photoCamera);
  const scene = { page, seen, photo: photograph(seen, paper, page), crop: corners };
  const found = { number, kind: page.name, crop };
  try {
    const { flat, places, displacement } = flattened(sampled(depths, depthCamera, scene), scene);
    const wrong = displacement > MAX_RIGHT_DISPLACEMENT || shareBeside(flat.map, places) > MAX_RIGHT_SHARE_BESIDE;
    return { ...found, verdict: flat.verdict ?? '', wrong, displacement };
  } catch (problem) {
    if (!(problem instanceof DevelopableError)) throw problem;
    return { ...found, verdict: 'refused', wrong: true, displacement: NaN };
  }
}

/** @param {{ quick: boolean }} bench */
export async function verdicts({ quick }) {
  await init();
  await load('files', 'images', 'meshes', 'unroll');
  const paper = print();
  const some = (/** @type {number} */ length, isLidar = false) => Array.from({ length }, (_, number) => {
    const one = outcome(number, paper, isLidar);
    console.log(`  ${Object.values(one).join(', ')}`);
    return one;
  });
  const outcomes = some(quick ? 12 : 204);
  const lidar = some(quick ? 6 : 96, true);
  const sure = ['flat', 'unrolled'];
  const row = (/** @type {string} */ name, /** @type {Outcome[]} */ of) => {
    const count = (/** @type {(one: Outcome) => boolean} */ is) => String(of.filter(is).length);
    return [
      name, count(() => true), count(({ wrong }) => wrong),
      ...['flat', 'unrolled', 'stretched', 'doubtful', 'refused'].map((word) => count(({ verdict }) => verdict === word)),
      count(({ verdict, wrong }) => wrong && sure.includes(verdict)),
      count(({ verdict, wrong }) => !wrong && !sure.includes(verdict)),
      (100 * median(of.map(({ displacement }) => displacement))).toFixed(2),
    ];
  };
  const kinds = [...new Set(lidar.map(({ kind }) => kind))];
  const crops = [...new Set(outcomes.map(({ crop }) => crop))].sort();
  return {
    title: "Verdicts on pages from a phone's depth",
    text: 'Pages at random (flat, curled, folded, crumpled, on a cone, and spreads of books) at random poses before a wall or on a table, seen by '
      + 'a simulated phone: depths of 256 × 192 in whole millimetres, dropouts, mixtures at outlines; noise of 0.5 to 4 mm that is smooth over 0.7 to 3 pixels; crops of 32 points on the outline, exact and up to 6 '
      + 'pixels off, of four corners, and of corners 5 to 15 % within the page and 3 to 13 % beside it. An image is wrong where its displacement is more than 1 % of the page, '
      + 'or more than 5 % of it show what is beside the page. '
      + 'False trust: wrong, and called `flat` or `unrolled`. False alarm: right, and called something else. Then noise of 2 to 5 mm that is smooth over '
      + "2 to 4 pixels, as a phone's LiDAR has it, by the page's kind, with crops roughly along the outline. Last, the median displacement, in % of the width.",
    columns: ['crop', 'captures', 'wrong', 'flat', 'unrolled', 'stretched', 'doubtful', 'refused', 'false trust', 'false alarm', 'median'],
    rows: [
      ...crops.map((name) => row(name, outcomes.filter(({ crop }) => crop === name))), row('all', outcomes),
      ...kinds.map((name) => row(`LiDAR, ${name}`, lidar.filter(({ kind }) => kind === name))), row('LiDAR, all', lidar),
    ],
  };
}
