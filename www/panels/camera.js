/** Camera of depths: back-projects them to a mesh in space, which is then sampled from a view. */
import { runInWorker } from '../worker-task.js';
import { onFileChosen, element } from '../dom.js';
import { number } from '../format.js';
import { DEPTH_WORDS } from '../messages.js';

/** @import {Mesh, PhotoCamera} from '../api.js' */
/** @import {InputOrigin} from '../mesh-sampling.js' */
/** @import {Input, Session, TimedTask} from '../session.js' */

/** Field of view that is assumed at first, in degrees along the longer side: about that of a phone. */
const ASSUMED_FIELD_OF_VIEW_DEGREES = 60;

/**
 * @param {Session} session
 * @param {(origin: InputOrigin, load: (signal: AbortSignal) => Promise<Mesh>, doing: string, task: TimedTask) => Promise<boolean>} openLoadedMesh
 */
export function cameraPanel(session, openLoadedMesh) {
  const depthCheckbox = element('is-depth', HTMLInputElement);
  const panel = element('camera', HTMLElement);
  const [fx, fy, cx, cy, scale] = ['fx', 'fy', 'cx', 'cy', 'scale'].map((name) => element(`camera-${name}`, HTMLInputElement));
  const fields = [fx, fy, cx, cy, scale];
  const angle = element('camera-angle', HTMLInputElement);
  const about = element('camera-about', HTMLElement);
  const span = element('camera-span', HTMLElement);
  /** The input whose values are the depths. */
  const depthInput = () => session.input?.depthSource ?? session.input;
  /** Properties of the camera that have no field: the size of its images, and lens distortion. @type {Partial<PhotoCamera>} */
  let hiddenProperties = {};

  const describe = () => {
    const input = depthInput();
    if (!input) return;
    const { width = input.width, height = input.height, k1, k2, k3, p1, p2 } = hiddenProperties;
    const lens = [k1, k2, k3, p1, p2].some((value) => value) ? ', and a lens that distorts' : '';
    const companionWords = input.companions ? ` With ${input.companions.names.map((name) => `“${name}”`).join(' and ')}.` : '';
    about.textContent = `For images of ${width} × ${height} pixels${lens}.${companionWords}`;
    const [near, far] = depthRange(input.data).map((depth) => depth * scale.valueAsNumber);
    span.textContent = Number.isFinite(near) ? `With this scale, what is seen is ${number(near)} to ${number(far)} away.` : '';
  };
  /** Sets the focal lengths that belong to the field of view. @param {number} width @param {number} height */
  const setFocalLengths = (width, height) => {
    fx.value = fy.value = String(Number((Math.max(width, height) / 2 / Math.tan((angle.valueAsNumber * Math.PI) / 360)).toPrecision(6)));
  };
  /** Fills the fields with a typical camera, whose principal point is the middle of the image. @param {Input} input */
  const assumeCamera = ({ width, height, depthUnit }) => {
    hiddenProperties = {};
    cx.value = String((width - 1) / 2);
    cy.value = String((height - 1) / 2);
    angle.value = String(ASSUMED_FIELD_OF_VIEW_DEGREES);
    setFocalLengths(width, height);
    scale.value = depthUnit === 'm' ? '1' : '0.001';
    describe();
  };
  /** Shows the fields, filled with a typical camera. */
  const show = () => {
    depthCheckbox.checked = true;
    panel.hidden = false;
    const input = depthInput();
    if (input) assumeCamera(input);
  };
  /** Fills the fields with a camera. @param {PhotoCamera} camera */
  const fill = ({ fx: x, fy: y, cx: across, cy: down, depthScale, rotation, translation, ...rest }) => {
    hiddenProperties = rest;
    angle.value = '';
    [x, y, across, down, depthScale ?? scale.valueAsNumber].forEach((value, i) => (fields[i].value = String(value)));
    describe();
  };

  depthCheckbox.addEventListener('change', () => {
    const depthSource = session.input?.depthSource;
    if (depthCheckbox.checked) show();
    // The values are heights after all.
    else if (depthSource) void session.open('The heights could not be taken', async () => ({ ...depthSource, depths: undefined })).then((opened) => {
        if (opened) void session.run();
      });
    else panel.hidden = true;
  });
  scale.addEventListener('change', describe);
  angle.addEventListener('change', () => {
    const input = depthInput();
    const isValid = angle.valueAsNumber > 0 && angle.valueAsNumber < 180;
    angle.setCustomValidity(isValid || angle.value === '' ? '' : 'It must be an angle above 0° and below 180°.');
    if (!angle.reportValidity() || !isValid || !input) return;
    setFocalLengths(hiddenProperties.width ?? input.width, hiddenProperties.height ?? input.height);
  });
  /** Reads the camera from a file. @param {File} file */
  const readCamera = async (file) => {
    const input = depthInput();
    if (!input) return false;
    try {
      const camera = session.api.parseCamera(await file.text(), [input, ...(input.photo ? [input.photo.image] : [])].map(({ width, height }) => ({ width, height })));
      if (depthInput() !== input) return false;
      show();
      fill(camera);
      return true;
    } catch (error) {
      session.fail(`“${file.name}” could not be used`, error);
      return false;
    }
  };
  onFileChosen(element('camera-open', HTMLButtonElement), element('camera-file', HTMLInputElement), readCamera);

  /** Builds the mesh from the depths. @param {boolean} [isAssumed] whether the camera was assumed, not given */
  const backProject = async (isAssumed = false) => {
    const input = depthInput();
    if (!input) return false;
    for (const field of fields) {
      const isValid = Number.isFinite(field.valueAsNumber) && (field === cx || field === cy || field.valueAsNumber > 0);
      field.setCustomValidity(isValid ? '' : `It must be a number${field === cx || field === cy ? '' : ' above 0'}.`);
      if (!field.reportValidity()) return false;
    }
    const [x, y, across, down, depthScale] = fields.map((field) => field.valueAsNumber);
    const { name, width, height, data, photo, companions } = input;
    const camera = { ...hiddenProperties, fx: x, fy: y, cx: across, cy: down, depthScale };
    const options = companions && { confidence: companions.confidence, mask: companions.mask };
    const kind = companions ? `depths, with ${companions.names.join(' and ')}` : 'depths';
    const unit = input.depths ? { unit: /** @type {const} */ ('m') } : {};
    const cameraAssumption = isAssumed ? DEPTH_WORDS.assumed(number(angle.valueAsNumber), depthScale) : undefined;
    return openLoadedMesh({ name, kind, photo: session.input?.photo ?? photo, depthSource: input, cameraAssumption },
      (signal) => runInWorker(session.api, signal, async (worker) => ({ ...await worker.backProject({ width, height, data }, camera, options), ...unit })),
      DEPTH_WORDS.failed, { label: DEPTH_WORDS.building, kind: 'depths', size: width * height });
  };
  element('back-project', HTMLButtonElement).addEventListener('click', async () => {
    if (await backProject()) void session.run();
  });
  session.on('cleared', () => {
    depthCheckbox.checked = session.input?.depthSource !== undefined;
    panel.hidden = !depthCheckbox.checked;
  });
  return { show, readCamera, backProject };
}

/** The smallest and the largest depth. @param {Float64Array} data */
function depthRange(data) {
  let [near, far] = [Infinity, -Infinity];
  for (const depth of data) {
    if (!(depth > 0 && depth < Infinity)) continue;
    near = Math.min(near, depth);
    far = Math.max(far, depth);
  }
  return [near, far];
}
