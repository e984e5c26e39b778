/**
 * Previews: approximate results of an input on lattices from coarse to fine, solved in a worker of their own while the
 * certified result is still being computed.
 *
 * The coarsest solve always finishes, so that each of many requests in a row yields a preview; a finer one is aborted by
 * a newer request.
 */
import { downsample } from './surface/downsampling.js';
import { callWorker } from './surface/worker-client.js';
import { WORKER_IDLE_MS } from './worker-task.js';

/** @import {OpenSolver} from '../pkg/index.js' */
/** @typedef {{ width: number, height: number, pixelSize: number, data: ArrayLike<number> }} Image */
/** @typedef {{ input: Input, lambda: number, image: Image }} Preview */
/** @typedef {{ input: Input, solver: Promise<OpenSolver> }} PreviewLevel */

/** Longer sides of the lattices from coarse to fine, in pixels: the first takes about 30 ms, each further one four times as long. */
const PREVIEW_SIDES_PIXELS = [96, 192, 384];
/** Whether a solve of an input takes so long that it is accompanied by previews. @param {Input} input */
export const isPreviewed = ({ width, height }) => Math.max(width, height) > 1.5 * PREVIEW_SIDES_PIXELS[0];
/** Duality gap at which a preview stops. */
const PREVIEW_GAP = 0.1;

export class PreviewSolver {
  #api;
  #callbacks;
  /** @type {InstanceType<Api['DevelopableWorker']> | null} */
  #worker = null;
  /** Open solvers by the longer side of their lattice. @type {Map<number, PreviewLevel>} */
  #levels = new Map();
  /** Heights of the last input, reduced for the finest preview. @type {{ data: ArrayLike<number>, heights: Promise<import('./surface/downsampling.js').Heights> } | null} */
  #reduced = null;
  /** The newest request, until its finest preview is ready. @type {{ input: Input, settings: Settings, isFine: boolean, lambda?: number, abort: AbortController } | null} */
  #request = null;
  #isSolving = false;
  /** Timer that disposes of the idle worker. */
  #idleTimer = 0;
  /** The last request that was finished. @type {{ input: Input, settings: Settings } | null} */
  #finished = null;

  /**
   * @param {Api} api
   * @param {{ onPreview: (preview: Preview) => void, onFinished: (settings: Settings) => void }} callbacks
   *   `onFinished`: the finest preview of the newest request is ready
   */
  constructor(api, callbacks) {
    this.#api = api;
    this.#callbacks = callbacks;
  }

  /** Starts the worker before the first request. An error here is ignored: it occurs again, and is reported, where the worker is needed. */
  start() {
    this.#connectedWorker().init().catch(() => {});
    this.#disposeWhenIdle();
  }

  #connectedWorker() {
    return this.#worker?.connected ? this.#worker : (this.#worker = new this.#api.SolverWorker());
  }

  /**
   * Requests previews of an input, in place of those requested before.
   * @param {Input} input
   * @param {Settings} settings
   * @param {boolean} isFine whether it is solved on all lattices, not on the coarsest alone
   * @param {number} [lambda] λ of the last result, which replaces `auto`
   */
  request(input, settings, isFine, lambda) {
    if ([this.#request, this.#finished].some((one) => one?.input === input && one.settings === settings)) return;
    this.#request?.abort.abort();
    this.#request = { input, settings, isFine, lambda, abort: new AbortController() };
    if (!this.#isSolving) void this.#solveRequests();
  }

  /** Cancels the newest request. */
  cancel() {
    this.#request?.abort.abort();
    this.#request = null;
  }

  /** Solves the newest request on all its lattices, from coarse to fine, until there is no request left. */
  async #solveRequests() {
    this.#isSolving = true;
    clearTimeout(this.#idleTimer);
    for (let request = this.#request; request; request = this.#request) {
      const { input, settings, isFine, abort } = request;
      /** The coarsest lattice chooses λ for the finer ones. @type {Settings['lambda']} */
      let lambda = settings.lambda === 'auto' ? request.lambda ?? 'auto' : settings.lambda;
      const sides = PREVIEW_SIDES_PIXELS.filter((side, i) => i === 0 || (isFine && 1.5 * side < Math.max(input.width, input.height)));
      for (let i = 0; i < sides.length && (i === 0 || !abort.signal.aborted); i++) {
        try {
          const preview = await this.#solve(input, { ...settings, lambda }, sides[i], i === 0 ? undefined : abort.signal);
          lambda = preview.lambda;
          if (this.#request?.input === input) this.#callbacks.onPreview(preview);
        } catch {
          // The certified run reports the error.
          break;
        }
      }
      if (this.#request !== request) continue;
      this.#request = null;
      this.#finished = request;
      this.#callbacks.onFinished(settings);
    }
    this.#isSolving = false;
    this.#disposeWhenIdle();
  }

  /** Disposes of the worker, and frees its memory, unless there is another request before. */
  #disposeWhenIdle() {
    this.#idleTimer = window.setTimeout(() => {
      this.#worker?.dispose();
      this.#worker = null;
      this.#levels.clear();
    }, WORKER_IDLE_MS);
  }

  /**
   * @param {Input} input
   * @param {Pick<Settings, 'lambda' | 'energy'>} settings
   * @param {number} side longer side of the lattice in pixels
   * @param {AbortSignal} [signal]
   * @returns {Promise<Preview>}
   */
  async #solve(input, { lambda, energy }, side, signal) {
    // Crease passes are left to the certified run.
    const passes = energy === 'huber' ? { creasePasses: 0 } : {};
    const { image, report } = await (await this.#levelFor(input, side).solver).fit({ lambda, energy, ...passes, gap: PREVIEW_GAP, signal });
    if (!image) throw new Error('it has no image');
    return { input, lambda: report.lambda, image };
  }

  /** The level for an input. @param {Input} input @param {number} side */
  #levelFor(input, side) {
    const found = this.#levels.get(side);
    if (found?.input === input) return found;
    found?.solver.then((open) => open.dispose(), () => {});
    const solver = this.#reducedTo(input, side).then((heights) => this.#connectedWorker().open(heights));
    // Whoever awaits the solver handles its error.
    solver.catch(() => this.#levels.delete(side));
    const level = { input, solver };
    this.#levels.set(side, level);
    return level;
  }

  /** Reduces the heights of an input to fewer pixels. @param {Input} input @param {number} side longer side in pixels */
  async #reducedTo({ width, height, data, pixelSize, heightScale }, side) {
    if (this.#reduced?.data !== data) this.#reduced = { data, heights: callWorker('downsample', { width, height, data, pixelSize }, Math.max(...PREVIEW_SIDES_PIXELS)) };
    const { heights: reduced } = this.#reduced;
    // It is tried again after a failure.
    reduced.catch(() => (this.#reduced = null));
    return { ...downsample(await reduced, side), heightScale };
  }
}
