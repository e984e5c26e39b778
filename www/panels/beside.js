/** Images of what is known besides the heights: how far they are to be trusted, and what must be met. */
import { apart, readingOf } from '../worker-task.js';
import { choosesFile, element } from '../dom.js';
import { keepSmall } from '../surface/known.js';
import { handOver } from '../surface/work.js';

/** @import {Input, Session} from '../session.js' */

/** @param {Session} session */
export function besidePanel(session) {
  const panel = element('beside', HTMLElement);
  const rows = [
    imageRow(session, 'confidence', 'confidenceOf'),
    imageRow(session, 'constraints', 'constraintsOf'),
  ];
  session.on('input', (input) => {
    // A design is all constraints, and a mesh has no pixels.
    panel.hidden = input.design === true || input.lattice !== undefined;
    for (const show of rows) show(input);
  });
}

/**
 * A button to open an image, its name, and a button to do without it.
 * @param {Session} session
 * @param {'confidence' | 'constraints'} what
 * @param {'confidenceOf' | 'constraintsOf'} task by which it is understood
 */
function imageRow(session, what, task) {
  const file = element(`${what}-file`, HTMLInputElement);
  const open = element(`${what}-open`, HTMLButtonElement);
  const drop = element(`${what}-drop`, HTMLButtonElement);
  const name = element(`${what}-name`, HTMLElement);
  const hint = name.textContent;
  let opened = '';

  drop.addEventListener('click', () => {
    session.amend({ [what]: undefined });
    open.focus();
  });
  choosesFile(open, file, async (chosen) => {
    const { input } = session;
    if (!input) return;
    const found = await session.obtain(`“${chosen.name}” could not be used`, async (signal) => {
      const image = await apart(session.api, signal, (reader) => reader.read(chosen));
      if (image.width !== input.width || image.height !== input.height) {
        throw new Error(`it is ${image.width} × ${image.height} pixels, and the heights are ${input.width} × ${input.height}`);
      }
      return handOver(task, [image.data], image);
    }, readingOf(chosen));
    if (!found || session.input !== input) return;
    opened = chosen.name;
    keepSmall(found.values, found.small);
    session.amend({ [what]: found.values });
  });
  return (/** @type {Input} */ input) => {
    const there = input[what] !== undefined;
    drop.hidden = !there;
    name.textContent = there ? opened || 'by hand' : hint;
  };
}
