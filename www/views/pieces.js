/** What cannot be laid flat whole, as the sheets that it can be cut into. */
import { make } from '../dom.js';
import { number, signed, strainInWords } from '../format.js';
import { CREASE, css, FOLDS, linear } from '../surface/colours.js';
import { canvasOf } from '../surface/layer.js';
import { imagePicture } from '../surface/picture.js';
import { work } from '../surface/work.js';
import { handySide, piecesInFigures, piecesInWords, piecesOf, previewOf, strainOf } from '../pattern.js';
import { colourBar, figures, key, say } from './legend.js';
import { sheet } from './sheet.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Shown} from './shown.js' */
/** @typedef {import('../../pkg/types.js').Drawing} Drawing */

/** Pixels along the drawing's longer side, so that lines stay lines. */
const FINE = 2400;

/**
 * The surface laid flat: whole where that goes without stretch, or else in pieces.
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<Shown>}
 */
export async function flat(analyses, result) {
  const { verdict, picture: { most } } = await analyses.unroll(result);
  const whole = () => sheet(analyses, result);
  if (verdict !== 'stretched' || !Number.isFinite((await analyses.pieces(result)).count)) return whole();
  // Where no cut helps, the whole with its strain is what there is to see.
  const drawing = await piecesOf(analyses, result, { side: handySide(result), assembly: true }).catch(() => null);
  if (!drawing) return whole();
  const { width, height } = drawing;
  const strain = drawing.assembly && await work('drawnStrains', drawing.assembly.model, { width, height, bounds: drawing.sheets.map(({ bounds }) => bounds) });
  const image = await previewOf((made) => analyses.svg(made), drawing);
  const canvas = document.createElement('canvas');
  const scale = FINE / Math.max(image.naturalWidth, image.naturalHeight);
  Object.assign(canvas, { width: Math.round(image.naturalWidth * scale), height: Math.round(image.naturalHeight * scale) });
  const context = canvas.getContext('2d');
  if (!context) return whole();
  context.fillStyle = '#fff';
  context.fillRect(0, 0, canvas.width, canvas.height);
  if (strain) context.drawImage(canvasOf(strain, strain.pixels), 0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  // Creases are numbered alike only where they were found on the same lattice, and patches left whole.
  const known = analyses.cutsAsItIs(result) && drawing.summary.slits === 0;
  const folds = new Map(known ? drawing.sheets.flatMap(({ folds }) => folds.map(({ crease, direction }) => /** @type {const} */ ([crease, direction]))) : []);
  /** @param {number} crease */
  const look = (crease) => {
    const direction = folds.get(crease);
    return direction ? { colour: FOLDS[direction], width: 3 } : { colour: CREASE, width: 1.5 };
  };
  // Where a coarser lattice cannot be cut like this one, it goes whole.
  const unfolding = await analyses.unfoldInPieces(result, strainOf(drawing), most).then(
    (apart) => ({ ...apart, look: () => ({ colour: CREASE, width: 1.5 }) }),
    async () => ({ ...await analyses.unfold(result, most), look }),
  );
  return {
    unfolding,
    after: imagePicture(canvas, 'Laid flat, in pieces', piecesInWords(drawing), (x, y) => {
      const [across, down] = [x / canvas.width, y / canvas.height];
      const value = strain?.values[Math.floor(down * strain.height) * strain.width + Math.floor(across * strain.width)] ?? NaN;
      const sheet = sheetAt(drawing, across * width, (1 - down) * height);
      return sheet && [sheet, strainInWords(value)].filter(Boolean).join(' · ');
    }),
    about: [
      say(`In one piece it would stretch; cut along its creases it lies flat. ${piecesInWords(drawing)}`),
      ...(folds.size > 0 ? [make('p', 'keys', key(css(CREASE), 'cut'), key(css(FOLDS.mountain), 'folded to a ridge'), key(css(FOLDS.valley), 'folded to a valley'))] : []),
      ...(strain ? [colourBar('Strain: blue is compressed, red is stretched', linear(strain.most, signed))] : []),
      figures(piecesInFigures(drawing)),
    ],
  };
}

/**
 * Which sheet is at a place of the drawing, and how large it is.
 * @param {Drawing} drawing
 * @param {number} x
 * @param {number} y
 */
function sheetAt({ sheets }, x, y) {
  // Holes are closed lines, too: a place on the sheet has an odd number of them to its right.
  const found = sheets.find(({ cuts }) => cuts.reduce((sum, line) => sum + crossings(line, x, y), 0) % 2 === 1);
  if (!found) return '';
  const { name, bounds: [low, high] } = found;
  return `${name}, ${number(high[0] - low[0], 3)} × ${number(high[1] - low[1], 3)} mm`;
}

/** How often a closed line crosses the ray to the right of a place. @param {[number, number][]} line @param {number} x @param {number} y */
function crossings(line, x, y) {
  return line.filter(([ax, ay], i) => {
    const [bx, by] = line[(i + 1) % line.length];
    return ay > y !== by > y && ax + ((y - ay) / (by - ay)) * (bx - ax) > x;
  }).length;
}
