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
    const files = [...event.dataTransfer?.files ?? []];
    if (files.length > 0) take(files);
  });
}
