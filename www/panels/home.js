/** The first screen: three doors, each with its files, the camera or an example. */
import { exampleModel } from '../doors/example-model.js';
import { element, elements, onFilesChosen } from '../dom.js';

/** @typedef {'page' | 'model' | 'scan'} Door */

/** Endings that the file dialog of a door offers: any for heights. @type {Partial<Record<Door, string>>} */
const ACCEPTED = { page: 'image/*,.pdf', model: '.obj,.ply,.stl,.glb,.gltf,.3mf,.off,.xyz,.mtl,image/*' };

/**
 * @param {(files: File[], door?: Door) => unknown} open opens files; of a door, if they were chosen there
 * @param {{ page: () => void, scan: () => void }} examples show the examples of the doors that need no file
 */
export function homePanel(open, examples) {
  const input = element('file', HTMLInputElement);
  /** The door whose dialog is open. @type {Door | undefined} */
  let asked;
  /** @param {Door} [door] */
  const ask = (door) => {
    asked = door;
    input.accept = (door && ACCEPTED[door]) ?? '';
  };
  element('open', HTMLButtonElement).addEventListener('click', () => ask());
  onFilesChosen(element('open', HTMLButtonElement), input, (files) => open(files, asked));
  onFilesChosen(element('take-photo', HTMLButtonElement), element('camera-shot', HTMLInputElement), (files) => open(files, 'page'));
  for (const button of elements('[data-open]', HTMLButtonElement)) {
    button.addEventListener('click', () => {
      ask(/** @type {Door} */ (button.dataset.open));
      input.click();
    });
  }
  for (const button of elements('[data-example]', HTMLButtonElement)) {
    button.addEventListener('click', () => {
      const door = /** @type {Door} */ (button.dataset.example);
      if (door === 'model') open([exampleModel()]);
      else examples[door]();
    });
  }
}
