/** Error messages, as the page says them. */

/** Whether an error is one of the package's with this code. @param {unknown} error @param {string} code */
export const hasCode = (error, code) => error instanceof Error && 'code' in error && error.code === code;

/** The message of an error, in the page’s own marks. @param {unknown} error or its message @returns {string} a sentence without its full stop */
export function plainMessage(error) {
  if (hasCode(error, 'NO_INTERIOR')) return 'there are too few heights beside each other for a surface';
  const message = error instanceof Error ? error.message : String(error);
  return message.replace(/`([^`]*)`/g, '“$1”').replace(/\.$/, '');
}
