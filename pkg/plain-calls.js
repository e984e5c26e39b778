/**
 * Calls that are about one thing and no more: it is checked, and goes with the options to the function of the same name in one wasm
 * file, here or in the worker. A call of this kind is one row, from which both APIs are made.
 */
import { asBytes, asField } from './input.js';
import { asMeshOrLattice, isMesh, wholeOf } from './mesh-input.js';
import { OPTIONS, optionsOf } from './options.js';
import { placedOptions } from './sheet-input.js';
import { asText, plainCopy } from './values.js';

/** @typedef {import('./calls.js').Part} Part */
/**
 * The wasm file, what checks and copies the input, and what does so with the options, where these need more than their table.
 * @typedef {readonly [part: Part, take: (input: any) => any, options?: (input: any, given: any) => any]} Taken
 * @typedef {Taken | { heights: Part, mesh: Part }} PlainCall a call of any surface has two wasm files
 */

/** @param {import('./types.js').Mesh} mesh */
const shapeOf = (mesh) => wholeOf(mesh).shape;
/** A mesh, or heights, of a call of any surface. @param {any} input @returns {any} */
export const asSurface = (input) => (isMesh(input) ? shapeOf(input) : asField(input, ', or a mesh ({ positions, triangles })'));
/** @param {unknown} drawing */
const asDrawing = (drawing) => plainCopy('the drawing', drawing);
/** @param {unknown} name */
const asExample = (name) => asText('OPTION', 'the name of the example', name);

/** @satisfies {Record<string, PlainCall>} */
export const PLAIN_CALLS = {
  example: ['solver', asExample],
  formatOf: ['files', asBytes],
  npzArrays: ['images', asBytes],
  writeObj: ['files', asMeshOrLattice],
  writeMtl: ['files', (picture) => asText('INPUT', "the picture's name", picture)],
  writePly: ['meshes', asMeshOrLattice],
  writeStl: ['meshes', asMeshOrLattice],
  patches: { heights: 'unroll', mesh: 'patterns' },
  rulings: { heights: 'unroll', mesh: 'fitmesh' },
  unroll: { heights: 'unroll', mesh: 'patterns' },
  picture: ['unroll', asField, (input, given) => placedOptions('picture', input, given)],
  recognizeMesh: ['patterns', shapeOf],
  writeSvg: ['patterns', asDrawing],
  writePdf: ['patterns', asDrawing],
  writeDxf: ['patterns', asDrawing],
};

/** @typedef {keyof typeof PLAIN_CALLS} PlainCallName */

/** The name of the options of a call of any surface: those of meshes have a set of their own. @param {string} call @param {unknown} input */
const surfaceCall = (call, input) => /** @type {'unroll' | 'unrollMesh'} */ (isMesh(input) ? `${call}Mesh` : call);

/**
 * Makes something of each of these calls.
 * @template T
 * @param {(name: PlainCallName, part: (input: any) => Part, check: (input: any, given?: object) => [taken: any, options: any]) => T} make
 *   `check`: returns checked copies of the input and of the options, none for a call without options
 * @returns {Record<PlainCallName, T>}
 */
export function ofPlainCalls(make) {
  const rows = /** @type {[PlainCallName, PlainCall][]} */ (/** @type {unknown} */ (Object.entries(PLAIN_CALLS)));
  return /** @type {Record<PlainCallName, T>} */ (Object.fromEntries(rows.map(([name, call]) => {
    if ('mesh' in call) {
      return [name, make(name, (input) => call[isMesh(input) ? 'mesh' : 'heights'], (input, given) => {
        const options = optionsOf(surfaceCall(name, input), given);
        return [asSurface(input), options];
      })];
    }
    const own = Object.hasOwn(OPTIONS, name) ? (/** @type {any} */ _, /** @type {any} */ given) => optionsOf(/** @type {'unroll'} */ (name), given) : undefined;
    const [part, take, options = own] = call;
    return [name, make(name, () => part, (input, given) => [take(input), options?.(input, given)])];
  })));
}
