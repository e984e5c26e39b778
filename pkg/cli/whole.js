/** `developable fit --surface`: a mesh as it is, without a view. */
import * as developable from '../index.js';
import { checkPlaces, writeWhole } from './files.js';
import { readMesh } from './inputs.js';
import { announceMesh, percent, progressLine } from './terminal.js';

/**
 * @param {import('./arguments.js').MeshTask} task
 * @param {AbortSignal} signal
 */
export async function whole(task, signal) {
  await checkPlaces(...task.written);
  const mesh = await readMesh({ ...task, lattice: 'mesh', normalize: true });
  const line = progressLine();
  const surface = await developable
    .fitMesh(mesh, { ...task.options, signal, onProgress: line.shown ? line.show : undefined })
    .finally(() => line.clear());
  const { report } = surface;
  const files = [{ path: task.output, bytes: await encode(task.extension, surface) }];
  if (task.report !== undefined) {
    files.push({ path: task.report, bytes: new TextEncoder().encode(`${JSON.stringify(report, undefined, 2)}\n`) });
  }
  await writeWhole(files, signal);
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
 * @param {import('../types.js').MeshSurface} surface
 */
function encode(extension, surface) {
  switch (extension) {
    case '.obj': return developable.writeObj(surface);
    case '.ply': return developable.writePly(surface);
    case '.stl': return developable.writeStl(surface);
    default: return developable.writeGlb(surface);
  }
}
