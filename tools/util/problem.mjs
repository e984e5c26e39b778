/** Something the user can do something about: one sentence, shown without a stack trace. */
export class Problem extends Error {}

/**
 * Runs a command's body and turns what goes wrong into one sentence and exit status 1.
 * @param {() => Promise<void>} body
 */
export async function main(body) {
  try {
    if (Number.parseInt(process.versions.node, 10) < 20) {
      throw new Problem(`Node 20 or newer is needed and this is ${process.version}: install a newer one.`);
    }
    await body();
  } catch (error) {
    console.error(`\n${describe(error)}`);
    process.exitCode = 1;
  }
}

/** @param {unknown} error */
export function describe(error) {
  if (error instanceof Problem) return error.message;
  if (process.env.DEBUG && error instanceof Error) return String(error.stack);
  return `This is a mistake in tools/ (DEBUG=1 shows where): ${error}`;
}
