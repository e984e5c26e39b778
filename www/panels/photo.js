/** The photo that is to be made flat: opened, or printed on an example; and what comes of it, saved. */
import { readingOf } from '../worker-task.js';
import { choosesFile, element } from '../dom.js';
import { FORMAT_WORDS } from '../messages.js';
import { partAt } from '../mesh-part.js';
import { pixelsOf } from '../pixels.js';
import { drawingOf, see } from '../mesh-sampling.js';
import { cropPanel } from './crop.js';
import { offerToSave } from './save-dialog.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result, Session} from '../session.js' */
/** @typedef {import('../../pkg/types.js').Dewarped} Dewarped */

/** @typedef {import('../analyses.js').FlatOptions} FlatOptions */
/** @typedef {{ photo: ImageData, options: FlatOptions }} Wish */

/**
 * @param {Session} session
 * @param {Analyses} analyses
 * @param {() => void} changed what is to be shown is another
 */
export function photoPanel(session, analyses, changed) {
  const panel = element('photo', HTMLElement);
  const file = element('photo-file', HTMLInputElement);
  const open = element('photo-open', HTMLButtonElement);
  const name = element('photo-name', HTMLElement);
  const dots = element('dots', HTMLInputElement);
  const trim = element('trim', HTMLInputElement);
  const save = element('flat-save', HTMLButtonElement);
  const hint = name.textContent ?? '';
  /** @type {ImageData | null} */
  let photo = null;
  /** @type {Dewarped | null} */
  let flat = null;

  const all = element('all-parts', HTMLButtonElement);
  const crop = cropPanel({ changed, click: (place) => void onlyPart(place) });

  /**
   * Takes the part of the mesh that the photo shows at a place, or all of it.
   * @param {readonly [number, number] | null} place
   */
  const onlyPart = async (place) => {
    const { input } = session;
    if (!input?.seen || !photo) return;
    const { mesh, options, whole = mesh } = input.seen;
    const part = place && partAt(whole, [(place[0] + 0.5) / photo.width, 1 - (place[1] + 0.5) / photo.height]);
    if (place && !part) return;
    const own = { name: name.textContent ?? '', image: photo };
    const taken = await see(
      session, { name: input.name, kind: input.kind, photo: own, depthSource: input.depthSource, assumed: input.assumed }, async () => part ?? whole, options,
      'This part could not be taken', { whole: part ? whole : undefined, slow: drawingOf(whole) },
    );
    if (taken) await session.run();
  };
  all.addEventListener('click', () => void onlyPart(null));

  session.on('cleared', () => {
    const own = session.input?.photo;
    photo = own?.image ?? null;
    name.textContent = own?.name ?? hint;
    all.hidden = session.input?.seen?.whole === undefined;
    crop.forget();
  });

  /** @param {string} called @param {ImageData} image */
  const use = (called, image) => {
    photo = image;
    name.textContent = called;
  };
  choosesFile(open, file, async (chosen) => {
    const { result } = session;
    if (!result) return;
    const read = await session.obtain(`“${chosen.name}” could not be used`, () => pixelsOf(chosen), readingOf(chosen));
    if (!read || session.input !== result.input) return;
    use(chosen.name, read);
    changed();
  });
  dots.addEventListener('change', () => {
    const sound = dots.value === '' || dots.valueAsNumber > 0;
    dots.setCustomValidity(sound ? '' : 'It must be a number above 0, or empty.');
    if (dots.reportValidity()) changed();
  });
  trim.addEventListener('change', changed);

  save.addEventListener('click', () => {
    if (!flat || !photo) return;
    const image = flat;
    const { width, height } = photo;
    offerToSave(session.api, {
      title: 'Flat photo',
      stem: `${session.input?.name}-flat`,
      size: image.width * image.height,
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
    use,
    /** @param {boolean} wanted */
    show: (wanted) => {
      panel.hidden = !wanted;
      if (!wanted) crop.show(null);
    },
    /**
     * The photo that there is, or else a print, where the true surface is known.
     * @param {Result} result
     * @returns {Promise<Wish | null>}
     */
    async wish({ input, surface }) {
      if (!photo && surface.texture) {
        const { data, width } = await session.api.readPhoto(surface.texture);
        if (session.input === input && !photo) {
          photo = new ImageData(data, width);
          name.textContent = 'the scan’s own texture';
        }
      }
      if (!photo && input.truth) {
        const known = { ...input, truth: input.truth };
        const printed = await analyses.printOf(known);
        if (session.input === input && !photo) {
          photo = printed;
          name.textContent = 'a page printed on the true surface';
        }
      }
      crop.show(photo);
      return photo && { photo, options: { dots: dots.value === '' ? undefined : dots.valueAsNumber, trim: trim.checked, crop: crop.polygon } };
    },
    /** @param {Dewarped | null} made what can be saved */
    made: (made) => {
      flat = made;
      save.disabled = made === null;
    },
  };
}

/**
 * The warp map on a grid, null where there is no sheet: what the command writes, too.
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
