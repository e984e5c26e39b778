/** ZIP files, written by fflate, which is loaded with the first of them. */

/** A ZIP of files, by their names. @param {Record<string, Uint8Array | string>} files @returns {Promise<Uint8Array<ArrayBuffer>>} */
export async function zipOf(files) {
  const { strToU8, zipSync } = await import(new URL('./vendor/fflate.js', import.meta.url).href);
  return zipSync(Object.fromEntries(Object.entries(files).map(([name, content]) => [name, typeof content === 'string' ? strToU8(content) : content])));
}
