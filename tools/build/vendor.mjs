/** comlink, copied into the package with its types and licence: the package has no dependencies. */
import { copyFile, mkdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { pkgVendor, root } from '../util/paths.mjs';

const from = join(root, 'node_modules/comlink');

export async function buildVendor() {
  await mkdir(pkgVendor, { recursive: true });
  for (const name of ['comlink.mjs', 'node-adapter.mjs']) {
    const text = await readFile(join(from, 'dist/esm', name), 'utf8');
    // The source map is not copied along.
    await writeFile(join(pkgVendor, name), text.replace(/^\/\/# sourceMappingURL=.*\n?/m, ''));
  }
  await copyFile(join(from, 'dist/esm/comlink.d.ts'), join(pkgVendor, 'comlink.d.mts'));
  await copyFile(join(from, 'dist/esm/node-adapter.d.ts'), join(pkgVendor, 'node-adapter.d.mts'));
  await copyFile(join(from, 'dist/esm/protocol.d.ts'), join(pkgVendor, 'protocol.d.ts'));
  await copyFile(join(from, 'LICENSE'), join(pkgVendor, 'LICENSE-comlink'));
}
