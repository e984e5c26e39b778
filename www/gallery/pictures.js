/** Pictures of the gallery's cards: input and result side by side, solved on few pixels. */
import { make } from '../dom.js';
import { heightsOf } from '../session.js';
import { Tasks } from '../worker-task.js';

/** Pixels along the longer side of heights that a small picture shows, and the duality gap at which their solve stops. */
export const THUMBNAIL_SIDE_PIXELS = 120;
export const THUMBNAIL_GAP = 0.05;

/** Created with the first picture. @type {Tasks | null} */
let tasks = null;
/** Ends with the picture that was requested last: they are solved one after the other. */
let last = Promise.resolve();

/**
 * The input of a card.
 * @param {Api} api
 * @param {Card} card
 * @param {number} size pixels along its side
 * @param {number} [turn] angle by which it is turned, in degrees
 * @returns {Promise<Input>}
 */
export async function cardInput(api, { example, input }, size, turn = 0) {
  if (input) return input(size, turn);
  if (!example) throw new Error('it has neither');
  const { name, noise } = example;
  const generated = await api.example(name, { size, noise });
  const { width, height, data, pixelSize = 1, heightScale = 1 } = generated.input;
  return { name, width, height, data: Float64Array.from(data), pixelSize, heightScale, truth: Float64Array.from(generated.truth), example: { size, noise } };
}

/**
 * Draws the picture of a card.
 * @param {Api} api
 * @param {Readonly<Settings>} defaults
 * @param {Card} card
 * @param {HTMLCanvasElement} canvas
 */
export async function drawPicture(api, defaults, card, canvas) {
  const input = await cardInput(api, card, THUMBNAIL_SIDE_PIXELS).catch(() => null);
  if (!input) return;
  const heights = heightsOf(input);
  await (last = last.then(() => (tasks ??= new Tasks(api.SolverWorker)).run(async (worker) => {
    const { coarsening: _coarsening, ...options } = { ...defaults, ...card.settings, gap: THUMBNAIL_GAP };
    // If the solve fails, the picture shows the input alone.
    await worker.draw(canvas, heights);
    const { image } = await worker.fit(heights, options);
    const after = make('canvas', '');
    if (!image) return;
    await worker.draw(after, image);
    const half = canvas.width >> 1;
    canvas.getContext('2d')?.drawImage(after, half, 0, half, canvas.height, half, 0, half, canvas.height);
  })).catch(() => {}));
}
