/** `developable dewarp PHOTO`, with or without `--edges EDGES`. */
import * as developable from '../index.js';
import { messageOf } from '../errors.js';
import { dewarp as flattening, dewarpPage } from '../schema/photo.js';
import { asProblem, withFileName } from './explain.js';
import { checkPlaces, readBytes, writeWhole } from './files.js';
import { mapFile, mapOptions, printed, sizeInWords, titleOf } from './flat-image.js';
import { tellAssumptions } from './inputs.js';
import { Problem, status } from './problem.js';
import { optionsFrom } from './task.js';
import { during, say, succeed } from './terminal.js';
import { json } from './texts.js';

/** Width and height of a PDF's pages where no size is given, in millimetres: A4. */
const DEFAULT_PAPER = /** @type {const} */ ([210, 297]);

/**
 * @param {import('./task.js').Task} task
 * @param {AbortSignal} signal
 */
export async function page(task, signal) {
  await checkPlaces(...task.written);
  const edges = task.edges === undefined ? undefined : await readEdges(task.edges);
  const { light: lighting, ink } = flattening;
  const options = { ...optionsFrom({ light: lighting, ink }, task), ...optionsFrom(dewarpPage, task) };
  /** @type {{ path: string, bytes: Uint8Array }[]} */
  const files = [];
  const reports = [];
  /** @type {import('../types.js').BookPage[]} */
  const book = [];
  /** @type {{ input: string, problem: Problem }[]} */
  const failures = [];
  const several = task.inputs.length > 1;
  let figures = '';
  /** @param {string} input */
  const flatten = async (input) => {
    const bytes = await readBytes(input);
    const photo = tellAssumptions(input, await withFileName(input, () => developable.readPhoto(bytes)));
    const { width, height } = photo;
    const flat = await during(`flattening ${input}`, (watched) => {
      const dewarp = () => developable.dewarpPage(photo, edges, { ...options, ...mapOptions(task.map), ...watched, transfer: true });
      return several ? withFileName(input, dewarp) : dewarp();
    });
    if (task.map !== undefined) files.push({ path: task.map, bytes: mapFile(flat, { width, height }) });
    const { size, unit, report, outline, light } = flat;
    figures = sizeInWords(flat);
    reports.push({ ...(several && { input }), ...report, size, unit, light, ...(outline && { outline }), assumptions: photo.assumptions });
    if (task.extension === '.pdf') {
      const paper = flat.width > flat.height ? [DEFAULT_PAPER[1], DEFAULT_PAPER[0]] : DEFAULT_PAPER;
      const extension = task.ink ? '.png' : '.jpg';
      const picture = await printed({ extension, quality: task.quality }, flat);
      book.push({ picture, size: unit === 'mm' ? size : /** @type {[number, number]} */ (paper) });
    } else {
      files.push({ path: task.output, bytes: await printed(task, flat) });
    }
    for (const told of [outline && outlineWords(outline), verdictWords(report), lightWords(task, light)]) {
      if (told !== undefined) say(`${several ? `${input}: ` : ''}${told}`);
    }
  };
  for (const input of task.inputs) {
    signal.throwIfAborted();
    try {
      await flatten(input);
    } catch (error) {
      const problem = asProblem(error);
      if (!several || problem.status !== status.input) throw error;
      // The other pages of a book are worth having.
      failures.push({ input, problem });
      reports.push({ input, failure: problem.message });
      say(problem.message);
    }
  }
  if (several && book.length === 0) throw new Problem(status.input, 'none of the photos was flattened');
  if (book.length > 0) files.push({ path: task.output, bytes: await developable.writeBook(book, { title: titleOf(task.output) }) });
  if (task.report !== undefined) files.push({ path: task.report, bytes: json(several ? reports : reports[0]) });
  await writeWhole(files, signal);
  if (several) say(`${task.output}: ${book.length} of ${task.inputs.length} photos`);
  else succeed(task.output, figures);
  if (failures.length > 0) {
    throw new Problem(status.failure, `not in ${task.output}: ${failures.map(({ input }) => input).join(', ')}`);
  }
}

/**
 * @param {import('./task.js').Task} task
 * @param {'even' | 'keep'} light what happened to it
 */
function lightWords(task, light) {
  if (light === 'even' || task.light === 'keep') return undefined;
  return 'the light was kept, since the page is dark or not mostly paper';
}

/** The verdict, unless nothing is to be said about it. @param {import('../types.js').PageReport} report */
function verdictWords(report) {
  if (report.verdict === 'unrolled') return undefined;
  const words = developable.describePage(report);
  return report.verdict === 'flat' ? words : `warning: ${words}`;
}

/** @type {Record<import('../types.js').OutlineReason, string>} */
const reasonWords = {
  cornerOutside: 'a corner is outside of the photo, and was extrapolated',
  cornerCovered: 'a corner is covered, folded over or torn off, and was extrapolated',
  edgeOutside: "an edge is outside of the photo or on its rim, which is taken for the page's edge",
  faintEdge: 'part of an edge is covered, or looks like the ground',
  unlikelyShape: 'it has hardly the shape of a sheet of paper',
  noPage: 'nothing looks like a page on a ground',
};

/** @param {import('../types.js').PageOutlines} outline */
function outlineWords({ verdict, reasons, pages }) {
  switch (verdict) {
    case 'doubtful': {
      const why = reasons.map((reason) => reasonWords[reason]).join('; ') || 'its edges have little contrast';
      return `warning: the outline that was found may be wrong: ${why}. --report FILE has it; --edges FILE takes a corrected one`;
    }
    case 'several':
      return `warning: there are ${pages.length} pages in the photo, and the clearest one was made flat: cut the photo, or choose ` +
        'with --edges one of those that --report FILE has';
    default:
      return undefined;
  }
}

/**
 * @param {string} path
 * @returns {Promise<import('../types.js').PageEdges>}
 */
async function readEdges(path) {
  const text = new TextDecoder().decode(await readBytes(path));
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Problem(status.input, `cannot read ${path}: it is no JSON (${messageOf(error)})`);
  }
}
