/** The solve that is shown, as a line for the command and as code for the package. */
import { noDataOptions } from './import-interpretation.js';
import { spacingOf } from './session.js';

/** The paper of the method, for BibTeX. */
export const CITATION = `@article{sellan2020developability,
  author = {Sell{\\'a}n, Silvia and Aigerman, Noam and Jacobson, Alec},
  title = {Developability of Heightfields via Rank Minimization},
  journal = {ACM Transactions on Graphics},
  volume = {39}, number = {4}, articleno = {109}, year = {2020},
  doi = {10.1145/3386569.3392419}
}
`;

/** Whether the heights are those of a file or an example. @param {Input} input */
const isUnchanged = ({ sampling, depths }) => !(sampling || depths);

/** The options of `fit` that solve the same, without those that are the package's own. @param {Result} result */
function optionsOf({ input, settings }) {
  const { coarsening, ...options } = settings;
  return {
    ...options,
    ...(coarsening > 1 && spacingOf(input, coarsening)),
  };
}

/** The command that solves the same; null where it cannot read the input: an example, a mesh, depths. @param {Result} result @returns {string | null} */
export function asCommand(result) {
  const { input } = result;
  const { file, name, stored, array, assumptions = [] } = input;
  if (file === undefined || !isUnchanged(input)) return null;
  const { pixelSize, heightScale, noData } = stored ?? {};
  const options = { array: array?.name, pixelSize, heightScale, noData, ...optionsOf(result) };
  // The command assumes the same. Given, a size of pixels would also keep it from resampling those that are not square.
  for (const { option } of assumptions) if (option === 'pixelSize' || option === 'heightScale') options[option] = undefined;
  const flags = Object.entries(options).filter(([, given]) => given !== undefined).map(([option, given]) =>
    `--${option.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)} ${quoted(String(given))}`);
  return ['npx developable fit', quotedPath(file), '-o', quotedPath(`${name}-developable.obj`), ...flags].join(' ');
}

/** A word of a POSIX shell. @param {string} text */
function quoted(text) {
  return /^[\w.+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}

/** A file name as a word of a POSIX shell, which is not taken for a flag. @param {string} path */
function quotedPath(path) {
  return quoted(path.startsWith('-') ? `./${path}` : path);
}

/** Code for the package that solves the same; null where it needs more than a file or an example: a mesh or depths. @param {Result} result @returns {string | null} */
export function asCode(result) {
  const { input } = result;
  const { name, file, example, stored, array } = input;
  if ((file ?? example) === undefined || !isUnchanged(input)) return null;
  const { pixelSize, heightScale, noData } = stored ?? {};
  const reading = { array: array?.name, ...noDataOptions(noData) };
  const options = Object.values(reading).some((value) => value !== undefined) ? `, ${JSON.stringify(reading)}` : '';
  const source = file === undefined
    ? [
      "import { example, fit } from 'developable';",
      `const { input } = await example(${JSON.stringify(name)}, ${JSON.stringify(example)});`,
    ]
    : [
      "import { readFile } from 'node:fs/promises';",
      "import { fit, read } from 'developable';",
      `const image = await read(await readFile(${JSON.stringify(file)})${options});`,
      `const input = { ...image, ...${JSON.stringify({ pixelSize, heightScale })} };`,
    ];
  return [...source, `const surface = await fit(input, ${JSON.stringify(optionsOf(result))});`, ''].join('\n');
}
