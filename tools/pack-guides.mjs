/**
 * The guides in the package while it is packed: docs/ without links to what is not packed, and a README whose links lead there.
 * `--undo` takes both back.
 */
import { mkdir, readFile, readdir, rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { pkg, root } from './util/paths.mjs';

const readme = join(pkg, 'README.md');
const guides = join(pkg, 'docs');
const [inClone, inPackage] = ['](../docs/', '](docs/'];
const undo = process.argv.includes('--undo');
const [from, to] = undo ? [inPackage, inClone] : [inClone, inPackage];

await rm(guides, { recursive: true, force: true });
if (!undo) {
  await mkdir(guides);
  for (const name of (await readdir(join(root, 'docs'))).filter((one) => one.endsWith('.md'))) {
    const text = await readFile(join(root, 'docs', name), 'utf8');
    await writeFile(join(guides, name), text.replace(/!?\[([^\]]*)\]\((?:\.\.\/(?!README)[^)]*|[^):]*\.png)\)/g, '$1'));
  }
}
await writeFile(readme, (await readFile(readme, 'utf8')).replaceAll(from, to));
