/** What every function of the package throws or rejects with. */
export class DevelopableError extends Error {
  /**
   * @param {import('./errors.js').ErrorCode} code
   * @param {string} message
   * @param {{ cause?: unknown }} [options]
   */
  constructor(code, message, options) {
    // What was given may be part of it, and be long.
    super(message.length > 900 ? `${message.slice(0, 900)}…` : message, options);
    this.code = code;
  }
}

// On the prototype, as the built-in errors have it, so that it stays out of the way when logged.
Object.defineProperty(DevelopableError.prototype, 'name', {
  value: 'DevelopableError',
  configurable: true,
  writable: true,
});

/**
 * The message of anything that was thrown.
 * @param {unknown} thrown
 * @returns {string}
 */
export function messageOf(thrown) {
  try {
    return String(thrown instanceof Error ? thrown.message : thrown);
  } catch {
    return 'an exception that does not say what it is';
  }
}
