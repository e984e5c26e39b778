/** The heights that are seen of a mesh, as the input. */
import { apart } from './worker-task.js';
import { gridOver } from './surface/lattice.js';
import { work } from './surface/work.js';

/** @import {Mesh, SampleMeshOptions} from './api.js' */
/** @import {Input, Session, Slow} from './session.js' */
/** @typedef {Pick<Input, 'name' | 'kind' | 'photo' | 'depthSource' | 'assumed'>} Called */

/** Milliseconds for a vertex of a mesh that is drawn into a lattice, until that was measured. */
const EACH = 1e-3;

/** A mesh that is seen from another side. @param {Mesh} mesh @returns {Slow} */
export function drawingOf({ positions }) {
  return { words: 'Looking at it from there', kind: 'mesh', size: positions.length / 3, each: EACH };
}

/**
 * @param {Session} session
 * @param {Called} file
 * @param {(signal: AbortSignal) => Promise<Mesh>} load
 * @param {SampleMeshOptions} options
 * @param {string} doing for the message if it fails
 * @param {{ whole?: Mesh, slow?: Slow }} [from] what the mesh is a part of, what takes long
 */
export function see(session, file, load, options, doing, { whole, slow } = {}) {
  return session.open(doing, async (signal) => {
    const mesh = await load(signal);
    const lattice = await apart(session.api, signal, (worker) => worker.sampleMesh(mesh, options));
    const grid = gridOver(lattice);
    const data = await work('interpolated', lattice, lattice.heights, grid);
    if (!lattice.heights.some(Number.isFinite)) throw new Error('nothing of it is seen from there');
    return { ...file, ...grid, heightScale: 1, data, lattice, unit: lattice.unit ?? undefined, seen: { mesh, options, whole } };
  }, slow);
}
