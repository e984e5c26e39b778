/** The version of the package. */
import { readFile } from 'node:fs/promises';

/** @returns {Promise<string>} */
export async function version() {
  const manifest = await readFile(new URL('../package.json', import.meta.url), 'utf8');
  return JSON.parse(manifest).version;
}
