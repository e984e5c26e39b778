/** Pictures of the gallery's cards: the input on the left and what comes of it on the right, solved roughly. */
import { settingsFor } from '../design.js';
import { make } from '../dom.js';
import { previewOf } from '../pattern.js';
import { heightsOf } from '../session.js';
import { drawBeside, drawHalves, drawThumbnail } from '../surface/thumbnail.js';
import { handOver } from '../surface/work.js';
import { canvasOf } from '../views/dewarped.js';

/** @import {Api, Surface} from '../api.js' */
/** @import {Card} from './cards.js' */
/** @import {Input, Settings} from '../session.js' */
/** @typedef {InstanceType<Api['DevelopableWorker']>} Worker */

/** Pixels along a side of the heights that a card's picture shows. */
const PICTURE = 112;
/** Duality gap at which a card's picture is good enough. */
const PICTURE_GAP = 0.05;
/** Millimetres along the longer side of a design whose sheets a picture shows: little, so that lines of a fixed width are seen. */
const SHEETS_SIDE = 50;

/**
 * @param {Api} api
 * @param {Card} card
 * @param {number} size
 * @returns {Promise<Input>}
 */
export async function inputOf(api, { example, input }, size) {
  if (input) return input(size);
  if (!example) throw new Error('it has neither');
  const { name, noise } = example;
  const made = await api.example(name, { size, noise });
  const { width, height, data, pixelSize = 1, heightScale = 1 } = made.input;
  return { name, width, height, data: Float64Array.from(data), pixelSize, heightScale, truth: Float64Array.from(made.truth) };
}

/**
 * @param {Api} api
 * @param {Readonly<Settings>} defaults
 * @param {Card} card
 * @param {HTMLCanvasElement} canvas
 */
export async function drawPicture(api, defaults, card, canvas) {
  const input = await inputOf(api, card, PICTURE).catch(() => null);
  if (!input) return;
  const sketch = card.sketch?.(PICTURE) ?? input;
  drawThumbnail(canvas, sketch, sketch.heightScale / sketch.pixelSize);
  // What cannot be had leaves the input alone.
  await inTurn(api, async (worker) => {
    const { coarsening: _, ...options } = settingsFor(input, { ...defaults, ...card.settings, gap: PICTURE_GAP });
    const surface = await worker.fit(heightsOf(input), options);
    if (card.shows === 'photo') return drawPhotos(canvas, worker, input, surface);
    const { image } = surface;
    if (!image) return;
    const [before, after] = [make('canvas', ''), make('canvas', '')];
    drawThumbnail(after, image, 1 / image.pixelSize);
    if (card.shows === 'sheets') return drawBeside(canvas, after, await sheetsOf(worker, surface, image));
    // Of a design there is nothing to be seen before.
    if (input.design) return drawThumbnail(canvas, image, 1 / image.pixelSize);
    drawThumbnail(before, input, input.heightScale / input.pixelSize);
    drawHalves(canvas, before, after);
  }).catch(() => {});
}

/**
 * A print on the true surface, and the same made flat.
 * @param {HTMLCanvasElement} canvas
 * @param {Worker} worker
 * @param {Input} input
 * @param {Surface} surface
 */
async function drawPhotos(canvas, worker, { width, height, pixelSize, heightScale, truth = new Float64Array() }, surface) {
  const { triangles, positions, places } = await worker.unroll({ width, height, pixelSize, heightScale, data: truth });
  const photo = await handOver('photographed', [triangles, positions, places], { width, height, pixelSize, heightScale, truth }, { triangles, positions, places });
  const flat = await worker.dewarp(surface, photo, { map: false });
  drawBeside(canvas, canvasOf(photo), canvasOf(new ImageData(flat.data, flat.width)));
}

/** @param {Worker} worker @param {Surface} surface @param {{ width: number, height: number, pixelSize: number }} image of the surface */
async function sheetsOf(worker, surface, { width, height, pixelSize }) {
  const drawing = await worker.pattern(surface, { scale: SHEETS_SIDE / (Math.max(width, height) * pixelSize) });
  return previewOf((own) => worker.writeSvg(own), drawing);
}

/** The worker of the pictures, while there are some to come, and the last one. */
const small = { worker: /** @type {Worker | null} */ (null), open: 0, last: Promise.resolve() };

/**
 * One picture after the other, in one worker.
 * @param {Api} api
 * @param {(worker: Worker) => Promise<void>} draw
 */
function inTurn(api, draw) {
  small.open++;
  const mine = small.last.then(() => draw(small.worker ??= new api.DevelopableWorker())).finally(() => {
    if (--small.open > 0) return;
    small.worker?.dispose();
    small.worker = null;
  });
  small.last = mine.catch(() => {});
  return mine;
}
