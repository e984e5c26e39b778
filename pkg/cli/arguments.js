/** From the command line to a task. */
import { realpathSync } from 'node:fs';
import { extname, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { messageOf } from '../errors.js';
import { Problem, status } from './problem.js';

/**
 * @typedef {'.npy' | '.png' | '.obj'} Extension
 * @typedef {object} FitTask
 * @property {'fit'} command
 * @property {string} input
 * @property {string} output
 * @property {Extension} extension the output's
 * @property {string} [report]
 * @property {string} [mask]
 * @property {'square' | 'hex'} lattice
 * @property {number} [spacing]
 * @property {number} [heightScale]
 * @property {number} [noData]
 * @property {import('../types.js').SolverOptions} options
 */

const flags = /** @type {const} */ ({
  output: { type: 'string', short: 'o' },
  lambda: { type: 'string' },
  gap: { type: 'string' },
  schedule: { type: 'string' },
  'max-iterations': { type: 'string' },
  lattice: { type: 'string' },
  spacing: { type: 'string' },
  'height-scale': { type: 'string' },
  mask: { type: 'string' },
  'no-data': { type: 'string' },
  'no-normalize': { type: 'boolean' },
  report: { type: 'string' },
  help: { type: 'boolean', short: 'h' },
  version: { type: 'boolean' },
});

const lattices = /** @type {const} */ (['square', 'hex']);
const schedules = /** @type {const} */ (['default', 'paper']);

/**
 * @param {string[]} args
 * @returns {FitTask | { command: 'help' } | { command: 'version' }}
 */
export function parse(args) {
  const { values, positionals } = split(args);
  if (values.help) return { command: 'help' };
  if (values.version) return { command: 'version' };
  const [command, input, ...more] = positionals;
  if (command === undefined) throw usage('there is nothing to do');
  if (command !== 'fit') throw usage(`there is no command "${command}", only "fit"`);
  if (input === undefined) throw usage('the input is missing');
  if (more.length > 0) throw usage(`one input at a time: what is "${more[0]}"?`);

  const { output, mask, report } = values;
  if (output === undefined) throw usage('the output is missing: -o FILE');
  if (report !== undefined) apart({ report }, { output, input, mask });
  apart({ output }, { mask });
  /** @param {'spacing' | 'height-scale' | 'no-data' | 'gap' | 'max-iterations'} name */
  const number = (name) => asNumber(name, values[name]);
  return {
    command: 'fit',
    input,
    output,
    extension: extension(output),
    report,
    mask,
    lattice: choice('lattice', values.lattice ?? 'square', lattices),
    spacing: number('spacing'),
    heightScale: number('height-scale'),
    noData: number('no-data'),
    options: {
      lambda: lambda(values.lambda),
      gap: number('gap'),
      schedule: choice('schedule', values.schedule ?? 'default', schedules),
      maxIterations: number('max-iterations'),
      normalize: !values['no-normalize'],
    },
  };
}

/**
 * Nothing that is read is overwritten, but for the input on demand: `-o INPUT`.
 * @param {Record<string, string>} written
 * @param {Record<string, string | undefined>} others
 */
function apart(written, others) {
  const [[name, file]] = Object.entries(written);
  for (const [other, path] of Object.entries(others)) {
    if (path !== undefined && whereabouts(path) === whereabouts(file)) {
      throw usage(`the ${other} and the ${name} are the same file`);
    }
  }
}

/** A file's place, by whatever links it is reached. @param {string} file */
function whereabouts(file) {
  try {
    return realpathSync(file);
  } catch {
    return resolve(file); // not there yet
  }
}

/** @param {string[]} args */
function split(args) {
  try {
    return parseArgs({ args: joined(args), options: flags, allowPositionals: true });
  } catch (error) {
    throw usage(messageOf(error).replace(/\. To specify a positional.*$/s, ''));
  }
}

/**
 * Joins negative numbers to the flags before them, which `parseArgs` would take for flags.
 * @param {string[]} args
 */
function joined(args) {
  /** @type {string[]} */
  const out = [];
  for (const arg of args) {
    const last = out.at(-1);
    if (last?.startsWith('--') && /^-(\.?\d|inf|nan)/i.test(arg)) out[out.length - 1] = `${last}=${arg}`;
    else out.push(arg);
  }
  return out;
}

/**
 * @param {string} output
 * @returns {Extension}
 */
function extension(output) {
  const found = extname(output).toLowerCase();
  if (found === '.npy' || found === '.png' || found === '.obj') return found;
  throw usage(`the output must end in .npy, .png or .obj, but is "${output}"`);
}

/**
 * @param {string | undefined} text
 * @returns {import('../types.js').SolverOptions['lambda']}
 */
function lambda(text) {
  return text === 'small' || text === 'medium' || text === 'big' ? text : asNumber('lambda', text);
}

/**
 * @template {string} T
 * @param {string} name
 * @param {string} value
 * @param {readonly T[]} choices
 * @returns {T}
 */
function choice(name, value, choices) {
  const chosen = choices.find((known) => known === value);
  if (chosen !== undefined) return chosen;
  throw usage(`--${name} must be ${choices.join(' or ')}, but is "${value}"`);
}

/**
 * @param {string} name
 * @param {string | undefined} text
 */
function asNumber(name, text) {
  if (text === undefined) return undefined;
  // `Number` takes blanks for 0.
  const value = text.trim() === '' ? NaN : Number(text);
  if (!Number.isNaN(value)) return value;
  const names = name === 'lambda' ? 'small, medium, big or ' : '';
  throw usage(`--${name} must be ${names}a number, but is "${text}"`);
}

/** @param {string} message */
function usage(message) {
  return new Problem(status.usage, `${message}\nTry "developable --help".`);
}
