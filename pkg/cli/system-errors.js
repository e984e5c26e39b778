/** Messages about files that cannot be read or written, in words of our own. */
import { messageOf } from '../errors.js';
import { Problem, status } from './problem.js';

/** Reasons by the system's codes. @type {Record<string, string>} */
export const reasons = {
  ENOENT: 'there is no such file or folder',
  EISDIR: 'it is a folder',
  ENOTDIR: 'a part of the path is no folder',
  // Node makes U+FFFD of what is not UTF-8 in a name.
  NOT_UTF8: 'its name is not UTF-8, which Node cannot pass on: rename the file, or redirect it (- is standard input and output)',
  EACCES: 'permission denied',
  EPERM: 'not permitted',
  EROFS: 'the file system is read-only',
  ENOSPC: 'the disk is full',
  EDQUOT: 'the disk quota is exceeded',
  EFBIG: 'it would be too large a file',
  EIO: 'the disk failed',
  EBUSY: 'it is in use',
  EMFILE: 'too many files are open',
  ENFILE: 'too many files are open',
  ELOOP: 'its links go in a circle',
  ENAMETOOLONG: 'the name is too long',
  ERR_INVALID_ARG_VALUE: 'no file can have this name',
};

/**
 * Says what went wrong with a file, without the system's own names for it.
 * @param {string} what
 * @param {unknown} error
 */
export function failed(what, error) {
  if (error instanceof Problem) return error;
  const reason = (what.includes('\ufffd') && reasons.NOT_UTF8) || reasons[codeOf(error)] || messageOf(error).replace(/^E[A-Z0-9]+: (.*?)(, \w+( '.*)?)?$/s, '$1');
  return new Problem(status.input, `${what}: ${reason}`);
}

/** @param {unknown} error */
export function codeOf(error) {
  return /** @type {NodeJS.ErrnoException} */ (error).code ?? '';
}
