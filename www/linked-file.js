/** A small file within an address, so that a link holds what was opened. */

/** Maximum length of a file in an address, in characters: Safari takes addresses of 80 thousand, other browsers longer ones. */
const MAX_LINKED_CHARACTERS = 60_000;

/** @typedef {{ name: string, data: string }} LinkedFile `data`: its bytes, deflated, in the alphabet of addresses */

/** @param {Blob} bytes @param {CompressionStream | DecompressionStream} through */
const piped = (bytes, through) => new Response(bytes.stream().pipeThrough(through));

/** A file as a part of an address; undefined if it is too large for that. @param {File} file @returns {Promise<LinkedFile | undefined>} */
export async function linkedFile(file) {
  const bytes = new Uint8Array(await piped(file, new CompressionStream('deflate-raw')).arrayBuffer());
  if ((4 / 3) * bytes.length > MAX_LINKED_CHARACTERS) return undefined;
  return { name: file.name, data: btoa(String.fromCharCode(...bytes)).replace(/[+/=]/g, (letter) => ({ '+': '-', '/': '_' })[letter] ?? '') };
}

/** The file of an address. @param {LinkedFile} linked @throws if the address is not whole */
export async function fileOfLink({ name, data }) {
  const bytes = Uint8Array.from(atob(data.replace(/[-_]/g, (letter) => (letter === '-' ? '+' : '/'))), (letter) => letter.charCodeAt(0));
  return new File([await piped(new Blob([bytes]), new DecompressionStream('deflate-raw')).blob()], name);
}
