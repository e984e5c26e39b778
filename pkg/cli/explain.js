/** What the command tells of an error, and the exit status that goes with it. */
import { DevelopableError } from '../index.js';
import { messageOf } from '../errors.js';
import { asFlags } from './flags.js';
import { Problem, status } from './problem.js';

/**
 * What to tell the user of an error, whatever threw it.
 * @param {unknown} error
 * @returns {Problem}
 */
export function asProblem(error) {
  if (error instanceof Problem) return error;
  if (!(error instanceof DevelopableError)) {
    return new Problem(status.failure, error instanceof Error && error.stack ? error.stack : messageOf(error));
  }
  switch (error.code) {
    case 'OPTION':
      return new Problem(status.usage, asFlags(error.message));
    case 'INIT':
    case 'TRAP':
    case 'WORKER':
      return new Problem(status.failure, error.message);
    default:
      return new Problem(status.input, error.message);
  }
}

/**
 * Names the file in what is wrong with it.
 * @template T
 * @param {string} path
 * @param {() => Promise<T>} read
 */
export async function withFileName(path, read) {
  try {
    return await read();
  } catch (error) {
    if (error instanceof DevelopableError && error.code !== 'TRAP') {
      throw new Problem(status.input, `${path}: ${asFlags(error.message)}`);
    }
    throw error;
  }
}
