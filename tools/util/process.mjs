/** Running other programs: time limits, captured output, and nothing left behind. */
import { AsyncLocalStorage } from 'node:async_hooks';
import { spawn } from 'node:child_process';
import { Problem } from './problem.mjs';

/** @typedef {Record<string, string | undefined>} Env */

/**
 * @typedef {object} Options
 * @property {Env} [env] default: this process's own
 * @property {string} [cwd]
 * @property {number} [limit] seconds after which the program is ended
 * @property {boolean} [show] passes the output on while it is captured
 */

/**
 * @typedef {object} Result
 * @property {boolean} ok exit status 0, in time
 * @property {string} output standard output and error together
 * @property {string} failure why it is not ok, in a few words
 */

/** What is shown of programs that run beside others: kept until it is their turn. @type {AsyncLocalStorage<{ text: string, isShown: boolean }>} */
export const shownLater = new AsyncLocalStorage();
/** Those of which something is kept. @type {Set<{ text: string, isShown: boolean }>} */
const unshown = new Set();

/** Ends everything a child has started: with a process group of its own that is one signal. */
const groups = process.platform !== 'win32';
/** @type {Set<import('node:child_process').ChildProcess>} */
const running = new Set();

/**
 * @param {import('node:child_process').ChildProcess} child
 * @param {NodeJS.Signals} signal
 */
function end(child, signal) {
  try {
    if (groups && child.pid) process.kill(-child.pid, signal);
    else child.kill(signal);
  } catch {
    // It has ended by itself.
  }
}

process.on('exit', () => {
  running.forEach((child) => end(child, 'SIGTERM'));
  // It has not been their turn.
  for (const { text, isShown } of unshown) if (!isShown) process.stdout.write(text);
});
/** @type {[NodeJS.Signals, number][]} */
const signals = [['SIGINT', 130], ['SIGTERM', 143], ['SIGHUP', 129]];
for (const [signal, status] of signals) {
  process.on(signal, () => {
    // A command with an orderly end of its own listens as well.
    if (process.listenerCount(signal) === 1) process.exit(status);
  });
}

/**
 * @param {string} command
 * @param {readonly string[]} args
 * @param {Options} [options]
 * @returns {Promise<Result>}
 */
export function run(command, args, { env = process.env, cwd, limit, show = false } = {}) {
  return new Promise((resolve) => {
    const child = spawn(command, args, {
      env, cwd, detached: groups, windowsHide: true, stdio: ['ignore', 'pipe', 'pipe'],
    });
    running.add(child);
    const kept = shownLater.getStore();
    let output = '';
    let late = false;
    const timer = limit && setTimeout(() => {
      late = true;
      end(child, 'SIGTERM');
      setTimeout(() => end(child, 'SIGKILL'), 5000).unref();
    }, limit * 1000);

    /** @type {[import('node:stream').Readable, NodeJS.WriteStream][]} */
    const streams = [[child.stdout, process.stdout], [child.stderr, process.stderr]];
    for (const [from, to] of streams) {
      from.setEncoding('utf8');
      from.on('data', (text) => {
        output += text;
        if (show && kept?.isShown === false) {
          kept.text += text;
          unshown.add(kept);
        } else if (show) to.write(text);
      });
    }

    /** @param {string} failure */
    const finish = (failure) => {
      clearTimeout(timer || undefined);
      running.delete(child);
      resolve({ ok: failure === '', output, failure });
    };
    child.on('error', (error) => {
      const missing = 'code' in error && error.code === 'ENOENT';
      finish(missing ? `${command} is not installed` : error.message);
    });
    child.on('close', (status, signal) => {
      if (late) finish(`not done after ${limit} s`);
      else if (status === 0) finish('');
      else finish(signal ? `ended by ${signal}` : `exit status ${status}`);
    });
  });
}

/**
 * Runs a program that has to succeed; gives what it printed.
 * @param {string} command
 * @param {readonly string[]} args
 * @param {Options} [options]
 */
export async function succeed(command, args, options = {}) {
  const { ok, output, failure } = await run(command, args, options);
  if (ok) return output;
  throw new Problem(`${[command, ...args].join(' ').slice(0, 70)}: ${failure}${options.show ? ', see above' : `\n${output.slice(-3000)}`}`);
}
