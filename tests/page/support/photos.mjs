/** Photos of a curled page of dots, whose places are known in closed form, and what became of the dots. */
import { init, load, readPhoto, writePhoto } from '../../../pkg/direct.js';
import { similarity } from '../../../tools/bench/phone/fitting.mjs';
import { meets } from '../../js/support/phone.mjs';

await init();
await load('files');

/** @typedef {[x: number, y: number]} Place */
/** @typedef {{ width: number, height: number, data: Uint8Array | Uint8ClampedArray }} Pixels RGBA */

/** A phone's camera, 43 cm from an A4 page that is tilted by 25°. */
export const camera = { width: 800, height: 600, fx: 640, fy: 640, cx: 394, cy: 303 };
const [radius, tilt, away, wide, high] = [0.12, (25 * Math.PI) / 180, 0.43, 0.21, 0.297];
/** Dots across and down, at the middles of equal cells. */
export const dots = { across: 6, down: 8 };

/**
 * Where a place of the page is seen, in shares of its width and height from its upper left corner.
 * @param {number} s
 * @param {number} t
 * @returns {Place}
 */
export function seen(s, t) {
  const angle = ((s - 0.5) * wide) / radius;
  const [u, v, w] = [radius * Math.sin(angle), (t - 0.5) * high + Math.sin(tilt) * away, radius * (1 - Math.cos(angle)) + Math.cos(tilt) * away];
  const [y, z] = [Math.cos(tilt) * v - Math.sin(tilt) * w, Math.sin(tilt) * v + Math.cos(tilt) * w];
  return [camera.cx + (camera.fx * u) / z, camera.cy + (camera.fy * y) / z];
}

/**
 * A page of dots on a ground.
 * @param {{ page: number, ground: number }} [greys]
 * @param {readonly number[]} [tint] factors of red, green and blue
 * @returns {Buffer} a PNG
 */
export function dottedPhoto({ page, ground } = { page: 240, ground: 60 }, tint = [1, 1, 1]) {
  const { width, height } = camera;
  const data = new Uint8Array(4 * width * height).fill(255);
  const grey = (/** @type {number} */ col, /** @type {number} */ row) => {
    const place = meets(camera, col, row);
    if (!place) return ground;
    const [s, t] = [(place[1] / wide + 0.5) * dots.across, (place[2] / high + 0.5) * dots.down];
    const [ds, dt] = [(s % 1) - 0.5, (t % 1) - 0.5];
    return Math.hypot((ds * wide) / dots.across, (dt * high) / dots.down) < 0.008 ? 20 : page;
  };
  for (let i = 0; i < width * height; i++) {
    const [col, row] = [i % width, Math.floor(i / width)];
    let sum = 0;
    for (const [dx, dy] of [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]]) sum += grey(col + dx, row + dy);
    tint.forEach((factor, k) => (data[4 * i + k] = (factor * sum) / 4));
  }
  return png({ width, height, data });
}

/** A PNG of RGBA bytes. @param {Pixels} pixels */
export const png = (pixels) => Buffer.from(writePhoto(pixels));

/** The pixels of a PNG. @param {Buffer} bytes @returns {Pixels} */
export const parsePng = (bytes) => readPhoto(bytes);

export const LEVEL_WIDTH = 400;
/** An A4 page with an orange square, seen from straight above, which is flattened in half the time of a curled one. */
export const levelPhoto = png({ width: LEVEL_WIDTH, height: 300, data: new Uint8Array(4 * LEVEL_WIDTH * 300).map((_, i) => {
  const [x, y, channel] = [(i >> 2) % LEVEL_WIDTH, Math.floor((i >> 2) / LEVEL_WIDTH), i % 4];
  if (channel === 3) return 255;
  if (x >= 180 && x < 220 && y >= 120 && y < 160) return [200, 120, 40][channel];
  return x >= 120 && x < 280 && y >= 30 && y < 256 ? 230 : 60;
}) });

/** A small picture in one colour, in which soon no page is found. */
export const colouredPicture = png({ width: 16, height: 16, data: Uint8Array.from({ length: 1024 }, (_, i) => [200, 100, 50, 255][i % 4]) });

/**
 * How far the dots of a flat image are from where they are on the page: root of the mean square after the best
 * similarity, as a share of the page's width.
 * @param {Pixels} flat
 */
export function misplaced(flat) {
  const found = darkSpots(flat);
  const { across, down } = dots;
  if (found.length !== across * down) throw new Error(`${found.length} dots`);
  const rows = found.sort((a, b) => a[1] - b[1]);
  const pairs = Array.from({ length: down }, (_, j) => rows.slice(j * across, (j + 1) * across).sort((a, b) => a[0] - b[0]))
    .flatMap((row, j) => row.map(([x, y], i) =>
      /** @type {import('../../../tools/bench/phone/fitting.mjs').Pair} */ ([x, y, ((i + 0.5) / across) * wide, ((j + 0.5) / down) * high])));
  return similarity(pairs).rms / wide;
}

/** The middles of the dark spots within a bright page. @param {Pixels} image @returns {Place[]} */
function darkSpots({ width, height, data }) {
  const darkness = (/** @type {number} */ i) => (data[4 * i + 3] === 255 ? Math.max(0, 128 - data[4 * i]) : 0);
  const done = new Uint8Array(width * height);
  /** @type {Place[]} */
  const spots = [];
  for (let start = 0; start < done.length; start++) {
    if (done[start] || darkness(start) === 0) continue;
    const open = [start];
    done[start] = 1;
    let [sum, x, y, rim] = [0, 0, 0, false];
    for (let i = open.pop(); i !== undefined; i = open.pop()) {
      const [col, row] = [i % width, Math.floor(i / width)];
      sum += darkness(i);
      x += darkness(i) * col;
      y += darkness(i) * row;
      // What is left of the ground.
      rim ||= col < 2 || row < 2 || col > width - 3 || row > height - 3;
      for (const j of [i - 1, i + 1, i - width, i + width]) {
        if (j < 0 || j >= done.length || done[j] || darkness(j) === 0) continue;
        done[j] = 1;
        open.push(j);
      }
    }
    if (!rim && sum > 500) spots.push([x / sum, y / sum]);
  }
  return spots;
}
