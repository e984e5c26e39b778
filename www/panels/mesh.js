/** Meshes and point clouds: turned, and seen as heights from a direction. */
import { apart, readingOf } from '../worker-task.js';
import { element, elements } from '../dom.js';
import { MESH } from '../file-kinds.js';
import { count, number } from '../format.js';
import { drawingOf, see } from '../mesh-sampling.js';
import { MeshView } from '../surface/mesh-view.js';

/** @import {Mesh, SampleMeshOptions} from '../api.js' */
/** @import {Called} from '../mesh-sampling.js' */
/** @import {Input, Session, Slow} from '../session.js' */

/** How long the hand rests, in milliseconds, before what it has turned to is solved. */
const REST = 180;

/** @param {Session} session */
export function meshPanel(session) {
  const panel = element('mesh-options', HTMLElement);
  const canvas = element('mesh-canvas', HTMLCanvasElement);
  const missing = element('mesh-missing', HTMLElement);
  const name = element('mesh-name', HTMLElement);
  const span = element('mesh-span', HTMLElement);
  const resolution = element('mesh-resolution', HTMLInputElement);
  const turned = element('mesh-turned', HTMLButtonElement);
  const buttons = elements('button[data-view]', HTMLButtonElement);
  /** @type {Promise<MeshView | null> | null} */
  let viewer = null;
  /** @type {Mesh | null} */
  let shown = null;

  /** The package knows what suits a mesh, and what a point cloud. */
  const wanted = () => (resolution.value === '' ? undefined : resolution.valueAsNumber);

  /** @param {SampleMeshOptions} change */
  const again = async (change) => {
    const { input } = session;
    if (!input?.seen) return;
    const { mesh, options, whole } = input.seen;
    if (await see(session, calledAs(input), async () => mesh, { ...options, ...change }, 'The mesh could not be seen so', { whole, slow: drawingOf(mesh) })) void session.run();
  };
  let rest = 0;
  /** Solved from the new side while it is turned, whenever the hand rests. @param {MeshView} view */
  const follow = (view) => {
    clearTimeout(rest);
    rest = window.setTimeout(() => again({ view: view.direction }), REST);
  };
  for (const button of buttons) {
    button.addEventListener('click', () => again({ view: /** @type {SampleMeshOptions['view']} */ (button.dataset.view) }));
  }
  turned.addEventListener('click', async () => {
    const view = await viewer;
    if (view) again({ view: view.direction });
  });
  resolution.addEventListener('change', () => {
    const number = wanted();
    const sound = number === undefined || (Number.isInteger(number) && number >= 3);
    resolution.setCustomValidity(sound ? '' : 'It must be a whole number, at least 3, or empty.');
    if (resolution.reportValidity()) again({ resolution: number });
  });

  session.on('input', async ({ seen, lattice, name: called, kind }) => {
    panel.hidden = seen === undefined;
    if (!seen || !lattice?.frame) return;
    const { towards } = lattice.frame;
    const { mesh, options } = seen;
    name.textContent = `${called} (${kind})`;
    span.textContent = spanInWords(mesh);
    for (const button of buttons) button.setAttribute('aria-pressed', String(button.dataset.view === options.view));
    turned.setAttribute('aria-pressed', String(typeof options.view !== 'string'));
    viewer ??= MeshView.on(canvas, follow).catch(() => null);
    const view = await viewer;
    canvas.hidden = turned.hidden = view === null;
    missing.hidden = view !== null;
    if (session.input?.seen !== seen || !view) return;
    try {
      if (shown !== mesh) view.show(mesh);
      shown = mesh;
      if (typeof options.view === 'string') view.look([-towards[0], -towards[1], -towards[2]]);
    } catch (error) {
      session.fail('The mesh could not be shown', error);
    }
  });

  return {
    /**
     * @param {Called} file
     * @param {(signal: AbortSignal) => Promise<Mesh>} load
     * @param {string} doing
     * @param {Slow} [slow]
     */
    take: (file, load, doing, slow) => see(session, file, load, { view: 'best-fit', resolution: wanted() }, doing, { slow }),
    /**
     * @param {File} file
     * @param {readonly File[]} [beside] what it may name: materials, textures, buffers
     */
    open(file, beside = []) {
      const kind = MESH.exec(file.name)?.[1].toUpperCase();
      const called = file.name.replace(MESH, '') || 'mesh';
      return this.take({ name: called, kind }, async (signal) => {
        const files = new Map(await Promise.all(beside.map(async (one) => /** @type {const} */ ([one.name, await one.arrayBuffer()]))));
        return apart(session.api, signal, (reader) => reader.readMesh(file, { files }));
      }, `“${file.name}” could not be read`, readingOf(file));
    },
  };
}

/** @param {Input} input @returns {Called} */
function calledAs({ name, kind, photo, depthSource, assumed }) {
  return { name, kind, photo, depthSource, assumed };
}

/** @param {Mesh} mesh */
function spanInWords({ positions, triangles, missing = [] }) {
  const sides = [0, 1, 2].map((k) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = k; i < positions.length; i += 3) {
      low = Math.min(low, positions[i]);
      high = Math.max(high, positions[i]);
    }
    return number(high - low);
  });
  const what = triangles.length > 0 ? `${count(triangles.length / 3)} triangles` : `${count(positions.length / 3)} points`;
  const without = missing.length > 0 ? ` Without ${missing.join(', ')}, which were not opened with it.` : '';
  return `${what}; x, y and z span ${sides.join(', ')}.${without}`;
}
