/** A question before a fit of very many vertices, which a slip of the keyboard in --resolution may have asked for. */
import { createInterface } from 'node:readline/promises';
import { Problem, status } from './problem.js';
import { say, streams } from './terminal.js';

/** Maximum number of vertices that are fitted without a question. More of them take minutes, and gigabytes of memory. */
export const MAX_VERTICES_UNASKED = 2_000_000;

/** Maximum number of vertices of a lattice: `MAX_CELLS` in Rust. More are refused, so that there is nothing to ask. */
const MAX_VERTICES = 5 * 2 ** 22;

/** Vertices of the lattice for each square whose side is the spacing. */
const VERTICES_PER_SQUARE = 2 / Math.sqrt(3);

/**
 * @typedef {import('./inputs.js').Input} Input
 * @typedef {{ lattice: 'square' | 'hex' | 'mesh', resolution?: number, spacing?: number, force: boolean }} Task
 * @typedef {{ answers: boolean, ask: (question: string, signal: AbortSignal) => Promise<string>, warn: (text: string) => void }} User
 */

/**
 * Asks whether to go on where --resolution or --spacing makes so many vertices that a fit takes long. Where nobody can
 * answer that is a warning, and with --force nothing is said.
 * @param {Task} task
 * @param {Input} input
 * @param {AbortSignal} signal
 * @param {User} [user]
 */
export async function confirmSize(task, input, signal, user = terminalUser) {
  const { lattice, resolution, spacing, force } = task;
  // Of heights that are on the lattice already the spacing makes no vertices.
  if (force || lattice === 'hex' || (resolution === undefined && spacing === undefined)) return;
  // What cannot be is refused by the fit, which says why.
  if (spacing !== undefined && !(spacing > 0)) return;
  const vertices = vertexCount(task, input);
  if (vertices <= MAX_VERTICES_UNASKED || vertices > MAX_VERTICES) return;
  const flag = resolution === undefined ? '--spacing' : '--resolution';
  const size = `${flag} ${resolution ?? spacing} makes ${vertices.toLocaleString('en')} vertices, which take long to fit and much memory`;
  if (!user.answers) {
    user.warn(`warning: ${size}; --force goes on without this warning`);
    return;
  }
  const answer = await user.ask(`${size}. Go on? [y/N] `, signal);
  if (/^y(es)?$/i.test(answer.trim())) return;
  const coarser = resolution === undefined ? 'a larger --spacing' : 'a smaller --resolution';
  throw new Problem(status.usage, `nothing was fitted: choose ${coarser}, or add --force to go on without a question`);
}

/**
 * The number of vertices that have a height, or of an image that is going to be resampled about that.
 * @param {Task} task
 * @param {Input} input
 */
function vertexCount({ lattice, spacing = 1 }, input) {
  if (lattice === 'mesh') {
    const { heights } = /** @type {{ heights: Float64Array }} */ (input);
    return heights.reduce((count, z) => (Number.isFinite(z) ? count + 1 : count), 0);
  }
  const { width, height, pixelSize = 1 } = /** @type {import('../types.js').HeightImage} */ (input);
  return Math.round(width * height * (pixelSize / spacing) ** 2 * VERTICES_PER_SQUARE);
}

/** Somebody at a terminal. @type {User} */
const terminalUser = {
  get answers() {
    const { stdin, stderr } = streams();
    return stdin.isTTY === true && stderr.isTTY === true;
  },

  async ask(question, signal) {
    // Not as a terminal of readline's, which would take the key that interrupts for itself.
    const { stdin, stderr } = streams();
    const lines = createInterface({ input: stdin, output: stderr, terminal: false });
    const closed = new Promise((resolve) => lines.once('close', () => resolve('')));
    try {
      return /** @type {string} */ (await Promise.race([lines.question(question, { signal }), closed]));
    } finally {
      lines.close();
    }
  },

  warn: say,
};
