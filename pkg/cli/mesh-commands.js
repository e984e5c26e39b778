/** `--surface`: a mesh as it is, without a view, fitted and what is made of it. */
import * as developable from '../index.js';
import { meshSolver } from '../schema/fit.js';
import { rulingsMesh } from '../schema/shape.js';
import { counted, drawingOptions, patternFiles, reportPattern, reportSimplified } from './drawing.js';
import { checkPlaces, writeWhole } from './files.js';
import { writeMesh } from './fit.js';
import { readMesh } from './inputs.js';
import { chosenOf, tellPlans, withPlans } from './pattern.js';
import { optionsFrom } from './task.js';
import { during, meshFitInWords, percent, progressLine, say, succeed, toStderr } from './terminal.js';
import { flatObj, json, linesObj, plainArrays, reportFile } from './texts.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {import('../types.js').Mesh} Mesh
 * @typedef {{ path: string, bytes: Uint8Array }} File
 */

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function whole(task, signal) {
  await checkPlaces(...task.written);
  const mesh = await readMesh(task);
  if (task.explore || task.sheets !== undefined) return planned(task, mesh, signal);
  const exact = isLaidFlat(task) && ((task.faces ?? 0) > 0 || await isExact(task, mesh));
  const surface = task.asIs || exact ? undefined : await fitted(task, mesh, signal);
  const files = await made[task.command](task, surface ?? mesh, mesh, exact || surface?.report.stopReason === 'noNoise');
  await writeWhole(files, signal);
  if (surface !== undefined) tell(task, surface, mesh);
}

/** Whether a command lays a mesh flat, whose faces may be exact. @param {Task} task */
const isLaidFlat = ({ command }) => command === 'pattern' || command === 'unroll';

/** What the command says is done with an exact mesh, by its kind. */
const TAKEN = {
  faces: 'each of its faces is kept (--lambda auto removes noise first)',
  bends: 'its bends are divided along their lines, and its other faces kept (--lambda auto removes noise first)',
  surface: 'its vertices have no noise',
};

/**
 * Whether a mesh is taken as it is, which is said. Who gives λ asks for a fit.
 * @param {Task} task
 * @param {Mesh} mesh
 */
async function isExact({ command, input, asIs, blank, lambda, recognized }, mesh) {
  const { kind, thickness, faces, noise = 0 } = recognized ?? await developable.recognizeMesh(mesh);
  if (thickness !== undefined && command === 'pattern' && !blank) {
    say(`${input} looks like sheet metal, ${Number(thickness.toPrecision(4))} thick in the file's unit: --blank draws what it is bent from`);
  }
  if (kind === 'noisy' || (lambda !== undefined && !asIs)) return false;
  if (kind === 'noisyFaces') {
    if (asIs) return false;
    say(`${input} looks like ${faces === 1 ? '1 flat face' : `${faces} flat faces`} with noise of ${Number(noise.toPrecision(2))} in the file's unit: the noise is removed (--as-is keeps it)`);
  } else if (!asIs) say(`${input} is taken as it is: ${TAKEN[kind]}`);
  return true;
}

/**
 * @param {Task} task
 * @param {Mesh} mesh
 * @param {AbortSignal} signal
 */
function fitted(task, mesh, signal) {
  const line = progressLine();
  line.begin();
  return developable
    .fitMesh(mesh, { ...optionsFrom(meshSolver, task), signal, onProgress: line.shown ? line.show : undefined })
    .finally(() => line.clear());
}

