/** Runs the command: as a child process, or in this one. */
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { PassThrough } from 'node:stream';
import { text } from 'node:stream/consumers';
import { after } from 'node:test';
import { batchOf } from '../../../pkg/cli/batch.js';
import { split } from '../../../pkg/cli/command-line.js';
import { main } from '../../../pkg/cli/main.js';
import { filesOf } from '../../../pkg/cli/globs.js';
import { taskOf } from '../../../pkg/cli/task.js';
import { pkg } from './paths.mjs';

export const command = join(pkg, 'bin/developable.js');

/**
 * What a command line asks for: a batch, a task, or a text that is printed.
 * @param {string[]} args
 */
export function parse(args) {
  const line = split(args);
  if ('printed' in line) return line;
  const inputs = line.inputs.flatMap(filesOf);
  return batchOf({ ...line, inputs }) ?? taskOf(line.command, inputs, line.values);
}

/** A folder that goes away with the tests of the file. */
export async function temporaryFolder() {
  const folder = await mkdtemp(join(tmpdir(), 'developable-test-'));
  after(() => rm(folder, { recursive: true, force: true }));
  return folder;
}

/**
 * A process of its own.
 * @param {string} folder
 * @param {string[]} args
 * @param {object} [options]
 * @param {(child: import('node:child_process').ChildProcess) => void} [options.onStart]
 * @param {string[]} [options.program] what is started, in the place of Node with the command
 * @param {Record<string, string>} [options.env] variables of the environment besides those of this process
 * @param {boolean} [options.channel] whether the child can send messages
 * @returns {Promise<{ status: number | null, stdout: string, stderr: string }>}
 */
export function runProcess(folder, args, { onStart, program = [process.execPath, command], env, channel = false } = {}) {
  return new Promise((resolve, reject) => {
    const [file, ...first] = program;
    /** @type {import('node:child_process').StdioOptions} */
    const stdio = ['ignore', 'pipe', 'pipe', ...(channel ? [/** @type {const} */ ('ipc')] : [])];
    const child = spawn(file, [...first, ...args], { cwd: folder, stdio, env: { ...process.env, ...env } });
    let [stdout, stderr] = ['', ''];
    child.stdout?.on('data', (chunk) => (stdout += chunk));
    child.stderr?.on('data', (chunk) => (stderr += chunk));
    child.on('error', reject);
    child.on('close', (status) => resolve({ status, stdout, stderr }));
    onStart?.(child);
  });
}

/** The command that runs within this process, whose folder it works in. @type {Promise<unknown>} */
let running = Promise.resolve();

/**
 * The command within this process: one at a time, and without the start of a process.
 * @param {string} folder
 * @param {string | readonly string[]} line words, or a text of words between spaces
 * @param {object} [options]
 * @param {AbortSignal} [options.signal] interrupts it
 * @param {Uint8Array | PassThrough} [options.input] what is on standard input, or that itself
 * @param {boolean} [options.terminal] whether somebody reads standard error on a terminal
 * @returns {Promise<{ status: number, stdout: string, stderr: string }>}
 */
export function run(folder, line, options = {}) {
  const args = typeof line === 'string' ? line.split(' ').filter(Boolean) : [...line];
  const result = running.then(() => runHere(folder, args, options));
  running = result.catch(() => {});
  return result;
}

/** The command, which has to succeed. @type {typeof run} */
export async function succeeds(...of) {
  const result = await run(...of);
  assert.equal(result.status, 0, `${of[1]}: ${result.stderr}`);
  return result;
}

/** What is said and done by a command that has nothing to say. */
export const silent = { status: 0, stdout: '', stderr: '' };

/**
 * Each of these command lines is refused by a message alone.
 * @param {string} folder
 * @param {readonly (readonly [line: string | readonly string[], message: RegExp, status?: number])[]} cases status 2 if nothing else is said
 * @param {Parameters<typeof run>[2]} [options]
 */
export async function refuses(folder, cases, options) {
  for (const [line, message, wanted = 2] of cases) {
    const { status, stdout, stderr } = await run(folder, line, options);
    assert.deepEqual([status, stdout], [wanted, ''], `${line}: ${stderr}`);
    assert.match(stderr, message);
    assert.doesNotMatch(stderr, /\n\s+at /, 'no stack trace');
  }
}

/** @type {(folder: string, args: string[], options: Required<Parameters<typeof run>>[2]) => ReturnType<typeof run>} */
async function runHere(folder, args, { signal, input, terminal = false }) {
  const stdin = input instanceof PassThrough ? input : new PassThrough().end(input);
  const [stdout, stderr] = [new PassThrough(), Object.assign(new PassThrough(), { isTTY: terminal })];
  const said = Promise.all([text(stdout), text(stderr)]);
  const before = process.cwd();
  process.chdir(folder);
  try {
    const status = await main(args, { stdin, stdout, stderr, signal });
    stdout.end();
    stderr.end();
    const [output, errors] = await said;
    return { status, stdout: output, stderr: errors };
  } finally {
    process.chdir(before);
  }
}
