/** The result as files. */
import { download, element, elements } from '../dom.js';
import { shortest } from '../format.js';
import { resultImage } from '../surface/known.js';

/** @import {Result, Session} from '../session.js' */

/** @type {Record<string, string>} */
const TYPES = {
  npy: 'application/octet-stream', png: 'image/png', tiff: 'image/tiff', exr: 'image/x-exr',
  obj: 'model/obj', ply: 'model/ply', stl: 'model/stl', glb: 'model/gltf-binary',
};

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
        download(bytes, TYPES[format], `${fileStem(result)}.${format}`);
      } catch (error) {
        session.fail(`The ${format.toUpperCase()} could not be written`, error);
      }
    });
  }
  const more = element('save-more', HTMLButtonElement);
  more.addEventListener('click', () => {
    const open = more.getAttribute('aria-expanded') !== 'true';
    more.setAttribute('aria-expanded', String(open));
    element('save-others', HTMLElement).hidden = !open;
  });
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
async function encode({ api }, result, format) {
  const { surface } = result;
  switch (format) {
    case 'npy': return api.writeNpy(resultImage(result));
    case 'png': return api.writePng(resultImage(result));
    case 'tiff': return api.writeTiff(resultImage(result));
    case 'exr': return api.writeExr(resultImage(result));
    case 'ply': return api.writePly(surface);
    case 'stl': return api.writeStl(surface);
    case 'glb': return api.writeGlb(surface);
    default: return api.writeObj(surface);
  }
}

/** @param {Result} result */
function fileStem({ input, surface }) {
  const lambda = input.design ? '' : `-${shortest(surface.report.lambda)}`;
  const cancelled = surface.report.stopReason === 'cancelled' ? '-cancelled' : '';
  return `${input.name}-developable${lambda}${cancelled}`;
}
