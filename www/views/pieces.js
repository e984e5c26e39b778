/** The view of the flat surface, cut into sheets if it would stretch in one piece. */
import { make } from '../dom.js';
import { number, strainInWords } from '../format.js';
import { CREASE_COLOUR, toCss, FOLD_COLOURS } from '../surface/colours.js';
import { canvasFromPixels } from '../surface/layer.js';
import { imagePicture } from '../surface/picture-view.js';
import { callWorker } from '../surface/worker-client.js';
import { suggestedSideOf, sheetFigures, sheetsInWords, cutSheets, drawingImage } from '../pattern.js';
import { figures, key } from './legend.js';
import { sheet, strainColours } from './sheet.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {ViewContent} from './view-content.js' */
/** @typedef {import('../../pkg/types.js').Drawing} Drawing */

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
  const { verdict } = await analyses.unroll(result, tell);
  const whole = () => sheet(analyses, result, tell);
  if (verdict !== 'stretched' || !Number.isFinite((await analyses.patchCount(result)).count)) return whole();
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
    after: imagePicture(canvas, 'Laid flat, in pieces', sheetsInWords(drawing), (x, y) => {
      const [across, down] = [x / canvas.width, y / canvas.height];
      const value = strain?.values[Math.floor(down * strain.height) * strain.width + Math.floor(across * strain.width)] ?? NaN;
      const sheet = sheetAt(drawing, across * width, (1 - down) * height);
      return sheet && [sheet, strainInWords(value)].filter(Boolean).join(' · ');
    }),
    said: `In one piece it would stretch; cut along its creases it lies flat. ${sheetsInWords(drawing)}`,
    colours: strain ? strainColours(strain.maxStrain) : undefined,
    about: [
      ...(isFolded ? [make('p', 'keys', key(toCss(CREASE_COLOUR), 'cut'), key(toCss(FOLD_COLOURS.mountain), 'folded to a ridge'), key(toCss(FOLD_COLOURS.valley), 'folded to a valley'))] : []),
      figures(sheetFigures(drawing)),
    ],
  };
}

/**
 * The name and size of the sheet at a place of the drawing; empty beside the sheets.
 * @param {Drawing} drawing
 * @param {number} x
 * @param {number} y
 */
function sheetAt({ sheets }, x, y) {
  // Even-odd rule: outlines and holes are closed lines.
  const found = sheets.find(({ cuts }) => cuts.reduce((sum, line) => sum + crossings(line, x, y), 0) % 2 === 1);
  if (!found) return '';
  const { name, bounds: [low, high] } = found;
  return `${name}, ${number(high[0] - low[0], 3)} × ${number(high[1] - low[1], 3)} mm`;
}

/** Number of crossings of a closed line with the ray to the right of a place. @param {[number, number][]} line @param {number} x @param {number} y */
function crossings(line, x, y) {
  return line.filter(([ax, ay], i) => {
    const [bx, by] = line[(i + 1) % line.length];
    return ay > y !== by > y && ax + ((y - ay) / (by - ay)) * (bx - ax) > x;
  }).length;
}
