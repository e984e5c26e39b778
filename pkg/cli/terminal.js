/** What people see: results on standard output, and on a terminal how the work goes, so that scripts get silence. */
import { AsyncLocalStorage } from 'node:async_hooks';
import { failed } from './files.js';

/**
 * Standard input, output and error of the command: the process's own, or those of a caller within the process.
 * @typedef {object} Streams
 * @property {NodeJS.ReadableStream & { isTTY?: boolean }} stdin
 * @property {NodeJS.WritableStream & { isTTY?: boolean }} stdout
 * @property {NodeJS.WritableStream & { isTTY?: boolean }} stderr
 */

/** @type {AsyncLocalStorage<Streams>} */
const current = new AsyncLocalStorage();

/** The streams of the command that runs. @returns {Streams} */
export const streams = () => current.getStore() ?? process;

/**
 * Runs a command with streams of the caller's.
 * @template T
 * @param {Streams} given
 * @param {() => Promise<T>} run
 */
export function withStreams(given, run) {
  // What cannot be written is said where it was asked for, and of standard error there is nobody to tell.
  for (const stream of new Set([given.stdout, given.stderr])) {
    if (stream.listenerCount('error') === 0) stream.on('error', () => {});
  }
  return current.run(given, run);
}

/** Writes to standard error. @param {string} text */
export const toStderr = (text) => void streams().stderr.write(text);

/**
 * @param {string} text
 * @returns {Promise<void>}
 */
export function print(text) {
  return new Promise((resolve, reject) => {
    streams().stdout.write(text, (/** @type {Error | null | undefined} */ error) => {
      // Who has read enough, as `head` has, closes the pipe.
      if (!error || /** @type {NodeJS.ErrnoException} */ (error).code === 'EPIPE') resolve();
      else reject(failed('cannot write to standard output', error));
    });
  });
}

/** Says something on standard error, in the place of what a terminal shows of the work. @param {string} text */
export function say(text) {
  toStderr(`${streams().stderr.isTTY ? '\r\x1b[K' : ''}developable: ${text}\n`);
}

/** Whether what is said on standard error is read on a terminal: scripts get no news of success. */
export function isTerminal() {
  return streams().stderr.isTTY === true;
}

/** One line that is written over and over. */
export function statusLine() {
  // News may come from where no command runs.
  const terminal = streams().stderr;
  const shown = terminal.isTTY === true;
  return {
    shown,
    /** @param {string} text */
    show: (text) => terminal.write(`\r\x1b[K${text}`),
    clear() {
      if (shown) terminal.write('\r\x1b[K');
    },
  };
}

/**
 * Shows on a terminal what is done while it is done.
 * @template T
 * @param {string} text
 * @param {() => Promise<T>} work
 * @returns {Promise<T>}
 */
export async function during(text, work) {
  const line = statusLine();
  if (line.shown) line.show(`${text}...`);
  try {
    return await work();
  } finally {
    line.clear();
  }
}

/** How a solve goes on, in one line. */
export function progressLine() {
  const line = statusLine();
  return {
    ...line,
    /** Before there is any progress, which may take long where there are many vertices. */
    begin: () => line.shown && line.show('setting up...'),
    /** @param {import('../types.js').Progress} progress */
    show({ level, iteration, gap, elapsed }) {
      const state = level > 0 ? `coarse lattice, ${level} finer to come` : gap === undefined ? 'gap unknown' : `gap ${percent(gap)}`;
      line.show(`iteration ${iteration}, ${state}, ${elapsed.toFixed(1)} s`);
    },
  };
}

/**
 * @param {string} output
 * @param {import('../types.js').Report} report
 */
export function announce(output, { interior, boundary, omitted, iterations, gap, seconds }) {
  if (!streams().stderr.isTTY) return;
  const vertices = interior + boundary + omitted;
  const quality = gap === undefined ? 'the optimum up to rounding' : `within ${percent(gap)} of the optimum`;
  toStderr(
    `${output}: ${vertices} vertices, ${quality} ` +
      `after ${iterations} iterations and ${seconds.total.toFixed(1)} s\n`,
  );
}

/**
 * @param {string} output
 * @param {import('../types.js').MeshReport} report
 */
export function announceMesh(output, { vertices, passes, seconds }) {
  if (!streams().stderr.isTTY) return;
  const iterations = passes.reduce((sum, pass) => sum + pass.iterations, 0);
  const gap = passes.at(-1)?.gap;
  const quality = gap === undefined ? '' : `, the last of ${passes.length} linearised problems within ${percent(gap)} of its optimum`;
  toStderr(`${output}: ${vertices} vertices${quality} after ${iterations} iterations and ${seconds.total.toFixed(1)} s\n`);
}

/** @param {number} share */
export function percent(share, digits = 3) {
  return `${Number((100 * share).toPrecision(digits))} %`;
}
