/** The view of a photo of the surface and the flat photo. */
import { count, number, percent } from '../format.js';
import { canvasFromImage } from '../surface/layer.js';
import { imagePicture } from '../surface/picture-view.js';
import { DEWARP_VERDICTS, CYLINDER_NOTE, assumedInWords } from '../messages.js';
import { figures, statement } from './legend.js';

/** @import {Analyses, FlatOptions} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {ViewContent} from './view-content.js' */
/** @typedef {import('../../pkg/types.js').Dewarped} Dewarped */

/** Codes of the assumptions about the scale of heights: a page is flat only by the right one. */
const SCALE_ASSUMPTIONS = ['pixelSize', 'heightScale'];

/**
 * Dewarps a photo by a result.
 * @param {Analyses} analyses
 * @param {Result} result
 * @param {ImageData} photo
 * @param {FlatOptions} options
 * @returns {Promise<ViewContent & { flat: Dewarped }>}
 */
export async function dewarped(analyses, result, photo, options) {
  const flat = await analyses.dewarp(result, photo, options);
  const { width, height, data, resolution, verdict, parallel, report: { distortion, parts, crossings } } = flat;
  const scale = assumedInWords(result.input.assumptions?.filter(({ code }) => SCALE_ASSUMPTIONS.includes(code)));
  const unit = result.input.unit ?? 'unit';
  return {
    flat,
    before: imagePicture(canvasFromImage(photo), 'Photo', `The photo, ${photo.width} × ${photo.height} pixels`),
    after: imagePicture(canvasFromImage(new ImageData(data, width)), 'Made flat', `The photo made flat, ${width} × ${height} pixels`,
      (x, y) => `${number(x / resolution)}, ${number(y / resolution)} ${result.input.unit ?? 'units'} from the upper left corner`),
    about: [
      statement(scale || `${DEWARP_VERDICTS[verdict]}${parallel ? ` ${CYLINDER_NOTE}` : ''}`),
      figures([
        ['Flat image', `${width} × ${height} pixels`],
        ['Resolution', `${number(resolution, 4)} pixels per ${unit}`],
        ['Size', `${number(width / resolution)} × ${number(height / resolution)} ${result.input.unit ?? 'units'}`],
        ['RMS strain', percent(distortion.rms)],
        ['Strain above 1 %', `${percent(distortion.above)} of the area`],
        ['Overlaps', crossings === 0 ? 'none' : `borders cross ${count(crossings)} times`],
        ...(parts > 1 ? [/** @type {const} */ (['Parts', count(parts)])] : []),
      ]),
    ],
  };
}
