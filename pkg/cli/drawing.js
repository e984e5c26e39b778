/** Drawings of patterns in files, and what is said of them. */
import * as developable from '../index.js';
import { limits, patternMesh } from '../schema/pattern.js';
import { titleOf } from './flat-image.js';
import { optionsFrom } from './task.js';
import { percent, say, succeed, toStderr } from './terminal.js';
import { json, reportFile } from './texts.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {Pick<import('../types.js').PatternPlan, 'lambda' | 'smallest' | 'distance'>} Plan how a pattern came about, of several that were tried
 */

/**
 * The options of a pattern.
 * @param {Task} task
 */
export function drawingOptions(task) {
  return { ...optionsFrom(patternMesh, task), assembly: task.assembly !== undefined || task.report !== undefined };
}

/**
 * @param {Task} task
 * @param {import('../types.js').Drawing} drawing
 * @param {Plan} [plan]
 */
export async function patternFiles(task, drawing, plan) {
  const files = [{ path: task.output, bytes: await drawn(drawing, task.extension, titleOf(task.output)) }];
  const { assembly } = drawing;
  files.push(...reportFile(task, { ...drawing.summary, ...plan, bends: bendTable(drawing), assembly: assembly?.steps }));
  if (task.assembly !== undefined && assembly !== undefined) {
    files.push({ path: task.assembly, bytes: task.assembly.toLowerCase().endsWith('.svg') ? assembly.picture : assembly.model });
  }
  return files;
}

/**
 * @param {import('../types.js').Drawing} drawing
 * @param {string} extension
 * @param {string} [title]
 */
export async function drawn(drawing, extension, title) {
  switch (extension) {
    case '.svg': return developable.writeSvg(drawing, { title });
    case '.pdf': return developable.writePdf(drawing, { title });
    case '.dxf': return developable.writeDxf(drawing);
    default: return json({ ...drawing, assembly: undefined });
  }
}

/** The smooth bends of all sheets, lengths in millimetres and angles in degrees. @param {import('../types.js').Drawing} drawing */
function bendTable({ sheets }) {
  const bends = sheets.flatMap(({ name, folds }) =>
    folds.filter(({ bend }) => bend?.isMiddle).map(({ direction, length, bend }) => ({ sheet: name, direction, length, ...bend, isMiddle: undefined })));
  return bends.length > 0 ? bends : undefined;
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
  reportSimplified(task, drawing.summary);
  reportMissing(drawing.summary);
  const { untabbed, unlettered, strain } = drawing.summary;
  const { maxStrain = limits.maxStrain.default } = /** @type {import('../types.js').PatternOptions} */ (drawingOptions(task));
  if (strain > maxStrain) {
    say(`warning: a sheet is strained by ${percent(strain, 2)}, more than the limit of ${percent(maxStrain, 2)}: lengths on it are wrong by that much on average`);
  }
  if (untabbed > 0) say(`warning: ${counted(untabbed, 'seam')} without a tab, for want of room on both sides`);
  if (unlettered > 0) say(`warning: ${counted(unlettered, 'cut')} without a letter, for want of room on one side or both`);
}

/** How well what is joined fits. @param {import('../types.js').Drawing} drawing */
function reportFit({ summary: { mismatch, worstJoint, worstAngle } }) {
  const words = [];
  if (worstJoint !== undefined) {
    const [a, b] = worstJoint.lengths.map((long) => long.toFixed(2));
    // Rounding is no difference.
    if (Math.abs(Number(a) - Number(b)) > 0.015) words.push(`the two sides of a joint differ in length by at most ${percent(mismatch, 2)} (${a} and ${b} mm)`);
  }
  if (worstAngle !== undefined) {
    words.push(`the angles of the pieces around a point differ from those on the surface by at most ${Math.abs(worstAngle.flat - worstAngle.surface).toFixed(1)}°`);
  }
  if (words.length > 0) toStderr(`developable: ${words.join(', ')}\n`);
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

/** Says how many slits the sheets have besides the creases, and how long these are. @param {import('../types.js').Drawing['summary']} summary */
function reportSlits({ slits, slitLength, sheets, strain }) {
  if (slits === 0) return;
  toStderr(
    `developable: ${counted(sheets, 'sheet')}, strained by ${percent(strain, 2)} at most; that takes ${counted(slits, 'slit')} ` +
      `besides the creases, ${slitLength.toFixed(0)} mm long (--faces 500 makes it of flat faces, without any)\n`,
  );
}

/**
 * Says how many flat faces stand for the surface.
 * @param {Task} task
 * @param {Pick<import('../types.js').Drawing['summary'], 'simplified'>} summary
 * @param {string} [unit]
 */
export function reportSimplified({ input, faces }, { simplified }, unit = 'mm') {
  if (simplified === undefined) return;
  const why = faces === undefined ? 'no cut lays it flat within the limits; --faces decides how many, 0 none' : 'as --faces says';
  say(`${simplified.faces} flat faces stand for ${input}, ${Number(simplified.distance.toPrecision(2))} ${unit} from it (root mean square): ${why}`);
}

/** Warns of parts of the surface that are on no sheet. @param {import('../types.js').Drawing['summary']} summary */
function reportMissing({ missing, area: drawn }) {
  const squares = (/** @type {number} */ area) =>
    area < 100 ? `${Number(area.toPrecision(2))} mm²` : `${(area / 100).toFixed(area < 1000 ? 1 : 0)} cm²`;
  const words = [];
  if (missing !== undefined && missing.area > 0) {
    words.push(`${squares(missing.area)} of the surface (${percent(missing.area / (missing.area + drawn), 2)}) on no sheet, which are crumbs or do not lie flat with what is around them`);
  }
  if (missing !== undefined && missing.steps > 0) {
    words.push(`the walls of ${counted(missing.steps, 'step')} (about ${squares(missing.stepArea)}) on no sheet`);
  }
  if (words.length > 0) toStderr(`developable: warning: ${words.join('; ')}\n`);
}

/** @param {number} count @param {string} what @param {string} [several] */
export const counted = (count, what, several = `${what}s`) => `${count} ${count === 1 ? what : several}`;
