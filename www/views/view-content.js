/** @import {Unfolding} from '../surface/unfolding.js' */
/** @import {Layer} from '../surface/layer.js' */
/** @import {Picture} from '../surface/picture-view.js' */

/**
 * The content of a view.
 * @typedef {object} ViewContent
 * @property {Layer} [input] layer over the input
 * @property {Layer} [result] layer over the result
 * @property {Picture} [before] picture in place of the input
 * @property {Picture} [after] picture in place of the result
 * @property {Unfolding} [unfolding] mesh in space in place of the result
 * @property {readonly Node[]} about elements below the view
 */
export {};
