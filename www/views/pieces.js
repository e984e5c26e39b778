/** The view of the flat surface, cut into sheets if it would stretch in one piece. */
import { element, make } from '../dom.js';
import { CREASE_COLOUR, toCss, FOLD_COLOURS } from '../surface/colours.js';
import { imagePicture } from '../surface/picture-view.js';
import { longerSide, suggestedSide, sheetFigures, sheetsInWords, cutSheets, drawingImage } from '../pattern.js';
import { figures, key } from './legend.js';
import { sheetOfHeights } from './sheet.js';

/**
 * The surface laid flat: in one piece if that does not stretch it, else cut into sheets.
 * @param {Api} api
 * @param {Analyses} analyses
 * @param {Result} result
 * @param {Tell} tell
 * @returns {Promise<ViewContent>}
 */
export async function flat(api, analyses, result, tell) {
  const unrolled = await analyses.unroll(result, tell);
  const whole = () => sheetOfHeights(result.input.unit ?? 'units', unrolled);
  if (unrolled.verdict !== 'stretched' || !Number.isFinite((await analyses.patchCount(result)).count)) return whole();
  // If cutting fails, the surface is shown in one piece with its strain.
  const drawing = await cutSheets(analyses, result, { side: suggestedSide(longerSide(result), result.input.unit) }, tell).catch(() => null);
  if (!drawing) return whole();
  const picture = imagePicture(await drawingImage(api, drawing, element('space', HTMLElement)), sheetsInWords(drawing));
  const isFolded = drawing.sheets.some(({ folds }) => folds.length > 0);
  return {
    flat: picture,
    said: `In one piece it would stretch; cut along its creases it lies flat. ${sheetsInWords(drawing)}`,
    about: [
      ...(isFolded ? [make('p', 'keys', key(toCss(CREASE_COLOUR), 'cut'), key(toCss(FOLD_COLOURS.mountain), 'folded to a ridge'), key(toCss(FOLD_COLOURS.valley), 'folded to a valley'))] : []),
      figures(sheetFigures(drawing)),
    ],
  };
}
