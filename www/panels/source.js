/** Where the heights come from: an example, or a file with its scale. */
import { readingOf } from '../worker-task.js';
import { designInput } from '../design.js';
import { doubtOf } from '../unit-check.js';
import { choosesFiles, element, elements } from '../dom.js';
import { InColour, inputOf } from '../height-file.js';
import { hasColours } from '../views/photo.js';
import { spanInWords, understood } from '../import-interpretation.js';
import { pixelsOf } from '../pixels.js';
import { isCamera, together } from '../dropped-files.js';
import { isMesh, kindByName, otherInWords } from '../file-kinds.js';
import { DEPTH_WORDS, FILE_WORDS } from '../messages.js';
import { areSurelyDepths } from '../metadata-guess.js';
import { cameraPanel } from './camera.js';
import { meshPanel } from './mesh.js';
import { hideNotice, showNotice } from './notice.js';

/** @import {ExampleName} from '../api.js' */
/** @import {Session} from '../session.js' */
/** @import {Together} from '../dropped-files.js' */

/**
 * @param {Session} session
 * @param {object} result
 * @param {(view: string) => void} result.choose a view of it
 * @param {(name: string, image: ImageData) => void} result.usePhoto lays a photo on it
 * @param {(files: readonly File[]) => void} opened files that are the input now
 * @param {(photo: File) => void} openPage makes a photo of a page flat
 */
