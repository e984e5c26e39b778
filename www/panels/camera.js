/** Depths from a camera, put where it has seen them: a mesh, of which a view is taken. */
import { apart } from '../worker-task.js';
import { choosesFile, element } from '../dom.js';
import { number } from '../format.js';
import { DEPTH_WORDS } from '../messages.js';

/** @import {Mesh, PhotoCamera} from '../api.js' */
/** @import {Called} from '../mesh-sampling.js' */
/** @import {Input, Session, Slow} from '../session.js' */

/** Milliseconds for a depth that a surface is built from, until that was measured. */
const EACH = 2e-3;
/** Depths that are larger than that are no metres. */
const FAR = 100;

/**
 * @param {Session} session
 * @param {(file: Called, load: (signal: AbortSignal) => Promise<Mesh>, doing: string, slow: Slow) => Promise<boolean>} take
 */
export function cameraPanel(session, take) {
  const wanted = element('is-depth', HTMLInputElement);
  const panel = element('camera', HTMLElement);
  const [fx, fy, cx, cy, scale] = ['fx', 'fy', 'cx', 'cy', 'scale'].map((name) => element(`camera-${name}`, HTMLInputElement));
  const fields = [fx, fy, cx, cy, scale];
  const angle = element('camera-angle', HTMLInputElement);
  const about = element('camera-about', HTMLElement);
  const span = element('camera-span', HTMLElement);
  const source = () => session.input?.depthSource ?? session.input;
  /** What a file says besides what is shown: the images that its numbers are for, the lens. @type {Partial<PhotoCamera>} */
  let further = {};

  const tell = () => {
    const input = source();
    if (!input) return;
    const { width = input.width, height = input.height, k1, k2, k3, p1, p2 } = further;
    const lens = [k1, k2, k3, p1, p2].some((value) => value) ? ', and a lens that distorts' : '';
    const beside = input.beside ? ` With ${input.beside.names.map((name) => `“${name}”`).join(' and ')}.` : '';
    about.textContent = `For images of ${width} × ${height} pixels${lens}.${beside}`;
    const [near, far] = rangeOf(input.data).map((depth) => depth * scale.valueAsNumber);
    span.textContent = Number.isFinite(near) ? `With this scale, what is seen is ${number(near)} to ${number(far)} away.` : '';
  };
  /** Focal lengths of the angle that is set. @param {number} width @param {number} height */
  const widen = (width, height) => {
    fx.value = fy.value = String(Number((Math.max(width, height) / 2 / Math.tan((angle.valueAsNumber * Math.PI) / 360)).toPrecision(6)));
  };
  /** Most cameras look through the middle. @param {Input} input */
  const begin = ({ width, height, data, dataType = '', depths }) => {
    further = {};
    cx.value = String((width - 1) / 2);
    cy.value = String((height - 1) / 2);
    // About a phone's.
    angle.value = '60';
    widen(width, height);
    // Whole numbers are millimetres, and what is small is metres.
    scale.value = depths === 'm' || (dataType.startsWith('f') && rangeOf(data)[1] < FAR) ? '1' : '0.001';
    tell();
  };
  const ask = () => {
    wanted.checked = true;
    panel.hidden = false;
    const input = source();
    if (input) begin(input);
  };
  /** @param {PhotoCamera} camera */
  const fill = ({ fx: x, fy: y, cx: across, cy: down, depthScale, rotation, translation, ...rest }) => {
    further = rest;
    angle.value = '';
    [x, y, across, down, depthScale ?? scale.valueAsNumber].forEach((value, i) => (fields[i].value = String(value)));
    tell();
  };

  wanted.addEventListener('change', () => {
    const depths = session.input?.depthSource;
    if (wanted.checked) ask();
    // Not depths after all: the heights that the file holds.
    else if (depths) void session.open('The heights could not be taken', async () => ({ ...depths, depths: undefined })).then((opened) => {
        if (opened) void session.run();
      });
    else panel.hidden = true;
  });
  scale.addEventListener('change', tell);
  angle.addEventListener('change', () => {
    const input = source();
    const sound = angle.valueAsNumber > 0 && angle.valueAsNumber < 180;
    angle.setCustomValidity(sound || angle.value === '' ? '' : 'It must be an angle above 0° and below 180°.');
    if (!angle.reportValidity() || !sound || !input) return;
    widen(further.width ?? input.width, further.height ?? input.height);
  });
  /** @param {File} file */
  const read = async (file) => {
    const input = source();
    if (!input) return false;
    try {
      const camera = session.api.parseCamera(await file.text(), [input, ...(input.photo ? [input.photo.image] : [])].map(({ width, height }) => ({ width, height })));
      if (source() !== input) return false;
      ask();
      fill(camera);
      return true;
    } catch (error) {
      session.fail(`“${file.name}” could not be used`, error);
      return false;
    }
  };
  choosesFile(element('camera-open', HTMLButtonElement), element('camera-file', HTMLInputElement), read);

  /** @param {boolean} [guessed] whether nobody has said what the camera was */
  const project = async (guessed = false) => {
    const input = source();
    if (!input) return false;
    for (const field of fields) {
      const sound = Number.isFinite(field.valueAsNumber) && (field === cx || field === cy || field.valueAsNumber > 0);
      field.setCustomValidity(sound ? '' : `It must be a number${field === cx || field === cy ? '' : ' above 0'}.`);
      if (!field.reportValidity()) return false;
    }
    const [x, y, across, down, depthScale] = fields.map((field) => field.valueAsNumber);
    const { name, width, height, data, photo, beside } = input;
    const camera = { ...further, fx: x, fy: y, cx: across, cy: down, depthScale };
    const known = beside && { confidence: beside.confidence, mask: beside.mask };
    const kind = beside ? `depths, with ${beside.names.join(' and ')}` : 'depths';
    const unit = input.depths ? { unit: /** @type {const} */ ('m') } : {};
    const assumed = guessed ? DEPTH_WORDS.assumed(number(angle.valueAsNumber), depthScale) : undefined;
    return take({ name, kind, photo: session.input?.photo ?? photo, depthSource: input, assumed },
      (signal) => apart(session.api, signal, async (worker) => ({ ...await worker.backProject({ width, height, data }, camera, known), ...unit })),
      DEPTH_WORDS.failed, { words: DEPTH_WORDS.building, kind: 'depths', size: width * height, each: EACH });
  };
  element('back-project', HTMLButtonElement).addEventListener('click', async () => {
    if (await project()) void session.run();
  });
  session.on('cleared', () => {
    wanted.checked = session.input?.depthSource !== undefined;
    panel.hidden = !wanted.checked;
  });
  return { ask, read, project };
}

/** Without what is no depth. @param {Float64Array} data */
function rangeOf(data) {
  let [near, far] = [Infinity, -Infinity];
  for (const depth of data) {
    if (!(depth > 0 && depth < Infinity)) continue;
    near = Math.min(near, depth);
    far = Math.max(far, depth);
  }
  return [near, far];
}
