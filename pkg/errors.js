/** What every function of the package throws or rejects with. */
export class DevelopableError extends Error {
  /**
   * @param {import('./errors.js').ErrorCode} code
   * @param {string} message
   * @param {{ cause?: unknown }} [options]
   */
  constructor(code, message, options) {
    super(message, options);
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
  return thrown instanceof Error ? thrown.message : String(thrown);
}
