/** Comlink, set up alike on both sides: errors cross with their code and come out as what they were. */
import { transferHandlers } from './vendor/comlink.mjs';
import { DevelopableError } from './errors.js';

export { expose, transfer, wrap } from './vendor/comlink.mjs';

/**
 * @typedef {{ code?: import('./errors.js').ErrorCode, name: string, message: string, stack?: string }} Wire
 * @typedef {import('./vendor/comlink.mjs').TransferHandler<{ value: unknown }, Wire>} ThrowHandler
 */

// The library keeps what marks a thrown value to itself, so its own test for it is kept.
const plain = /** @type {ThrowHandler} */ (transferHandlers.get('throw'));

/** @type {ThrowHandler} */
const handler = {
  canHandle: plain.canHandle,
  serialize({ value }) {
    const { code, name, message, stack } = /** @type {DevelopableError} */ (
      value instanceof Error ? value : new Error(String(value))
    );
    return [{ code, name, message, stack }, []];
  },
  deserialize({ code, name, message, stack }) {
    const error = code === undefined
      ? Object.assign(new Error(message), { name })
      : new DevelopableError(code, message);
    // Where it happened says more than where it arrived.
    if (stack !== undefined) error.stack = stack;
    throw error;
  },
};
transferHandlers.set('throw', handler);
