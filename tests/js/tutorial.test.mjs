/** The commands of docs/patterns.md, as they stand there. */
import assert from 'node:assert/strict';
import { readFile, readdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { run, temporaryFolder } from './support/command.mjs';
import { readDxf, readPdf } from './support/drawings.mjs';
import { image } from './support/shapes.mjs';

test('a tutorial that does what it says', async () => {
  await direct.init();
  await direct.load('files', 'images');
  const folder = await temporaryFolder();
  // A hipped roof with a lower wing, measured with some noise.
  const noise = (/** @type {number} */ x, /** @type {number} */ y) => 0.05 * Math.sin(51 * x + 37 * y) * Math.sin(83 * x - 29 * y);
  const roof = image(72, 60, (x, y) => {
    const [u, v] = [Math.abs(x - 35.3), Math.abs(y - 30.4)];
    return 20 - 0.7 * Math.max(v, u - 12) + noise(x, y);
  });
  await writeFile(join(folder, 'scan.tif'), direct.writeImage(roof, { format: 'tiff' }));
  // A channel, for metal.
  const box = image(72, 60, (x) => 20 - 0.9 * Math.max(Math.abs(x - 35.3) - 14, 0));
  await writeFile(join(folder, 'box.tif'), direct.writeImage(box, { format: 'tiff' }));
  const text = await readFile(new URL('../../docs/patterns.md', import.meta.url), 'utf8');
  const commands = [...text.matchAll(/^```sh\n([\s\S]*?)^```/gm)].flatMap(([, lines]) => lines.trim().split('\n'));
  assert.equal(commands.length, 7);
  const told = [];
  for (const line of commands) {
    const [npx, name, ...args] = line.split(' ');
    assert.deepEqual([npx, name], ['npx', 'developable']);
    const done = await run(folder, args);
    assert.equal(done.status, 0, `${line}: ${done.stderr}`);
    told.push(done);
  }
  assert.match(told[1].stdout, /^lambda +smallest +sheets/);
  const files = await readdir(folder);
  for (const file of ['model.pdf', 'model.glb', 'model.json', 'model.svg', 'numbered.svg', 'model.dxf', 'cloth.svg', 'box.dxf']) {
    assert.ok(files.includes(file), file);
  }
  const { sheets, a4, assembly, strain } = JSON.parse(await readFile(join(folder, 'model.json'), 'utf8'));
  assert.ok(sheets <= 12 && strain <= 0.01);
  assert.equal(assembly.length, sheets);
  assert.equal((await readPdf(await readFile(join(folder, 'model.pdf')))).length, a4);
  assert.ok(readDxf(await readFile(join(folder, 'model.dxf'))).layers.CUT.length >= sheets);
});
