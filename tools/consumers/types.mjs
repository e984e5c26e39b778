/** The package's types, in a strict program, with each way of finding modules. */
import { mkdir, readFile, rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';

/** How modules are found. */
const resolutions = [
  { module: 'esnext', moduleResolution: 'bundler' },
  { module: 'node16', moduleResolution: 'node16' },
  { module: 'nodenext', moduleResolution: 'nodenext' },
];

/** The oldest standard libraries that will do: a browser's alone, and Node's alone, which has no namespace `WebAssembly`. */
const libraries = [
  { name: 'dom', lib: ['es2022', 'dom'], types: [] },
  { name: 'node', lib: ['es2022'], types: ['node'], typeRoots: [join(root, 'node_modules/@types')] },
];

/** Strict, the package's own declarations included. */
const strict = {
  strict: true, exactOptionalPropertyTypes: true, noUncheckedIndexedAccess: true, noEmit: true, skipLibCheck: false, target: 'es2022',
};

/** Each way of finding modules with each library. @returns {{ name: string, compilerOptions: object }[]} */
export function configurations() {
  return resolutions.flatMap((resolution) =>
    libraries.map(({ name, ...library }) => ({
      name: `${resolution.moduleResolution} with ${name}`,
      compilerOptions: { ...strict, ...library, ...resolution },
    })));
}

/**
 * The first example of the README, and uses of all else there are types of.
 * @param {string} folder where the package is installed
 */
export async function program(folder) {
  const manual = join(folder, 'node_modules/developable');
  const readme = await readFile(join(manual, 'README.md'), 'utf8');
  const example = /```js\n([^]*?)```/.exec(readme)?.[1];
  if (!example) throw new Problem('the README has no example');
  /** @type {{ exports: Record<string, unknown> }} */
  const { exports } = JSON.parse(await readFile(join(manual, 'package.json'), 'utf8'));
  const paths = Object.keys(exports).filter((path) => path !== './package.json');
  const imports = paths.map((path, i) => `import * as _${i} from '${path.replace('.', 'developable')}';`);
  return {
    'readme.ts': example,
    'paths.ts': `${imports.join('\n')}\nexport default [${imports.map((_, i) => `_${i}`).join(', ')}];\n`,
  };
}

/** @param {string} tool a version of TypeScript */
export function typesWith(tool) {
  /** @param {{ folder: string }} context */
  return async ({ folder }) => {
    const place = join(folder, 'types');
    await rm(place, { recursive: true, force: true });
    await mkdir(place);
    await writeFile(join(place, 'package.json'), '{ "type": "module" }\n');
    const files = await program(folder);
    for (const [name, text] of Object.entries(files)) await writeFile(join(place, name), text);
    const tried = configurations();
    for (const { name, compilerOptions } of tried) {
      await writeFile(join(place, 'tsconfig.json'), JSON.stringify({ compilerOptions, files: Object.keys(files) }));
      const { ok, output } = await run(process.execPath, [`node_modules/${tool}/bin/tsc`, '-p', 'types'], { cwd: folder });
      if (!ok) throw new Problem(`${name}: ${output}`);
    }
    return `works with ${tried.map(({ name }) => name).join(', ')}`;
  };
}
