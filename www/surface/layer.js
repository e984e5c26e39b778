/** Layers over a surface: its colours, and lines. */
import { interpolatorOf } from './lattice.js';
import { interpolateAt } from './triangles.js';

/** @import {Lattice} from './lattice.js' */
/** @import {Place, Surface} from './scene.js' */
/** @import {Colours} from '../views/legend.js' */

/**
 * @typedef {object} Line
 * @property {readonly (readonly [number, number, number])[]} points
 * @property {Colour} colour
 * @property {number} width in CSS pixels
 */

/**
 * What a view shows on the input or on the result.
 * @typedef {object} Layer
 * @property {(plain: Surface) => Surface} [surface] what is drawn in place of the plain surface
 * @property {readonly Line[]} [lines]
 * @property {(place: Place) => string} [read] the value at a place, with its name and unit
 */

/**
 * The content of a view.
 * @typedef {object} ViewContent
 * @property {readonly [Layer | undefined, Layer | undefined]} [layers] on the input and on the result
 * @property {Picture} [flat] picture in place of both surfaces
 * @property {string} [said] sentence below the view
 * @property {Colours} [colours]
 * @property {readonly Node[]} [about] further elements below the view
 */

/** A canvas with an image. @param {ImageData} image */
export function canvasFromImage(image) {
  const canvas = document.createElement('canvas');
  canvas.width = image.width;
  canvas.height = image.height;
  canvas.getContext('2d')?.putImageData(image, 0, 0);
  return canvas;
}

/** @typedef {{ at: (vertex: number, x: number, y: number) => number, read: (place: Place) => number }} Field values at the vertices that are drawn, and under the pointer */

/** Colour of places without a value: that of steel. @type {Colour} */
const NO_VALUE_COLOUR = [182, 187, 193];

/** Values of a lattice, over heights that are drawn on any grid. @param {Lattice} lattice @param {ArrayLike<number>} values @returns {Field} */
export function latticeField(lattice, values) {
  const at = interpolatorOf(lattice, values);
  return { at: (_, x, y) => at(x, y), read: ({ point: [x, y] }) => at(x, y) };
}

/** Values at the vertices of a mesh. @param {Pick<Mesh, 'triangles'>} mesh @param {ArrayLike<number>} values @returns {Field} */
export function meshField(mesh, values) {
  return { at: (vertex) => values[vertex], read: (place) => interpolateAt(mesh, place, (vertex) => values[vertex]) };
}

/** Colours a surface by values at its vertices. @param {Field['at']} at @param {(value: number) => Colour} colourOf @returns {NonNullable<Layer['surface']>} */
export function colouredBy(at, colourOf) {
  return (plain) => {
    const { positions } = plain;
    const colors = new Float32Array(positions.length);
    for (let i = 0; i < positions.length; i += 3) {
      const value = at(i / 3, positions[i], positions[i + 1]);
      colors.set(Number.isNaN(value) ? NO_VALUE_COLOUR : colourOf(value), i);
    }
    return { ...plain, colors: colors.map((channel) => channel / 255) };
  };
}
