/** Several inputs, each by a process of its own, and one summary. */
import { spawn } from 'node:child_process';
import { statSync } from 'node:fs';
import { mkdir } from 'node:fs/promises';
import { availableParallelism } from 'node:os';
import { dirname, extname, basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { show } from '../values.js';
import { commands } from './commands.js';
import { isRecorded, record } from './fingerprint.js';
import { CAMERA_FILE, readFlag, usage, valueName } from './flags.js';
import { Problem, status } from './problem.js';
import { failed } from './system-errors.js';
import { defaultExtension, isBook, taskOf } from './task.js';
import { print, say, statusLine } from './terminal.js';

/**
 * @typedef {object} BatchItem
 * @property {string} input
 * @property {string[]} args the command line for this input alone
 * @property {string[]} read the files that it reads, as far as the command line names them
 * @property {string[]} written the files that it writes
 *
 * @typedef {{ items: BatchItem[], jobs: number, overwrite: boolean }} Batch
 * @typedef {{ code: number | null, stdout: string, stderr: string }} Ending
 */

/** Flags that name a file, in which `*` stands for the name of the input without folder and ending. */
const NAMING_FLAGS = [
  'output', 'report', 'map', 'mtl', 'assembly', 'mask', 'confidence', 'constraints', 'occlusions', 'texture', 'photo-camera',
  'intrinsics', 'edges',
];

/** Flags that name a file which the command writes. @type {readonly string[]} */
const WRITTEN_FLAGS = ['output', 'report', 'map', 'mtl', 'assembly'];

/** Environment variable that tells a process that it does one input of a batch, and so starts no batch itself. */
const CHILD_VARIABLE = 'DEVELOPABLE_BATCH_CHILD';

/** Maximum number of characters that are kept of what one process says. */
const MAX_KEPT_OUTPUT = 1 << 24;

/**
 * The batch that a command line asks for; nothing where it has one input and one output. All of it is checked before any
 * of it is started.
 * @param {import('./command-line.js').CommandLine} line with the files that its inputs stand for
 * @returns {Batch | undefined}
 */
export function batchOf({ command, inputs, values, texts }) {
  const { output, jobs = availableParallelism(), overwrite = false } = values;
  if (process.env[CHILD_VARIABLE] !== undefined || inputs.length === 0 || command === 'completion') return undefined;
  /** @type {readonly string[]} */
  const endings = commands[command].writes;
  const folder = output !== undefined && (isFolderName(output) || (isFolder(output) && !endings.includes(extname(output).toLowerCase())));
  const names = folder || output?.includes('*');
  if (inputs.length === 1 && !names) return undefined;
  if (isBook(command, inputs, values)) return undefined;
  if (command !== 'info' && (output === undefined || output === '-')) {
    throw usage('the output of several inputs is missing: -o FOLDER/, or a name with * for that of the input, as in -o "FOLDER/*.json"', command);
  }
  if (inputs.includes('-')) throw usage('- is standard input of one input with one output: name the files, or do it apart', command);
  /** @type {Map<string, string>} */
  const owners = new Map();
  const items = inputs.map((input) => {
    const named = namesFor(command, input, values, texts, inputs.length > 1);
    const own = { ...texts, ...named };
    const flags = Object.entries(own).filter(([flag]) => flag !== 'jobs' && flag !== 'overwrite');
    const line = [command, ...flags.map(([flag, text]) => (text === null ? `--${flag}` : `--${flag}=${text}`))];
    // A name that begins with a hyphen is no flag.
    line.push(input.startsWith('-') ? `./${input}` : input);
    const read = Object.entries(named).map(([flag, text]) => [valueName(flag), readFlag(flag, text, command)]);
    const { written } = taskOf(command, [input], { ...values, ...Object.fromEntries(read) });
    for (const path of written) {
      const other = owners.get(path);
      if (other !== undefined) {
        throw usage(`${other} and ${input} would both be written to ${path}: give one of them another name, or do them apart`, command);
      }
      owners.set(path, input);
    }
    const known = NAMING_FLAGS.filter((flag) => !WRITTEN_FLAGS.includes(flag)).flatMap((flag) => own[flag] ?? [])
      // The numbers of a camera are no file.
      .filter((path) => path !== own.intrinsics || CAMERA_FILE.test(path));
    return { input, args: line, read: [input, ...known], written };
  });
  return { items, jobs: Math.min(jobs, items.length), overwrite };
}

/**
 * The names of files for one of the inputs, by their flags.
 * @param {import('./commands.js').CommandName} command
 * @param {string} input
 * @param {import('./task.js').Values} values
 * @param {Record<string, string | null>} texts
 * @param {boolean} several whether there are other inputs
 * @returns {Record<string, string>}
 */
function namesFor(command, input, values, texts, several) {
  const stem = basename(input, extname(input));
  /** @type {Record<string, string>} */
  const own = {};
  for (const flag of NAMING_FLAGS) {
    const path = texts[flag] ?? undefined;
    if (path === undefined) continue;
    if (path.includes('*')) {
      own[flag] = path.replaceAll('*', () => stem);
    } else if (flag === 'output' && command !== 'info' && (isFolderName(path) || isFolder(path))) {
      own[flag] = join(path, stem + defaultExtension(command, input, values));
    } else if (several && WRITTEN_FLAGS.includes(flag)) {
      const also = flag === 'output' ? ', or a folder' : '';
      throw usage(`--${flag} ${show(path)} is one file for several inputs: * stands for the name of the input${also}`, command);
    }
  }
  return own;
}

/** @param {string} path */
function isFolderName(path) {
  return path.endsWith('/') || path.endsWith('\\');
}

/** @param {string} path */
function isFolder(path) {
  try {
    return statSync(path).isDirectory();
  } catch {
    return false; // what is wrong with the path is said where it is written
  }
}

/**
 * Does all of a batch, several inputs at a time. What is done already is skipped, and a failure stops none of the others.
 * @param {Batch} batch
 * @param {AbortSignal} signal
 * @returns {Promise<number>} the exit status
 */
export async function runBatch({ items, jobs, overwrite }, signal) {
  const counts = { done: 0, skipped: 0, failed: 0 };
  /** @type {number[]} */
  const codes = [];
  /** @type {Map<BatchItem, string>} */
  const told = new Map();
  const line = statusLine();
  const waiting = items.values();
  const news = () => {
    const finished = counts.done + counts.skipped + counts.failed;
    if (line.shown) line.show(`${finished} of ${items.length} files${counts.failed > 0 ? `, ${counts.failed} failed` : ''}...`);
  };
  const work = async () => {
    for (const item of waiting) {
      if (signal.aborted) return;
      if (!overwrite && (await isRecorded(item))) {
        counts.skipped += 1;
      } else {
        const { code, stdout, stderr } = await ending(item, signal);
        if (signal.aborted) return;
        told.set(item, stdout);
        const words = stderr.replace(/^developable: /gm, '').trim();
        // What is wrong with a file begins with its name.
        if (words !== '') say(words.startsWith(`${item.input}:`) ? words : `${item.input}: ${words}`);
        else if (code !== status.success) say(`${item.input}: the process ended with ${code ?? 'a signal'}`);
        if (code === status.success) await record(item);
        counts[code === status.success ? 'done' : 'failed'] += 1;
        if (code !== status.success) codes.push(code ?? status.failure);
      }
      news();
    }
  };
  news();
  try {
    await Promise.all(Array.from({ length: jobs }, work));
  } finally {
    line.clear();
  }
  signal.throwIfAborted();
  // In the order of the inputs, whichever was ready first.
  for (const item of items) {
    const text = told.get(item) ?? '';
    if (text !== '') await print(`==> ${item.input} <==\n${text}`);
  }
  const skipped = counts.skipped > 0 ? `, ${counts.skipped} done before (--overwrite does them again)` : '';
  say(`${items.length} file${items.length === 1 ? '' : 's'}: ${counts.done} done${skipped}, ${counts.failed} failed`);
  if (codes.length === 0) return status.success;
  return codes.every((code) => code === codes[0]) ? codes[0] : status.failure;
}

/**
 * How a process ends that does one input.
 * @param {BatchItem} item
 * @param {AbortSignal} signal
 * @returns {Promise<Ending>}
 */
async function ending({ args, written }, signal) {
  for (const path of written) {
    try {
      await mkdir(dirname(path), { recursive: true });
    } catch (error) {
      const problem = failed(`cannot make the folder of ${path}`, error);
      return { code: problem.status, stdout: '', stderr: problem.message };
    }
  }
  // An interruption may have come meanwhile, when there was no process to end.
  if (signal.aborted) return { code: null, stdout: '', stderr: '' };
  const command = fileURLToPath(new URL('../bin/developable.js', import.meta.url));
  return new Promise((resolve) => {
    const child = spawn(process.execPath, [...process.execArgv, command, ...args], {
      stdio: ['ignore', 'pipe', 'pipe'],
      env: { ...process.env, [CHILD_VARIABLE]: '1' },
    });
    let [stdout, stderr] = ['', ''];
    child.stdout.setEncoding('utf8').on('data', (text) => (stdout = (stdout + text).slice(0, MAX_KEPT_OUTPUT)));
    child.stderr.setEncoding('utf8').on('data', (text) => (stderr = (stderr + text).slice(0, MAX_KEPT_OUTPUT)));
    const stop = () => child.kill(signal.reason instanceof Problem && signal.reason.status === status.interrupted ? 'SIGINT' : 'SIGTERM');
    signal.addEventListener('abort', stop);
    child.on('error', (error) => resolve({ code: status.failure, stdout, stderr: error.message }));
    child.on('close', (code) => {
      signal.removeEventListener('abort', stop);
      resolve({ code, stdout, stderr });
    });
  });
}
