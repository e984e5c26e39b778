/** Inputs that need nothing from outside: the library's examples under noise, as files. */
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';

/**
 * @typedef {import('./task.mjs').Input} Input
 * @typedef {import('../../pkg/types.js').ExampleName} ExampleName
 */

/**
 * Standard deviation of the noise, as a share of the height range. Fidelity and nuclear norm are
 * then of one order; under much more noise the fidelity alone makes any relative gap a small one.
 */
const noise = 0.005;

/** Share of the square over the longer side that has data. */
const shares = { roof: 1, cylinder: 1, cone: 0.724, oloid: 0.398, page: 0.606, house: 0.75 };

/**
 * An example of about so many vertices. Its pixels are taken for the hexagonal lattice's vertices:
 * an affine map of the plane, under which developable surfaces remain what they are, and noise
 * stays independent from vertex to vertex.
 * @param {string} folder
 * @param {ExampleName} name
 * @param {number} vertices
 * @param {Input['lattice']} [lattice]
 * @returns {Promise<Input>}
 */
export async function exampleInput(folder, name, vertices, lattice = 'hex') {
  const { example, init, load, writeImage } = await import('../../pkg/direct.js');
  await init();
  await load('files');
  // On square pixels there is one for each √3/2 vertices.
  const pixels = lattice === 'hex' ? vertices : vertices * Math.sqrt(0.75);
  const size = Math.round(Math.sqrt(pixels / shares[name]));
  const file = join(folder, `${name}-${size}.npy`);
  await writeFile(file, writeImage(example(name, { size, noise }).input));
  // The longer side is 1 already, and other solvers know nothing of normalisation.
  return { file, name, lattice, spacing: 1 / size, noData: null, normalize: false };
}
