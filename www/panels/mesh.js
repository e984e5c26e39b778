/** Meshes and point clouds: turned by hand, and sampled as heights from a view. */
import { runInWorker } from '../worker-task.js';
import { element, elements } from '../dom.js';
import { MESH_ENDING } from '../file-kinds.js';
import { count, number } from '../format.js';
import { boundingBoxSides } from '../mesh-fit.js';
import { TASK_WORDS } from '../messages.js';
import { openSampledMesh } from '../mesh-sampling.js';
import { SceneView } from '../surface/scene.js';

/** @import {Mesh, SampleMeshOptions} from '../api.js' */
/** @import {InputOrigin} from '../mesh-sampling.js' */
/** @import {Input, Session} from '../session.js' */

/** Delay after the mesh was turned before it is sampled, in milliseconds. */
const TURN_DELAY_MS = 180;

/** @param {Session} session */
export function meshPanel(session) {
  const panel = element('mesh-options', HTMLElement);
  const canvas = element('mesh-canvas', HTMLCanvasElement);
  const missing = element('mesh-missing', HTMLElement);
  const name = element('mesh-name', HTMLElement);
  const span = element('mesh-span', HTMLElement);
  const buttons = elements('button[data-view]', HTMLButtonElement);
  /** @type {Promise<SceneView | null> | null} */
  let viewer = null;
  /** The mesh that is displayed. @type {Mesh | null} */
  let shownMesh = null;

  /** Samples the mesh with changed options. @param {SampleMeshOptions} change */
  const resample = async (change) => {
    const { input } = session;
    if (!input?.sampling) return;
    const { mesh, options } = input.sampling;
    const opened = await openSampledMesh(
      session, originOf(input), async () => mesh, { ...options, ...change }, 'The mesh could not be seen so', TASK_WORDS.sampling,
    );
    if (opened) void session.run();
  };
  let turnTimer = 0;
  /** Samples the mesh from the new view after it was turned. */
  const onTurn = () => {
    clearTimeout(turnTimer);
    turnTimer = window.setTimeout(async () => resample({ view: (await viewer)?.direction }), TURN_DELAY_MS);
  };
  for (const button of buttons) {
    button.addEventListener('click', () => resample({ view: /** @type {SampleMeshOptions['view']} */ (button.dataset.view) }));
  }
  session.on('input', async ({ sampling, lattice, name: title, kind }) => {
    panel.hidden = sampling === undefined;
    if (!sampling || !lattice?.frame) return;
    const { towards } = lattice.frame;
    const { mesh, options } = sampling;
    name.textContent = `${title} (${kind})`;
    span.textContent = spanInWords(mesh);
    for (const button of buttons) button.setAttribute('aria-pressed', String(button.dataset.view === options.view));
    viewer ??= SceneView.create(canvas, { onTurn }).catch(() => null);
    const view = await viewer;
    canvas.hidden = view === null;
    missing.hidden = view !== null;
    if (session.input?.sampling !== sampling || !view) return;
    try {
      if (shownMesh !== mesh) view.show(mesh);
      shownMesh = mesh;
      if (typeof options.view === 'string') view.setDirection([-towards[0], -towards[1], -towards[2]]);
    } catch (error) {
      session.fail('The mesh could not be shown', error);
    }
  });

  return {
    /**
     * Opens a mesh, sampled from its best-fit view.
     * @param {InputOrigin} origin
     * @param {(signal: AbortSignal) => Promise<Mesh>} load
     * @param {string} doing what could not be done, for the message if it fails
     * @param {string} [task] what its progress says
     */
    openLoaded: (origin, load, doing, task) => openSampledMesh(session, origin, load, { view: 'best-fit' }, doing, task),
    /**
     * Opens the mesh of a file.
     * @param {File} file
     * @param {readonly File[]} [referencedFiles] files that it may refer to: materials, textures, buffers
     */
    openFile(file, referencedFiles = []) {
      const kind = MESH_ENDING.exec(file.name)?.[1].toUpperCase();
      const name = file.name.replace(MESH_ENDING, '') || 'mesh';
      return this.openLoaded({ name, kind }, async (signal) => {
        const files = new Map(await Promise.all(referencedFiles.map(async (one) => /** @type {const} */ ([one.name, await one.arrayBuffer()]))));
        return runInWorker(session.api, signal, (reader) => reader.readMesh(file, { files }));
      }, `“${file.name}” could not be read`, TASK_WORDS.reading);
    },
  };
}

/** @param {Input} input @returns {InputOrigin} */
function originOf({ name, kind, photo, depthSource, cameraAssumption }) {
  return { name, kind, photo, depthSource, cameraAssumption };
}

/** The number of triangles or points and the bounding box as a sentence. @param {Mesh} mesh */
function spanInWords({ positions, triangles, unit, missing = [] }) {
  const sides = boundingBoxSides({ positions }).map((side) => number(side));
  const size = triangles.length > 0 ? `${count(triangles.length / 3)} triangles` : `${count(positions.length / 3)} points`;
  const without = missing.length > 0 ? ` Without ${missing.join(', ')}, which were not opened with it.` : '';
  return `${size}; x, y and z span ${sides.join(', ')}${unit ? ` ${unit}` : ''}.${without}`;
}
