/** A photo of the surface, and the same made flat. */
import { doubtOf } from '../unit-check.js';
import { count, number, percent } from '../format.js';
import { imagePicture } from '../surface/picture.js';
import { FLATTENED, PARALLEL } from '../messages.js';
import { figures, say } from './legend.js';

/** @import {Analyses, FlatOptions} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Shown} from './shown.js' */
/** @typedef {import('../../pkg/types.js').Dewarped} Dewarped */

/**
 * @param {Analyses} analyses
 * @param {Result} result
 * @param {ImageData} photo
 * @param {FlatOptions} options
 * @returns {Promise<Shown & { flat: Dewarped }>}
 */
export async function dewarped(analyses, result, photo, options) {
  const flat = await analyses.dewarp(result, photo, options);
  const { width, height, data, resolution, verdict, parallel, report: { distortion, parts, crossings } } = flat;
  const doubt = doubtOf(result.input);
  const unit = result.input.unit ?? 'unit';
  return {
    flat,
    before: photoPicture(photo),
    after: imagePicture(canvasOf(new ImageData(data, width)), 'Made flat', `The photo made flat, ${width} × ${height} pixels`,
      (x, y) => `${number(x / resolution)}, ${number(y / resolution)} ${result.input.unit ?? 'units'} from the upper left corner`),
    about: [
      say(doubt || `${FLATTENED[verdict]}${parallel ? ` ${PARALLEL}` : ''}`),
      figures([
        ['Flat image', `${width} × ${height} pixels`],
        ['Resolution', `${number(resolution, 4)} pixels per ${unit}`],
        ['Size', `${number(width / resolution)} × ${number(height / resolution)} ${result.input.unit ?? 'units'}`],
        ['RMS strain', percent(distortion.rms)],
        ['Strain above 1 %', `${percent(distortion.above)} of the area`],
        ['Overlaps', crossings === 0 ? 'none' : `borders cross ${count(crossings)} times`],
        ...(parts > 1 ? [/** @type {const} */ (['Parts', `${count(parts)}: click one in the photo to have it alone`])] : []),
      ]),
    ],
  };
}

/** @param {ImageData} photo */
export function photoPicture(photo) {
  return imagePicture(canvasOf(photo), 'Photo', `The photo, ${photo.width} × ${photo.height} pixels`);
}

/** @param {ImageData} image */
export function canvasOf(image) {
  const canvas = document.createElement('canvas');
  canvas.width = image.width;
  canvas.height = image.height;
  canvas.getContext('2d')?.putImageData(image, 0, 0);
  return canvas;
}
