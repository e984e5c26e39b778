/** What went wrong with a file, without the words of the library that reads it. */

/** How messages of our own begin; what else follows “cannot read this as” is a library's. */
const OWN = /^(it|its|the file|there|an attribute|a) /;
/** What libraries say of files that end too early. */
const SHORT = /end of file|unexpected end|EOF|EOCD|fill whole buffer|missing bytes|completely read|too short|exceeds that of slice|truncated/i;
const AGAIN = 'copy, download or export it again';

/**
 * @param {string} message of an error
 * @returns {string} the same without a stop at its end
 */
export function plainly(message) {
  const [, format, reason] = /^cannot read this as (?:an? )?(.+?): (.*)$/s.exec(message) ?? [];
  if (format) {
    if (SHORT.test(reason)) return `the ${format} file is cut short: it ends before all of it is there; ${AGAIN}`;
    if (OWN.test(reason)) return reason;
    const [, line] = /\b[Ll]ine:? (\d+)/.exec(reason) ?? [];
    if (/index out of bounds/.test(reason)) return 'the file is damaged: one of its faces has a corner that is not in the file';
    return `the file is damaged, or not of the format ${format}: ${line ? `line ${line} of it` : 'a part of it'} cannot be read; ${AGAIN}`;
  }
  const [, row] = /^vertex position of the mesh is .* at row (\d+)/.exec(message) ?? [];
  if (row) return `vertex ${Number(row) + 1} of the mesh is at no place (“not a number” or infinite); repair the mesh, or take the vertex out`;
  return message
    .replace(/^this file: /, '')
    .replace(/: readMesh reads it$/, '; give its name the ending of a mesh, such as .glb')
    .replace(/^(\w+): it has no faces; points without any are a point cloud$/, 'there are neither faces nor points in it')
    .replace(/^EXR: too new file feature flags$/, 'this EXR file is of a kind that is not read; save it as a plain one, with one layer')
    .replace(/\.$/, '');
}
