/**
 * `npm run consumers`: tries the packed package with the tools that people use; `npm run consumers --
 * NAME...` with those whose name contains one of the words. The tools are those of
 * tests/consumers/package-lock.json and are installed in target/consumers/.
 */
import { cp, mkdir, readFile, rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { browser } from './setup/browser.mjs';
import { root, pkg } from './util/paths.mjs';
import { describe, main, Problem } from './util/problem.mjs';
import { succeed } from './util/process.mjs';
import { trials } from './consumers/trials.mjs';

const folder = join(root, 'target/consumers');

/** Time that a part of the installation may take. */
const MAX_SECONDS = 600;

await main(async () => {
  const words = process.argv.slice(2);
  const chosen = trials.filter(({ name }) => words.length === 0 || words.some((word) => name.includes(word)));
  if (chosen.length === 0) {
    throw new Problem(`No trial has such a name: there are ${trials.map(({ name }) => name).join(', ')}.`);
  }
  const { chrome } = await browser();
  if (!chrome) throw new Problem('No Chromium or Chrome was found: CHROME can name one.');
  await install();

  const rows = [];
  for (const { name, tool, run: attempt } of chosen) {
    process.stdout.write(`${name}... `);
    const result = await attempt({ folder, chrome }).then((remark) => remark || 'works', (error) => {
      process.exitCode = 1;
      return `FAILED: ${describe(error)}`;
    });
    console.log(result);
    rows.push({ trial: name, version: await version(tool), result: result.split('\n')[0] });
  }
  console.table(rows);
});

/** The tools, and the package as npm would pack it. */
async function install() {
  await mkdir(folder, { recursive: true });
  for (const name of ['app', 'hosted', 'next', 'own']) await rm(join(folder, name), { recursive: true, force: true });
  await cp(join(root, 'tests/consumers'), folder, { recursive: true });
  const lock = await readFile(join(folder, 'package-lock.json'), 'utf8');
  const installed = await readFile(join(folder, 'node_modules/.installed'), 'utf8').catch(() => '');
  if (lock !== installed) {
    console.log('- The tools, into target/consumers (about 1 minute, 700 MB)');
    // Not `npm ci`, which insists on the programs for all other systems, too, and not all mirrors have them.
    await succeed('npm', ['install', '--ignore-scripts', '--no-audit', '--no-fund'], { cwd: folder, limit: MAX_SECONDS });
    // Puts its program, which npm has brought, in its place.
    await succeed(process.execPath, ['install.js'], { cwd: join(folder, 'node_modules/bun'), limit: MAX_SECONDS });
    await writeFile(join(folder, 'node_modules/.installed'), lock);
  }
  const output = await succeed('npm', ['pack', '--json', '--pack-destination', folder], { cwd: pkg, limit: MAX_SECONDS });
  const [{ filename }] = JSON.parse(output.slice(output.indexOf('[')));
  const place = join(folder, 'node_modules/developable');
  await rm(place, { recursive: true, force: true });
  await mkdir(place);
  await succeed('tar', ['-xzf', join(folder, filename), '--strip-components=1', '-C', place]);
}

/** @param {string} tool a package, or nothing for Node itself */
async function version(tool) {
  if (tool === 'node') return process.versions.node;
  if (tool === 'chromium') return 'Chromium';
  return JSON.parse(await readFile(join(folder, 'node_modules', tool, 'package.json'), 'utf8')).version;
}
