/** The surface laid flat, to scale, each triangle in the colour of its strain. */
import { count, number, percent, signed, strainInWords } from '../format.js';
import { CREASE, linear } from '../surface/colours.js';
import { canvasOf } from '../surface/layer.js';
import { VERDICTS } from '../messages.js';
import { colourBar, figures, say } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Picture} from '../surface/picture.js' */
/** @import {Shown} from './shown.js' */
/** @typedef {ReturnType<typeof import('../surface/pixels.js').sheetPixels>} Sheet */

/** Free room around the sheet, in pixels of the page, at the sides and below. */
const MARGIN = { side: 12, below: 34 };

/**
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<Shown>}
 */
export async function sheet(analyses, result) {
  const { picture, report: { distortion, crossings, parts, plan }, verdict } = await analyses.unroll(result);
  const { extent, most } = picture;
  const unit = result.input.unit ?? 'units';
  const scale = linear(most, signed);
  const size = `${number(extent.width, 4)} × ${number(extent.height, 4)} ${unit}`;
  return {
    after: pictureOf(picture, unit, `The surface laid flat, ${size}`),
    unfolding: { ...await analyses.unfold(result, most), look: () => ({ colour: CREASE, width: 1.5 }) },
    about: [
      say(VERDICTS[verdict]),
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
 * @param {Sheet} sheet
 * @param {string} unit
 * @param {string} words
 * @returns {Picture}
 */
function pictureOf({ extent, width: cols, height: rows, pixels, read }, unit, words) {
  const image = canvasOf({ width: cols, height: rows }, pixels);
  /** Where it is drawn. @param {{ width: number, height: number }} canvas @param {number} ratio */
  const placed = ({ width, height }, ratio) => {
    const room = { width: width - 2 * MARGIN.side * ratio, height: height - (MARGIN.side + MARGIN.below) * ratio };
    const dots = Math.min(room.width / extent.width, room.height / extent.height);
    const [wide, high] = [extent.width * dots, extent.height * dots];
    return { dots, left: (width - wide) / 2, top: MARGIN.side * ratio + (room.height - high) / 2, wide, high };
  };
  return {
    title: 'Laid flat',
    words,
    paint: (context, ratio) => {
      const { dots, left, top, wide, high } = placed(context.canvas, ratio);
      if (!(dots > 0)) return;
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, left, top, wide, high);
      drawRuler(context, dots, unit, ratio);
    },
    read: (canvas, ratio, x, y) => {
      const { left, top, wide, high } = placed(canvas, ratio);
      const [col, row] = [Math.floor(((x - left) / wide) * read.width), Math.floor(((y - top) / high) * read.height)];
      const inside = col >= 0 && row >= 0 && col < read.width && row < read.height;
      return strainInWords(inside ? read.strains[row * read.width + col] : NaN);
    },
  };
}

/**
 * A length to compare with, in the lower left corner.
 * @param {CanvasRenderingContext2D} context
 * @param {number} dots pixels for each unit of length
 * @param {string} unit
 * @param {number} ratio
 */
function drawRuler(context, dots, unit, ratio) {
  const rough = (0.25 * context.canvas.width) / dots;
  const power = 10 ** Math.floor(Math.log10(rough));
  const length = ([5, 2, 1].find((m) => m * power <= rough) ?? 1) * power;
  const style = getComputedStyle(context.canvas);
  const [x, y] = [MARGIN.side * ratio, context.canvas.height - 10 * ratio];
  context.strokeStyle = context.fillStyle = style.getPropertyValue('--ink').trim();
  context.lineWidth = 1.5 * ratio;
  context.beginPath();
  context.moveTo(x, y - 4 * ratio);
  context.lineTo(x, y);
  context.lineTo(x + length * dots, y);
  context.lineTo(x + length * dots, y - 4 * ratio);
  context.stroke();
  context.font = `${12 * ratio}px ${style.fontFamily}`;
  context.textBaseline = 'bottom';
  context.fillText(`${number(length)} ${length === 1 ? unit.replace(/^units$/, 'unit') : unit}`, x + 5 * ratio, y - 2 * ratio);
}
