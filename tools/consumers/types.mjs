/** The package's types, in a strict program, with each way of finding modules. */
import { mkdir, readFile, rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';

/** Each with the oldest standard library that suits it; what is not said has its default. */
export const resolutions = [
  { module: 'esnext', moduleResolution: 'bundler' },
  { module: 'node16', moduleResolution: 'node16' },
  { module: 'nodenext', moduleResolution: 'nodenext' },
];

/** Strict, the package's own declarations included. */
export const compilerOptions = {
  strict: true, exactOptionalPropertyTypes: true, noUncheckedIndexedAccess: true, noEmit: true, skipLibCheck: false,
  target: 'es2022', lib: ['es2022', 'dom'], types: [],
};

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
    for (const resolution of resolutions) {
      const config = { compilerOptions: { ...compilerOptions, ...resolution }, files: Object.keys(files) };
      await writeFile(join(place, 'tsconfig.json'), JSON.stringify(config));
      const { ok, output } = await run(process.execPath, [`node_modules/${tool}/bin/tsc`, '-p', 'types'], { cwd: folder });
      if (!ok) throw new Problem(`${resolution.moduleResolution}: ${output}`);
    }
    return `works with ${resolutions.map(({ moduleResolution }) => moduleResolution).join(', ')}`;
  };
}
