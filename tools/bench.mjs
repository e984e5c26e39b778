/**
 * `npm run bench`: how fast it is, always as ratios of things measured in the same run;
 * `npm run bench -- NAME...` makes some of the tables, `--peers` those with other programs, `--quick` smaller ones;
 * `--write` writes the document of all tables.
 */
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { parse } from './bench/arguments.mjs';
import { Bench, buildNative } from './bench/bench.mjs';
import { machine } from './bench/machine.mjs';
import { document, documentTables, tables } from './bench/tables.mjs';
import { rule } from './bench/task.mjs';
import { asMarkdown, asText } from './bench/text.mjs';
import { build } from './build.mjs';
import { inTemporaryFolder } from './util/folders.mjs';
import { root } from './util/paths.mjs';
import { main } from './util/problem.mjs';

await main(async () => {
  const { quick, names, write } = parse(process.argv.slice(2));
  await build();
  await buildNative();

  const start = performance.now();
  const where = await machine();
  /** @type {Record<string, import('./bench/text.mjs').Table>} */
  const made = {};
  await inTemporaryFolder(async (folder) => {
    const bench = new Bench(folder, quick);
    for (const name of names) made[name] = await tables[name](bench);
  });

  for (const table of Object.values(made)) console.log(asText(table));
  for (const { summary } of Object.values(made)) if (summary) console.log(summary);
  console.log(`\n${where}\n${((performance.now() - start) / 1000).toFixed(0)} s`);
  if (write) await writeFile(join(root, document.path), page(where, Object.keys(documentTables).map((name) => made[name])));
});

/**
 * The document of tables, with what they come to at its head.
 * @param {string} where
 * @param {import('./bench/text.mjs').Table[]} made
 */
function page(where, made) {
  const date = new Date().toISOString().slice(0, 10);
  const summaries = made.flatMap(({ summary }) => (summary ? [`- ${summary}`] : []));
  const head = `# ${document.title}

Written by \`npm run bench -- --write\` on ${date}: ${where}.

${[...summaries, ''].join('\n')}
Times change from machine to machine; what to look at are the ratios, all of which were measured in
one run. Each measurement has a process of its own and is ${rule}. Everything runs in one thread.
Inputs are the library's own examples under noise, so that nothing else is needed to repeat this.
`;
  return [head.trimEnd(), ...made.map(asMarkdown)].join('\n\n').concat('\n');
}
