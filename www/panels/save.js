/** The result as files. */
import { elements } from '../dom.js';

/** @import {Result, Session} from '../session.js' */

/** @type {Record<string, string>} */
const TYPES = { npy: 'application/octet-stream', png: 'image/png', obj: 'model/obj' };

/** @param {Session} session */
export function savePanel(session) {
  const buttons = elements('button[data-save]', HTMLButtonElement);
  for (const button of buttons) {
    const format = button.dataset.save ?? '';
    button.addEventListener('click', async () => {
      const { result } = session;
      if (!result) return;
      try {
        const bytes = await encode(session, result, format);
        download(new Blob([bytes], { type: TYPES[format] }), `${fileStem(result)}.${format}`);
      } catch (error) {
        session.fail(`The ${format.toUpperCase()} could not be written`, error);
      }
    });
  }
  /** @param {boolean} ready */
  const enable = (ready) => {
    for (const button of buttons) button.disabled = !ready;
  };
  session.on('result', () => enable(true));
  session.on('cleared', () => enable(false));
}

/**
 * Images at the input's pixels, the mesh on the lattice.
 * @param {Session} session
 * @param {Result} result
 * @param {string} format
 * @returns {Promise<Uint8Array<ArrayBuffer>>}
 */
async function encode({ api }, { surface }, format) {
  const image = surface.image;
  const bytes = format === 'obj' || !image
    ? await api.writeObj(surface)
    : await (format === 'png' ? api.writePng(image) : api.writeNpy(image));
  return /** @type {Uint8Array<ArrayBuffer>} */ (bytes);
}

/** @param {Result} result */
function fileStem({ input, settings, surface }) {
  const lambda = input.design ? '' : `-${settings.lambda.toExponential().replace('e+', 'e')}`;
  const cancelled = surface.report.stopReason === 'cancelled' ? '-cancelled' : '';
  return `${input.name}-developable${lambda}${cancelled}`;
}

/**
 * @param {Blob} blob
 * @param {string} name
 */
function download(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // Once the browser has taken hold of it.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
