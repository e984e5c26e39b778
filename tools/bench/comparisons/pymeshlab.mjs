/** Noisy scenes smoothed by the filters of pymeshlab, beside this library. */
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { native } from '../../util/env.mjs';
import { inTemporaryFolder } from '../../util/folders.mjs';
import { cache, root } from '../../util/paths.mjs';
import { Problem } from '../../util/problem.mjs';
import { run } from '../../util/process.mjs';
import { digits } from '../text.mjs';

/** Scenes that a quick comparison takes. */
const QUICK_SCENES = 6;

/** A filter that takes longer than this over all scenes hangs, in seconds. */
const MAX_SECONDS = 45 * 60;

/**
 * @typedef {object} Filter
 * @property {string} name
 * @property {{ mean: number, largest: number }} normals ours over theirs
 * @property {{ mean: number, largest: number }} distances ours over theirs
 * @property {number} seconds
 * @property {number} ours
 */

/** @param {import('../bench.mjs').Bench} bench */
export async function pymeshlab({ quick }) {
  const python = await environment();
  return inTemporaryFolder(async (folder) => {
    await done('cargo', ['run', '--release', '--locked', '--example', 'scenes', '--', 'meshes', folder]);
    const scenes = quick ? ['--scenes', String(QUICK_SCENES)] : [];
    const file = join(folder, 'summary.json');
    await done(python, [join(root, 'benches/pymeshlab/compare.py'), folder, '--json', file, ...scenes]);
    /** @type {{ version: string, filters: Filter[] }} */
    const { version, filters } = JSON.parse(await readFile(file, 'utf8'));
    const best = filters.reduce((least, filter) => (filter.normals.mean > least.normals.mean ? filter : least));
    return {
      summary: `The best filter of pymeshlab, with its best parameters, leaves ${digits(1 / best.normals.mean)} times the error of normals.`,
      title: 'Filters of pymeshlab',
      text: `Noisy scenes of known shape, smoothed by filters of pymeshlab ${version} with the parameters that are best by the truth, and by `
        + 'this library with none (benches/pymeshlab/compare.py). Ours over theirs: mean error of normals and root mean square of distances, '
        + 'geometric means over the scenes and the largest. Seconds of native code, the choice of λ included.',
      columns: ['filter', 'normals', 'largest', 'distances', 'largest', 'seconds', 'ours'],
      rows: filters.map(({ name, normals, distances, seconds, ours }) => [
        name, ...[normals.mean, normals.largest, distances.mean, distances.largest, seconds, ours].map(digits),
      ]),
    };
  });
}

/** The Python of an environment that has pymeshlab; made once. */
async function environment() {
  const folder = join(cache, 'pymeshlab');
  const python = join(folder, 'bin/python');
  const known = await run(python, ['-c', 'import pymeshlab'], {});
  if (known.ok) return python;
  await done('python3', ['-m', 'venv', folder]);
  await done(python, ['-m', 'pip', 'install', '--quiet', '-r', join(root, 'benches/pymeshlab/requirements.txt')]);
  return python;
}

/**
 * @param {string} command
 * @param {string[]} args
 */
async function done(command, args) {
  const { ok, output, failure } = await run(command, args, { env: native, cwd: root, limit: MAX_SECONDS });
  if (!ok) throw new Problem(`pymeshlab cannot be compared with: ${command} ${args[0]} failed (${failure}). It needs Python 3 with venv, and pip.\n${output}`);
}
