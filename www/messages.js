/** Sentences of the page: results, errors, hints and labels. */
import { count, countOf, number, percent, percentAtMost, seconds, shortLambda } from './format.js';
import { plainMessage } from './error-messages.js';
import { sidesOf } from './surface/triangles.js';

/** @typedef {import('../pkg/types.js').Assumption} Assumption */
/** @import {Report, StopReason, Surface, Verdict} from '../pkg/types.js' */

/** Why a solve stopped. @type {Record<StopReason, string>} */
export const STOP_REASONS = {
  gap: 'the requested gap was proven',
  residuals: 'the residuals were small enough (the paper’s rule)',
  rounding: 'the optimum was reached, up to rounding',
  maxIterations: 'the maximum number of iterations was reached',
  cancelled: 'cancelled; this is the best surface so far',
  noNoise: 'there is no noise that is worth removing',
  diverged: 'the iterations diverged; this is the best surface before',
};

/** Names of the views. */
export const VIEW_LABELS = { shaded: 'Shaded', photo: 'Photo', patches: 'Patches', sheet: 'Laid flat', gaussian: 'Curvature K', kappa2: 'Curvature κ₂', rulings: 'Rulings' };
/** What each view shows, in one sentence. @type {Record<string, string>} */
export const VIEW_WORDS = {
  shaded: 'Input and result stand in the same light. Smooth pieces shine evenly, creases are sharp lines.',
  gaussian: 'Colour shows how much a place bends both ways at once. Places without colour can be laid flat.',
  kappa2: 'Colour shows the smaller principal curvature. It is 0 where the surface bends one way only.',
  rulings: 'Rulings are straight lines in the surface. Paper bends across them, never along them.',
  patches: 'Each smooth piece has its own colour; black lines are the creases between them.',
  sheet: 'This is the surface laid flat, to scale.',
  photo: 'Both surfaces show the photo, or the scan’s own colours.',
};

/** What a task does, as its progress says. */
export const TASK_WORDS = {
  reading: 'Reading the file',
  making: 'Making the example',
  sampling: 'Looking at it from there',
  building: 'Building the 3D surface',
  view: 'Preparing this view',
  unrolling: 'Laying it flat',
  cutting: 'Cutting the sheets',
  solving: 'Solving',
  flattening: 'Flattening the page',
  writing: 'Writing the file',
};
/** @typedef {keyof typeof TASK_WORDS} Task */

/** Messages about files that were dropped on the wrong part of the page, or that cannot be read. */
export const FILE_WORDS = {
  noHeights: (/** @type {string} */ name) => `“${name}” has no heights. Open a photo, a model or a scan. If it is a camera, open it together with its depths.`,
  takenForPage: 'Taken for a photo of a page.',
  heightsInstead: 'Heights instead?',
  takenForHeights: 'Taken for heights.',
  openAsPage: 'Flatten it as a page',
  /** @param {readonly { name: string }[]} files @param {'photo' | 'mesh' | 'depths'} beside what they came with */
  leftOut: (files, beside) => `Left out: ${files.map(({ name }) => `“${name}”`).join(', ')}. ${{ photo: 'With photos of pages go only photos and PDFs.', mesh: 'With a model go only the textures and materials that it names.', depths: 'With depths go one photo and the camera’s file.' }[beside]}`,
  openInstead: (/** @type {readonly { name: string }[]} */ files) => (files.length === 1 ? `Open “${files[0].name}” instead` : 'Open these instead'),
};

/** Labels and messages about several scans that are cleaned in one go. */
export const BATCH_WORDS = {
  offer: (/** @type {number} */ n) => `Clean ${n === 2 ? 'both' : `all ${count(n)}`} into one ZIP…`,
  title: (/** @type {number} */ n) => `${count(n)} scans in one ZIP`,
  /** @param {number} n @param {number} all @param {string} name */
  solving: (n, all, name) => `Cleaning ${count(n)} of ${count(all)}, “${name}”…`,
  depths: 'it has depths from a camera: open it alone',
  without: (/** @type {readonly string[]} */ problems) => (problems.length > 0 ? `Without ${problems.join('; ')}.` : ''),
};

