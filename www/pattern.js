/** Sheets to cut out of a surface: their size, options, figures and pictures. */
import { count, number, numberAgainst, percent } from './format.js';

/**
 * Options of a pattern, with lengths in millimetres; `side` is the longer side of the finished surface.
 * @typedef {{ side: number } & Pick<PatternOptions, 'tabs' | 'kerf' | 'thickness' | 'innerRadius' | 'kFactor' | 'assembly'>
 *   & Pick<import('../pkg/types.js').MeshPatternOptions, 'cut' | 'join' | 'stock' | 'faces'>} CutOptions
 */

/** The options of a pattern without those of flat faces, which alone are cut anywhere. @template {Partial<CutOptions>} T @param {T} options */
export const withoutFaces = ({ cut, join, stock, ...others }) => others;

/** What tells a model from others, to keep what was chosen for it. @param {Pick<Input, 'name' | 'width' | 'height' | 'sampling'>} input */
export const modelOf = ({ name, width, height, sampling }) => `${name} ${sampling ? sampling.mesh.positions.length : width * height}`;

/** Maximum strain of paper. */
const MAX_PAPER_STRAIN = 0.01;
/** Length mismatch of joints above which their sides are seen not to fit, as a share. */
const MAX_FITTING_MISMATCH = 0.02;
/** Longer side of a finished surface without a unit, or that cannot have its true size, in millimetres. */
const DEFAULT_FINISHED_SIDE_MM = 180;

/** Width of the lines of a drawing that is shown, and wanted size of its texts, in CSS pixels; how many of these find room across a piece, and how many titles across the height of a sheet. */
const [LINE_PIXELS, TEXT_PIXELS, TEXTS_ACROSS, TITLES_HIGH] = [1.2, 12, 5, 3];

/** Longer side of a result seen from above, in the unit of its input. @param {Result} result */
export const longerSide = ({ input: { width, height, pixelSize } }) => Math.max(width, height) * pixelSize;

/** Millimetres in a metre, in an inch and in the other units of length. */
export const MM_PER_UNIT = { mm: 1, cm: 10, m: 1000, inch: 25.4 };
/** Bounds of the longer side of a finished surface, in millimetres. */
export const [MIN_SIDE_MM, MAX_SIDE_MM] = [10, 5000];
/** @typedef {keyof typeof MM_PER_UNIT} LengthUnit */

/** The longer side of a surface in millimetres; NaN if its unit is not known. @param {number} length longer side in its unit @param {string | null} [unit] */
export const trueSide = (length, unit) => Number((length * (MM_PER_UNIT[/** @type {LengthUnit} */ (unit ?? '')] ?? NaN)).toPrecision(4));

/**
 * The suggested longer side of a finished surface, in millimetres: its true size, if it can have that.
 * @param {number} length longer side in its unit
 * @param {string | null} [unit]
 */
export function suggestedSide(length, unit) {
  const side = trueSide(length, unit);
  return side >= MIN_SIDE_MM && side <= MAX_SIDE_MM ? side : DEFAULT_FINISHED_SIDE_MM;
}

/** The unit of an input: `none` for an example, `unknown` for a file whose unit neither it nor its size tells. @param {{ unit?: string, kind?: string }} input @returns {LengthUnit | 'none' | 'unknown'} */
export function lengthUnitOf({ unit, kind }) {
  if (kind === undefined) return 'none';
  return unit !== undefined && Object.hasOwn(MM_PER_UNIT, unit) ? /** @type {LengthUnit} */ (unit) : 'unknown';
}

/** Cuts a result into sheets. @param {Analyses} analyses @param {Result} result @param {CutOptions} options @param {Tell} tell */
export function cutSheets(analyses, result, { side, ...given }, tell) {
  return analyses.pattern(result, { scale: side / longerSide(result), ...(given.faces === undefined ? withoutFaces(given) : given) }, tell);
}

/** The number of sheets, folds, seams and slits in sentences, and what is missing. @param {Drawing} drawing */
export const sheetsInWords = (drawing) => [countsInWords(drawing), ...faultsInWords(drawing)].join(' ');

/** Says in one or two sentences how many sheets, folds and cuts a drawing has. @param {Drawing} drawing @param {boolean} [fitsPages] whether its sheets were cut so that each fits a page */
export function countsInWords({ summary: { sheets, seams, folds, slits, simplified } }, fitsPages = false) {
  const cut = seams === 0 ? '' : `, to be joined along ${seams === 1 ? 'one cut' : `${count(seams)} cuts`}`;
  const fold = folds === 0 ? '' : `, with ${folds === 1 ? 'one fold' : `${count(folds)} folds`}`;
  const slit = slits === 0 ? '' : ` ${slits === 1 ? 'One cut' : `${count(slits)} cuts`}, then ${sheets === 1 ? 'it lies' : 'they lie'} flat.`;
  const faces = simplified === undefined ? '' : ` Built of ${count(simplified.faces)} flat faces, ${number(simplified.distance, 2)} mm from the shape.`;
  return `${sheets === 1 ? 'One sheet' : `${count(sheets)} sheets${fitsPages ? ' that each fit a page' : ''}`}${fold}${cut}.${slit}${faces}`;
}

