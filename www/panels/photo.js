/** Dewarping of a photo of the surface: opens the photo, and saves the flat one. */
import { onFileChosen, element } from '../dom.js';
import { FORMAT_WORDS, TASK_WORDS } from '../messages.js';
import { readPicture } from '../pixels.js';
import { offerToSave } from './save-dialog.js';

/** @import {Result, Session} from '../session.js' */
/** @typedef {import('../../pkg/types.js').Dewarped} Dewarped */

/** @typedef {import('../analyses.js').FlatOptions} FlatOptions */
/** @typedef {{ photo: ImageData, options: FlatOptions }} DewarpRequest */

/**
 * @param {Session} session
 * @param {() => void} onChange called when another photo, or other options, are to be shown
 */
export function photoPanel(session, onChange) {
  const panel = element('photo', HTMLElement);
  const file = element('photo-file', HTMLInputElement);
  const open = element('photo-open', HTMLButtonElement);
  const name = element('photo-name', HTMLElement);
  const trim = element('trim', HTMLInputElement);
  const save = element('flat-save', HTMLButtonElement);
  const hint = name.textContent ?? '';
  /** @type {ImageData | null} */
  let photo = null;
  /** @type {Dewarped | null} */
  let flat = null;

  session.on('cleared', () => {
    const own = session.input?.photo;
    photo = own?.image ?? null;
    name.textContent = own?.name ?? hint;
  });

  /** Sets the photo. @param {string} title @param {ImageData} image */
  const setPhoto = (title, image) => {
    photo = image;
    name.textContent = title;
  };
  onFileChosen(open, file, async (chosen) => {
    const { result } = session;
    if (!result) return;
    const read = await session.load(`“${chosen.name}” could not be used`, () => readPicture(chosen), TASK_WORDS.reading);
    if (!read || session.input !== result.input) return;
    setPhoto(chosen.name, read);
    onChange();
  });
  trim.addEventListener('change', onChange);

  save.addEventListener('click', () => {
    if (!flat || !photo) return;
    const image = flat;
    const { width, height } = photo;
    offerToSave(session.api, {
      title: 'Flat photo',
      stem: `${session.input?.name}-flat`,
      formats: [
        { value: 'png', name: 'PNG', words: FORMAT_WORDS.png, type: 'image/png', write: (worker) => worker.writePhoto(image) },
        { value: 'jpg', name: 'JPEG', words: FORMAT_WORDS.jpg, type: 'image/jpeg', write: (worker) => worker.writePhoto(image, { format: 'jpeg' }) },
        {
          value: 'pdf', name: 'PDF', words: FORMAT_WORDS.pdf, type: 'application/pdf',
          without: image.unit ? undefined : 'no true size is known: the file has no unit',
          write: (worker) => worker.writePhoto(image, { format: 'pdf' }),
        },
        { value: 'json', name: 'Warp map', words: FORMAT_WORDS.map, type: 'application/json', write: async () => mapJson(image, { width, height }) },
      ],
    });
  });

  return {
    setPhoto,
    /** Shows or hides the panel. @param {boolean} visible */
    show: (visible) => (panel.hidden = !visible),
    /**
     * The photo to dewarp, with its options: the opened one, else the texture of the scan.
     * @param {Result} result
     * @returns {Promise<DewarpRequest | null>}
     */
    async dewarpRequest({ input, surface }) {
      if (!photo && surface.texture) {
        const { data, width } = await session.api.readPhoto(surface.texture);
        if (session.input === input && !photo) {
          photo = new ImageData(data, width);
          name.textContent = 'the scan’s own texture';
        }
      }
      return photo && { photo, options: { trim: trim.checked } };
    },
    /** Sets the flat photo that can be saved. @param {Dewarped | null} dewarped */
    setFlat: (dewarped) => {
      flat = dewarped;
      save.disabled = dewarped === null;
    },
  };
}

/**
 * The warp map on a grid as JSON, in the format that the command writes; null outside of the sheet.
 * @param {Dewarped} flat
 * @param {{ width: number, height: number }} photo
 */
function mapJson({ width, height, resolution, unit, corner, grid }, photo) {
  if (!grid) throw new Error('no map was made');
  const { columns, rows, step, places, rms, maximum } = grid;
  const rounded = (/** @type {number} */ value) => Math.round(1000 * value) / 1000;
  return `${JSON.stringify({
    width, height, photo, resolution, unit: unit ?? null, corner, error: { rms, maximum }, columns, rows, origin: [0, 0], step,
    places: Array.from({ length: columns * rows }, (_, i) =>
      (Number.isNaN(places[2 * i]) ? null : [rounded(places[2 * i]), rounded(places[2 * i + 1])])),
  })}\n`;
}
