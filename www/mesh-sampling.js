/** Heights that are sampled from a mesh, seen from one side, as the input. */
import { runInWorker } from './worker-task.js';
import { gridOverLattice } from './surface/lattice.js';
import { callWorker } from './surface/worker-client.js';

/** @import {Mesh, SampleMeshOptions} from './api.js' */
/** @import {Input, Session} from './session.js' */
/** @typedef {Pick<Input, 'name' | 'kind' | 'photo' | 'depthSource' | 'cameraAssumption'>} InputOrigin */

/**
 * Samples a mesh from a view and opens its heights as the input.
 * @param {Session} session
 * @param {InputOrigin} origin
 * @param {(signal: AbortSignal) => Promise<Mesh>} load
 * @param {SampleMeshOptions} options
 * @param {string} doing what could not be done, for the message if it fails
 * @param {import('./messages.js').Task} [task]
 */
export function openSampledMesh(session, origin, load, options, doing, task) {
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
