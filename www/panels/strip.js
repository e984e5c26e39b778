/** The same input at five λ, small and side by side: a click takes one. */
import { element, make } from '../dom.js';
import { shortest } from '../format.js';
import { smoothPieces } from '../analyses.js';
import { STRIP_WORDS } from '../messages.js';
import { drawThumbnail } from '../surface/thumbnail.js';

/** @import {Input, Session, Settings} from '../session.js' */

const LAMBDAS = [1e4, 1e5, 1e6, 1e7, 1e8];
/** Pixels along the longer side: enough to tell them apart, and soon there. */
const SIDE = 120;

/**
 * @param {Session} session
 * @param {(settings: Settings) => void} adopt
 */
export function stripPanel(session, adopt) {
  const strip = element('strip', HTMLElement);
  const list = /** @type {HTMLElement} */ (strip.firstElementChild);
  const button = element('strip-open', HTMLButtonElement);
  /** What is worked out now. @type {AbortController | null} */
  let job = null;
  /** @type {Input | null} */
  let shown = null;

  const pictures = LAMBDAS.map((lambda) => {
    const canvas = make('canvas', '');
    canvas.setAttribute('aria-hidden', 'true');
    const figures = make('span', 'muted', '\u00a0');
    const choice = make('button', 'strip-one', canvas, make('span', '', `λ = ${shortest(lambda)}`), figures);
    choice.type = 'button';
    choice.addEventListener('click', () => adopt({ ...session.settings, lambda }));
    list.append(choice);
    return { lambda, canvas, choice, figures };
  });

  const press = () => {
    for (const { lambda, choice } of pictures) choice.setAttribute('aria-pressed', String(session.settings.lambda === lambda));
  };

  const draw = async () => {
    const { input } = session;
    if (strip.hidden || !input || shown === input) return;
    job?.abort();
    const mine = (job = new AbortController());
    shown = input;
    const small = thinned(input);
    for (const { canvas, figures } of pictures) {
      drawThumbnail(canvas, small, small.heightScale / small.pixelSize);
      figures.textContent = '\u00a0';
    }
    strip.setAttribute('aria-busy', 'true');
    const worker = new session.api.DevelopableWorker();
    try {
      // The energy and whatever else is set stays the same.
      const { lambda: _, coarsening: __, ...options } = session.settings;
      for (const { lambda, canvas, figures } of pictures) {
        const surface = await worker.fit(small, { ...options, gap: 0.03, spacing: small.pixelSize, lambda, signal: mine.signal });
        const { image } = surface;
        drawThumbnail(canvas, image, 1 / image.pixelSize);
        const [map, curvatures] = await Promise.all([worker.patches(surface), worker.analyze(surface)]);
        figures.textContent = STRIP_WORDS.figures(await smoothPieces(map, curvatures), distance(small, image));
      }
    } catch (error) {
      if (job === mine && !mine.signal.aborted) session.fail('The five pictures could not be made', error);
    } finally {
      worker.dispose();
      if (job === mine) strip.setAttribute('aria-busy', 'false');
    }
  };

  /** @param {boolean} wanted */
  const show = (wanted) => {
    strip.hidden = !wanted;
    button.setAttribute('aria-expanded', String(wanted));
    if (!wanted) {
      job?.abort();
      shown = null;
    }
    press();
    void draw();
  };
  button.addEventListener('click', () => show(strip.hidden === true));
  session.on('input', (input) => {
    // A design has no input to stay close to.
    button.disabled = input.design === true;
    if (input.design) show(false);
  });
  session.on('result', () => {
    press();
    void draw();
  });
  return { show };
}

/**
 * Distance of a surface from its input, root mean square, as a share of the input's width.
 * @param {ReturnType<typeof thinned>} input
 * @param {{ data: Float64Array }} image of the surface
 */
function distance({ width, data, pixelSize, heightScale }, image) {
  let [sum, count] = [0, 0];
  data.forEach((step, i) => {
    const off = step * heightScale - image.data[i];
    if (!Number.isFinite(off)) return;
    sum += off * off;
    count++;
  });
  return Math.sqrt(sum / Math.max(1, count)) / (width * pixelSize);
}

/**
 * Every so many-th pixel of an input.
 * @param {Input} input
 */
function thinned({ width, height, data, pixelSize, heightScale }) {
  const step = Math.max(1, Math.ceil(Math.max(width, height) / SIDE));
  const [cols, rows] = [Math.floor(width / step), Math.floor(height / step)];
  const some = Float64Array.from({ length: cols * rows }, (_, i) => data[Math.floor(i / cols) * step * width + (i % cols) * step]);
  return { width: cols, height: rows, data: some, pixelSize: pixelSize * step, heightScale };
}
