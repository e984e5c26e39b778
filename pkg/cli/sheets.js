/** `developable unroll`, `developable pattern` and `developable dewarp`. */
import { basename, extname } from 'node:path';
import * as developable from '../index.js';
import { solver } from '../schema/fit.js';
import { limits, patternMesh } from '../schema/pattern.js';
import { dewarp as flattening } from '../schema/photo.js';
import { readCamera } from './camera.js';
import { checkPlaces, readBytes, writeWhole } from './files.js';
import { solve } from './fit.js';
import { about } from './explain.js';
import { readForFit, readInput } from './inputs.js';
import { Problem, status } from './problem.js';
import { TABLE, isMesh, optionsFrom } from './task.js';
import { during, percent, say, statusLine, succeed, toStderr } from './terminal.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {Pick<import('../types.js').PatternPlan, 'lambda' | 'smallest' | 'distance'>} Plan how a pattern came about, of several that were tried
 * @typedef {import('./inputs.js').Input} Input
 * @typedef {import('../types.js').Unrolling} Unrolling
 */

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function unroll(task, signal) {
  await checkPlaces(...task.written);
  const { surface, options } = await flattened(task, signal);
  const sheet = await during('laying it flat', (watched) => developable.unroll(surface, { ...options, ...watched }));
  const bytes = task.extension === '.obj' ? flatObj(sheet) : json(plainArrays(sheet));
  await writeWhole([{ path: task.output, bytes }, ...reported(task, sheet)], signal);
  succeed(task.output, `${sheet.triangles.length / 3} triangles laid flat, strained by ${percent(sheet.report.distortion.rms, 2)}`);
}

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function pattern(task, signal) {
  await checkPlaces(...task.written);
  if (task.explore) return tellPlans(task, (await explored(task, signal)).plans, signal);
  const { drawing, plan } = await drawnOnce(task, signal);
  await writeWhole(await patternFiles(task, drawing, plan), signal);
  reportPattern(task, drawing, plan);
}

/**
 * @param {Task} task
 * @param {import('../types.js').Drawing} drawing
 * @param {Plan} [plan]
 */
export async function patternFiles(task, drawing, plan) {
  const files = [{ path: task.output, bytes: await drawn(drawing, task.extension, basename(task.output, extname(task.output))) }];
  const { assembly } = drawing;
  if (task.report !== undefined) {
    files.push({ path: task.report, bytes: json({ ...drawing.summary, ...plan, bends: bendTable(drawing), assembly: assembly?.steps }) });
  }
  if (task.assembly !== undefined && assembly !== undefined) {
    files.push({ path: task.assembly, bytes: task.assembly.toLowerCase().endsWith('.svg') ? assembly.picture : assembly.model });
  }
  return files;
}

/**
 * @param {Task} task
 * @param {import('../types.js').Drawing} drawing
 * @param {Plan} [plan]
 */
export function reportPattern(task, drawing, plan) {
  reportFit(drawing);
  reportSize(task.output, drawing);
  if (plan !== undefined) {
    toStderr(
      `developable: ${counted(drawing.summary.sheets, 'sheet')} with --lambda ${Number(plan.lambda.toPrecision(6))} and --smallest ` +
        `${plan.smallest}, ${Number(plan.distance.toPrecision(3))} from the input (root mean square)\n`,
    );
  }
  reportSlits(drawing.summary);
  reportMissing(drawing.summary);
  const { untabbed, strain } = drawing.summary;
  const { maxStrain = limits.maxStrain.default } = /** @type {import('../types.js').PatternOptions} */ (drawingOptions(task));
  if (strain > maxStrain) {
    say(`warning: a sheet is strained by ${percent(strain, 2)}, more than the limit of ${percent(maxStrain, 2)}: lengths on it are wrong by that much on average`);
  }
  if (untabbed > 0) say(`warning: ${counted(untabbed, 'seam')} without a tab, for want of room on both sides`);
}

/** The smooth bends of all sheets, lengths in millimetres and angles in degrees. @param {import('../types.js').Drawing} drawing */
function bendTable({ sheets }) {
  const bends = sheets.flatMap(({ name, folds }) =>
    folds.filter(({ bend }) => bend?.isMiddle).map(({ direction, length, bend }) => ({ sheet: name, direction, length, ...bend, isMiddle: undefined })));
  return bends.length > 0 ? bends : undefined;
}

/**
 * How large the drawing is, and on how many pages.
 * @param {string} output
 * @param {import('../types.js').Drawing} drawing
 */