export function sourcePanel(session, { choose, usePhoto }, opened, openPage) {
  const radios = elements('input[name="example"]', HTMLInputElement);
  const size = element('size', HTMLSelectElement);
  const noise = element('noise', HTMLSelectElement);
  const file = element('file', HTMLInputElement);
  const exampleOptions = element('example-options', HTMLElement);
  const fileOptions = element('file-options', HTMLElement);
  const fileName = element('file-name', HTMLElement);
  const pixelSize = element('pixel-size', HTMLInputElement);
  const heightScale = element('height-scale', HTMLInputElement);
  const span = element('scale-span', HTMLElement);
  const doubt = element('scale-doubt', HTMLElement);
  const zero = element('zero-is-nothing', HTMLInputElement);
  const hex = element('is-hexagonal', HTMLInputElement);
  const told = element('guessed', HTMLElement);
  const design = element('is-design', HTMLInputElement);
  const arrayField = element('array-field', HTMLElement);
  const array = element('array', HTMLSelectElement);
  const mesh = meshPanel(session);
  const camera = cameraPanel(session, mesh.take);
  const designHint = element('design-hint', HTMLElement);
  /** The file whose scale was asked about. */
  let doubted = '';
  /** A photo that was opened before what it shows. @type {File | null} */
  let waiting = null;

  /** Generates the chosen example and, as it is quick and needs no further word, solves it. */
  const openExample = async () => {
    const radio = radios.find((button) => button.checked);
    if (!radio) return;
    const options = { size: Number(size.value), noise: Number(noise.value) };
    const opened = await session.open('The example could not be made', async () => {
      if (radio.value === 'design') return designInput();
      const name = /** @type {ExampleName} */ (radio.value);
      const { input, truth } = await session.example(name, options);
      const { width, height, data, pixelSize: side = 1, heightScale: step = 1 } = input;
      return { name, width, height, data, pixelSize: side, heightScale: step, truth };
    });
    if (opened) await session.run();
  };

  /**
   * Opens a file and solves it, unless it has to be asked about first.
   * @param {File} chosen
   * @param {string} [wanted] array of it
   * @param {Pick<Together, 'photo' | 'confidence' | 'mask'>} [others] that go with it
   * @param {boolean} [known] whether the camera's file comes with it
   */
  const openFile = async (chosen, wanted, others = {}, known = false) => {
    if (isMesh(chosen.name)) return openMesh(chosen);
    const kind = kindByName(chosen);
    // Without depths a text has nothing to say.
    if (kind === 'other' || (/\.txt$/i.test(chosen.name) && !session.input?.kind)) {
      showNotice(FILE_WORDS.unread(chosen.name, otherInWords(chosen)));
      return false;
    }
    if (isCamera(chosen)) return camera.read(chosen);
    const photo = others.photo ?? waiting ?? undefined;
    /** @type {unknown} */
    let coloured = null;
    const opened = await session.open(`“${chosen.name}” could not be read`, async (signal) => {
      try {
        return await inputOf(session.api, chosen, signal, wanted, { ...others, photo });
      } catch (error) {
        if (error instanceof InColour && wanted === undefined) coloured = error;
        throw error;
      }
    }, readingOf(chosen));
    if (coloured) return takePhoto(chosen);
    if (!opened || !session.input) return false;
    waiting = null;
    const { depths, stored, data } = session.input;
    setCoarsening(stored?.coarsening ?? 1);
    if (!depths) {
      void session.run();
      return true;
    }
    camera.ask();
    if (known) return true;
    if (!areSurelyDepths(chosen.name, data)) {
      void session.run();
      return true;
    }
    if (!(await camera.project(true))) return true;
    void session.run();
    choose(hasColours(session.input) ? 'photo' : 'shaded');
    return true;
  };

  /** @param {File} file @param {readonly File[]} [beside] */
  const openMesh = async (file, beside) => {
    const opened = await mesh.open(file, beside);
    if (opened) void session.run();
    return opened;
  };

  /** A picture in colour belongs to the heights that are there, or to those that come next. @param {File} file */
  const takePhoto = async (file) => {
    const { input, result } = session;
    hideNotice();
    if (input?.kind === undefined) {
      waiting = file;
      showNotice(FILE_WORDS.pageNoHeights(file.name), 'alert', { label: FILE_WORDS.openAsPage, act: () => openPage(file) });
      return true;
    }
    const image = await session.obtain(`“${file.name}” could not be used`, () => pixelsOf(file), readingOf(file));
    if (!image || session.input !== input) return false;
    if (result) usePhoto(file.name, image);
    else session.amend({ photo: { name: file.name, image } });
    return true;
  };

  /** @param {number} step */
  const setCoarsening = (step) => {
    if (step === session.settings.coarsening) return;
    element('coarsening', HTMLSelectElement).value = String(step);
    session.set({ coarsening: step });
  };

  /** What belongs together, or one file. @param {readonly File[]} files */
  const openFiles = async (files) => {
    // The camera's file alone, or a photo, is about what is there.
    const alone = files.length === 1 && session.input?.kind !== undefined && isCamera(files[0]);
    const before = session.input;
    if (!(await put(files)) || alone || session.input === before || !session.input?.kind) return;
    opened(files);
  };

  /** @param {readonly File[]} files @returns {Promise<boolean>} */
  const put = async (files) => {
    if (files.length === 1) return openFile(files[0]);
    const { mesh: scan, depths, camera: numbers, others, ...beside } = await together(files);
    if (scan) return openMesh(scan, files.filter((file) => file !== scan));
    if (!depths) {
      session.fail('These files could not be put together', new Error('there are neither a mesh nor heights or depths (a TIFF, EXR, PFM, NPY or grey PNG) among them'));
      return false;
    }
    if (!(await openFile(depths, undefined, beside, numbers !== undefined))) return false;
    if (!session.input?.depthSource && (numbers || beside.confidence || beside.mask)) camera.ask();
    if (numbers && !(await camera.read(numbers))) return true;
    if (numbers && !(await camera.project())) return true;
    // All that is needed is there.
    const run = numbers && beside.photo ? session.run() : undefined;
    if (run) choose('dewarped');
    // A run takes away what was said before.
    if (others.length > 0) {
      const names = others.map(({ name }) => `“${name}”`).join(', ');
      showNotice(`Not used: ${names}. With depths go one photo, the camera’s file, and images whose names tell that they are their confidence or a mask.`);
    }
    await run;
    return true;
  };

  /** @param {Parameters<typeof understood>[1]} change */
  const understand = (change) => {
    const { input } = session;
    if (!input) return;
    try {
      session.amend(understood(input, change));
    } catch (error) {
      session.fail('It could not be taken so', error);
    }
  };

  const rescale = () => {
    pixelSize.setCustomValidity(pixelSize.valueAsNumber > 0 ? '' : 'The pixel size must be above 0.');
    heightScale.setCustomValidity(Math.abs(heightScale.valueAsNumber) > 0 ? '' : 'The height scale must not be 0.');
    if (!pixelSize.reportValidity() || !heightScale.reportValidity()) return;
    understand({ pixelSize: pixelSize.valueAsNumber, heightScale: heightScale.valueAsNumber, told: '' });
  };
  /** @param {number} factor of the relief against the width */
  const steepen = (factor) => {
    const stored = session.input?.stored;
    if (!stored) return;
    // Of levels nobody knows the height; of numbers the pixels' size.
    const { levels, heightScale: step, pixelSize: side } = stored;
    understand(levels ? { heightScale: step * factor } : { pixelSize: side / factor });
  };

  for (const control of [...radios, size, noise]) control.addEventListener('change', openExample);
  for (const control of [pixelSize, heightScale]) control.addEventListener('change', rescale);
  zero.addEventListener('change', () => understand({ zeros: zero.checked }));
  hex.addEventListener('change', () => understand({ hexagonal: hex.checked }));
  element('flatter', HTMLButtonElement).addEventListener('click', () => steepen(0.5));
  element('steeper', HTMLButtonElement).addEventListener('click', () => steepen(2));
  design.addEventListener('change', () => session.amend({ design: design.checked }));
  choosesFiles(element('open', HTMLButtonElement), file, openFiles);
  array.addEventListener('change', () => {
    const several = session.input?.array;
    if (several) void openFile(several.file, array.value);
  });

  session.on('input', (input) => {
    const isFile = input.kind !== undefined;
    exampleOptions.hidden = isFile || input.design === true || !radios.some(({ value }) => value === input.name);
    designHint.hidden = isFile || !input.design;
    const built = input.depthSource !== undefined;
    fileOptions.hidden = !isFile || (input.seen !== undefined && !built);
    fileOptions.toggleAttribute('data-built', built);
    for (const radio of radios) radio.checked = !isFile && radio.value === input.name;
    if (fileOptions.hidden) return;
    if (built) {
      told.textContent = input.assumed ?? '';
      told.hidden = told.textContent === '';
    }
    const { array: several } = input;
    arrayField.hidden = several === undefined;
    array.replaceChildren(...(several?.names ?? []).map((name) => new Option(name, name, false, name === several?.name)));
    fileName.textContent = `${input.name} (${input.kind})`;
    if (!input.stored) return;
    pixelSize.value = plain(input.stored.pixelSize);
    heightScale.value = plain(input.stored.heightScale);
    zero.checked = input.stored.zeros;
    design.checked = input.design === true;
    hex.checked = input.stored.hexagonal;
    told.textContent = input.depths ? DEPTH_WORDS.maybe : input.stored.told;
    told.hidden = told.textContent === '';
    span.textContent = spanInWords(input);
    const words = doubtOf(input);
    // Its room is kept while the same file is scaled, or what is clicked next would move away.
    if (words === '' && doubted === input.name) doubt.dataset.settled = '';
    else {
      delete doubt.dataset.settled;
      doubt.hidden = words === '';
      doubt.textContent = words;
      doubted = words === '' ? '' : input.name;
    }
  });

  return {
    /**
     * @param {string} name
     * @param {{ size: number, noise: number }} options the nearest that can be chosen
     */
    async openNamed(name, options) {
      for (const radio of radios) radio.checked = radio.value === name;
      if (!radios.some(({ checked }) => checked)) radios[0].checked = true;
      chooseNearest(size, options.size);
      chooseNearest(noise, options.noise);
      await openExample();
    },
    openFiles,
    understand,
    takeMesh: mesh.take,
  };
}

/** @param {HTMLSelectElement} select @param {number} value */
function chooseNearest(select, value) {
  const values = [...select.options].map((option) => Number(option.value));
  const nearest = values.toSorted((a, b) => Math.abs(a - value) - Math.abs(b - value))[0];
  select.value = String(nearest);
}

/** A number as an input field takes it, without the digits that only binary fractions have. @param {number} value */
function plain(value) {
  return String(Number(value.toPrecision(12)));
}
