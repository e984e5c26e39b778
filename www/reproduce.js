/** The solve that is shown, as a line for the command and as code for the package. */

/** @import {Result} from './session.js' */

/** The settings of a result as options of `fit`, without those that are the package's own. @param {Result} result */
function optionsOf({ settings, surface: { report } }) {
  const { gap, schedule, coarsening, reweighting, occlusionThreshold } = settings;
  return {
    lambda: settings.lambda,
    energy: report.energy,
    gap,
    ...(schedule === 'paper' && { schedule }),
    ...(coarsening > 1 && { spacing: coarsening }),
    ...(reweighting > 0 && { reweighting }),
    ...(occlusionThreshold !== undefined && { occlusionThreshold }),
  };
}

/** How the heights of a file were read, as options. @param {Result} result */
function readingOf({ input: { stored, array } }) {
  return {
    ...(array && { array: array.name }),
    ...(stored && { pixelSize: stored.pixelSize, heightScale: stored.heightScale }),
    ...(stored?.noData !== undefined && { noData: stored.noData }),
    ...(stored?.hexagonal && { lattice: 'hex' }),
  };
}

/** Spacing counts in units of length, and in the page in pixels. @param {Result} result */
function allOptions(result) {
  const { spacing, ...options } = optionsOf(result);
  return { ...options, ...(spacing && { spacing: spacing * result.input.pixelSize }) };
}

/** The command that solves the same; of an example, its heights have to be saved before. @param {Result} result */
export function asCommand(result) {
  const { name, kind = 'npy' } = result.input;
  const flags = Object.entries({ ...readingOf(result), ...allOptions(result) }).map(([key, value]) => {
    const text = /^[\w.+-]+$/.test(String(value)) ? value : `'${String(value).replaceAll("'", "'\\''")}'`;
    return `--${key.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)} ${text}`;
  });
  const stem = `'${name.replaceAll("'", "'\\''")}`;
  return `npx developable fit ${stem}.${kind.toLowerCase()}' -o ${stem}-developable.obj' ${flags.join(' ')}`;
}

/** Code for the package that solves the same. @param {Result} result @param {{ size: number, noise: number }} example */
export function asCode(result, example) {
  const { name, kind } = result.input;
  const { array, ...reading } = /** @type {Record<string, unknown>} */ (readingOf(result));
  const input = kind === undefined
    ? [`const { input } = await example(${JSON.stringify(name)}, ${JSON.stringify(example)});`]
    : [
      `const image = await read(await readFile(${JSON.stringify(`${name}.${kind.toLowerCase()}`)})${array ? `, ${JSON.stringify({ array })}` : ''});`,
      `const input = { ...image, ...${JSON.stringify(reading)} };`,
    ];
  return [
    ...(kind === undefined ? [] : ["import { readFile } from 'node:fs/promises';"]),
    `import { fit, ${kind === undefined ? 'example' : 'read'} } from 'developable';`,
    ...input,
    `const surface = await fit(input, ${JSON.stringify(allOptions(result))});`,
    '',
  ].join('\n');
}