function reportSize(output, { width, height, pages, summary: { sheets } }) {
  const paper = pages === undefined ? '' : ` on ${counted(pages.pages.length, 'page')}`;
  succeed(output, `${counted(sheets, 'sheet')}, together ${Math.ceil(width)} × ${Math.ceil(height)} mm${paper}`);
}

/** What it takes besides the creases. @param {import('../types.js').Drawing['summary']} summary */
function reportSlits({ slits, slitLength, sheets, strain }) {
  if (slits === 0) return;
  toStderr(
    `developable: ${counted(sheets, 'sheet')}, strained by ${percent(strain, 2)} at most; that takes ${counted(slits, 'slit')} ` +
      `besides the creases, ${slitLength.toFixed(0)} mm long\n`,
  );
}

/**
 * The options of a pattern.
 * @param {Task} task
 */
export function drawingOptions(task) {
  return { ...optionsFrom(patternMesh, task), assembly: task.assembly !== undefined || task.report !== undefined };
}

/**
 * The pattern that is asked for, and how it came about where several were tried.
 * @param {Task} task
 * @param {AbortSignal} signal
 * @returns {Promise<{ drawing: import('../types.js').Drawing, plan?: Plan }>}
 */
async function drawnOnce(task, signal) {
  if (task.sheets === undefined) {
    const { surface, options } = await flattened(task, signal);
    const refold = task.report !== undefined;
    const draw = (/** @type {object} */ watched) => developable.pattern(surface, { ...options, ...drawingOptions(task), refold, ...watched });
    return { drawing: await during('cutting it into sheets', draw).catch((problem) => { throw withRemedy(problem, task.input); }) };
  }
  return chosenOf(task, await explored(task, signal));
}

/**
 * The problem of a pattern, with what else can be done about a mesh: only the view of it from one side was to be laid flat.
 * @param {unknown} problem
 * @param {string} input
 */
function withRemedy(problem, input) {
  if (!(problem instanceof developable.DevelopableError) || problem.code !== 'NOT_FLAT' || !isMesh(input)) return problem;
  return new Problem(status.input, `${problem.message}; or give --surface: it lays the whole mesh flat, and not a view of it from one side`);
}

/**
 * The pattern of the first plan with few enough sheets.
 * @param {{ sheets?: number }} task
 * @param {import('../types.js').ExploredPatterns} found
 */
export function chosenOf(task, { plans, chosen }) {
  if (chosen?.drawing === undefined) {
    const fewest = Math.min(...plans.map(({ drawing }) => drawing?.sheets.length ?? Infinity));
    throw new Problem(
      status.input,
      fewest === Infinity
        ? `no plan lays it flat: ${plans.at(-1)?.problem}`
        : `no plan has as few sheets as ${task.sheets}: the fewest are ${fewest}; --max-strain allows more, --explore shows all`,
    );
  }
  const { lambda, smallest, distance } = chosen;
  return { drawing: chosen.drawing, plan: { lambda, smallest, distance } };
}

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
async function explored(task, signal) {
  const input = await readForFit(task, signal);
  const { lambda, ...fitting } = { ...optionsFrom(solver, task), ...spacing(task) };
  const { smallest, ...pattern } = drawingOptions(task);
  return withPlans((onPlan) => developable.explorePattern(input, { solver: fitting, pattern, sheets: task.sheets, signal, onPlan }));
}

/**
 * Plans, shown as they are found.
 * @param {(onPlan?: (plan: import('../types.js').PatternPlan) => void) => Promise<import('../types.js').ExploredPatterns>} explore
 */
export async function withPlans(explore) {
  const line = statusLine();
  try {
    return await explore(line.shown ? (plan) => line.show(row(plan).join('  ')) : undefined);
  } finally {
    line.clear();
  }
}

const COLUMNS = ['lambda', 'smallest', 'sheets', 'folds', 'slits', 'cuts (mm)', 'strain', 'distance', 'time (s)'];

/** @param {import('../types.js').PatternPlan} plan */
function row({ lambda, smallest, distance, seconds, drawing }) {
  const figures = drawing === undefined ? ['cannot be laid flat', '', '', '', ''] : told(drawing.summary);
  return [Number(lambda.toPrecision(3)).toExponential(), String(smallest), ...figures, String(Number(distance.toPrecision(3))), seconds.toFixed(1)];
}

