/** Photos of printed pages in space, made by a camera that is known: something to make flat at once. */
import { printed } from '../sample-page.js';
import { fillTriangles } from '../surface/triangles.js';

/** @typedef {'curled' | 'book'} ExampleName */

/** The photo's size, and the camera's focal length in its pixels, as a phone has it. */
const [WIDTH, HEIGHT, FOCAL] = [960, 1280, 1150];
/** The page in millimetres. */
const [WIDE, HIGH] = [210, 297];
/** Cells of the page that are drawn, in each direction, and vertices in a row of them. */
const STEPS = 100;
const ROW = STEPS + 1;

/**
 * @typedef {object} Scene
 * @property {number} pages beside each other
 * @property {(s: number) => number} slope angle of the page along its upper edge, from 0 to 1, in radians
 * @property {number} distance of the camera from the page's middle
 * @property {readonly [number, number, number]} turn of the camera about its axes x, y, z in radians
 */

/** @type {Record<ExampleName, Scene>} */
const SCENES = {
  curled: {
    pages: 1,
    slope: (s) => 0.8 * Math.cos(Math.PI * s) - 0.15,
    distance: 380,
    turn: [0.2, -0.1, 0.05],
  },
  book: {
    pages: 2,
    // Nearly flat outside, steep at the gutter.
    slope: (s) => (s < 0.5 ? -1 : 1) * (1.05 * Math.exp(-Math.abs(s - 0.5) / 0.09) - 0.16),
    distance: 450,
    turn: [0.05, 0.04, -0.03],
  },
};

/**
 * @param {ExampleName} name
 * @returns {{ image: ImageData, film35: number, pages: number }}
 */
export function examplePhoto(name) {
  const scene = SCENES[name];
  const { pages } = scene;
  // An open book is held the other way.
  const [width, height] = pages === 2 ? [HEIGHT, WIDTH] : [WIDTH, HEIGHT];
  const image = table(width, height);
  const page = printed(WIDE, HIGH);
  const { triangles, places, ahead, slopes } = seen(scene, width, height);
  fillTriangles({ width, height }, triangles, places, (pixel, t, a, b, c) => {
    const [i, j, k] = [triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]];
    // Weights as they are on the page, not in the photo.
    const [u, v, w] = [a / ahead[i], b / ahead[j], c / ahead[k]];
    const across = (u * (i % ROW) + v * (j % ROW) + w * (k % ROW)) / (u + v + w) / STEPS;
    const down = (u * Math.floor(i / ROW) + v * Math.floor(j / ROW) + w * Math.floor(k / ROW)) / (u + v + w) / STEPS;
    const light = 0.78 + 0.22 * Math.cos(slopes[i % ROW] + 0.5);
    copy(page, ((across * pages) % 1) * (page.width - 1), down * (page.height - 1), light, image.data, 4 * pixel);
  });
  return { image: softened(image), film35: (FOCAL * Math.hypot(36, 24)) / Math.hypot(width, height), pages };
}

/**
 * Where the page's points are in the photo.
 * @param {Scene} scene
 * @param {number} width
 * @param {number} height
 */
