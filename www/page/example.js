/** Example photos of printed pages, rendered by a pinhole camera. */
import { samplePage } from '../sample-page.js';
import { fillTriangles } from '../surface/triangles.js';

/** @typedef {'curled' | 'book'} ExampleName */

/** Size of an upright photo. */
const [PHOTO_WIDTH_PIXELS, PHOTO_HEIGHT_PIXELS] = [960, 1280];
/** Focal length of the camera, about that of a phone. */
const FOCAL_LENGTH_PIXELS = 1150;
/** Size of a page: A4. */
const [PAGE_WIDTH_MM, PAGE_HEIGHT_MM] = [210, 297];
/** Number of cells of the rendered page in each direction. */
const PAGE_CELLS = 100;
/** Number of vertices in a row of cells. */
const ROW_VERTICES = PAGE_CELLS + 1;

/**
 * @typedef {object} Scene
 * @property {number} pages number of pages side by side
 * @property {(s: number) => number} slope angle of the page in radians, by the position along its upper edge from 0 to 1
 * @property {number} distance of the camera from the centre of the page, in millimetres
 * @property {readonly [number, number, number]} turn rotation of the camera about its axes x, y and z, in radians
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
    // Nearly flat at the outer edges, steep at the gutter.
    slope: (s) => (s < 0.5 ? -1 : 1) * (1.05 * Math.exp(-Math.abs(s - 0.5) / 0.09) - 0.16),
    distance: 450,
    turn: [0.05, 0.04, -0.03],
  },
};

/**
 * Renders an example photo.
 * @param {ExampleName} name
 * @returns {{ image: ImageData, film35: number, pages: number }}
 */
export function examplePhoto(name) {
  const scene = SCENES[name];
  const { pages } = scene;
  // An open book needs a landscape photo.
  const [width, height] = pages === 2 ? [PHOTO_HEIGHT_PIXELS, PHOTO_WIDTH_PIXELS] : [PHOTO_WIDTH_PIXELS, PHOTO_HEIGHT_PIXELS];
  const image = drawTable(width, height);
  const page = samplePage(PAGE_WIDTH_MM, PAGE_HEIGHT_MM);
  const { triangles, places, depths, slopes } = projectPage(scene, width, height);
  fillTriangles({ width, height }, triangles, places, (pixel, t, a, b, c) => {
    const [i, j, k] = [triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]];
    // Perspective-correct weights: those on the page, not those in the photo.
    const [u, v, w] = [a / depths[i], b / depths[j], c / depths[k]];
    const across = (u * (i % ROW_VERTICES) + v * (j % ROW_VERTICES) + w * (k % ROW_VERTICES)) / (u + v + w) / PAGE_CELLS;
    const down = (u * Math.floor(i / ROW_VERTICES) + v * Math.floor(j / ROW_VERTICES) + w * Math.floor(k / ROW_VERTICES)) / (u + v + w) / PAGE_CELLS;
    const light = 0.78 + 0.22 * Math.cos(slopes[i % ROW_VERTICES] + 0.5);
    copyColour(page, ((across * pages) % 1) * (page.width - 1), down * (page.height - 1), light, image.data, 4 * pixel);
  });
  return { image: blur(image), film35: (FOCAL_LENGTH_PIXELS * Math.hypot(36, 24)) / Math.hypot(width, height), pages };
}

/**
 * Projects the vertices of the page into the photo.
 * @param {Scene} scene
 * @param {number} width
 * @param {number} height
 */
