/** Draws a pattern put together, at an angle: its sheets in their colours, with their numbers, above the steps in which they are joined. */
import { assemblyOf, buildSteps, sheetsInWords } from '../pattern.js';
import { CREASE_COLOUR, patchColour } from './colours.js';
import { PAPER_LOOKS, SceneView } from './scene.js';
import { borderEdges, boxOf } from './triangles.js';

/** @import {Vector} from './scene.js' */

/** Size of the picture, of its numbers, and of the lines around the sheets, in pixels. */
const PICTURE_SIZE = { width: 2000, height: 1500 };
const NUMBER_HEIGHT_PIXELS = 44;
const LINE_WIDTH_PIXELS = 3;
/** Number of places of a sheet at which its number may stand, the middle first. */
const NUMBER_PLACES = 40;

/** Draws a pattern's assembly. @param {Drawing} drawing @param {'y' | 'z'} up the axis that points upwards @returns {Promise<Blob>} a PNG */
export async function builtPicture(drawing, up) {
  const { positions, triangles, sheets } = assemblyOf(drawing);
  const scene = await SceneView.create(document.createElement('canvas'), PICTURE_SIZE);
  scene.setLook(PAPER_LOOKS[up]);
  const borders = borderEdges(triangles).map((ends) => ({ points: ends.map((vertex) => /** @type {Vector} */ ([positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]])), colour: CREASE_COLOUR, width: LINE_WIDTH_PIXELS }));
  scene.setBox(boxOf(positions));
  scene.setSurface(0, { positions, triangles, colors: Float32Array.from([...sheets].flatMap((sheet) => patchColour(sheet)), (value) => value / 255) });
  scene.setLines(0, borders);
  scene.look();
  scene.draw();
  const lines = [sheetsInWords(drawing), ...buildSteps(drawing).map((step, i) => `${i + 1}. ${step}`)].flatMap((text) => text.match(/.{1,110}( |$)/g) ?? []);
  const picture = new OffscreenCanvas(PICTURE_SIZE.width, PICTURE_SIZE.height + (lines.length + 1) * NUMBER_HEIGHT_PIXELS);
  const context = picture.getContext('2d');
  if (!context) throw new Error('this browser draws no pictures');
  context.fillStyle = 'white';
  context.fillRect(0, 0, picture.width, picture.height);
  context.drawImage(scene.canvas, 0, 0);
  Object.assign(context, { font: `600 ${NUMBER_HEIGHT_PIXELS}px Helvetica, Arial, sans-serif`, textAlign: 'center', textBaseline: 'middle', lineWidth: NUMBER_HEIGHT_PIXELS / 5, strokeStyle: 'white', fillStyle: 'black' });
  for (const sheet of new Set(sheets)) {
    const place = placesOf(triangles.filter((vertex) => sheets[vertex] === sheet), positions).map((middle) => scene.project(middle)).find(([x, y]) => {
      const seen = scene.pick({ offsetX: x, offsetY: y });
      return seen && sheets[triangles[3 * seen.triangle]] === sheet;
    });
    if (!place) continue;
    context.strokeText(String(sheet + 1), ...place);
    context.fillText(String(sheet + 1), ...place);
  }
  scene.dispose();
  Object.assign(context, { font: `${0.75 * NUMBER_HEIGHT_PIXELS}px Helvetica, Arial, sans-serif`, textAlign: 'left' });
  lines.forEach((line, i) => context.fillText(line, NUMBER_HEIGHT_PIXELS, PICTURE_SIZE.height + (i + 0.75) * NUMBER_HEIGHT_PIXELS));
  return picture.convertToBlob({ type: 'image/png' });
}

/** The middles of triangles, from the middle of all outwards. @param {Uint32Array} triangles @param {Float64Array} positions */
function placesOf(triangles, positions) {
  /** @param {ArrayLike<number>} vertices */
  const middleOf = (vertices) => /** @type {Vector} */ (/** @type {unknown} */ ([0, 1, 2].map((k) => Array.from(vertices).reduce((sum, vertex) => sum + positions[3 * vertex + k], 0) / vertices.length)));
  const middle = middleOf(triangles);
  /** @param {Vector} place */
  const distance = (place) => Math.hypot(...middle.map((value, k) => place[k] - value));
  const places = Array.from({ length: triangles.length / 3 }, (_, t) => middleOf(triangles.subarray(3 * t, 3 * t + 3))).sort((a, b) => distance(a) - distance(b));
  const step = Math.max(1, Math.floor(places.length / NUMBER_PLACES));
  return places.filter((_, i) => i % step === 0);
}
