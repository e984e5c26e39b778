/** The view of the surface laid flat in one piece, to scale and coloured by strain. */
import { count, number, percent, signedPercent, strainInWords } from '../format.js';
import { CREASE_COLOUR, linearScale } from '../surface/colours.js';
import { canvasFromPixels } from '../surface/layer.js';
import { VERDICTS } from '../messages.js';
import { colourBar, figures, statement } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Picture} from '../surface/picture-view.js' */
/** @import {ViewContent} from './view-content.js' */
/** @typedef {ReturnType<typeof import('../surface/colour-images.js').sheetStrainImage>} Sheet */

/** Margins around the sheet, in CSS pixels. */
const MARGIN = { side: 12, below: 34 };

/**
 * The view of the flat surface.
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<ViewContent>}
 */
export async function sheet(analyses, result) {
  const { picture, report: { distortion, crossings, parts, plan }, verdict } = await analyses.unroll(result);
  const { extent, maxStrain } = picture;
  const unit = result.input.unit ?? 'units';
  const scale = linearScale(maxStrain, signedPercent);
  const size = `${number(extent.width, 4)} × ${number(extent.height, 4)} ${unit}`;
  return {
    after: pictureOf(picture, unit, `The surface laid flat, ${size}`),
    unfolding: { ...await analyses.unfold(result, maxStrain), lineStyle: () => ({ colour: CREASE_COLOUR, width: 1.5 }) },
    about: [
      statement(VERDICTS[verdict]),
      colourBar('Strain: blue is compressed, red is stretched', scale),
      figures([
        ['Sheet size', size],
        ['RMS strain', percent(distortion.rms)],
        ['Largest strain', percent(distortion.maximum)],
        ['Strain above 1 %', `${percent(distortion.above)} of the area`],
        ['Flipped triangles', count(distortion.flipped)],
        ['Overlaps', crossings === 0 ? 'none' : `borders cross ${count(crossings)} times`],
        ['Strain seen from above, RMS', percent(plan.rms)],
        ...(parts > 1 ? [/** @type {const} */ (['Parts', count(parts)])] : []),
      ]),
    ],
  };
}

/**
 * The picture of a sheet with a scale bar.
 * @param {Sheet} sheet
 * @param {string} unit
 * @param {string} words
 * @returns {Picture}
 */
function pictureOf({ extent, width: cols, height: rows, pixels, readout }, unit, words) {
  const image = canvasFromPixels({ width: cols, height: rows }, pixels);
  /** The rectangle of the sheet on a canvas. @param {{ width: number, height: number }} canvas @param {number} ratio */
  const fittedBox = ({ width, height }, ratio) => {
    const room = { width: width - 2 * MARGIN.side * ratio, height: height - (MARGIN.side + MARGIN.below) * ratio };
    const dots = Math.min(room.width / extent.width, room.height / extent.height);
    const [wide, high] = [extent.width * dots, extent.height * dots];
    return { dots, left: (width - wide) / 2, top: MARGIN.side * ratio + (room.height - high) / 2, wide, high };
  };
  return {
    title: 'Laid flat',
    words,
    paint: (context, ratio) => {
      const { dots, left, top, wide, high } = fittedBox(context.canvas, ratio);
      if (!(dots > 0)) return;
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, left, top, wide, high);
      drawRuler(context, dots, unit, ratio);
    },
    read: (canvas, ratio, x, y) => {
      const { left, top, wide, high } = fittedBox(canvas, ratio);
      const [col, row] = [Math.floor(((x - left) / wide) * readout.width), Math.floor(((y - top) / high) * readout.height)];
      const inside = col >= 0 && row >= 0 && col < readout.width && row < readout.height;
      return strainInWords(inside ? readout.strains[row * readout.width + col] : NaN);
    },
  };
}

/**
 * Draws a scale bar in the lower left corner.
 * @param {CanvasRenderingContext2D} context
 * @param {number} pixelsPerUnit device pixels per unit of length
 * @param {string} unit
 * @param {number} ratio
 */
function drawRuler(context, pixelsPerUnit, unit, ratio) {
  const rough = (0.25 * context.canvas.width) / pixelsPerUnit;
  const power = 10 ** Math.floor(Math.log10(rough));
  const length = ([5, 2, 1].find((m) => m * power <= rough) ?? 1) * power;
  const style = getComputedStyle(context.canvas);
  const [x, y] = [MARGIN.side * ratio, context.canvas.height - 10 * ratio];
  context.strokeStyle = context.fillStyle = style.getPropertyValue('--ink').trim();
  context.lineWidth = 1.5 * ratio;
  context.beginPath();
  context.moveTo(x, y - 4 * ratio);
  context.lineTo(x, y);
  context.lineTo(x + length * pixelsPerUnit, y);
  context.lineTo(x + length * pixelsPerUnit, y - 4 * ratio);
  context.stroke();
  context.font = `${12 * ratio}px ${style.fontFamily}`;
  context.textBaseline = 'bottom';
  context.fillText(`${number(length)} ${length === 1 ? unit.replace(/^units$/, 'unit') : unit}`, x + 5 * ratio, y - 2 * ratio);
}
