/** Where the heights come from: an example, or a file with its scale. */
import { designInput } from '../design.js';
import { doubtOf } from '../doubts.js';
import { choosesFiles, element, elements } from '../dom.js';
import { number } from '../format.js';
import { pixelsOf } from '../pixels.js';
import { isCamera, together } from '../together.js';
import { cameraPanel } from './camera.js';
import { isMesh, meshPanel } from './mesh.js';
import { showNotice } from './notice.js';

/** @import {ExampleName} from '../api.js' */
/** @import {Beside, Input, Session} from '../session.js' */
/** @import {Together} from '../together.js' */

/**
 * @param {Session} session
 * @param {(view: string) => void} choose a view of the result
 */
export function sourcePanel(session, choose) {
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
  const design = element('is-design', HTMLInputElement);
  const arrayField = element('array-field', HTMLElement);
  const array = element('array', HTMLSelectElement);
  const mesh = meshPanel(session);
  const camera = cameraPanel(session, mesh.take);
  const designHint = element('design-hint', HTMLElement);
  /** The file whose scale was asked about. */
  let doubted = '';
  /** The open file's values as they are stored. @type {Float64Array} */
  let stored = new Float64Array();

  /** Generates the chosen example and, as it is quick and needs no further word, solves it. */
  const openExample = async () => {
    const radio = radios.find((button) => button.checked);
    if (!radio) return;
    const options = { size: Number(size.value), noise: Number(noise.value) };
    const opened = await session.open('The example could not be made', async () => {
      if (radio.value === 'design') return designInput();
      const name = /** @type {ExampleName} */ (radio.value);
      const { input, truth } = await session.api.example(name, options);
      const { width, height, data, pixelSize: side = 1, heightScale: step = 1 } = input;
      return { name, width, height, data, pixelSize: side, heightScale: step, truth };
    });
    if (opened) await session.run();
  };

  /**
   * @param {File} chosen
   * @param {string} [wanted] array of it
   * @param {Pick<Together, 'photo' | 'confidence' | 'mask'>} [others] that go with it
   */
  const openFile = async (chosen, wanted, { photo: picture, ...others } = {}) => {
    if (isMesh(chosen.name)) return mesh.open(chosen);
    if (isCamera(chosen)) return camera.read(chosen);
    /** @type {Float64Array} */
    let values = stored;
    const opened = await session.open(`“${chosen.name}” could not be read`, async () => {
      const names = await arraysOf(session, chosen);
      const several = names.length > 1 ? { file: chosen, names, name: wanted ?? names[0] } : undefined;
      const options = several && { array: several.name };
      const { format, dataType, width, height, data, pixelSize: side, heightScale: step, unit } = await session.api.read(chosen, options).catch(plainly);
      const photo = picture && { name: picture.name, image: await pixelsOf(picture) };
      const beside = await besideOf(session, others);
      if (!data.some(Number.isFinite)) throw new Error('it has no heights, every pixel is “no data” (NaN)');
      if (data.some((value) => Math.abs(value) === Infinity)) throw new Error('it has infinite heights; mark them as NaN, “no data”');
      if (width < 3 || height < 3) throw new Error(`it is ${width} × ${height} pixels; a surface needs at least 3 × 3`);
      values = data;
      const name = chosen.name.replace(/\.[^.]*$/, '') || 'heights';
      const kind = `${format.toUpperCase()}, ${typeInWords(dataType)}`;
      return { name, kind, dataType, photo, beside, width, height, data, pixelSize: side, heightScale: step, unit: unit ?? undefined, array: several };
    });
    if (!opened) return false;
    stored = values;
    zero.checked = false;
    design.checked = false;
    return true;
  };

  /** What belongs together, or one file. @param {readonly File[]} files */
  const openFiles = async (files) => {
    if (files.length === 1) return void openFile(files[0]);
    const { mesh: scan, depths, camera: numbers, others, ...beside } = await together(files);
    if (scan) return void mesh.open(scan, files.filter((file) => file !== scan));
    if (!depths) {
      session.fail('These files could not be put together', new Error('there are neither a mesh nor depths (a TIFF, EXR, PFM, NPY or 16-bit PNG) among them'));
      return;
    }
    if (!(await openFile(depths, undefined, beside))) return;
    camera.ask();
    if (numbers && !(await camera.read(numbers))) return;
    if (numbers && !(await camera.project())) return;
    // All that is needed is there.
    const run = numbers && beside.photo ? session.run() : undefined;
    if (run) choose('dewarped');
    // A run takes away what was said before.
    if (others.length > 0) {
      const names = others.map(({ name }) => `“${name}”`).join(', ');
      showNotice(`Not used: ${names}. With depths go one photo, the camera’s file, and images whose names tell that they are their confidence or a mask.`);
    }
    await run;
  };

  const dropZeros = () => {
    const data = zero.checked ? stored.map((value) => (value === 0 ? NaN : value)) : stored;
    if (data.some(Number.isFinite)) session.amend({ data });
    else session.fail('The zeros could not be taken as “no data”', new Error('nothing else would be left'));
  };

  const rescale = () => {
    pixelSize.setCustomValidity(pixelSize.valueAsNumber > 0 ? '' : 'The pixel size must be above 0.');
    heightScale.setCustomValidity(Math.abs(heightScale.valueAsNumber) > 0 ? '' : 'The height scale must not be 0.');
    if (!pixelSize.reportValidity() || !heightScale.reportValidity()) return;
    session.amend({ pixelSize: pixelSize.valueAsNumber, heightScale: heightScale.valueAsNumber });
  };

  for (const control of [...radios, size, noise]) control.addEventListener('change', openExample);
  for (const control of [pixelSize, heightScale]) control.addEventListener('change', rescale);
  zero.addEventListener('change', dropZeros);
  design.addEventListener('change', () => session.amend({ design: design.checked }));
  choosesFiles(element('open', HTMLButtonElement), file, openFiles);
  array.addEventListener('change', () => {
    const several = session.input?.array;
    if (several) void openFile(several.file, array.value);
  });

  session.on('input', (input) => {
    const isFile = input.kind !== undefined;
    exampleOptions.hidden = isFile || input.design === true;
    designHint.hidden = isFile || !input.design;
    fileOptions.hidden = !isFile || input.seen !== undefined;
    for (const radio of radios) radio.checked = !isFile && radio.value === input.name;
    if (fileOptions.hidden) return;
    const { array: several } = input;
    arrayField.hidden = several === undefined;
    array.replaceChildren(...(several?.names ?? []).map((name) => new Option(name, name, false, name === several?.name)));
    fileName.textContent = `${input.name} (${input.kind})`;
    pixelSize.value = plain(input.pixelSize);
    heightScale.value = plain(input.heightScale);
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

  return { openExample, openFiles, takeMesh: mesh.take };
}

/**
 * The names of the arrays of an NPZ that may be heights; other files have none.
 * @param {Session} session
 * @param {File} file
 */
async function arraysOf(session, file) {
  if (!/\.npz$/i.test(file.name)) return [];
  const arrays = await session.api.npzArrays(file);
  return arrays.filter(({ shape, dataType }) => shape.length === 2 && /^[uif]\d+$/.test(dataType)).map(({ name }) => name);
}

/**
 * What is known of depths besides, as it is stored.
 * @param {Session} session
 * @param {Pick<Together, 'confidence' | 'mask'>} files
 * @returns {Promise<Beside | undefined>}
 */
async function besideOf(session, { confidence, mask }) {
  /** @param {File} [file] */
  const read = async (file) => {
    if (!file) return undefined;
    try {
      const { width, height, data, dataType } = await session.api.read(file);
      // Whole numbers are levels, or shares of the largest.
      if (dataType === 'u8') return { width, height, data: Uint8Array.from(data, (value) => value || 0) };
      if (dataType === 'u16') return { width, height, data: Uint16Array.from(data, (value) => value || 0) };
      return { width, height, data };
    } catch (error) {
      throw new Error(`its “${file.name}” could not be read: ${error instanceof Error ? error.message : error}`);
    }
  };
  const names = [confidence, mask].flatMap((file) => (file ? [file.name] : []));
  return names.length === 0 ? undefined : { confidence: await read(confidence), mask: await read(mask), names };
}

/** Says what to do with a photo. @param {unknown} error @returns {never} */
function plainly(error) {
  if (!(error instanceof Error && /colour/.test(error.message))) throw error;
  throw new Error('it is in colour, and no heights follow from that. A photo alone is made flat under “A photo of a page”; with its depths, open both together');
}

/** @param {string} type such as u16 */
function typeInWords(type) {
  const [, letter, bits] = /^([a-z]+)(\d+)$/.exec(type) ?? [];
  /** @type {Record<string, string>} */
  const names = { u: 'integers', i: 'signed integers', f: 'floats' };
  return names[letter] ? `${bits}-bit ${names[letter]}` : type;
}

/** @param {Input} input */
function spanInWords({ data, width, height, pixelSize, heightScale }) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of data) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  const depth = (high - low) * Math.abs(heightScale);
  return `Spans ${number(width * pixelSize)} × ${number(height * pixelSize)}, and ${number(depth)} in height.`;
}

/** A number as an input field takes it, without the digits that only binary fractions have. @param {number} value */
function plain(value) {
  return String(Number(value.toPrecision(12)));
}