/** @param {import('../types.js').Drawing['summary']} summary */
function told({ sheets, folds, slits, cutLength, strain }) {
  return [String(sheets), String(folds), String(slits), cutLength.toFixed(0), percent(strain, 2)];
}

/**
 * All plans, as a table or as JSON.
 * @param {Task} task
 * @param {import('../types.js').PatternPlan[]} plans
 * @param {AbortSignal} signal
 */
export async function tellPlans({ output, extension }, plans, signal) {
  if (extension !== TABLE) {
    const figures = plans.map(({ drawing, ...plan }) => ({ ...plan, summary: drawing?.summary }));
    await writeWhole([{ path: output, bytes: json(figures) }], signal);
    return;
  }
  const rows = [COLUMNS, ...plans.map(row)];
  const widths = COLUMNS.map((_, i) => Math.max(...rows.map((cells) => (i === 2 && cells[3] === '' ? 0 : cells[i].length))));
  const lines = rows.map((cells) => cells.map((cell, i) => (cells[3] === '' && i === 2 ? cell : cell.padStart(widths[i]))).join('  '));
  await writeWhole([{ path: output, bytes: new TextEncoder().encode(`${lines.join('\n')}\n`) }], signal);
}

/** How well what is joined fits. @param {import('../types.js').Drawing} drawing */
function reportFit({ summary: { mismatch, worstJoint, worstAngle } }) {
  const words = [];
  if (worstJoint !== undefined) {
    const [a, b] = worstJoint.lengths.map((long) => long.toFixed(2));
    if (a !== b) words.push(`the two sides of a joint differ in length by at most ${percent(mismatch, 2)} (${a} and ${b} mm)`);
  }
  if (worstAngle !== undefined) {
    words.push(`the angles of the pieces around a point differ from those on the surface by at most ${Math.abs(worstAngle.flat - worstAngle.surface).toFixed(1)}°`);
  }
  if (words.length > 0) toStderr(`developable: ${words.join(', ')}\n`);
}

/** What is on no sheet, and what was cut off. @param {import('../types.js').Drawing['summary']} summary */
function reportMissing({ missing, loops }) {
  const squares = (/** @type {number} */ area) => `${(area / 100).toFixed(area < 1000 ? 1 : 0)} cm²`;
  const words = [];
  if (missing !== undefined && missing.vertices > 0) {
    words.push(`${counted(missing.vertices, 'vertex', 'vertices')} (${squares(missing.area)}) left out, which lie flat with nothing beside them or are crumbs`);
  }
  if (missing !== undefined && missing.steps > 0) {
    words.push(`the walls of ${counted(missing.steps, 'step')} (about ${squares(missing.stepArea)}) on no sheet`);
  }
  if (loops > 0) words.push(`${counted(loops, 'small loop')} in which outlines crossed themselves cut off`);
  if (words.length > 0) toStderr(`developable: warning: ${words.join('; ')}\n`);
}

/** @param {number} count @param {string} what @param {string} [several] */
const counted = (count, what, several = `${what}s`) => `${count} ${count === 1 ? what : several}`;

/**
 * @param {import('../types.js').Drawing} drawing
 * @param {string} extension
 * @param {string} title
 */
export async function drawn(drawing, extension, title) {
  switch (extension) {
    case '.svg': return developable.writeSvg(drawing);
    case '.pdf': return developable.writePdf(drawing, { title });
    case '.dxf': return developable.writeDxf(drawing);
    default: return json({ ...drawing, assembly: undefined });
  }
}

/**
 * Refuses what is seen of a mesh if nothing says where in the photo that is: before it is fitted.
 * @param {string} path
 * @param {import('./inputs.js').Input} input
 */
