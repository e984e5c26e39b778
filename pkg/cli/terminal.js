/** What people see: results on standard output, and on a terminal how the work goes, so that scripts get silence. */
import { failed } from './files.js';

const terminal = process.stderr;

// What cannot be written is said where it was asked for, and of standard error there is nobody to tell.
for (const stream of [process.stdout, process.stderr]) stream.on('error', () => {});

/**
 * @param {string} text
 * @returns {Promise<void>}
 */
export function print(text) {
  return new Promise((resolve, reject) => {
    process.stdout.write(text, (error) => {
      // Who has read enough, as `head` has, closes the pipe.
      if (!error || /** @type {NodeJS.ErrnoException} */ (error).code === 'EPIPE') resolve();
      else reject(failed('cannot write to standard output', error));
    });
  });
}

/** Says something on standard error, in the place of what a terminal shows of the work. @param {string} text */
export function say(text) {
  terminal.write(`${terminal.isTTY ? '\r\x1b[K' : ''}developable: ${text}\n`);
}

/** One line that is written over and over. */
export function statusLine() {
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
  if (!terminal.isTTY) return;
  const vertices = interior + boundary + omitted;
  const quality = gap === undefined ? 'the optimum up to rounding' : `within ${percent(gap)} of the optimum`;
  terminal.write(
    `${output}: ${vertices} vertices, ${quality} ` +
      `after ${iterations} iterations and ${seconds.total.toFixed(1)} s\n`,
  );
}

/**
 * @param {string} output
 * @param {import('../types.js').MeshReport} report
 */
export function announceMesh(output, { vertices, passes, seconds }) {
  if (!terminal.isTTY) return;
  const iterations = passes.reduce((sum, pass) => sum + pass.iterations, 0);
  const gap = passes.at(-1)?.gap;
  const quality = gap === undefined ? '' : `, the last of ${passes.length} linearised problems within ${percent(gap)} of its optimum`;
  terminal.write(`${output}: ${vertices} vertices${quality} after ${iterations} iterations and ${seconds.total.toFixed(1)} s\n`);
}

/** @param {number} share */
export function percent(share, digits = 3) {
  return `${Number((100 * share).toPrecision(digits))} %`;
}
