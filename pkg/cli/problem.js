/** How the command can end. */
export const status = {
  success: 0,
  /** Something that should not happen: the library failed. */
  failure: 1,
  usage: 2,
  input: 3,
  /** The terminal was closed. */
  hungUp: 129,
  interrupted: 130,
  terminated: 143,
};

/** Something to tell the user, and the exit status that goes with it. */
export class Problem extends Error {
  /**
   * @param {number} status
   * @param {string} message
   */
  constructor(status, message) {
    super(message);
    this.status = status;
  }
}
