/**
 * Calls that are about one thing and no more: it is checked, and goes with the options to the function of the same name in one wasm
 * file, here or in the worker. A call of this kind is one row, from which both APIs are made.
 */
import { asField } from './input.js';
import { asMeshOrLattice, wholeOf } from './mesh-input.js';
import { OPTIONS, optionsOf } from './options.js';
import { asText, plainCopy } from './values.js';

/** @typedef {import('./direct.js').PartName} PartName */
/** @typedef {readonly [part: PartName, take: (input: any) => any]} PlainCall the wasm file, and what checks and copies the input */

/** @param {import('./types.js').Mesh} mesh */
const shapeOf = (mesh) => wholeOf(mesh).shape;
/** @param {unknown} drawing */
const asDrawing = (drawing) => plainCopy('the drawing', drawing);

/** @satisfies {Record<string, PlainCall>} */
export const PLAIN_CALLS = {
  writeObj: ['files', asMeshOrLattice],
  writeMtl: ['files', (picture) => asText('INPUT', "the picture's name", picture)],
  writePly: ['meshes', asMeshOrLattice],
  writeStl: ['meshes', asMeshOrLattice],
  patches: ['unroll', asField],
  rulings: ['unroll', asField],
  unroll: ['unroll', asField],
  pattern: ['patterns', asField],
  analyzeMesh: ['fitmesh', shapeOf],
  meshRulings: ['fitmesh', shapeOf],
  unrollMesh: ['patterns', shapeOf],
  recognizeMesh: ['patterns', shapeOf],
  writeSvg: ['patterns', asDrawing],
  writePdf: ['patterns', asDrawing],
  writeDxf: ['patterns', asDrawing],
};

/** @typedef {keyof typeof PLAIN_CALLS} PlainCallName */

/**
 * Makes something of each of these calls.
 * @template T
 * @param {(name: PlainCallName, part: PartName, check: (input: any, given?: object) => [taken: any, options: any]) => T} make `check`: returns
 *   checked copies of the input and of the options, none for a call without options
 * @returns {Record<PlainCallName, T>}
 */
export function ofPlainCalls(make) {
  const rows = /** @type {[PlainCallName, PlainCall][]} */ (/** @type {unknown} */ (Object.entries(PLAIN_CALLS)));
  return /** @type {Record<PlainCallName, T>} */ (Object.fromEntries(rows.map(([name, [part, take]]) => [name, make(name, part, (input, given) => {
    const options = Object.hasOwn(OPTIONS, name) ? optionsOf(/** @type {'unroll'} */ (name), given) : undefined;
    return [take(input), options];
  })])));
}