/** Says in sentences what is wrong with the sheets of a drawing, and what they lack. @param {Drawing} drawing */
export function faultsInWords({ summary: { strain, mismatch, missing, untabbed, unlettered } }) {
  const stretch = strain > MAX_PAPER_STRAIN ? `Paper has to give by ${percent(strain)}: use something that stretches, or a smaller λ.` : '';
  const misfit = mismatch > MAX_FITTING_MISMATCH ? `Joints will not fit: the two sides of one differ in length by ${percent(mismatch)}.` : '';
  const lost = (missing?.area ?? 0) + (missing?.stepArea ?? 0);
  const without = lost > 0 ? `${number(lost / 100, 2)} cm² of the surface, at ragged borders or steps, are on no sheet.` : '';
  const bare = untabbed > 0 ? `${untabbed === 1 ? 'One cut has' : `${count(untabbed)} cuts have`} no room for a tab.` : '';
  const nameless = unlettered > 0 ? `${unlettered === 1 ? 'One cut has' : `${count(unlettered)} cuts have`} no room for a letter.` : '';
  return [misfit, stretch, without, bare, nameless].filter(Boolean);
}

/** Figures of a drawing: names and values. @param {Drawing} drawing @returns {[string, string][]} */
export function sheetFigures({ width, height, summary: { cutLength, mountainLength, valleyLength, area, strain, mismatch, worstAngle, a4, letter } }) {
  const angleMismatch = worstAngle && Math.abs(worstAngle.flat - worstAngle.surface);
  return [
    ['Drawing', `${number(width, 3)} × ${number(height, 3)} mm`],
    ['Pages', `${count(a4)} of A4, ${count(letter)} of Letter`],
    ['To cut', `${number(cutLength / 1000)} m`],
    ['To fold', `${number((mountainLength + valleyLength) / 1000)} m`],
    ['Area', `${number(area / 100)} cm²`],
    ['Largest strain', percent(strain)],
    ['Length mismatch of joints', percent(mismatch)],
    ...(angleMismatch === undefined ? [] : [/** @type {[string, string]} */ (['Angle mismatch of joints', `${numberAgainst(angleMismatch, 360)}°`])]),
  ];
}

/**
 * Displays a drawing as an image element, made from the SVG file.
 * @param {Api} api
 * @param {Drawing} drawing
 * @param {{ clientWidth: number, clientHeight: number }} frame into which it fits
 * @param {number} [zoom] how much larger it is shown
 */
export async function drawingImage(api, drawing, frame, zoom = 1) {
  const image = new Image();
  const { pages: { part: [wide, high], pages } = { part: [0, 0], pages: [] } } = drawing;
  image.style.setProperty('--aspect', String(drawing.width / drawing.height));
  // On paper lines are a fifth of a millimetre wide and letters 3 mm high: too small to be seen where a large drawing is shown small.
  const pixel = Math.max(drawing.width / frame.clientWidth, drawing.height / frame.clientHeight) / zoom;
  const width = LINE_PIXELS * pixel;
  const room = Math.sqrt(drawing.summary.area / drawing.sheets.flatMap(({ patches }) => patches).length) / TEXTS_ACROSS;
  const svg = new TextDecoder().decode(await api.writeSvg(drawing)).replace(/(?<=<svg[^>]*>)/, `<rect width="100%" height="100%" fill="#fff"/>${pages.map(({ corner: [x, y] }) =>
    `<rect x="${x}" y="${drawing.height - y - high}" width="${wide}" height="${high}" fill="none" stroke="#ccd3d8" stroke-width="0"/>`).join('')}`).replace(/stroke-width="[^"]*"/g, `stroke-width="${width}"`)
    .replace(/stroke-dasharray="([^"]*)"/g, (_, dashes) => `stroke-dasharray="${dashes.split(' ').map((/** @type {string} */ dash) => 3 * Number(dash) * width).join(' ')}"`)
    .replace(/id="label"/, `$& paint-order="stroke" stroke="#fff" stroke-width="${3 * width}"`)
    .replace(/class="([^"]*)" data-sheet="([^"]*)" dy="([^"]*)" font-size="([^"]*)"(?=[^>]* y="([^"]*)")/g, (_, kind, sheet, dy, given, y) => {
      // Titles stand above their sheets, and grow upwards: small above small ones, or they would lie on others or be cut off.
      const isTitle = kind === 'sheet';
      const [[left, bottom], [right, top]] = drawing.sheets[sheet - 1].bounds;
      const size = Math.max(given, Math.min(isTitle ? Math.min((right - left) / TEXTS_ACROSS, (top - bottom) / TITLES_HIGH) : room, TEXT_PIXELS * pixel));
      return `dy="${isTitle ? Math.max(dy, 0.75 * size - y) : 0.35 * size}" font-size="${size}"`;
    });
  const address = URL.createObjectURL(new Blob([svg], { type: 'image/svg+xml' }));
  try {
    image.src = address;
    await image.decode();
  } finally {
    URL.revokeObjectURL(address);
  }
  image.alt = sheetsInWords(drawing);
  return image;
}

/** How the sheets of a drawing are put together. @param {Drawing} drawing */
export function assemblyOf({ assembly }) {
  if (!assembly) throw new Error('nothing is said of how it is put together');
  return assembly;
}

/** What is joined in each step of the assembly, by the sheets' numbers and the letters of their sides. @param {Drawing} drawing */
export function buildSteps(drawing) {
  return assemblyOf(drawing).steps.map(({ sheet, joints }) => {
    const ways = [...new Set(joints.map(({ to }) => to))].map((to) => {
      const sides = joints.filter((joint) => joint.to === to).map(({ name }) => name || '–').join(', ');
      return to === sheet ? `its own sides ${sides}` : `${sides} to sheet ${to + 1}`;
    });
    return `Sheet ${sheet + 1}${ways.length > 0 ? `: join ${ways.join('; ')}` : ''}.`;
  });
}
