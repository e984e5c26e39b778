/** The surface laid flat, to scale, each triangle in the colour of its strain. */
import { count, number, percent } from '../format.js';
import { divergingPixel, linear, magnitude } from '../surface/colours.js';
import { imageOf } from '../surface/layer.js';
import { fillTriangles } from '../surface/triangles.js';
import { VERDICTS } from '../words.js';
import { colourBar, figures, say } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Scale} from '../surface/colours.js' */
/** @import {Picture} from '../surface/picture.js' */
/** @import {Shown} from './shown.js' */
/** @typedef {import('../../pkg/types.js').Unrolling} Unrolling */

/** Strain below which colours would only show rounding. */
const FAINTEST = 1e-3;
/** Free room around the sheet, in pixels of the page, at the sides and below. */
const MARGIN = { side: 12, below: 34 };

/**
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<Shown>}
 */
export async function sheet(analyses, result) {
  const unrolling = await analyses.unroll(result);
  const { report: { distortion, crossings, parts, plan }, verdict } = unrolling;
  const unit = result.input.unit ?? 'units';
  const strains = strainsOf(unrolling.stretches);
  const scale = linear(Math.max(FAINTEST, magnitude([strains], 0.99)), (value) => `${value > 0 ? '+' : ''}${percent(value)}`);
  const extent = extentOf(unrolling.places);
  const size = `${number(extent.width, 4)} × ${number(extent.height, 4)} ${unit}`;
  return {
    after: picture(unrolling, extent, strains, scale, unit, `The surface laid flat, ${size}`),
    about: [
      say(VERDICTS[verdict]),
      colourBar('Strain: blue is compressed, red is stretched', scale),
      figures([
        ['Size of the sheet', size],
        ['Strain, root mean square', percent(distortion.rms)],
        ['Largest of any triangle', percent(distortion.maximum)],
        ['Above 1 % of strain', `${percent(distortion.above)} of the area`],
        ['Flipped triangles', count(distortion.flipped)],
        ['Overlaps', crossings === 0 ? 'none' : `borders cross ${count(crossings)} times`],
        ['Seen from above instead', `${percent(plan.rms)} of strain`],
        ...(parts > 1 ? [/** @type {const} */ (['Parts', count(parts)])] : []),
      ]),
    ],
  };
}

/**
 * Of each triangle, the strain of larger magnitude: above 0 where it is stretched.
 * @param {Float64Array} stretches singular values, two for each triangle
 */
function strainsOf(stretches) {
  return Float64Array.from({ length: stretches.length / 2 }, (_, t) => {
    const [large, small] = [stretches[2 * t] - 1, stretches[2 * t + 1] - 1];
    return Math.abs(large) >= Math.abs(small) ? large : small;
  });
}

/** @typedef {{ left: number, top: number, width: number, height: number }} Extent y up */

/** @param {Float64Array} places x, y */
export function extentOf(places) {
  let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let i = 0; i < places.length; i += 2) {
    left = Math.min(left, places[i]);
    right = Math.max(right, places[i]);
    bottom = Math.min(bottom, places[i + 1]);
    top = Math.max(top, places[i + 1]);
  }
  return { left, top, width: right - left, height: top - bottom };
}

/**
 * @param {Unrolling} unrolling
 * @param {Extent} extent
 * @param {Float64Array} strains
 * @param {Scale} scale
 * @param {string} unit
 * @param {string} words
 * @returns {Picture}
 */
function picture({ triangles, places }, extent, strains, scale, unit, words) {
  return {
    title: 'Laid flat',
    words,
    paint: (context, ratio) => {
      const { width, height } = context.canvas;
      const room = { width: width - 2 * MARGIN.side * ratio, height: height - (MARGIN.side + MARGIN.below) * ratio };
      const dots = Math.min(room.width / extent.width, room.height / extent.height);
      if (!(dots > 0)) return;
      const left = (width - extent.width * dots) / 2;
      const top = MARGIN.side * ratio + (room.height - extent.height * dots) / 2;
      const onCanvas = places.map((value, i) =>
        (i % 2 === 0 ? left + (value - extent.left) * dots : top + (extent.top - value) * dots));
      const pixels = new Uint32Array(width * height);
      fillTriangles({ width, height }, triangles, onCanvas, (pixel, triangle) => {
        pixels[pixel] = divergingPixel(scale.place(strains[triangle]));
      });
      context.drawImage(imageOf({ width, height }, (i) => pixels[i]), 0, 0);
      drawRuler(context, dots, unit, ratio);
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