/** Messages about depths from a camera. */
export const DEPTH_WORDS = {
  /** @param {string} angle @param {number} scale */
  assumed: (angle, scale) => `${angle}° field of view, depths in ${scale === 1 ? 'metres' : scale === 0.001 ? 'millimetres' : `steps of ${number(scale)} m`}`,
  disparities: ', not disparities as the name says (a depth is focal length × baseline ÷ disparity)',
  maybe: 'These may be depths from a camera. If so, build the 3D surface below. Now the page takes them for heights.',
  failed: 'The 3D surface could not be built',
  /** @param {import('../pkg/types.js').PhotoCamera} camera */
  camera: ({ fx, fy, cx, cy, k1, k2, k3, p1, p2 }) => `Focal lengths ${number(fx, 5)} and ${number(fy, 5)}, centre ${number(cx, 5)}, ${number(cy, 5)}${[k1, k2, k3, p1, p2].some(Boolean) ? ', and a lens that distorts' : ''}.`,
};

/** What a reader has assumed of a file, as a sentence; empty if nothing. @param {readonly Assumption[]} [assumptions] */
export function assumedInWords(assumptions = []) {
  const words = assumptions.map((one) => one.words.replace(/(?<![.\d])\d{5,}(?![.\d])/g, (digits) => count(Number(digits)))
    .replace(/\d+\.\d{8,}/g, (digits) => number(Number(digits), 4)).replace(/`([^`]*)`/g, '“$1”'));
  return words.length > 0 ? `Assumed: ${words.join('; ')}.` : '';
}

/** Messages about guessed metadata of a file. */
export const GUESS_WORDS = {
  few: 'Few pixels have a height, and the surface exists only there. The command “design” makes a surface through single heights.',
  coarse: (/** @type {number} */ step) => `The image is large, so one vertex stands for ${step} × ${step} pixels (“Lattice” under “More options” changes that).`,
};

/** The energies: their names and what they do. @type {Record<Energy, { name: string, about: string }>} */
export const ENERGIES = {
  nuclear: { name: 'nuclear norm of the Hessian', about: 'The paper’s energy, nuclear norms of the Hessians: each piece bends one way only, and noisy bends become facets.' },
  huber: { name: 'smooth bends, sharp creases', about: 'Gentle bends count by their square, creases by their size: bends stay round and creases sharp. The proof is for the last pass over the creases.' },
  frobenius: { name: 'Frobenius norm', about: 'Frobenius norms of the Hessians: smooth where it should crease, for comparison.' },
  squaredNuclear: { name: 'squared nuclear norm', about: 'Squared nuclear norms of the Hessians: smooth where it should crease, for comparison.' },
  secondFormOfInput: { name: 'second form, slopes of the input', about: 'Nuclear norms of the second fundamental form (exact curvature), with the slopes of the input.' },
  secondForm: { name: 'second form, its own slopes', about: 'Nuclear norms of the second fundamental form (exact curvature), with the surface’s own slopes. The proof is for the last slopes.' },
};

/** Why a result cannot be copied as a command, and why not as code. */
export const REPRODUCE_WORDS = [
  'There is no command for it: commands read heights from a file, not examples, depths, or meshes as they are seen here.',
  'There is no code for it: code reads heights from a file, or makes an example, not depths, or meshes as they are seen here.',
];

/** Verdicts on an unrolled surface. @type {Record<Verdict, string>} */
export const VERDICTS = {
  flat: 'The surface was flat already.',
  unrolled: 'Laid flat: lengths on the sheet are those on the surface.',
  stretched: 'The surface cannot be laid flat without stretch or overlap: see the figures.',
  doubtful: 'The flat sheet may be wrong: see the figures.',
};

/** Messages about the file of an address. */
export const ADDRESS_WORDS = {
  lost: 'This browser has not kept the file of this address. Open the file again.',
  withoutFile: 'Copied, without the file',
  withFile: 'Copied, with the file',
  brokenLink: 'This link is not whole: copy all of it.',
  unkept: 'This browser could not keep the file (it is too large, or this is a private window). Open the file again.',
};

/** Figures below each of the five pictures with different λ. */
export const STRIP_WORDS = {
  /** @param {number} pieces infinite if they cannot be told apart @param {number} distance distance from the input, as a share of the width */
  figures: (pieces, distance) => `${Number.isFinite(pieces) ? `${countOf(pieces, 'piece')} · ` : ''}${percent(distance)} from the input`,
};

/** Messages about the fit of a whole mesh. */
export const MESH_FIT_WORDS = {
  kept: 'Cancelled. You see the surface from before.',
  solving: 'Solving the whole mesh…',
  solved: 'Done: the whole mesh.',
  collapsed: (/** @type {string} */ share) => `The shape is lost: ${share} of its area is left. Take a larger λ.`,
  unsolved: 'The mesh cannot be solved as a whole.',
  hidden: (/** @type {string} */ share) => `From this side ${share} of the surface is hidden. “Whole mesh” solves all of it.`,
  noNoise: 'The mesh has no noise that is worth removing, and is left as it is.',
  flatFaces: 'No colour: all faces are flat, so that the surface bends at edges and corners only.',
  maxIterations: 'The solve stopped at the maximum number of iterations.',
  diverged: 'The iterations diverged. You see the best surface before.',
  repaired: (/** @type {number} */ n) => `${countOf(n, 'triangle was', 'triangles were')} repaired first: wrong side, no area, or double.`,
  branched: (/** @type {number} */ n) => `${countOf(n, 'edge has', 'edges have')} three triangles or more, and ${n === 1 ? 'is a border' : 'are borders'} of each.`,
  /** @param {number} n @param {string} place */
  entangled: (n, place) => `${countOf(n, 'triangle is', 'triangles are')} folded over or cross others, the first near (${place}). Repair the mesh there.`,
  flipped: (/** @type {number} */ n) => `${countOf(n, 'triangle')} of the result ${n === 1 ? 'is' : 'are'} folded over.`,
  /** @param {number} passes @param {string} gap */
  proof: (passes, gap) => `${passes === 1 ? 'The step' : `The last of ${count(passes)} steps`} is proven within ${gap} of its optimum.`,
};

/** Labels and messages about sheets to cut out. */
export const SHEET_WORDS = {
  unit: (/** @type {string} */ unit) => (({ mm: 'millimetres', cm: 'centimetres', m: 'metres', inch: 'inches' })[unit] ?? unit),
  figures: 'Figures, and how to build it',
  title: 'Cut-out sheets',
  /** @param {string} side @param {number} pages @param {number} joints @param {string} [smallest] of several sheets */
  headline: (side, pages, joints, smallest) =>
    `Cut-out sheets: ${side} mm, ${countOf(pages, 'page')}${joints > 0 ? `, ${countOf(joints, 'joint')}` : ''}${smallest ? `, smallest sheet ${smallest} mm` : ''}`,
  small: (/** @type {string} */ smallest) => `Hard to build: the smallest sheet is ${smallest} mm long. Make it larger, or its pieces simpler.`,
  long: (/** @type {number} */ joints) => `Long to build: ${count(joints)} joints. Simpler pieces have fewer.`,
  manyPages: (/** @type {number} */ pages) => `These are ${count(pages)} pages. Is the unit of the file right? A smaller longer side needs fewer.`,
  fit: (/** @type {string} */ side) => `Each sheet on one page: ${side} mm`,
  upperSide: 'The surface is the upper side of the metal.',
  blank: (/** @type {string} */ thickness) => `A solid of sheet metal, ${thickness} mm thick: this is the blank that it is bent from.`,
  enlarge: 'Enlarge the picture',
  pairs: 'such as 1-7, 2-3',
  wrongPairs: 'These are numbers of two pieces each, such as 1-7, 2-3.',
  noEdge: 'There is no fold or cut here. Click a fold, or the letter of a cut.',
  /** @param {number[]} pair @param {number} pieces */
  noEdgeBetween: ([a, b], pieces) => (b > pieces ? `There is no piece ${b}.` : a === b ? `Piece ${a} has no edge with itself.` : `Pieces ${a} and ${b} have no edge in common.`),
  /** @param {{ seams: number, folds: number }} summary */
  legend: ({ seams, folds }) => `Numbers are those of the smooth pieces.${seams > 0 ? ' Sides with the same letter belong together.' : ''}${folds > 0 ? ' M is a fold to a ridge, V to a valley.' : ''}`,
  edges: 'Click a fold to cut it, or the letter of a cut to fold it.',
  /** @param {number[]} pair @param {boolean} isFold */
  edge: ([a, b], isFold) => `${isFold ? 'Fold' : 'Cut'} between pieces ${a} and ${b}: click to ${isFold ? 'cut' : 'fold'} it.`,
  /** @param {number[]} pair @param {boolean} wasFold */
  toggled: ([a, b], wasFold) => `Pieces ${a} and ${b} are ${wasFold ? 'cut apart' : 'joined by a fold'} now.`,
  unfoldable: (/** @type {number[]} */ [a, b]) => `Pieces ${a} and ${b} stay cut apart: with this fold pieces would lie on each other, or fit no page.`,
  unfoldableAll: 'With all these folds pieces would lie on each other, or fit no page. Leave out some.',
  undo: 'Undo',
  byNumber: 'Folds and cuts by number',
  cut: 'Cut the sheets',
  pdf: 'to print at 100 %, in true size',
  svg: 'for a cutting plotter or a drawing program',
  dxf: 'for a laser cutter or CAD',
  png: 'a picture of the finished piece, and how its sheets are joined',
  glb: 'a 3D film of how the sheets go to their places',
  curvedFold: 'Metal needs straight bends, and one fold of these sheets is curved. Choose “card or paper”, or a smaller λ for simpler pieces.',
  uncut: (/** @type {string} */ reason) => `The surface cannot be cut into sheets: ${reason}.`,
};

/** Purposes of file formats, as the save dialogs show them beside each format. */
export const FORMAT_WORDS = {
  obj: 'a mesh that nearly every program reads',
  stl: 'triangles alone, for CAD and modelling',
  glb: 'a mesh for the web and for phones, with colours',
  ply: 'a mesh in double precision',
  png: 'without loss',
  jpg: 'a smaller file',
};

/** Labels and messages about solids for 3D printers. */
export const SOLID_WORDS = {
  words: 'closed and in millimetres, for a 3D printer',
  shell: 'Where it bends more tightly than its thickness, the shell may cross itself.',
};

/** Messages and labels of the save dialog. */
export const SAVE_WORDS = {
  pdf: 'to print or to send',
  cancelled: 'Cancelled.',
  noDialog: 'The dialog could not be opened',
  pdfOfTwo: 'to print or to send, one page for each',
  working: 'Writing the file…',
  saved: (/** @type {string} */ name) => `Saved ${name}. Choose another format, or close the dialog.`,
  unit: (/** @type {string} */ unit) => `Lengths in the file are in ${SHEET_WORDS.unit(unit)}${unit === 'mm' ? '' : '; programs for 3D printing take them for millimetres'}.`,
  unwritten: (/** @type {string} */ reason) => `The file was not written: ${reason}.`,
  paper: (/** @type {string} */ looksLike) => `Paper size of the PDF${looksLike ? ` (looks like ${looksLike})` : ''}`,
  searchable: 'Searchable: recognise English text (loads 3.6 MB once; the photo stays here)',
  trueSize: (/** @type {string} */ size) => `true size, ${size}`,
  papers: { a4: 'A4', letter: 'Letter', a5: 'A5', a3: 'A3', 'a4-wide': 'A4 landscape', 'letter-wide': 'Letter landscape' },
};

/** Maximum duality gap that messages mention. At this gap the objective may be twice the optimum. */
const MAX_MENTIONED_GAP = 0.5;

/** Headlines, except those with the number of pieces. */
export const HEADLINE_WORDS = {
  solved: 'The surface is made of pieces that bend like paper.',
  unsolved: 'The surface is not solved.',
  stays: 'You see the result from before.',
  solving: 'Solving…',
  opened: (/** @type {string} */ name) => `Opened ${name}.`,
};

/** What the progress of a solve says. */
export const RUN_WORDS = {
  stopping: 'Stopping',
  coarse: (/** @type {number} */ level) => `Coarse solve, ${countOf(level, 'finer one')} to come`,
  /** @param {number | undefined} gap @param {number} iterations */
  fine: (gap, iterations) =>
    `${gap !== undefined && gap < MAX_MENTIONED_GAP ? `Within ${percentAtMost(gap)} of the best possible` : TASK_WORDS.solving}, ${countOf(iterations, 'iteration')}`,
};

/** The certificate of a result as one sentence. @param {Report} report */
export function certificateInWords({ gap, seconds: { total }, stopReason }) {
  const time = seconds(total);
  const within = gap !== undefined && gap < MAX_MENTIONED_GAP ? `proven within ${percentAtMost(gap)} of the best possible` : '';
  if (stopReason === 'cancelled') {
    return `Cancelled after ${time}: ${within || 'too early to tell how far the surface is from the best possible'}.`;
  }
  if (stopReason === 'rounding') return `This is the best possible surface, up to rounding, found in ${time}.`;
  return within ? `P${within.slice(1)}, in ${time}.` : `Stopped after ${time}, nothing is proven.`;
}

/**
 * The reduction of the noise as a sentence.
 * @param {{ before: number, after: number } | null} [accuracy] errors of the input and of the result; none if the truth is unknown
 */
export function noiseReductionInWords(accuracy) {
  if (!accuracy?.before || !accuracy.after) return '';
  const factor = accuracy.before / accuracy.after;
  if (factor >= 1.05) return `${factor >= 10 ? count(factor) : factor.toFixed(1)}× less noise (against the noise-free example).`;
  return 'No less noise (against the noise-free example).';
}

/**
 * The number of smooth pieces and creases as a sentence.
 * @param {number} pieces number of smooth pieces; infinite if the surface is creased all over
 * @param {number} creases
 * @param {boolean} [oneSide] whether the surface is one side of a mesh
 */
export function piecesInWords(pieces, creases, oneSide = false) {
  const smooth = pieces === 1 ? 'One smooth piece' : `${count(pieces)} smooth pieces`;
  const none = oneSide ? ', no crease told apart' : ' without a crease';
  const meet = creases === 0
    ? `${smooth}${pieces === 1 ? none : ', apart from each other'}`
    : `${smooth} ${pieces === 1 ? 'with' : 'meet in'} ${creases === 1 ? 'one crease' : `${count(creases)} creases`}`;
  if (oneSide && !Number.isFinite(pieces)) return 'Seen from one side only. Solve the whole mesh?';
  const words = Number.isFinite(pieces) ? meet : 'Its smooth pieces run into each other';
  return oneSide ? `From this side: ${words[0].toLowerCase()}${words.slice(1)}.` : `${words}.`;
}

/** Describes the inputs that a λ suits: the paper's heuristic (Sec. 5), extended to smaller and larger λ. @param {number} lambda */
export function lambdaHint(lambda) {
  const exponent = Math.log10(lambda);
  if (exponent < 4.5) return 'Very simple: you get a few large pieces, and most detail goes.';
  if (exponent < 5.5) return 'Simple: for heavy noise, or for few pieces.';
  if (exponent < 6.5) return 'Medium: for some noise, and for shapes to be built from pieces.';
  if (exponent < 7.5) return 'Close: for input that is nearly right, with small artefacts.';
  return 'Very close: keeps the input, and its noise.';
}

/** Hint for automatic λ, before it is chosen. */
export const AUTO_LAMBDA_HINT = 'The page chooses λ from the noise of the input. This takes a few more solves.';

/** A length in its unit, or as a share of a larger one if that is not known. @param {number} length @param {string | null | undefined} unit @param {number} whole @param {string} name of the larger one */
const lengthInWords = (length, unit, whole, name) => `${number(length)}${unit ? ` ${unit}` : whole > 0 ? `, ${percent(length / whole)} of ${name}` : ''}`;

/** How λ was chosen automatically; empty if it was given. @param {Pick<Surface, 'report' | 'pixelDistance' | 'heights'>} surface @param {string} [unit] of lengths */
export function lambdaChoiceInWords({ report: { lambda, lambdaChoice }, pixelDistance, heights }, unit) {
  if (!lambdaChoice) return '';
  const { reason, sigma, step, solves, correlationLength, ambiguous, residualExceedsNoise, residualRatio, tolerance, offsetRows, offsetColumns } = lambdaChoice;
  const lines = [offsetRows && 'rows', offsetColumns && 'columns'].filter(Boolean).join(' and ');
  const levelled = lines && ` Offsets of ${lines} were taken out.`;
  const length = correlationLength > 0 ? `, alike over distances of ${number(correlationLength)}${unit ? ` ${unit}` : ''}` : '';
  const noise = `${step === undefined ? 'Noise' : 'Steps'}: ${lengthInWords(step ?? sigma ?? 0, unit, sidesOf(heights, 1)[0], 'the range of the heights')}${step === undefined ? length : ''}`;
  const within = tolerance === undefined ? '' : ` The surface keeps to the heights, but for ${number(pixelDistance ?? tolerance)}${unit ? ` ${unit}` : ''} (root mean square).`;
  const unsure = ambiguous ? ` Shape and noise cannot be told apart.${within} Compare five values.` : '';
  const doubt = residualExceedsNoise
    ? ` The surface is at least ${number(residualRatio ?? 0)} times as far from the heights as their noise explains: a larger λ keeps more of the shape.`
    : unsure;
  switch (reason) {
    case 'prediction': return `Chosen automatically (${count(solves)} trial solves). ${noise}.${levelled}${doubt}`;
    case 'noise': return `Chosen automatically. ${noise}.${levelled}${doubt}`;
    case 'noNoise': return `The input has no noise${step === undefined ? '' : ` but steps of ${number(step)}`}.${levelled}${within} A simpler surface (smaller λ) has fewer, larger sheets.`;
    case 'tolerance': return `λ follows from the tolerance.${levelled}${within}`;
    default: return `Too few heights to measure their noise: λ = ${shortLambda(lambda)}.`;
  }
}

/** How λ of a whole mesh was chosen automatically. @param {Pick<MeshSurface, 'report' | 'unit' | 'positions'>} surface */
export function meshLambdaChoiceInWords({ report: { lambda, sigma, stopReason }, unit, positions }) {
  if (stopReason === 'noNoise') return 'There is no noise to choose λ by. The slider smooths it all the same.';
  if (sigma === undefined) return `Too few vertices to measure their noise: λ = ${shortLambda(lambda)}.`;
  return `Chosen automatically. Noise along the normals: ${lengthInWords(sigma, unit, Math.max(...sidesOf(positions)), 'the longest side')}.`;
}

/** The message about an error. @param {string} doing what could not be done @param {unknown} error */
export const errorMessage = (doing, error) => `${doing}: ${plainMessage(error)}.`;
