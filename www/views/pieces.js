/** The view of the flat surface, cut into sheets if it would stretch in one piece. */
import { make } from '../dom.js';
import { strainInWords } from '../format.js';
import { CREASE_COLOUR, toCss, FOLD_COLOURS } from '../surface/colours.js';
import { canvasFromPixels } from '../surface/layer.js';
import { imagePicture } from '../surface/picture-view.js';
import { callWorker } from '../surface/worker-client.js';
import { suggestedSideOf, sheetFigures, sheetsInWords, cutSheets, drawingImage } from '../pattern.js';
import { figures, key } from './legend.js';
import { sheetOfHeights, strainColours } from './sheet.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {ViewContent} from '../surface/layer.js' */

/** Length of the drawing's longer side, in pixels: enough for thin lines. */
const DRAWING_SIDE_PIXELS = 2400;

/**
 * The surface laid flat: in one piece if that does not stretch it, else cut into sheets.
 * @param {Analyses} analyses
 * @param {Result} result
 * @param {import('../mesh-fit.js').Tell} tell
 * @returns {Promise<ViewContent>}
 */
export async function flat(analyses, result, tell) {
  const unrolled = await analyses.unroll(result, tell);
  const whole = () => sheetOfHeights(result.input.unit ?? 'units', unrolled);
  if (unrolled.verdict !== 'stretched' || !Number.isFinite((await analyses.patchCount(result)).count)) return whole();
  // If cutting fails, the surface is shown in one piece with its strain.
  const drawing = await cutSheets(analyses, result, { side: suggestedSideOf(result), assembly: true }, tell).catch(() => null);
  if (!drawing) return whole();
  const { width, height } = drawing;
  const strain = drawing.assembly && await callWorker('drawingStrainImage', drawing.assembly.model, { width, height, bounds: drawing.sheets.map(({ bounds }) => bounds) });
  const image = await drawingImage((made) => analyses.svg(made), drawing);
  const canvas = document.createElement('canvas');
  const scale = DRAWING_SIDE_PIXELS / Math.max(image.naturalWidth, image.naturalHeight);
  Object.assign(canvas, { width: Math.round(image.naturalWidth * scale), height: Math.round(image.naturalHeight * scale) });
  const context = canvas.getContext('2d');
  if (!context) return whole();
  context.fillStyle = '#fff';
  context.fillRect(0, 0, canvas.width, canvas.height);
  if (strain) context.drawImage(canvasFromPixels(strain, strain.pixels), 0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  const isFolded = drawing.sheets.some(({ folds }) => folds.length > 0);
  return {
    flat: imagePicture(canvas, sheetsInWords(drawing), strain ? ((x, y) =>
      strainInWords(strain.values[Math.floor((y / canvas.height) * strain.height) * strain.width + Math.floor((x / canvas.width) * strain.width)])) : undefined),
    said: `In one piece it would stretch; cut along its creases it lies flat. ${sheetsInWords(drawing)}`,
    colours: strain ? strainColours(strain.maxStrain) : undefined,
    about: [
      ...(isFolded ? [make('p', 'keys', key(toCss(CREASE_COLOUR), 'cut'), key(toCss(FOLD_COLOURS.mountain), 'folded to a ridge'), key(toCss(FOLD_COLOURS.valley), 'folded to a valley'))] : []),
      figures(sheetFigures(drawing)),
    ],
  };
}
