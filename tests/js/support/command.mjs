/** Runs the command: as a child process, or in this one. */
import { spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { PassThrough } from 'node:stream';
import { text } from 'node:stream/consumers';
import { after } from 'node:test';
import { main } from '../../../pkg/cli/main.js';
import { pkg } from './paths.mjs';

export const command = join(pkg, 'bin/developable.js');

/** A folder that goes away with the tests of the file. */
export async function temporaryFolder() {
  const folder = await mkdtemp(join(tmpdir(), 'developable-test-'));
  after(() => rm(folder, { recursive: true, force: true }));
  return folder;
}

/**
 * @param {string} folder
 * @param {string[]} args
 * @param {object} [options]
 * @param {(child: import('node:child_process').ChildProcess) => void} [options.onStart]
 * @param {string[]} [options.program] what is started, in the place of Node with the command
 * @param {Record<string, string>} [options.env] variables of the environment besides those of this process
 * @param {boolean} [options.channel] whether the child can send messages
 * @returns {Promise<{ status: number | null, stdout: string, stderr: string }>}
 */
export function run(folder, args, { onStart, program = [process.execPath, command], env, channel = false } = {}) {
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

/**
 * The command within this process, whose folder it works in: one at a time, and without the start of a process.
 * @param {string} folder
 * @param {string[]} args
 * @param {AbortSignal} [signal] interrupts it
 * @returns {Promise<{ status: number, stdout: string, stderr: string }>}
 */
export async function runHere(folder, args, signal) {
  const [stdin, stdout, stderr] = [new PassThrough(), new PassThrough(), new PassThrough()];
  const said = Promise.all([text(stdout), text(stderr)]);
  const before = process.cwd();
  process.chdir(folder);
  try {
    stdin.end();
    const status = await main(args, { stdin, stdout, stderr, signal });
    stdout.end();
    stderr.end();
    const [output, errors] = await said;
    return { status, stdout: output, stderr: errors };
  } finally {
    process.chdir(before);
  }
}