function seen({ pages, slope, distance, turn }, width, height) {
  // The curve of the upper edge, by the trapezoidal rule.
  const [xs, zs] = [new Float64Array(ROW), new Float64Array(ROW)];
  const slopes = Float64Array.from({ length: ROW }, (_, i) => slope((i + 1e-6) / STEPS));
  for (let i = 1; i < ROW; i++) {
    const middle = slope((i - 0.5) / STEPS);
    xs[i] = xs[i - 1] + (pages * WIDE / STEPS) * Math.cos(middle);
    zs[i] = zs[i - 1] + (pages * WIDE / STEPS) * Math.sin(middle);
  }
  const [left, level] = [xs[STEPS] / 2, (Math.min(...zs) + Math.max(...zs)) / 2];
  const rotate = rotation(turn);
  const places = new Float64Array(2 * ROW * ROW);
  const ahead = new Float64Array(ROW * ROW);
  for (let j = 0; j < ROW; j++) {
    for (let i = 0; i < ROW; i++) {
      const [x, y, z] = rotate(xs[i] - left, HIGH * (j / STEPS - 0.5), -(zs[i] - level));
      const at = j * ROW + i;
      ahead[at] = z + distance;
      places[2 * at] = width / 2 + (FOCAL * x) / ahead[at];
      places[2 * at + 1] = height / 2 + (FOCAL * y) / ahead[at];
    }
  }
  const triangles = new Uint32Array(6 * STEPS * STEPS);
  for (let cell = 0; cell < STEPS * STEPS; cell++) {
    const at = Math.floor(cell / STEPS) * ROW + (cell % STEPS);
    triangles.set([at, at + 1, at + ROW, at + 1, at + ROW + 1, at + ROW], 6 * cell);
  }
  return { triangles, places, ahead, slopes };
}

/**
 * @param {readonly [number, number, number]} turn
 * @returns {(x: number, y: number, z: number) => [number, number, number]}
 */
function rotation([about, over, roll]) {
  /** @param {number} a @param {number} b @param {number} angle */
  const by = (a, b, angle) => [a * Math.cos(angle) - b * Math.sin(angle), a * Math.sin(angle) + b * Math.cos(angle)];
  return (x, y, z) => {
    const [y1, z1] = by(y, z, about);
    const [z2, x1] = by(z1, x, over);
    const [x2, y2] = by(x1, y1, roll);
    return [x2, y2, z2];
  };
}

/**
 * The colour of a picture between its pixels.
 * @param {ImageData} image
 * @param {number} x
 * @param {number} y
 * @param {number} light
 * @param {Uint8ClampedArray} out
 * @param {number} place
 */
function copy({ width, height, data }, x, y, light, out, place) {
  const [i, j] = [Math.min(width - 2, Math.floor(x)), Math.min(height - 2, Math.floor(y))];
  const [a, b] = [x - i, y - j];
  const [upper, lower] = [4 * (j * width + i), 4 * ((j + 1) * width + i)];
  for (let k = 0; k < 3; k++) {
    const above = (1 - a) * data[upper + k] + a * data[upper + 4 + k];
    const below = (1 - a) * data[lower + k] + a * data[lower + 4 + k];
    out[place + k] = light * ((1 - b) * above + b * below);
  }
}

/** A dark table. @param {number} width @param {number} height */
function table(width, height) {
  const image = new ImageData(width, height);
  const { data } = image;
  for (let i = 0; i < width * height; i++) {
    const [x, y] = [i % width, Math.floor(i / width)];
    const grain = 6 * Math.sin(y / 9 + 2 * Math.sin(x / 140)) + 4 * Math.sin(y / 3.1 + x / 300);
    data[4 * i] = 86 + grain;
    data[4 * i + 1] = 62 + 0.8 * grain;
    data[4 * i + 2] = 44 + 0.6 * grain;
    data[4 * i + 3] = 255;
  }
  return image;
}

/** As a lens softens edges. @param {ImageData} image */
function softened(image) {
  const { width, height } = image;
  const [sharp, soft] = [document.createElement('canvas'), document.createElement('canvas')];
  for (const canvas of [sharp, soft]) Object.assign(canvas, { width, height });
  sharp.getContext('2d')?.putImageData(image, 0, 0);
  const context = soft.getContext('2d', { willReadFrequently: true });
  if (!context) return image;
  // Where there are no filters it stays sharp.
  context.filter = 'blur(0.7px)';
  context.drawImage(sharp, 0, 0);
  // The rim is opaque all the same.
  const softer = context.getImageData(0, 0, width, height);
  for (let i = 3; i < softer.data.length; i += 4) softer.data[i] = 255;
  return softer;
}
