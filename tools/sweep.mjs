/**
 * `node tools/sweep.mjs FOLDER...`: runs `info` and `fit` on each file below the folders, and prints a table of what was read and
 * assumed. It shows at a glance what other programs' files come to.
 */
import { execFile } from 'node:child_process';
import { mkdtemp, readdir, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { extname, join, relative } from 'node:path';
import { pkg } from './util/paths.mjs';
import { main, Problem } from './util/problem.mjs';

/** Time that one call of the command may take, in milliseconds. */
const TIMEOUT_MS = 60_000;

/** Endings of meshes, which are fitted whole. */
const MESH_ENDING = /\.(obj|ply|stl|gltf|glb|3mf|off)$/i;

/** Endings of files that only go with others. */
const COMPANION_ENDING = /\.(mtl|bin|md|txt|json|mjs|py|license)$/i;

await main(async () => {
  const folders = process.argv.slice(2);
  if (folders.length === 0) throw new Problem('Name one or more folders: node tools/sweep.mjs FOLDER...');
  const output = await mkdtemp(join(tmpdir(), 'developable-sweep-'));
  console.log('| file | info | assumed | fit |\n|---|---|---|---|');
  try {
    for (const folder of folders) {
      for (const entry of (await readdir(folder, { recursive: true, withFileTypes: true })).sort((a, b) => (a.name < b.name ? -1 : 1))) {
        const path = join(entry.parentPath, entry.name);
        if (entry.isFile() && !COMPANION_ENDING.test(path)) console.log(await row(path, relative(folder, path), output));
      }
    }
  } finally {
    await rm(output, { recursive: true, force: true });
  }
});

/**
 * @param {string} path
 * @param {string} name
 * @param {string} folder of what is written
 */
async function row(path, name, folder) {
  const info = await call(['info', path]);
  const lines = info.stdout.split('\n');
  const value = (/** @type {string} */ key) => lines.filter((line) => line.startsWith(`${key}:`)).map((line) => line.slice(14).trim());
  const told = info.status === 0 ? [...value('format'), ...value('size'), ...value('values'), ...value('vertices'), ...value('unit')].join(', ') : failure(info);
  const fit = await call(MESH_ENDING.test(path)
    ? ['fit', path, '--surface', '-o', join(folder, 'out.obj')]
    : ['fit', path, '-o', join(folder, `out${extname(path) === '.npy' ? '.npy' : '.tif'}`)]);
  return `| ${[name, told, value('assumed').join('; '), fit.status === 0 ? 'done' : failure(fit)].map(cell).join(' | ')} |`;
}

/** @param {string} text */
function cell(text) {
  return text.replaceAll('|', '\\|').replaceAll('\n', ' ');
}

/** @param {{ status: number | string, stderr: string }} ended */
function failure({ status, stderr }) {
  const reason = stderr.split('\n').findLast((line) => line.startsWith('developable: ')) ?? stderr.trim();
  return `${status}: ${reason.replace('developable: ', '')}`;
}

/**
 * @param {string[]} args
 * @returns {Promise<{ status: number | string, stdout: string, stderr: string }>}
 */
function call(args) {
  return new Promise((resolve) => {
    execFile(process.execPath, [join(pkg, 'bin/developable.js'), ...args], { timeout: TIMEOUT_MS }, (error, stdout, stderr) => {
      const status = error === null ? 0 : error.killed ? 'took too long' : error.code ?? 'failed';
      resolve({ status, stdout, stderr });
    });
  });
}
