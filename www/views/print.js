/** A printed page on an example's true surface, photographed from above: something to make flat. */
import { normalsOf, UNIT } from '../surface/normals.js';
import { fillTriangles } from '../surface/triangles.js';
import { extentOf } from './sheet.js';

/** @import {Input} from '../session.js' */
/** @typedef {import('../../pkg/types.js').Unrolling} Unrolling */

/** Pixels along the longer side: of the photo, about; of the print. */
const PHOTO = 1000;
const PRINT = 1400;
const LIGHT = [-0.45, 0.4, 0.8];

/**
 * @param {Input & { truth: Float64Array }} input
 * @param {Unrolling} sheet the true surface, laid flat
 * @returns {ImageData}
 */
export function photographed(input, { triangles, positions, places }) {
  const { width, height, pixelSize, heightScale, truth } = input;
  const scale = Math.max(1, Math.round(PHOTO / Math.max(width, height)));
  const photo = new ImageData(width * scale, height * scale);
  const out = new Uint32Array(photo.data.buffer);

  const extent = extentOf(places);
  const page = print(extent.width, extent.height);
  const ink = new Uint32Array(page.data.buffer);
  const dots = (page.width - 1) / extent.width;
  const seen = new Float64Array(places.length);
  for (let i = 0; 2 * i < seen.length; i++) {
    seen[2 * i] = (positions[3 * i] / pixelSize) * scale;
    seen[2 * i + 1] = (height - positions[3 * i + 1] / pixelSize) * scale;
  }
  const { xy } = normalsOf(truth, width, height, heightScale / pixelSize);
  fillTriangles(photo, triangles, seen, (pixel, t, a, b, c) => {
    const [i, j, k] = [2 * triangles[3 * t], 2 * triangles[3 * t + 1], 2 * triangles[3 * t + 2]];
    const x = a * places[i] + b * places[j] + c * places[k] - extent.left;
    const y = extent.top - (a * places[i + 1] + b * places[j + 1] + c * places[k + 1]);
    const colour = ink[Math.round(y * dots) * page.width + Math.round(x * dots)];
    const [col, row] = [Math.floor((pixel % photo.width) / scale), Math.floor(pixel / photo.width / scale)];
    out[pixel] = dimmed(colour, lit(xy, row * width + col));
  });
  return photo;
}

/** @param {Int16Array} xy @param {number} i */
function lit(xy, i) {
  const [x, y] = [xy[2 * i] / UNIT, xy[2 * i + 1] / UNIT];
  const cosine = x * LIGHT[0] + y * LIGHT[1] + Math.sqrt(Math.max(0, 1 - x * x - y * y)) * LIGHT[2];
  return 0.5 + 0.5 * Math.min(1, Math.max(0, cosine));
}

/** @param {number} colour as the canvas' bytes @param {number} light */
function dimmed(colour, light) {
  /** @param {number} shift */
  const part = (shift) => Math.round(((colour >>> shift) & 255) * light) << shift;
  return (0xff000000 | part(16) | part(8) | part(0)) >>> 0;
}

const TEXT = 'What bends like paper can be laid flat again without a stretch or a tear. '
  + 'Seen from above, lines that were printed straight become curves, and what slants away becomes narrow. '
  + 'From the heights it follows how far each point is from its neighbours along the sheet, and so where it was before the sheet was bent. ';

/**
 * @param {number} wide
 * @param {number} high
 */
function print(wide, high) {
  const scale = (PRINT - 1) / Math.max(wide, high);
  const [width, height] = [Math.ceil(wide * scale) + 1, Math.ceil(high * scale) + 1];
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (!context) return new ImageData(width, height);
  context.fillStyle = '#fbfaf5';
  context.fillRect(0, 0, width, height);
  const [margin, line] = [width * 0.08, width * 0.034];
  context.fillStyle = '#22618f';
  context.font = `700 ${line * 1.7}px serif`;
  context.fillText('On laying paper flat', margin, margin + line * 1.4);
  context.fillStyle = '#23282d';
  context.font = `${line * 0.78}px serif`;
  const words = TEXT.repeat(12).split(' ');
  const foot = height - margin - 4 * line;
  for (let y = margin + 3.6 * line; y < foot; y += line) {
    let text = '';
    while (words.length > 0 && context.measureText(`${text} ${words[0]}`).width < width - 2 * margin) text += ` ${words.shift()}`;
    context.fillText(text.trim(), margin, y);
    context.fillRect(margin, y + 0.25 * line, width - 2 * margin, 2);
  }
  const square = (width - 2 * margin) / 24;
  for (let i = 0; i < 24; i++) context.fillRect(margin + i * square, height - margin - (i % 2 === 0 ? 2 : 1) * square, square, square);
  context.lineWidth = 3;
  context.strokeStyle = '#22618f';
  context.strokeRect(margin / 2, margin / 2, width - margin, height - margin);
  return context.getImageData(0, 0, width, height);
}
