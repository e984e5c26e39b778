/** The flags: what there is, which command takes what, and the command line taken apart. */
import { parseArgs } from 'node:util';
import { messageOf } from '../errors.js';
import { Problem, status } from './problem.js';

const text = /** @type {const} */ ({ type: 'string' });
const plain = /** @type {const} */ ({ type: 'boolean' });

const flags = {
  output: /** @type {const} */ ({ type: 'string', short: 'o' }),
  lambda: text,
  gap: text,
  schedule: text,
  'max-iterations': text,
  energy: text,
  reweight: text,
  'tie-break': text,
  lattice: text,
  spacing: text,
  'height-scale': text,
  intrinsics: text,
  ray: plain,
  texture: text,
  mtl: text,
  view: text,
  resolution: text,
  mask: text,
  'no-data': text,
  'no-normalize': plain,
  confidence: text,
  constraints: text,
  free: text,
  occlusions: text,
  threshold: text,
  array: text,
  'occlusion-mask': text,
  report: text,
  'as-is': plain,
  dots: text,
  trim: plain,
  map: text,
  scale: text,
  paper: text,
  tabs: text,
  help: /** @type {const} */ ({ type: 'boolean', short: 'h' }),
  version: plain,
};

/** @typedef {keyof typeof flags} Flag */
/** @typedef {'fit' | 'design' | 'occlusions' | 'analyze' | 'unroll' | 'pattern' | 'dewarp' | 'info'} Command */

/** What only a flat image can be told. @type {readonly Flag[]} */
const ofImages = ['dots', 'trim', 'map'];

/** What only a pattern can be told. @type {readonly Flag[]} */
const ofPatterns = ['scale', 'paper', 'tabs'];

/** What is about flat sheets. @type {readonly Flag[]} */
const ofSheets = ['as-is', ...ofImages, ...ofPatterns];

/** @type {readonly Flag[]} */
const general = ['array', 'help', 'version'];

/** What a command does not take. @type {Record<Command, readonly Flag[]>} */
const foreign = {
  fit: ['threshold', ...ofSheets],
  design: [
    'intrinsics', 'ray', 'texture', 'mtl', 'no-data', 'confidence', 'constraints', 'occlusions', 'threshold',
    ...ofSheets,
  ],
  occlusions: [
    'lambda', 'gap', 'schedule', 'max-iterations', 'energy', 'reweight', 'tie-break', 'confidence',
    'constraints', 'free', 'occlusions', 'occlusion-mask', 'report', 'texture', 'mtl', ...ofSheets,
  ],
  analyze: ['texture', 'mtl', 'report', ...ofImages, ...ofPatterns],
  unroll: ['texture', 'mtl', 'threshold', ...ofImages, ...ofPatterns],
  pattern: ['texture', 'mtl', 'threshold', ...ofImages],
  dewarp: ['mtl', 'threshold', ...ofPatterns],
  info: /** @type {Flag[]} */ (Object.keys(flags)).filter((flag) => !general.includes(flag)),
};

/** @param {string[]} args */
export function split(args) {
  try {
    return parseArgs({ args: joined(args), options: flags, allowPositionals: true });
  } catch (error) {
    throw usage(messageOf(error).replace(/\. To specify a positional.*$/s, ''));
  }
}

/** @typedef {ReturnType<typeof split>['values']} Values */

/**
 * @param {string} name
 * @param {Values} values
 * @returns {Command}
 */
export function commandOf(name, values) {
  const commands = /** @type {Command[]} */ (Object.keys(foreign));
  const command = commands.find((known) => known === name);
  if (!command) throw usage(`there is no command "${name}", only ${commands.join(', ')}`);
  const stray = foreign[command].find((flag) => values[flag] !== undefined);
  if (stray) throw usage(`--${stray} is not for "${command}"`);
  return command;
}

/**
 * Joins negative numbers and axes to the flags before them, which `parseArgs` would take for flags.
 * @param {string[]} args
 */
function joined(args) {
  /** @type {string[]} */
  const out = [];
  for (const arg of args) {
    const last = out.at(-1);
    if (last?.startsWith('--') && /^-(\.?\d|inf|nan|[xyz]$)/i.test(arg)) out[out.length - 1] = `${last}=${arg}`;
    else out.push(arg);
  }
  return out;
}

/** @param {string} message */
export function usage(message) {
  return new Problem(status.usage, `${message}\nTry "developable --help".`);
}