/** What each command writes. @type {Record<string, (task: Task, surface: Mesh, mesh: Mesh, exact: boolean) => Promise<File[]>>} */
const made = {
  async fit(task, surface) {
    const { report } = /** @type {import('../types.js').MeshSurface} */ (surface);
    return [{ path: task.output, bytes: await writeMesh(task.extension, surface) }, ...reportFile(task, report)];
  },

  async analyze({ output, asIs, threshold }, surface, mesh) {
    const figures = { input: (await developable.analyze(mesh, { threshold })).summary };
    const after = asIs ? {} : { output: (await developable.analyze(surface, { threshold })).summary };
    return [{ path: output, bytes: json({ ...figures, ...after }) }];
  },

  async rulings(task, surface) {
    const { output, extension } = task;
    const { lines } = await developable.rulings(surface, optionsFrom(rulingsMesh, task));
    const bytes = extension === '.obj' ? linesObj(lines) : json({ lines });
    return [{ path: output, bytes }, ...reportFile(task, { lines })];
  },

  async unroll(task, surface, _mesh, exact) {
    const sheets = await during('laying it flat', (watched) => developable.unroll(surface, { faces: task.faces, exact: exact ? undefined : false, ...watched }));
    reportSimplified(task, sheets.report, 'in the file’s unit');
    const { patches, creases, report } = sheets;
    const bytes = task.extension === '.obj' ? flatObj(sheets) : json(plainArrays(sheets));
    return [{ path: task.output, bytes }, ...reportFile(task, { ...report, patches, creases })];
  },

  async pattern(task, surface, _mesh, exact) {
    const pattern = await during('cutting it into sheets', (watched) =>
      developable.pattern(surface, { ...drawingOptions(task), exact: exact ? undefined : false, ...watched }));
    reportPattern(task, pattern);
    return patternFiles(task, pattern);
  },
};

/**
 * Patterns at several λ: all are told, or the first one with few enough sheets is written.
 * @param {Task} task
 * @param {Mesh} mesh
 * @param {AbortSignal} signal
 */
async function planned(task, mesh, signal) {
  const { lambda, ...solver } = optionsFrom(meshSolver, task);
  const { smallest, ...pattern } = drawingOptions(task);
  const { sheets } = task;
  const found = await withPlans((onPlan) => developable.explorePattern(mesh, { solver, pattern, sheets, signal, onPlan }));
  if (task.explore) return tellPlans(task, found.plans, signal);
  const { drawing, plan } = chosenOf(task, found);
  await writeWhole(await patternFiles(task, drawing, plan), signal);
  reportPattern(task, drawing, plan);
}

/**
 * Says how the fit went.
 * @param {Task} task
 * @param {import('../types.js').MeshSurface} surface
 * @param {Mesh} mesh
 */
function tell(task, { report }, mesh) {
  succeed(task.output, meshFitInWords(report));
  if (report.stopReason === 'noNoise') {
    say(`${task.input} has no noise that is worth removing: it is left as it is (a number for --lambda smooths it all the same)`);
  } else if (task.command !== 'fit') {
    const off = report.sigma === undefined ? '' : `; its vertices are off a smooth surface by ${Number(report.sigma.toPrecision(2))} in the file's unit`;
    say(`${task.input} has no exact faces, so that it is fitted first${off} (--as-is leaves its vertices where they are)`);
  }
  if (report.stopReason === 'maxIterations') {
    toStderr('developable: warning: stopped before the wanted gap; --max-iterations allows more\n');
  } else if (report.stopReason === 'diverged') {
    toStderr('developable: warning: the iterations diverged; this is the best surface before\n');
  }
  const { turned, degenerate, repeated, branched } = report.repairs;
  if (branched > 0) say(`edges of ${task.input} with three triangles or more are borders of each: ${branched}`);
  const mended = Object.entries({ 'on the wrong side': turned, 'with two corners at one place': degenerate, 'there twice': repeated });
  const found = mended.filter(([, count]) => count > 0).map(([what, count]) => `${count} ${what}`).join(', ');
  if (found) toStderr(`developable: warning: triangles of ${task.input} that are mended for the fit: ${found}\n`);
  const fitted = task.command === 'fit' ? task.output : 'the fitted surface';
  const [first] = report.entangled;
  if (first) {
    const place = first.position.map((x) => Number(x.toPrecision(4))).join(', ');
    toStderr(
      `developable: warning: ${counted(report.entangled.length, 'triangle')} of ${fitted} folded over or across others, as far as the noise ` +
        `tells; the first is number ${first.triangle}, at (${place})${task.command === 'fit' ? '; report.entangled has all' : ''}\n`,
    );
  } else if (report.flipped[1] > 0) {
    toStderr(`developable: warning: ${counted(report.flipped[1], 'triangle')} of ${fitted} folded over (${percent(report.flipped[1] / (mesh.triangles.length / 3))})\n`);
  }
}
