/** The heights that are seen of a mesh, as the input. */
import { gridOver } from './surface/lattice.js';
import { work } from './surface/work.js';

/** @import {Mesh, SampleMeshOptions} from './api.js' */
/** @import {Input, Session} from './session.js' */
/** @typedef {Pick<Input, 'name' | 'kind' | 'photo'>} Called */

/**
 * @param {Session} session
 * @param {Called} file
 * @param {(signal: AbortSignal) => Promise<Mesh>} load
 * @param {SampleMeshOptions} options
 * @param {string} doing for the message if it fails
 * @param {{ whole?: Mesh, read?: File }} [from] what the mesh is a part of, the file that is read
 */
export function see(session, file, load, options, doing, { whole, read } = {}) {
  return session.open(doing, async (signal) => {
    const mesh = await load(signal);
    const lattice = await session.api.sampleMesh(mesh, options);
    const grid = gridOver(lattice);
    const data = await work('interpolated', lattice, lattice.heights, grid);
    if (!lattice.heights.some(Number.isFinite)) throw new Error('nothing of it is seen from there');
    return { ...file, ...grid, heightScale: 1, data, lattice, seen: { mesh, options, whole } };
  }, read);
}
