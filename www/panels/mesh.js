/** Meshes and point clouds, sampled as heights from a view. */
import { runInWorker } from '../worker-task.js';
import { element } from '../dom.js';
import { choiceOf } from '../fields.js';
import { countOf, number } from '../format.js';
import { gridOverLattice } from '../surface/lattice.js';
import { sidesOf } from '../surface/triangles.js';
import { callWorker } from '../surface/worker-client.js';

/** @typedef {Pick<Input, 'name' | 'kind' | 'photo' | 'depthSource'>} InputOrigin */

/** Directions of view by the axis that points at the viewer. @type {Record<string, string>} */
const DIRECTIONS = { '-z': '+z', '-x': '+x', '-y': '+y', '+z': '−z', '+x': '−x', '+y': '−y', 'best-fit': 'Fitted plane' };

/** @param {Session} session */
export function meshPanel(session) {
  const panel = element('mesh-options', HTMLElement);
  const name = element('mesh-name', HTMLElement);
  const span = element('mesh-span', HTMLElement);

  /** Samples the mesh with changed options. @param {SampleMeshOptions} change */
  const resample = async (change) => {
    const { input } = session;
    if (!input?.sampling) return;
    const { mesh, options } = input.sampling;
    const opened = await openSampledMesh(
      session, input, async () => mesh, { ...options, ...change }, 'The mesh could not be seen so', 'sampling',
    );
    if (opened) void session.run();
    else direction.set(String(options.view));
  };
  const direction = choiceOf('mesh-side', DIRECTIONS, (view) => void resample({ view: /** @type {SampleMeshOptions['view']} */ (view) }));
  session.on('input', ({ sampling, name: title, kind }) => {
    panel.hidden = sampling === undefined;
    if (!sampling) return;
    const { mesh, options } = sampling;
    name.textContent = `${title} (${kind})`;
    span.textContent = spanInWords(mesh);
    direction.set(String(options.view));
  });

  return {
    /**
     * Opens a mesh, sampled from its best-fit view.
     * @param {InputOrigin} origin
     * @param {(signal: AbortSignal) => Promise<Mesh>} load
     * @param {string} doing what could not be done, for the message if it fails
     * @param {Task} task
     */
    openLoaded: (origin, load, doing, task) => openSampledMesh(session, origin, load, { view: 'best-fit' }, doing, task),
    /**
     * Opens the mesh of a file.
     * @param {File} file
     * @param {readonly File[]} [referencedFiles] files that it may refer to: materials, textures, buffers
     * @param {string} [format] name of its format, where the file's name does not tell it
     */
    openFile(file, referencedFiles = [], format = undefined) {
      const [, title = file.name, ending = ''] = /^(.*)\.(\w+)$/.exec(file.name) ?? [];
      const kind = (format ?? ending).toUpperCase();
      const name = title || 'mesh';
      return this.openLoaded({ name, kind }, async (signal) => {
        const files = new Map(await Promise.all(referencedFiles.map(async (one) => /** @type {const} */ ([one.name, await one.arrayBuffer()]))));
        return runInWorker(session.api, signal, (reader) => reader.readMesh(file, { files }));
      }, `“${file.name}” could not be read`, 'reading');
    },
  };
}

/**
 * Samples a mesh from a view and opens its heights as the input.
 * @param {Session} session
 * @param {InputOrigin} origin
 * @param {(signal: AbortSignal) => Promise<Mesh>} load
 * @param {SampleMeshOptions} options
 * @param {string} doing what could not be done, for the message if it fails
 * @param {Task} task
 */
function openSampledMesh(session, origin, load, options, doing, task) {
  return session.open(doing, async (signal) => {
    const mesh = await load(signal);
    const lattice = await runInWorker(session.api, signal, (worker) => worker.sampleMesh(mesh, options));
    const grid = gridOverLattice(lattice);
    const data = await callWorker('interpolateToGrid', lattice, lattice.heights, grid);
    if (!lattice.heights.some(Number.isFinite)) throw new Error('nothing of it is seen from there');
    const texture = lattice.texture && await session.api.readPhoto(lattice.texture);
    const photo = texture ? { name: origin.name, image: new ImageData(texture.data, texture.width) } : origin.photo;
    return { ...origin, photo, ...grid, heightScale: 1, data, lattice, unit: lattice.unit ?? undefined, assumptions: mesh.assumptions, sampling: { mesh, options } };
  }, task);
}

/** The number of triangles or points and the bounding box as a sentence. @param {Mesh} mesh */
function spanInWords({ positions, triangles, unit, missing = [] }) {
  const sides = sidesOf(positions).map((side) => number(side)).join(' × ');
  const size = triangles.length > 0 ? countOf(triangles.length / 3, 'triangle') : countOf(positions.length / 3, 'point');
  const without = missing.length > 0 ? ` Without ${missing.join(', ')}: not opened with it.` : '';
  return `${sides}${unit ? ` ${unit}` : ''}, ${size}.${without}`;
}
