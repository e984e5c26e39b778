/** `--surface`: a mesh as it is, without a view, fitted and what is made of it. */
import * as developable from '../index.js';
import { checkPlaces, writeWhole } from './files.js';
import { readMesh } from './inputs.js';
import { drawn, flatObj, json, linesObj, plainArrays, reportFit, reportSlits } from './sheets.js';
import { announceMesh, percent, print, progressLine } from './terminal.js';

/**
 * @typedef {import('./arguments.js').MeshTask} MeshTask
 * @typedef {import('../types.js').Mesh} Mesh
 * @typedef {{ path: string, bytes: Uint8Array }} File
 */

/**
 * @param {MeshTask} task
 * @param {AbortSignal} signal
 */
export async function whole(task, signal) {
  await checkPlaces(...task.written);
  const mesh = await readMesh({ ...task, lattice: 'mesh', normalize: true });
  const surface = task.asIs ? undefined : await fitted(task, mesh, signal);
  const files = await made[task.make](task, surface ?? mesh, mesh);
  const shown = task.output === '' ? files.shift() : undefined;
  await writeWhole(files, signal);
  if (surface !== undefined) tell(task, surface, mesh);
  if (shown !== undefined) await print(new TextDecoder().decode(shown.bytes));
}

/**
 * @param {MeshTask} task
 * @param {Mesh} mesh
 * @param {AbortSignal} signal
 */
function fitted(task, mesh, signal) {
  const line = progressLine();
  return developable
    .fitMesh(mesh, { ...task.options, signal, onProgress: line.shown ? line.show : undefined })
    .finally(() => line.clear());
}

/** What each command writes. @type {Record<MeshTask['make'], (task: MeshTask, surface: Mesh, mesh: Mesh) => Promise<File[]>>} */
const made = {
  async fit({ output, extension, report: path }, surface) {
    const { report } = /** @type {import('../types.js').MeshSurface} */ (surface);
    return [{ path: output, bytes: await encode(extension, surface) }, ...(path === undefined ? [] : [{ path, bytes: json(report) }])];
  },

  async analyze({ output, asIs, threshold }, surface, mesh) {
    const figures = { input: (await developable.analyzeMesh(mesh, { threshold })).summary };
    const after = asIs ? {} : { output: (await developable.analyzeMesh(surface, { threshold })).summary };
    return [{ path: output, bytes: json({ ...figures, ...after }) }];
  },

  async rulings({ output, extension, report: path, tracing }, surface) {
    const { lines } = await developable.meshRulings(surface, tracing);
    const report = json({ lines });
    const bytes = extension === '.obj' ? linesObj(lines) : report;
    return [{ path: output, bytes }, ...(path === undefined ? [] : [{ path, bytes: report }])];
  },

  async unroll({ output, extension, report: path, laying }, surface) {
    const sheets = await developable.unrollMesh(surface, laying);
    const { patches, creases, report } = sheets;
    const bytes = extension === '.obj' ? flatObj(sheets) : json(plainArrays(sheets));
    return [{ path: output, bytes }, ...(path === undefined ? [] : [{ path, bytes: json({ ...report, patches, creases }) }])];
  },

  async pattern({ output, extension, report, laying, drawing, assembly: path }, surface) {
    const told = path !== undefined || report !== undefined;
    const pattern = await developable.patternMesh(surface, { ...laying, ...drawing, assembly: told });
    const files = [{ path: output, bytes: await drawn(pattern, extension) }];
    const { assembly, summary } = pattern;
    if (report !== undefined) files.push({ path: report, bytes: json({ ...summary, assembly: assembly?.steps }) });
    if (path !== undefined && assembly !== undefined) {
      files.push({ path, bytes: path.toLowerCase().endsWith('.svg') ? assembly.picture : assembly.model });
    }
    reportFit(pattern);
    reportSlits(summary);
    return files;
  },
};

/**
 * Says how the fit went.
 * @param {MeshTask} task
 * @param {import('../types.js').MeshSurface} surface
 * @param {Mesh} mesh
 */
function tell(task, { report }, mesh) {
  announceMesh(task.output, report);
  if (report.stopReason === 'maxIterations') {
    process.stderr.write('developable: warning: stopped before the wanted gap; --max-iterations allows more\n');
  } else if (report.stopReason === 'diverged') {
    process.stderr.write('developable: warning: the iterations diverged; this is the best surface before\n');
  }
  const { turned, degenerate, repeated } = report.repairs;
  if (turned + degenerate + repeated > 0) {
    process.stderr.write(
      `developable: warning: ${task.input} was mended for the fit: ${turned} triangles faced the wrong side, ${degenerate} had ` +
        `two corners at one place, ${repeated} were there twice\n`,
    );
  }
  if (report.flipped[1] > 0) {
    process.stderr.write(
      `developable: warning: ${report.flipped[1]} triangles of ${task.output} are folded over (${percent(report.flipped[1] / (mesh.triangles.length / 3))})\n`,
    );
  }
}

/**
 * @param {import('./arguments.js').Extension} extension
 * @param {Mesh} surface
 */
function encode(extension, surface) {
  switch (extension) {
    case '.obj': return developable.writeObj(surface);
    case '.ply': return developable.writePly(surface);
    case '.stl': return developable.writeStl(surface);
    default: return developable.writeGlb(surface);
  }
}
