/** Errors that tests expect. */
import assert from 'node:assert/strict';
import { DevelopableError } from '../../../pkg/errors.js';

/**
 * For `assert.throws` and `assert.rejects`: an error of the package with a code and a message.
 * @param {string} code
 * @param {RegExp} [message]
 */
export const error = (code, message = /./) => (/** @type {unknown} */ thrown) => {
  assert.ok(thrown instanceof DevelopableError, String(thrown));
  assert.deepEqual([thrown.name, thrown.code], ['DevelopableError', code], thrown.message);
  assert.match(thrown.message, message);
  return true;
};