function checkPlace(path, input) {
  const { frame, camera, uvs } = /** @type {import('../types.js').Heightfield} */ (input);
  if (frame === undefined || camera !== undefined || uvs !== undefined) return;
  throw new Problem(
    status.input,
    `nothing says where in the photo the points of ${path} are: --photo-camera FILE gives the camera that took it; or take a mesh `
      + 'with texture coordinates',
  );
}

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function dewarp(task, signal) {
  await checkPlaces(...task.written);
  const texture = task.texture === undefined ? undefined : await readPhoto(task.texture);
  const { photoCamera } = task;
  const elsewhere = photoCamera !== undefined && texture !== undefined ? await readCamera(photoCamera, [texture]) : undefined;
  const { width = 0, height = 0, orientation } = texture ?? {};
  const seen = texture && { width, height, orientation, wanted: task.crop, camera: elsewhere };
  const { surface, options } = await flattened({ ...task, photo: seen }, signal, (input) => {
    if (task.extension === '.pdf') checkUnit(input);
    if (texture !== undefined && photoCamera === undefined) checkPlace(task.input, input);
  });
  const cylinder = cylinderOf(surface);
  const photo = texture ?? await textureOf(task.input, surface);
  const camera = elsewhere ?? (photoCamera === undefined ? undefined : await readCamera(photoCamera, [photo]));
  const { crop } = task;
  const given = { ...options, ...optionsFrom(flattening, task), ...mapOptions(task.map) };
  const flat = await during('flattening the photo', () => developable.dewarp(surface, photo, { ...given, camera, transfer: true }));
  const files = [{ path: task.output, bytes: await printed(task, flat) }, ...reported(task, { ...flat, report: { ...flat.report, ...(cylinder && { cylinder }) } })];
  if (task.map !== undefined) {
    files.push({ path: task.map, bytes: mapFile(flat, photo) });
  }
  await writeWhole(files, signal);
  succeed(task.output, sizeInWords(flat));
  if (task.camera !== undefined && crop === undefined && reachesRim(surface)) {
    toStderr(
      'developable: warning: the whole depth image was flattened, with what the page lies on; --crop x,y,x,y,... with the corners of ' +
        'the page in the photo selects the page, and so does --mask\n',
    );
  }
  if (cylinder?.verdict === 'other') {
    toStderr(
      'developable: warning: the heights are not those of a cylinder: what is made flat may be wrong; without --shape cylinder ' +
        'any surface that unrolls is fitted\n',
    );
  }
  if (crop?.length === 4 && flat.loss > MAX_UNMENTIONED_LOSS) {
    toStderr(`developable: warning: ${percent(flat.loss, 2)} of the page between the corners of --crop is missing: there are no depths of it\n`);
  }
  if (flat.verdict === 'doubtful' && flat.overreach > 0) {
    toStderr(
      `developable: warning: --crop reaches beyond the page that the photo shows, by up to ${percent(flat.overreach, 2)} of its side: the flat ` +
        'image may show what lies beside the page, and be bent by it; place the corners on the page\n',
    );
  }
  if (flat.verdict === 'flat') {
    toStderr('developable: the photo shows the page flat to begin with, and can be used as it is\n');
  } else if (flat.verdict === 'stretched') {
    const { distortion: { rms, above, flipped }, crossings } = flat.report;
    const reasons = [
      ...(above > 0 ? [`its sheet is stretched by ${percent(rms, 2)} on average and by more than 1 % in ${percent(above, 2)} of its area`] : []),
      ...(flipped + crossings > 0 ? ['parts of the sheet lie on others'] : []),
    ];
    toStderr(
      `developable: warning: the surface cannot be laid flat as it is: ${reasons.join(', and ')}; lengths on the flat image may be wrong\n`,
    );
  }
}

/** Largest share of a page that is left out without a word: a millimetre on each side of a page of A4. */
const MAX_UNMENTIONED_LOSS = 0.015;

/** How near to the rim of an image something is to reach it, and on what share of a side, in shares of that. */
const [NEAR, LONG] = [0.03, 0.3];

/**
 * Whether what a depth camera has seen of a surface goes on to the rim of its image, as a page alone does not.
 * @param {Input} surface
 */
function reachesRim(surface) {
  const { uvs, heights } = /** @type {import('../types.js').Heightfield} */ (surface);
  if (uvs === undefined || heights === undefined) return false;
  const steps = 100;
  const sides = Array.from({ length: 4 }, () => new Uint8Array(steps + 1));
  for (let i = 0; i < heights.length; i += 1) {
    const [u, v] = [uvs[2 * i], uvs[2 * i + 1]];
    if (!Number.isFinite(heights[i]) || !(u >= 0 && u <= 1 && v >= 0 && v <= 1)) continue;
    const [across, up] = [u, v].map((share) => Math.round(steps * share));
    [u, 1 - u].forEach((far, k) => far < NEAR && (sides[k][up] = 1));
    [v, 1 - v].forEach((far, k) => far < NEAR && (sides[2 + k][across] = 1));
  }
  return sides.some((side) => side.reduce((sum, one) => sum + one, 0) > LONG * steps);
}

/** Says what a true size takes, where it is not known. @param {Input} input */
function checkUnit({ unit }) {
  if (unit !== undefined && unit !== null) return;
  throw new Problem(
    status.usage,
    'a .pdf has its true size, and nothing says in what unit the lengths are: --unit mm or --unit m does (and --pixel-size ' +
      'how large a pixel of heights is, in that unit)',
  );
}

