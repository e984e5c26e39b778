/** @import {Sheet} from '../surface/space.js' */
/** @import {Layer} from '../surface/layer.js' */
/** @import {Picture} from '../surface/picture.js' */

/**
 * What a view shows.
 * @typedef {object} Shown
 * @property {Layer} [input] over the input
 * @property {Layer} [result] over the result
 * @property {Picture} [before] in the place of the input
 * @property {Picture} [after] in the place of the result
 * @property {Sheet} [unfolding] in space, in the place of the result
 * @property {readonly Node[]} about what stands below
 */
export {};
