/** Files and folders that are dropped on the page. */
import { element } from '../dom.js';

/** @param {(files: File[]) => void} onFiles */
export function watchDrops(onFiles) {
  const overlay = element('drop', HTMLElement);
  /** @param {DragEvent} event */
  const hasFiles = (event) => event.dataTransfer?.types.includes('Files') ?? false;
  addEventListener('dragover', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    overlay.hidden = false;
  });
  // Nothing of the page is entered where the page itself is left.
  addEventListener('dragleave', ({ relatedTarget }) => (overlay.hidden ||= relatedTarget === null));
  addEventListener('drop', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    overlay.hidden = true;
    void filesOf(event).then((files) => {
      if (files.length > 0) onFiles(files);
    });
  });
}

/**
 * The dropped files, and those in dropped folders.
 * @param {DragEvent} event
 * @returns {Promise<File[]>}
 */
async function filesOf({ dataTransfer }) {
  // The browser clears `dataTransfer` when the event handler returns, so it is read before any `await`.
  const files = [...dataTransfer?.files ?? []];
  const entries = [...dataTransfer?.items ?? []].map((item) => item.webkitGetAsEntry?.());
  const folders = /** @type {FileSystemDirectoryEntry[]} */ (entries.filter((entry) => entry?.isDirectory));
  if (folders.length === 0) return files;
  const folderFiles = await Promise.all(folders.map(filesIn));
  const names = folders.map(({ name }) => name);
  return [...files.filter(({ name }) => !names.includes(name)), ...folderFiles.flat()];
}

/**
 * The files of a folder, without hidden files and subfolders.
 * @param {FileSystemDirectoryEntry} folder
 * @returns {Promise<File[]>}
 */
async function filesIn(folder) {
  const reader = folder.createReader();
  /** @type {FileSystemEntry[]} */
  const entries = [];
  for (;;) {
    const batch = await new Promise((/** @type {(entries: FileSystemEntry[]) => void} */ resolve, reject) => reader.readEntries(resolve, reject));
    if (batch.length === 0) break;
    entries.push(...batch);
  }
  const visible = /** @type {FileSystemFileEntry[]} */ (entries.filter(({ isFile, name }) => isFile && !name.startsWith('.')));
  return Promise.all(visible.map((entry) => new Promise((/** @type {(file: File) => void} */ resolve, reject) => entry.file(resolve, reject))));
}
