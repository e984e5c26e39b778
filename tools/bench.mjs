/**
 * `npm run bench`: how fast it is, always as ratios of things measured in the same run;
 * `npm run bench -- NAME...` makes some of the tables, `--quick` smaller ones, `--write` writes
 * BENCHMARKS.md, and `--input FILE` adds a file of your own.
 */
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parse } from './bench/arguments.mjs';
import { Bench, buildNative } from './bench/bench.mjs';
import { machine } from './bench/machine.mjs';
import { tables } from './bench/tables.mjs';
import { rule } from './bench/task.mjs';
import { asMarkdown, asText } from './bench/text.mjs';
import { build } from './build.mjs';
import { root } from './util/paths.mjs';
import { main } from './util/problem.mjs';

await main(async () => {
  const { quick, write, names, file } = parse(process.argv.slice(2));
  await build();
  await buildNative();

  const start = performance.now();
  const where = await machine();
  const folder = await mkdtemp(join(tmpdir(), 'developable-bench-'));
  const made = [];
  try {
    const bench = new Bench({ folder, quick, file });
    for (const name of names) made.push(await tables[name](bench));
  } finally {
    await rm(folder, { recursive: true, force: true });
  }

  for (const table of made) console.log(asText(table));
  console.log(`\n${where}\n${((performance.now() - start) / 1000).toFixed(0)} s`);
  if (write) {
    const choices = await readFile(join(root, 'benches/choices.md'), 'utf8');
    await writeFile(join(root, 'BENCHMARKS.md'), page(where, made, choices));
  }
});

/**
 * @param {string} where
 * @param {import('./bench/text.mjs').Table[]} made
 * @param {string} choices what is not made anew
 */
function page(where, made, choices) {
  const date = new Date().toISOString().slice(0, 10);
  const head = `# Benchmarks

Written by \`npm run bench -- --write\` on ${date}: ${where}.

Times change from machine to machine; what to look at are the ratios, all of which were measured in
one run. Each measurement has a process of its own and is ${rule}. Everything runs in one thread.
Inputs are the library's own examples under noise, so that nothing else is needed to repeat this.
`;
  return [head.trimEnd(), ...made.map(asMarkdown), choices.trimEnd()].join('\n\n').concat('\n');
}
