/** Files dropped anywhere on the page. */
import { element } from '../dom.js';

/** @param {(files: File[]) => void} take */
export function watchDrops(take) {
  const veil = element('drop', HTMLElement);
  /** Entering a child comes before leaving its parent, so the two are counted. */
  let depth = 0;

  /** @param {DragEvent} event */
  const hasFiles = (event) => event.dataTransfer?.types.includes('Files') ?? false;
  const leave = () => {
    depth = 0;
    veil.hidden = true;
  };

  addEventListener('dragenter', (event) => {
    if (!hasFiles(event)) return;
    depth++;
    veil.hidden = false;
  });
  addEventListener('dragleave', (event) => {
    if (hasFiles(event) && --depth <= 0) leave();
  });
  addEventListener('dragover', (event) => {
    if (hasFiles(event)) event.preventDefault();
  });
  addEventListener('drop', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    leave();
    void filesOf(event).then((files) => {
      if (files.length > 0) take(files);
    });
  });
}

/**
 * What was dropped, and what lies in dropped folders.
 * @param {DragEvent} event
 * @returns {Promise<File[]>}
 */
async function filesOf({ dataTransfer }) {
  // Asked for at once: after a wait the browser forgets them.
  const files = [...dataTransfer?.files ?? []];
  const entries = [...dataTransfer?.items ?? []].map((item) => item.webkitGetAsEntry?.());
  const folders = /** @type {FileSystemDirectoryEntry[]} */ (entries.filter((entry) => entry?.isDirectory));
  if (folders.length === 0) return files;
  const within = await Promise.all(folders.map(filesIn));
  const names = folders.map(({ name }) => name);
  return [...files.filter(({ name }) => !names.includes(name)), ...within.flat()];
}

/**
 * @param {FileSystemDirectoryEntry} folder
 * @returns {Promise<File[]>} those right in it that are not hidden
 */
async function filesIn(folder) {
  const reader = folder.createReader();
  /** @type {FileSystemEntry[]} */
  const entries = [];
  for (;;) {
    const some = await new Promise((/** @type {(entries: FileSystemEntry[]) => void} */ resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) break;
    entries.push(...some);
  }
  const shown = /** @type {FileSystemFileEntry[]} */ (entries.filter(({ isFile, name }) => isFile && !name.startsWith('.')));
  return Promise.all(shown.map((entry) => new Promise((/** @type {(file: File) => void} */ resolve, reject) => entry.file(resolve, reject))));
}
