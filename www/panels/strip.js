/** Results with five λ, as small pictures side by side; a click takes the λ of one. */
import { element, make, makeButton } from '../dom.js';
import { shortLambda } from '../format.js';
import { smoothPatchCount } from '../analyses.js';
import { STRIP_WORDS } from '../messages.js';
import { rmsError } from '../surface/compare.js';
import { downsample } from '../surface/downsampling.js';

/** Pixels along the longer side of the heights that a picture shows, and the duality gap at which their solve stops. */
const THUMBNAIL_SIDE_PIXELS = 120;
const THUMBNAIL_GAP = 0.05;
/** λ of the five pictures. */
const STRIP_LAMBDAS = [1e4, 1e5, 1e6, 1e7, 1e8];

/** @param {Session} session @param {(settings: Settings) => void} adopt */
export function stripPanel(session, adopt) {
  const strip = element('strip', HTMLElement);
  const button = element('strip-open', HTMLButtonElement);
  /** Aborts the solves that are running. @type {AbortController | null} */
  let job = null;
  /** The input of the pictures. @type {Input | null} */
  let shownInput = null;

  const pictures = STRIP_LAMBDAS.map((lambda) => {
    const canvas = make('canvas', '');
    canvas.setAttribute('aria-hidden', 'true');
    const figures = make('span', 'muted', '\u00a0');
    const choice = makeButton('strip-one', () => adopt({ ...session.settings, lambda }), canvas, make('span', '', `λ = ${shortLambda(lambda)}`), figures);
    strip.append(choice);
    return { lambda, canvas, choice, figures };
  });

  const markChosen = () => {
    for (const { lambda, choice } of pictures) choice.setAttribute('aria-pressed', String(session.settings.lambda === lambda));
  };

  const draw = async () => {
    const { input } = session;
    if (strip.hidden || !input || shownInput === input) return;
    job?.abort();
    const mine = (job = new AbortController());
    shownInput = input;
    const small = { ...downsample(input, THUMBNAIL_SIDE_PIXELS), heightScale: input.heightScale };
    for (const { figures } of pictures) figures.textContent = '\u00a0';
    strip.setAttribute('aria-busy', 'true');
    const worker = new session.api.SolverWorker();
    try {
      for (const { canvas } of pictures) {
        await worker.draw(canvas, small);
        mine.signal.throwIfAborted();
      }
      // All settings except λ, spacing and gap are those of the session.
      const { lambda: _lambda, coarsening: _coarsening, ...options } = session.settings;
      for (const { lambda, canvas, figures } of pictures) {
        const surface = await worker.fit(small, { ...options, gap: THUMBNAIL_GAP, spacing: small.pixelSize, lambda, signal: mine.signal });
        const { image } = surface;
        await worker.draw(canvas, image);
        const [map, curvatures] = await Promise.all([worker.patches(surface), worker.analyze(surface)]);
        figures.textContent = STRIP_WORDS.figures(await smoothPatchCount(map, curvatures), rmsError(image.data, 1, small.data, small.heightScale) / (small.width * small.pixelSize));
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
      shownInput = null;
    }
    markChosen();
    void draw();
  };
  button.addEventListener('click', () => show(strip.hidden === true));
  session.on('result', () => {
    markChosen();
    void draw();
  });
  return { show };
}
