/** Images of what is known besides the heights: how far they are to be trusted, and what must be met. */
import { choosesFile, element } from '../dom.js';

/** @import {Input, Session} from '../session.js' */
/** @typedef {Awaited<ReturnType<Session['api']['read']>>} Image */

/** @param {Session} session */
export function besidePanel(session) {
  const panel = element('beside', HTMLElement);
  const rows = [
    imageRow(session, 'confidence', (image) => ({ confidence: confidenceOf(image) })),
    imageRow(session, 'constraints', (image) => ({ constraints: constraintsOf(image) })),
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
 * @param {(image: Image) => Partial<Pick<Input, 'confidence' | 'constraints'>>} take
 */
function imageRow(session, what, take) {
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
    try {
      const image = await session.api.read(chosen);
      if (session.input !== input) return;
      if (image.width !== input.width || image.height !== input.height) {
        throw new Error(`it is ${image.width} × ${image.height} pixels, and the heights are ${input.width} × ${input.height}`);
      }
      opened = chosen.name;
      session.amend(take(image));
    } catch (error) {
      session.fail(`“${chosen.name}” could not be used`, error);
    }
  });
  return (/** @type {Input} */ input) => {
    const there = input[what] !== undefined;
    drop.hidden = !there;
    name.textContent = there ? opened || 'by hand' : hint;
  };
}

/** White is 1; other numbers than whole ones are taken as they are. @param {Image} image */
function confidenceOf({ data, dataType }) {
  const [, bits] = /^u(\d+)$/.exec(dataType) ?? [];
  const largest = bits ? 2 ** Number(bits) - 1 : 1;
  const confidence = data.map((value) => (Number.isNaN(value) ? 0 : value / largest));
  if (confidence.some((value) => value < 0)) throw new Error('it has values below 0');
  return confidence;
}

/** @param {Image} image */
function constraintsOf({ data }) {
  const constraints = data.map((value) => (value === 0 ? NaN : value));
  if (constraints.every(Number.isNaN)) throw new Error('it holds nothing: every pixel is 0 or “no data”');
  return constraints;
}
