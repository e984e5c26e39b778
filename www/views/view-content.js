/** @import {Colours} from './legend.js' */
/** @import {Layer} from '../surface/layer.js' */
/** @import {Picture} from '../surface/picture-view.js' */

/**
 * The content of a view.
 * @typedef {object} ViewContent
 * @property {Layer} [input] layer over the input
 * @property {Layer} [result] layer over the result
 * @property {Picture} [after] picture in place of both surfaces
 * @property {string} [said] sentence below the view
 * @property {Colours} [colours]
 * @property {readonly Node[]} [about] further elements below the view
 */
export {};