/**
 * A flat image in a file of the kind that its name says.
 * @param {{ extension: string, quality?: number }} task
 * @param {import('../types.js').SizedPhoto} flat
 */
export function printed({ extension, quality }, flat) {
  const formats = /** @type {const} */ ({ '.png': 'png', '.pdf': 'pdf', '.jpg': 'jpeg', '.jpeg': 'jpeg' });
  return developable.writePhoto(flat, { format: formats[/** @type {keyof typeof formats} */ (extension)], quality, transfer: true });
}

/** The size of a flat image. @param {import('../types.js').SizedPhoto} flat */
export function sizeInWords({ width, height, resolution = 1, unit }) {
  const size = [width, height].map((pixels) => Number((pixels / resolution).toPrecision(4)));
  const lengths = unit === 'mm' || unit === 'm' ? `, ${size.join(' × ')} ${unit}` : '';
  return `${width} × ${height} pixels${lengths}`;
}

/** @param {string} path */
async function readPhoto(path) {
  const bytes = await readBytes(path);
  return about(path, () => developable.readPhoto(bytes));
}

/**
 * The picture that a scan has with it.
 * @param {string} input
 * @param {Input} surface
 */
async function textureOf(input, surface) {
  const { texture } = /** @type {import('../types.js').Heightfield} */ (surface);
  if (texture !== undefined) return developable.readPhoto(texture);
  throw new Problem(
    status.usage,
    `${input} has no texture of its own, or several: --texture PHOTO gives the picture that its texture coordinates are about`,
  );
}

/**
 * What is to be laid flat, and how it is resampled if it is no lattice yet.
 * @param {Task & { photo?: import('./inputs.js').Size }} task
 * @param {AbortSignal} signal
 * @param {(input: Input) => void} [check] whether it will do, before the work
 */
export async function flattened(task, signal, check = () => {}) {
  const input = await (task.asIs ? readInput(task) : readForFit(task, signal));
  check(input);
  if (task.asIs) return { surface: input, options: spacing(task) };
  const cylinder = await cylinderFor(task, input);
  return { surface: cylinder ?? await solve(task, input, { signal }), options: {} };
}

/**
 * Whether an option asks for another energy, λ or stop than the defaults do.
 * @param {[name: string, value: unknown]} option
 */
function asksForAnotherFit([name, value]) {
  /** @type {import('../schema/kinds.js').Options} */
  const options = solver;
  // `true` stands for the default number of pixels.
  const standard = name === 'bridge' ? DEFAULT_BRIDGE_PIXELS : options[name]?.default;
  return value !== undefined && value !== standard;
}

/** Default of `--bridge`, in pixels. */
const DEFAULT_BRIDGE_PIXELS = 4;

/**
 * The cylinder that is to be laid flat, if it is one.
 * @param {Task} task
 * @param {Input} input
 */
async function cylinderFor(task, input) {
  const shape = task.command === 'dewarp' ? task.shape ?? 'auto' : undefined;
  if (shape === undefined || shape === 'developable') return undefined;
  const field = /** @type {import('../types.js').Heightfield} */ (input);
  if (shape === 'cylinder') return developable.fitCylinder(field);
  // What is said about the energy is about a surface that is fitted by it.
  const said = Object.entries(optionsFrom(solver, task)).some(asksForAnotherFit);
  if (said || task.lattice !== 'mesh' || field.constraints !== undefined || field.occlusions !== undefined) return undefined;
  try {
    const found = await developable.fitCylinder(field);
    return found.report.verdict === 'cylinder' ? found : undefined;
  } catch (problem) {
    if (problem instanceof developable.DevelopableError && problem.code === 'UNSUPPORTED') return undefined; // too small
    throw problem;
  }
}

/** @param {Input | import('../types.js').FittedCylinder} surface */
function cylinderOf(surface) {
  const { report } = /** @type {Partial<import('../types.js').FittedCylinder>} */ (surface);
  return report !== undefined && 'rulings' in report ? report : undefined;
}

/** @param {Task} task */
export function spacing(task) {
  return task.lattice === 'square' ? { spacing: task.spacing } : {};
}

/**
 * @param {Task} task
 * @param {{ report: import('../types.js').UnrollReport, verdict: import('../types.js').Verdict, loss?: number, overreach?: number }} result
 */
