/** The heights that are seen of a mesh, as the input. */
import { gridOver, interpolated } from './surface/lattice.js';

/** @import {Mesh, SampleMeshOptions} from './api.js' */
/** @import {Input, Session} from './session.js' */
/** @typedef {Pick<Input, 'name' | 'kind' | 'photo'>} Called */

/**
 * @param {Session} session
 * @param {Called} file
 * @param {() => Promise<Mesh>} load
 * @param {SampleMeshOptions} options
 * @param {string} doing for the message if it fails
 * @param {Mesh} [whole] what the mesh is a part of
 */
export function see(session, file, load, options, doing, whole) {
  return session.open(doing, async () => {
    const mesh = await load();
    const lattice = await session.api.sampleMesh(mesh, options);
    const grid = gridOver(lattice);
    const data = interpolated(lattice, lattice.heights, grid);
    if (!lattice.heights.some(Number.isFinite)) throw new Error('nothing of it is seen from there');
    return { ...file, ...grid, heightScale: 1, data, lattice, seen: { mesh, options, whole } };
  });
}
