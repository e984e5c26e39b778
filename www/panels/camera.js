/** Depths from a camera, put where it has seen them: a mesh, of which a view is taken. */
import { element } from '../dom.js';

/** @import {Mesh} from '../api.js' */
/** @import {Input, Session} from '../session.js' */

/**
 * @param {Session} session
 * @param {(file: Pick<Input, 'name' | 'kind'>, load: () => Promise<Mesh>, doing: string) => void} take
 */
export function cameraPanel(session, take) {
  const wanted = element('is-depth', HTMLInputElement);
  const panel = element('camera', HTMLElement);
  const [fx, fy, cx, cy, scale] = ['fx', 'fy', 'cx', 'cy', 'scale'].map((name) => element(`camera-${name}`, HTMLInputElement));
  const fields = [fx, fy, cx, cy, scale];

  wanted.addEventListener('change', () => {
    panel.hidden = !wanted.checked;
    const { input } = session;
    if (!input) return;
    // Most cameras look through the middle.
    cx.value = String((input.width - 1) / 2);
    cy.value = String((input.height - 1) / 2);
  });
  element('back-project', HTMLButtonElement).addEventListener('click', () => {
    const { input } = session;
    if (!input) return;
    for (const field of fields) {
      const sound = Number.isFinite(field.valueAsNumber) && (field === cx || field === cy || field.valueAsNumber > 0);
      field.setCustomValidity(sound ? '' : `It must be a number${field === cx || field === cy ? '' : ' above 0'}.`);
      if (!field.reportValidity()) return;
    }
    const [x, y, across, down, depthScale] = fields.map((field) => field.valueAsNumber);
    const { name, width, height, data } = input;
    const camera = { fx: x, fy: y, cx: across, cy: down, depthScale };
    take({ name, kind: 'depths' }, () => session.api.backProject({ width, height, data }, camera), 'The depths could not be put in space');
  });
  session.on('cleared', () => {
    wanted.checked = false;
    panel.hidden = true;
  });
}
