/** Error messages about files, without the wording of the libraries that read them. */

/** Whether an error is one of the package's with this code. @param {unknown} error @param {string} code */
export const hasCode = (error, code) => error instanceof Error && 'code' in error && error.code === code;

/** Beginnings of the package's own messages; any other text after “cannot read this as …:” comes from a library. */
const OWN_MESSAGE_START = /^(it|its|the file|there|an attribute|a|line \d+) /;
/** Wordings of libraries for a file that ends too early. */
const TRUNCATED_FILE = /end of file|unexpected end|EOF|EOCD|fill whole buffer|missing bytes|completely read|too short|exceeds that of slice|truncated/i;
/** The sentence that names the kinds of files which the page opens. */
export const OPENED_FILES = 'This page opens photos of pages (JPEG, HEIC, PNG, WebP, GIF, BMP, TIFF, PDF), heights and depths (TIFF, EXR, PFM, NPY, NPZ, PGM, SRTM, grids in text, grey PNG), and meshes and point clouds (OBJ, PLY, STL, 3MF, OFF, GLB, XYZ)';
/** Advice for a damaged file. */
const COPY_AGAIN = 'copy, download or export it again';

/**
 * The message of an error, rewritten for the user.
 * @param {unknown} error or its message
 * @returns {string} a sentence without its full stop
 */
export function plainMessage(error) {
  if (hasCode(error, 'NO_INTERIOR')) return 'there are too few heights beside each other for a surface';
  const message = error instanceof Error ? error.message : String(error);
  const [, format, reason] = /^cannot read this as (?:an? )?(.+?): (.*)$/s.exec(message) ?? [];
  if (format) {
    if (TRUNCATED_FILE.test(reason)) return `the ${format} file is cut short: it ends before all of it is there; ${COPY_AGAIN}`;
    if (OWN_MESSAGE_START.test(reason)) return reason.includes(';') ? reason : `${reason}; ${COPY_AGAIN}`;
    const [, line] = /\b[Ll]ine:? (\d+)/.exec(reason) ?? [];
    return `the file is damaged, or not of the format ${format}: ${line ? `line ${line} of it` : 'a part of it'} cannot be read; ${COPY_AGAIN}`;
  }
  const [, row] = /^vertex position of the mesh is .* at row (\d+)/.exec(message) ?? [];
  if (row) return `vertex ${Number(row) + 1} of the mesh is at no place (“not a number” or infinite); repair the mesh, or take the vertex out`;
  return message
    .replace(/^this file: /, '')
    .replace(/^text: save what is in it as one that is read/, 'it is text, in none of the formats that are read')
    .replace(/^a file of unknown format: save what is in it as one that is read/, 'its format is not known')
    .replace(/^archive: unpack it first/, 'it is a packed archive, to be unpacked first')
    .replace(/; heights are read from .*$/, `. ${OPENED_FILES}`)
    .replace(/^EXR: too new file feature flags$/, 'this EXR file is of a kind that is not read; save it as a plain one, with one layer')
    .replace(/`([^`]*)`/g, '“$1”').replace(/\.$/, '');
}
