/** Images of confidence and of constraints for the heights. */
import { fileReadTask, runInWorker } from '../worker-task.js';
import { onFileChosen, element } from '../dom.js';
import { storePreviewHeights } from '../surface/derived-data.js';
import { transferToWorker } from '../surface/worker-client.js';

/** @import {Input, Session} from '../session.js' */

/** @param {Session} session */
export function inputImagesPanel(session) {
  const panel = element('beside', HTMLElement);
  const rows = [
    imageRow(session, 'confidence', 'confidenceOf'),
    imageRow(session, 'constraints', 'constraintsOf'),
  ];
  session.on('input', (input) => {
    // A design consists of constraints already, and a sampled mesh has no pixels of a file.
    panel.hidden = input.design === true || input.lattice !== undefined;
    for (const show of rows) show(input);
  });
}

/**
 * A row with a button that opens an image, its name, and a button that removes it.
 * @param {Session} session
 * @param {'confidence' | 'constraints'} property of the input
 * @param {'confidenceOf' | 'constraintsOf'} task conversion of the image in the page's worker
 */
function imageRow(session, property, task) {
  const fileInput = element(`${property}-file`, HTMLInputElement);
  const open = element(`${property}-open`, HTMLButtonElement);
  const remove = element(`${property}-drop`, HTMLButtonElement);
  const name = element(`${property}-name`, HTMLElement);
  const hint = name.textContent;
  let openedName = '';

  remove.addEventListener('click', () => {
    session.updateInput({ [property]: undefined });
    open.focus();
  });
  onFileChosen(open, fileInput, async (chosen) => {
    const { input } = session;
    if (!input) return;
    const found = await session.load(`“${chosen.name}” could not be used`, async (signal) => {
      const image = await runInWorker(session.api, signal, (reader) => reader.read(chosen));
      if (image.width !== input.width || image.height !== input.height) {
        throw new Error(`it is ${image.width} × ${image.height} pixels, and the heights are ${input.width} × ${input.height}`);
      }
      return transferToWorker(task, [image.data], image);
    }, fileReadTask(chosen));
    if (!found || session.input !== input) return;
    openedName = chosen.name;
    storePreviewHeights(found.values, found.small);
    session.updateInput({ [property]: found.values });
  });
  return (/** @type {Input} */ input) => {
    const isPresent = input[property] !== undefined;
    remove.hidden = !isPresent;
    name.textContent = isPresent ? openedName || 'by hand' : hint;
  };
}
