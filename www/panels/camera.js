/** Camera of depths: back-projects them to a mesh in space, which is then sampled from a view. */
import { runInWorker } from '../worker-task.js';
import { element, onFilesChosen } from '../dom.js';
import { hasCode } from '../error-messages.js';
import { above, between, fieldsOf } from '../fields.js';
import { number } from '../format.js';
import { DEPTH_WORDS } from '../messages.js';
import { boxOf } from '../surface/triangles.js';

/** @import {PhotoCamera} from '../../pkg/types.js' */
/** @import {InputOrigin} from './mesh.js' */

/** Field of view that is assumed at first, in degrees along the longer side: about that of a phone. */
const ASSUMED_FIELD_OF_VIEW_DEGREES = 60;
const FIELDS = {
  'camera-angle': { label: 'Field of view, °', range: between(1, 179), optional: true },
  'camera-scale': { label: 'Depth scale', value: '0.001', range: above(0) },
};

/** @param {Session} session @param {(origin: InputOrigin, load: (signal: AbortSignal) => Promise<Mesh>, doing: string, task: Task) => Promise<boolean>} openLoadedMesh */
export function cameraPanel(session, openLoadedMesh) {
  const depthCheckbox = element('is-depth', HTMLInputElement);
  const panel = element('camera', HTMLElement);
  const fields = fieldsOf(FIELDS, (name) => {
    if (name === 'camera-angle') fileCamera = null;
    describe();
  });
  element('camera-fields', HTMLElement).append(...fields.nodes());
  const about = element('camera-about', HTMLElement);
  const span = element('camera-span', HTMLElement);
  /** The input whose values are the depths. */
  const depthInput = () => session.input?.depthSource ?? session.input;
  /** The camera of a file; null where the field of view says what it is. @type {PhotoCamera | null} */
  let fileCamera = null;

  const describe = () => {
    const input = depthInput();
    if (!input) return;
    about.textContent = fileCamera ? DEPTH_WORDS.camera(fileCamera) : '';
    const { low, high } = boxOf(input.data.filter((depth) => depth > 0 && depth < Infinity), 1);
    const [near, far] = [...low, ...high].map((depth) => depth * fields.number('camera-scale'));
    span.textContent = Number.isFinite(near) ? `With this scale, what is seen is ${number(near)} to ${number(far)}${input.depths ? ' m' : ''} away.` : '';
  };
  /** Shows the fields, filled with a typical camera, whose principal point is the middle of the image. */
  const show = () => {
    depthCheckbox.checked = true;
    panel.hidden = false;
    fileCamera = null;
    fields.set('camera-angle', ASSUMED_FIELD_OF_VIEW_DEGREES);
    fields.set('camera-scale', depthInput()?.depthUnit === 'm' ? 1 : 0.001);
    describe();
  };

  depthCheckbox.addEventListener('change', () => {
    const depthSource = session.input?.depthSource;
    if (depthCheckbox.checked) show();
    // The values are heights after all.
    else if (depthSource) void session.open('The heights could not be taken', async () => ({ ...depthSource, depths: undefined }), 'reading').then((opened) => {
        if (opened) void session.run();
      });
    else panel.hidden = true;
  });
  /**
   * Reads the camera from a file.
   * @param {File} file
   * @param {boolean} [mayBeOther] whether the file may be something else
   * @returns {Promise<boolean | undefined>} whether it was read; undefined if there is no camera in it, which then is no error
   */
  const readCamera = async (file, mayBeOther = false) => {
    const input = depthInput();
    if (!input) return false;
    try {
      const camera = session.api.parseCamera(await file.arrayBuffer(), [input, ...(input.photo ? [input.photo.image] : [])].map(({ width, height }) => ({ width, height })));
      if (depthInput() !== input) return false;
      show();
      fileCamera = camera;
      fields.set('camera-angle', '');
      if (camera.depthScale) fields.set('camera-scale', camera.depthScale);
      describe();
      return true;
    } catch (error) {
      // Where no depths are open, a text was not meant as their camera.
      if ((mayBeOther || !(input.depths || depthCheckbox.checked)) && hasCode(error, 'FORMAT')) return undefined;
      session.fail(`“${file.name}” could not be used`, error);
      return false;
    }
  };
  onFilesChosen(element('camera-open', HTMLButtonElement), element('camera-file', HTMLInputElement), ([file]) => readCamera(file));

  /** The camera of the fields. @param {Input} input @returns {PhotoCamera} */
  const presentCamera = ({ width, height }) => {
    const depthScale = fields.number('camera-scale');
    if (fileCamera) {
      const { rotation, translation, ...camera } = fileCamera;
      return { ...camera, depthScale };
    }
    const focalLength = Math.max(width, height) / 2 / Math.tan((fields.number('camera-angle') * Math.PI) / 360);
    return { fx: focalLength, fy: focalLength, cx: (width - 1) / 2, cy: (height - 1) / 2, depthScale };
  };
  /** Builds the mesh from the depths. @param {boolean} [isAssumed] whether the camera was assumed, not given */
  const backProject = async (isAssumed = false) => {
    const input = depthInput();
    if (!fileCamera && fields.text('camera-angle') === '') fields.set('camera-angle', ASSUMED_FIELD_OF_VIEW_DEGREES);
    if (!input || fields.check()) return false;
    const { name, width, height, data, photo } = input;
    const camera = presentCamera(input);
    const unit = input.depths ? { unit: /** @type {const} */ ('m') } : {};
    const assumptions = isAssumed ? [{ code: 'camera', words: DEPTH_WORDS.assumed(number(fields.number('camera-angle')), fields.number('camera-scale')) + (/disp(?:arit|[^a-z]|$)/i.test(name) ? DEPTH_WORDS.disparities : '') }] : [];
    return openLoadedMesh({ name, kind: 'depths', photo, depthSource: input },
      (signal) => runInWorker(session.api, signal, async (worker) => ({ ...await worker.backProject({ width, height, data }, camera), ...unit, assumptions })),
      DEPTH_WORDS.failed, 'building');
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
