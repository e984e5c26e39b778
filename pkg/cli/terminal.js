/** What people see: results on standard output, and on a terminal how the work goes, so that scripts get silence. */
import { AsyncLocalStorage } from 'node:async_hooks';
import { addAbortSignal } from 'node:stream';
import { failed } from './system-errors.js';

/**
 * Standard input, output and error of the command: the process's own, or those of a caller within the process.
 * @typedef {object} Streams
 * @property {import('node:stream').Readable & { isTTY?: boolean }} stdin
 * @property {NodeJS.WritableStream & { isTTY?: boolean }} stdout
 * @property {NodeJS.WritableStream & { isTTY?: boolean }} stderr
 * @property {AbortSignal} [signal] interrupts the command
 * @property {Buffer} [input] what standard input had, once it is read
 * @property {{ path: string, bytes: Uint8Array }} [kept] the only input, where its format had to be read from it
 * @property {Map<string, string | undefined>} [formats] names of the formats of inputs whose names do not tell them
 * @property {import('../types.js').Assumption[]} [assumptions] what readers assumed of the input and no flag decides
 * @property {boolean} [quiet] whether nothing is said but why the command failed
 */

/** @type {AsyncLocalStorage<Streams>} */
const current = new AsyncLocalStorage();

/** The streams of the command that runs. @returns {Streams} */
export const streams = () => current.getStore() ?? own;

/** @type {Streams} */
const own = process;

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
  return current.run({ ...given }, run);
}

/** Writes to standard error, unless nothing is to be said. @param {string} text */
export const toStderr = (text) => void (streams().quiet || streams().stderr.write(text));

/** All of standard input, which `-` stands for among names of files. */
export async function readStandardInput() {
  const all = streams();
  if (all.input !== undefined) return all.input;
  /** @type {Buffer[]} */
  const chunks = [];
  if (all.signal) addAbortSignal(all.signal, all.stdin);
  for await (const chunk of all.stdin) chunks.push(Buffer.from(chunk));
  return (all.input = Buffer.concat(chunks));
}

/**
 * @param {string | Uint8Array} text
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

/** Whether somebody reads standard error on a terminal: scripts get no news of success. */
function isWatched() {
  const { stderr, quiet } = streams();
  return stderr.isTTY === true && !quiet;
}

/**
 * Says on a terminal what was made.
 * @param {string} output
 * @param {string} figures of it
 */
export function succeed(output, figures) {
  if (isWatched()) toStderr(`${output === '-' ? 'standard output' : output}: ${figures}\n`);
}

/** One line that is written over and over. */
export function statusLine() {
  // News may come from where no command runs.
  const terminal = streams().stderr;
  const shown = isWatched();
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
 * Shows on a terminal what is done while it is done, and how far that is where the work tells it.
 * @template T
 * @param {string} text
 * @param {(watched: { onProgress?: (progress: import('../types.js').CallProgress) => void }) => Promise<T>} work
 * @returns {Promise<T>}
 */
export async function during(text, work) {
  const line = statusLine();
  if (line.shown) line.show(`${text}...`);
  try {
    return await work(line.shown ? { onProgress: ({ fraction }) => line.show(`${text}: ${Math.floor(100 * fraction)} %`) } : {});
  } finally {
    line.clear();
  }
}

/** How a solve goes on, in one line whose numbers only grow: a gap is about one lattice and one pass, and jumps at the next. */
export function progressLine() {
  const line = statusLine();
  const start = performance.now();
  return {
    ...line,
    /** Before there is any progress, which may take long where there are many vertices. */
    begin: () => line.shown && line.show('setting up...'),
    /** @param {import('../types.js').Progress} progress */
    show({ iteration }) {
      line.show(`fitting: ${iteration} iterations, ${((performance.now() - start) / 1000).toFixed(1)} s`);
    },
  };
}

/**
 * What to say of a fit.
 * @param {import('../types.js').Report} report
 */
export function fitInWords({ interior, boundary, omitted, gap, seconds }) {
  const quality = gap === undefined ? 'the optimum up to rounding' : `within ${percent(gap)} of the optimum`;
  return `${interior + boundary + omitted} vertices, ${quality}, ${seconds.total.toFixed(1)} s`;
}

/**
 * What to say of a fit over a whole mesh.
 * @param {import('../types.js').MeshReport} report
 */
export function meshFitInWords({ vertices, passes, seconds }) {
  const gap = passes.at(-1)?.gap;
  const quality = gap === undefined ? '' : `, the last of ${passes.length} linearised problems within ${percent(gap)} of its optimum`;
  return `${vertices} vertices${quality}, ${seconds.total.toFixed(1)} s`;
}

/** @param {number} share */
export function percent(share, digits = 3) {
  return `${Number((100 * share).toPrecision(digits))} %`;
}
