/** A photo of the surface, and the same made flat. */
import { number, percent } from '../format.js';
import { imagePicture } from '../surface/picture.js';
import { FLATTENED } from '../words.js';
import { figures, say } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Shown} from './shown.js' */
/** @typedef {import('../../pkg/types.js').Dewarped} Dewarped */

/**
 * @param {Analyses} analyses
 * @param {Result} result
 * @param {ImageData} photo
 * @param {{ dots?: number, trim: boolean }} options
 * @returns {Promise<Shown & { flat: Dewarped }>}
 */
export async function dewarped(analyses, result, photo, options) {
  const flat = await analyses.dewarp(result, photo, options);
  const { width, height, data, resolution, verdict, report: { distortion } } = flat;
  const unit = result.input.unit ?? 'unit';
  return {
    flat,
    before: imagePicture(canvasOf(photo), 'Photo', `The photo, ${photo.width} × ${photo.height} pixels`),
    after: imagePicture(canvasOf(new ImageData(data, width)), 'Made flat', `The photo made flat, ${width} × ${height} pixels`),
    about: [
      say(FLATTENED[verdict]),
      figures([
        ['Flat image', `${width} × ${height} pixels`],
        ['Resolution', `${number(resolution, 4)} pixels per ${unit}`],
        ['Size', `${number(width / resolution)} × ${number(height / resolution)} ${result.input.unit ?? 'units'}`],
        ['Strain, root mean square', percent(distortion.rms)],
      ]),
    ],
  };
}

/** @param {ImageData} image */
export function canvasOf(image) {
  const canvas = document.createElement('canvas');
  canvas.width = image.width;
  canvas.height = image.height;
  canvas.getContext('2d')?.putImageData(image, 0, 0);
  return canvas;
}
