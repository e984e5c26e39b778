/** A surface as sheets to cut out: how large, and what they are like in words. */
import { count, number, numberAgainst, percent } from './format.js';

/** @import {Analyses} from './analyses.js' */
/** @import {Result} from './session.js' */
/** @typedef {import('../pkg/types.js').Drawing} Drawing */

/** @typedef {{ side: number } & Pick<import('../pkg/types.js').PatternOptions, 'tabs' | 'thickness' | 'innerRadius' | 'kFactor' | 'assembly'>} Cut all in millimetres; `side`: the longer one */

/** Strain that a sheet may have, and what is tried where no cut makes it so flat. */
const STRAINS = [0.01, 0.1];
/** Millimetres along the longer side, of what has no unit or could not be held. */
const HANDY = 180;

/** Of the result's plan. @param {Result} result */
export function longerSide({ input: { width, height, pixelSize } }) {
  return Math.max(width, height) * pixelSize;
}

/**
 * How long the longer side is to be in millimetres, where nobody has said: in true size, if that can be held.
 * @param {Result} result
 */
export function handySide(result) {
  return handyLength(longerSide(result), result.input.unit);
}

/** Millimetres in the units that a file may be in. */
export const MILLIMETRES = { mm: 1, cm: 10, m: 1000, inch: 25.4 };
/** Bounds of a longer side in millimetres that is taken in true size. */
const [MIN_HANDY, MAX_HANDY] = [30, 2000];
/** Bounds of a longer side in millimetres by which the unit of a file is guessed: what people cut at home. */
const [MIN_LIKELY, MAX_LIKELY] = [80, 1000];

/** @typedef {keyof typeof MILLIMETRES} LengthUnit */

/**
 * A longer side in millimetres: in true size, if that can be held.
 * @param {number} length
 * @param {string | null} [unit]
 */
export function handyLength(length, unit) {
  const side = length * (MILLIMETRES[/** @type {LengthUnit} */ (unit ?? '')] ?? NaN);
  return side >= MIN_HANDY && side <= MAX_HANDY ? Number(side.toPrecision(4)) : HANDY;
}

/**
 * The unit in which a length of a file that does not say it can be held: millimetres, if possible.
 * @param {number} length
 * @returns {LengthUnit | 'none'}
 */
export function likelyUnit(length) {
  const units = /** @type {LengthUnit[]} */ (['mm', 'cm', 'm']);
  return units.find((unit) => length * MILLIMETRES[unit] >= MIN_LIKELY && length * MILLIMETRES[unit] <= MAX_LIKELY) ?? 'none';
}

/** The unit of an input, for what is cut of it. @param {{ unit?: string, kind?: string }} input @returns {LengthUnit | 'none' | 'unknown'} */
export function unitOf({ unit, kind }) {
  if (kind === undefined) return 'none';
  return unit !== undefined && Object.hasOwn(MILLIMETRES, unit) ? /** @type {LengthUnit} */ (unit) : 'unknown';
}

/**
 * @param {Analyses} analyses
 * @param {Result} result
 * @param {Cut} cut
 * @returns {Promise<Drawing>} with as little strain as it can be had with
 */
export async function piecesOf(analyses, result, { side, ...options }) {
  const scale = side / longerSide(result);
  const { count: pieces } = await analyses.pieces(result);
  // Of what is creased all over no sheet is flat: to look for them takes a minute.
  for (const maxStrain of Number.isFinite(pieces) ? STRAINS : STRAINS.slice(-1)) {
    try {
      return await analyses.pattern(result, { scale, ...options, maxStrain });
    } catch (error) {
      const more = maxStrain !== STRAINS.at(-1) && error instanceof Error && 'code' in error && error.code === 'NOT_FLAT';
      if (!more) throw error;
    }
  }
  throw new Error('no cut lays it flat');
}

/** With how much strain it was to be had. @param {Drawing} drawing */
export function strainOf({ summary: { strain } }) {
  return STRAINS.find((most) => strain <= most) ?? STRAINS[STRAINS.length - 1];
}

/** @param {Drawing} drawing */
export function piecesInWords({ summary: { sheets, seams, folds, slits, strain } }) {
  const cut = seams === 0 ? '' : `, to be joined along ${seams === 1 ? 'one cut' : `${count(seams)} cuts`}`;
  const fold = folds === 0 ? '' : `, with ${folds === 1 ? 'one fold' : `${count(folds)} folds`}`;
  const slit = slits === 0 ? '' : ` ${slits === 1 ? 'One slit lets' : `${count(slits)} slits let`} ${sheets === 1 ? 'it' : 'them'} lie flat.`;
  const stretch = strain > STRAINS[0] ? ` Paper has to give by ${percent(strain)}: use something that stretches, or a smaller λ.` : '';
  return `${sheets === 1 ? 'One sheet' : `${count(sheets)} sheets`}${fold}${cut}.${slit}${stretch}`;
}

/**
 * @param {Drawing} drawing
 * @returns {[string, string][]}
 */
export function piecesInFigures({ width, height, summary: { cutLength, mountainLength, valleyLength, area, strain, mismatch, worstAngle, a4, letter } }) {
  const off = worstAngle && Math.abs(worstAngle.flat - worstAngle.surface);
  return [
    ['Drawing', `${number(width, 3)} × ${number(height, 3)} mm`],
    ['Pages', `${count(a4)} of A4, ${count(letter)} of Letter`],
    ['To cut', `${number(cutLength / 1000)} m`],
    ['To fold', `${number((mountainLength + valleyLength) / 1000)} m`],
    ['Area', `${number(area / 100)} cm²`],
    ['Largest strain', percent(strain)],
    ['Length mismatch of joints', percent(mismatch)],
    ...(off === undefined ? [] : [/** @type {[string, string]} */ (['Angle mismatch of joints', `${numberAgainst(off, 360)}°`])]),
  ];
}

/**
 * A drawing to be looked at, as the SVG that is saved.
 * @param {(drawing: Drawing) => Promise<Uint8Array<ArrayBuffer>>} svg
 * @param {Drawing} drawing
 */
export async function previewOf(svg, drawing) {
  const image = await imageOf(await svg(drawing));
  image.alt = piecesInWords(drawing);
  return image;
}

/** How sheets are put together, as a GLB file. @param {Drawing} drawing */
export function modelOf(drawing) {
  return assemblyOf(drawing).model;
}

/**
 * The finished piece at an angle, with the numbers of sheets and the letters of joints: a PNG file on white.
 * @param {Drawing} drawing
 * @returns {Promise<Uint8Array<ArrayBuffer>>}
 */
export async function numberedPicture(drawing) {
  const { model, picture } = assemblyOf(drawing);
  const { builtPicture } = await import('./surface/built-picture.js');
  const png = await builtPicture(model, new TextDecoder().decode(picture)).convertToBlob({ type: 'image/png' });
  return new Uint8Array(await png.arrayBuffer());
}

/** @param {Drawing} drawing */
function assemblyOf({ assembly }) {
  if (!assembly) throw new Error('nothing is said of how it is put together');
  return assembly;
}

/** @param {Uint8Array<ArrayBuffer>} svg */
async function imageOf(svg) {
  const image = new Image();
  const address = URL.createObjectURL(new Blob([svg], { type: 'image/svg+xml' }));
  try {
    image.src = address;
    await image.decode();
  } finally {
    URL.revokeObjectURL(address);
  }
  return image;
}