function reported({ report: path }, { report, verdict, loss, overreach }) {
  return path === undefined ? [] : [{ path, bytes: json({ verdict, loss, overreach, ...report }) }];
}

/** @param {unknown} value */
export function json(value) {
  return new TextEncoder().encode(`${JSON.stringify(value, undefined, 2)}\n`);
}

/** Typed arrays as plain ones, for JSON. @param {object} object */
export function plainArrays(object) {
  const entries = Object.entries(object);
  return Object.fromEntries(entries.map(([name, value]) => [name, ArrayBuffer.isView(value) ? [.../** @type {Float64Array} */ (value)] : value]));
}

/**
 * Lines as an OBJ, in the axes that the surface's mesh has.
 * @param {import('../types.js').Ruling[]} lines
 * @param {import('../types.js').Frame} [frame]
 */
export function linesObj(lines, frame) {
  const { right = [1, 0, 0], up = [0, 1, 0], towards = [0, 0, 1] } = frame ?? {};
  const text = ['# rulings'];
  let count = 0;
  for (const { points } of lines) {
    for (const [x, y, z] of points) {
      text.push(`v ${[0, 1, 2].map((k) => x * right[k] + y * up[k] + z * towards[k]).join(' ')}`);
    }
    // The file counts from 1.
    text.push(`l ${points.map((_, i) => count + i + 1).join(' ')}`);
    count += points.length;
  }
  return new TextEncoder().encode(`${text.join('\n')}\n`);
}

/** The sheet as a flat mesh. @param {Pick<Unrolling, 'places' | 'triangles'>} sheet */
export function flatObj({ places, triangles }) {
  const lines = ['# a surface laid flat'];
  for (let i = 0; i < places.length; i += 2) lines.push(`v ${places[i]} ${places[i + 1]} 0`);
  // The file counts from 1.
  for (let i = 0; i < triangles.length; i += 3) {
    lines.push(`f ${triangles[i] + 1} ${triangles[i + 1] + 1} ${triangles[i + 2] + 1}`);
  }
  return new TextEncoder().encode(`${lines.join('\n')}\n`);
}

/**
 * @typedef {Pick<import('../types.js').Dewarped, 'width' | 'height' | 'resolution' | 'corner' | 'map' | 'grid'> &
 *   { unit?: string }} WarpMap
 */

/** What of the warp map a file of it takes. @param {string} [path] */
export function mapOptions(path) {
  const full = path?.toLowerCase().endsWith('.npy') === true;
  return { map: full, grid: path !== undefined && !full };
}

/**
 * @param {WarpMap} flat
 * @param {{ width: number, height: number }} photo
 */
export function mapFile(flat, photo) {
  return flat.grid === undefined ? mapNpy(flat) : mapJson(flat, flat.grid, photo);
}

/** The warp map as a NumPy array of shape (height, width, 2). @param {WarpMap} flat */
function mapNpy({ width, height, map }) {
  const text = `{'descr': '<f4', 'fortran_order': False, 'shape': (${height}, ${width}, 2), }`;
  // The data begin at a multiple of 64 bytes, after a line break.
  const length = Math.ceil((10 + text.length + 1) / 64) * 64 - 10;
  const head = Buffer.from(`\x93NUMPY\x01\x00\0\0${text.padEnd(length - 1)}\n`, 'latin1');
  head.writeUInt16LE(length, 8);
  const data = Buffer.alloc(4 * map.length);
  map.forEach((value, i) => data.writeFloatLE(value, 4 * i));
  return Buffer.concat([head, data]);
}

/**
 * The map on a grid as JSON, null where there is no sheet.
 * @param {WarpMap} flat
 * @param {import('../types.js').WarpGrid} grid
 * @param {{ width: number, height: number }} photo
 */
function mapJson({ width, height, resolution, unit, corner }, { columns, rows, step, places, rms, maximum }, photo) {
  const rounded = (/** @type {number} */ value) => Math.round(1000 * value) / 1000;
  const file = {
    width,
    height,
    photo: { width: photo.width, height: photo.height },
    resolution,
    unit: unit ?? null,
    corner,
    error: { rms, maximum },
    columns,
    rows,
    origin: [0, 0],
    step,
    places: Array.from({ length: columns * rows }, (_, i) =>
      (Number.isNaN(places[2 * i]) ? null : [rounded(places[2 * i]), rounded(places[2 * i + 1])])),
  };
  return new TextEncoder().encode(`${JSON.stringify(file)}\n`);
}
