/** The view of a surface laid flat as it is, to scale and coloured by strain, of heights and meshes. */
import { areaUnit, count, number, numberAgainst, percent, signedPercent } from '../format.js';
import { linearScale } from '../surface/colours.js';
import { canvasFromImage } from '../surface/layer.js';
import { imagePicture } from '../surface/picture-view.js';
import { callWorker } from '../surface/worker-client.js';
import { VERDICTS } from '../messages.js';
import { figures } from './legend.js';

/** @typedef {import('../../pkg/types.js').MeshUnrolling} MeshUnrolling */
/** @typedef {ReturnType<typeof import('../surface/colour-images.js').sheetStrainImage>} Sheet */

/** Distance of the scale bar from the left and from below, in CSS pixels. */
const RULER_MARGIN = 12;

/** The view of heights laid flat. @param {string} unit @param {Awaited<ReturnType<Analyses['unroll']>>} unrolled @returns {ViewContent} */
export function sheetOfHeights(unit, { picture, report: { distortion, crossings, parts, plan }, verdict }) {
  return sheet(picture, unit, VERDICTS[verdict], [
    ['RMS strain', percent(distortion.rms)],
    ['Largest strain', percent(distortion.maximum)],
    ['Strain above 1 %', `${percent(distortion.above)} of the area`],
    ['Flipped triangles', count(distortion.flipped)],
    ['Overlaps', crossings === 0 ? 'none' : `borders cross ${count(crossings)} times`],
    ['Strain seen from above, RMS', percent(plan.rms)],
    ...(parts > 1 ? [/** @type {const} */ (['Parts', count(parts)])] : []),
  ]);
}

/** The view of a mesh laid flat. @param {string} unit @param {MeshUnrolling} unrolled @returns {Promise<ViewContent>} */
export async function sheetOfMesh(unit, { triangles, places, stretches, report: { sheets, strain, seamGap, missing, simplified } }) {
  const picture = await callWorker('sheetStrainImage', triangles, places, stretches);
  return sheet(picture, unit, sheets === 1 ? 'One sheet, if the paper is large enough.' : `${count(sheets)} sheets.`, [
    ['Largest strain', percent(strain)],
    ['Seam gap of folds', `${numberAgainst(seamGap, picture.extent.width)} ${unit}`],
    ...(simplified ? [/** @type {const} */ (['Flat faces that stand for it', `${count(simplified.faces)}, ${number(simplified.distance, 2)} ${unit} from it`])] : []),
    ...(missing.area > 0 ? [/** @type {const} */ (['Left out', `${number(missing.area)} ${areaUnit(unit)}`])] : []),
  ], percent(strain) !== percent(0));
}

/** @param {Sheet} picture @param {string} unit @param {string} said @param {readonly (readonly [string, string])[]} facts @param {boolean} [isStrained] @returns {ViewContent} */
function sheet(picture, unit, said, facts, isStrained = true) {
  const { extent, maxStrain } = picture;
  const size = `${number(extent.width, 4)} × ${number(extent.height, 4)} ${unit}`;
  return { flat: pictureOf(picture, unit, `The surface laid flat, ${size}`), said: `${said} ${isStrained ? 'Colour shows where it had to be stretched or compressed' : 'Nothing of it is stretched'}.`, colours: isStrained ? { title: 'Strain: blue is compressed, red is stretched', scale: linearScale(maxStrain, signedPercent) } : undefined, about: [figures([['Sheet size', size], ...facts])] };
}

/** The picture of a sheet with a scale bar. @param {Sheet} sheet @param {string} unit @param {string} words @returns {Picture} */
function pictureOf({ width, height, pixelsPerUnit, pixels, values }, unit, words) {
  const picture = imagePicture(canvasFromImage(new ImageData(new Uint8ClampedArray(pixels.buffer), width, height)), words, (x, y) => {
    const strain = values[Math.floor(y) * width + Math.floor(x)];
    return Number.isNaN(strain) ? '' : `strain ${signedPercent(strain)}`;
  });
  return {
    ...picture,
    paint: (context, ratio) => {
      picture.paint(context, ratio);
      drawRuler(context, pixelsPerUnit * Math.min(context.canvas.width / width, context.canvas.height / height), unit, ratio);
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
  const [x, y] = [RULER_MARGIN * ratio, context.canvas.height - RULER_MARGIN * ratio];
  context.strokeStyle = context.fillStyle = style.color;
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