function projectPage({ pages, slope, distance, turn }, width, height) {
  // The curve of the upper edge, integrated by the midpoint rule.
  const [xs, zs] = [new Float64Array(ROW_VERTICES), new Float64Array(ROW_VERTICES)];
  const slopes = Float64Array.from({ length: ROW_VERTICES }, (_, i) => slope((i + 1e-6) / PAGE_CELLS));
  for (let i = 1; i < ROW_VERTICES; i++) {
    const middle = slope((i - 0.5) / PAGE_CELLS);
    xs[i] = xs[i - 1] + (pages * PAGE_WIDTH_MM / PAGE_CELLS) * Math.cos(middle);
    zs[i] = zs[i - 1] + (pages * PAGE_WIDTH_MM / PAGE_CELLS) * Math.sin(middle);
  }
  const [left, middleDepth] = [xs[PAGE_CELLS] / 2, (Math.min(...zs) + Math.max(...zs)) / 2];
  const rotate = rotation(turn);
  const places = new Float64Array(2 * ROW_VERTICES * ROW_VERTICES);
  const depths = new Float64Array(ROW_VERTICES * ROW_VERTICES);
  for (let j = 0; j < ROW_VERTICES; j++) {
    for (let i = 0; i < ROW_VERTICES; i++) {
      const [x, y, z] = rotate(xs[i] - left, PAGE_HEIGHT_MM * (j / PAGE_CELLS - 0.5), -(zs[i] - middleDepth));
      const at = j * ROW_VERTICES + i;
      depths[at] = z + distance;
      places[2 * at] = width / 2 + (FOCAL_LENGTH_PIXELS * x) / depths[at];
      places[2 * at + 1] = height / 2 + (FOCAL_LENGTH_PIXELS * y) / depths[at];
    }
  }
  const triangles = new Uint32Array(6 * PAGE_CELLS * PAGE_CELLS);
  for (let cell = 0; cell < PAGE_CELLS * PAGE_CELLS; cell++) {
    const at = Math.floor(cell / PAGE_CELLS) * ROW_VERTICES + (cell % PAGE_CELLS);
    triangles.set([at, at + 1, at + ROW_VERTICES, at + 1, at + ROW_VERTICES + 1, at + ROW_VERTICES], 6 * cell);
  }
  return { triangles, places, depths, slopes };
}

/**
 * The rotation about the axes x, y and z, one after the other.
 * @param {readonly [number, number, number]} turn angles in radians
 * @returns {(x: number, y: number, z: number) => [number, number, number]}
 */
function rotation([about, over, roll]) {
  /** @param {number} a @param {number} b @param {number} angle */
  const rotateInPlane = (a, b, angle) => [a * Math.cos(angle) - b * Math.sin(angle), a * Math.sin(angle) + b * Math.cos(angle)];
  return (x, y, z) => {
    const [y1, z1] = rotateInPlane(y, z, about);
    const [z2, x1] = rotateInPlane(z1, x, over);
    const [x2, y2] = rotateInPlane(x1, y1, roll);
    return [x2, y2, z2];
  };
}

/**
 * Copies the bilinearly interpolated colour at a place of an image, dimmed by the light.
 * @param {ImageData} image
 * @param {number} x
 * @param {number} y
 * @param {number} light
 * @param {Uint8ClampedArray} out
 * @param {number} place
 */
function copyColour({ width, height, data }, x, y, light, out, place) {
  const [i, j] = [Math.min(width - 2, Math.floor(x)), Math.min(height - 2, Math.floor(y))];
  const [a, b] = [x - i, y - j];
  const [upper, lower] = [4 * (j * width + i), 4 * ((j + 1) * width + i)];
  for (let k = 0; k < 3; k++) {
    const above = (1 - a) * data[upper + k] + a * data[upper + 4 + k];
    const below = (1 - a) * data[lower + k] + a * data[lower + 4 + k];
    out[place + k] = light * ((1 - b) * above + b * below);
  }
}

/** The background: a dark wooden table. @param {number} width @param {number} height */
function drawTable(width, height) {
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

/** Blurs a photo slightly, as a lens does. @param {ImageData} image */
function blur(image) {
  const { width, height } = image;
  const [sharp, soft] = [document.createElement('canvas'), document.createElement('canvas')];
  for (const canvas of [sharp, soft]) Object.assign(canvas, { width, height });
  sharp.getContext('2d')?.putImageData(image, 0, 0);
  const context = soft.getContext('2d', { willReadFrequently: true });
  if (!context) return image;
  // A browser without canvas filters leaves the photo sharp.
  context.filter = 'blur(0.7px)';
  context.drawImage(sharp, 0, 0);
  // Blurring makes the border transparent: restore its opacity.
  const softer = context.getImageData(0, 0, width, height);
  for (let i = 3; i < softer.data.length; i += 4) softer.data[i] = 255;
  return softer;
}
