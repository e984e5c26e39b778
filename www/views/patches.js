/** The view of the patches, each in a colour, and of the creases between them, of heights and meshes. */
import { make } from '../dom.js';
import { areaUnit, count, number, percent } from '../format.js';
import { toPixel, CREASE_COLOUR, toCss, patchColour, PATCH_COLOURS } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { canvasFromPixels, valueAt } from '../surface/layer.js';
import { vertexColors } from '../surface/triangles.js';
import { callWorker } from '../surface/worker-client.js';
import { figures, key } from './legend.js';

/** Colour of triangles without a patch. @type {Colour} */
const UNLABELLED_COLOUR = [160, 160, 160];

/**
 * Figures of patches, and a legend of those with a colour of their own.
 * @param {readonly { area: number }[]} patches the largest first
 * @param {number} creases
 * @param {string | null} [unit]
 */
function aboutPatches(patches, creases, unit) {
  const total = patches.reduce((sum, { area }) => sum + area, 0);
  return [
    figures([['Patches', count(patches.length)], ['Creases', count(creases)], ['Area', `${number(total)} ${areaUnit(unit)}`]]),
    make('p', 'keys', ...patches.slice(0, PATCH_COLOURS.length).map(({ area }, i) => key(toCss(patchColour(i)), `${i + 1}: ${percent(area / total)}`))),
  ];
}

/**
 * The patches and creases of heights.
 * @param {Input} input
 * @param {import('../../pkg/types.js').PatchMap} map
 * @returns {Promise<ViewContent>}
 */
export async function patchesOfHeights(input, map) {
  const { creases, rows, cols, spacing, origin } = map;
  const grid = gridOf(input);
  const colours = map.patches.map((_, i) => toPixel(patchColour(i)));
  return {
    layers: [undefined, {
      image: canvasFromPixels(grid, await callWorker('labelPixels', { rows, cols, spacing, origin }, map.labels, grid, colours)),
      lines: creaseLines(creases),
      read: ({ point: [x, y] }) => patchInWords(valueAt({ ...map, values: map.labels }, x, y)),
    }],
    about: aboutPatches(map.patches, creases.length, input.unit),
  };
}

/**
 * The patches of a mesh.
 * @param {Mesh} mesh
 * @param {Pick<import('../../pkg/types.js').MeshUnrolling, 'labels' | 'patches' | 'creases'>} found
 * @returns {ViewContent}
 */
export function patchesOfMesh({ triangles, positions, unit }, { labels, patches, creases }) {
  // Triangles share no corners here, since patches end between triangles.
  const corners = {
    triangles: Uint32Array.from(triangles, (_, i) => i),
    positions: Float64Array.from({ length: 3 * triangles.length }, (_, i) => positions[3 * triangles[Math.floor(i / 3)] + (i % 3)]),
    colors: vertexColors(triangles.length, (i) => {
      const label = labels[Math.floor(i / 3)];
      return label < 0 ? UNLABELLED_COLOUR : patchColour(label);
    }),
  };
  return {
    layers: [undefined, { surface: corners, lines: creaseLines(creases), read: ({ triangle }) => patchInWords(labels[triangle]) }],
    about: aboutPatches(patches, creases.length, unit),
  };
}

/** Lines along creases, wider where the fold angle is larger. @param {readonly Pick<import('../../pkg/types.js').Crease, 'points' | 'fold'>[]} creases */
const creaseLines = (creases) => creases.map(({ points, fold }) => ({ points, colour: CREASE_COLOUR, width: 1 + 2 * Math.min(1, fold) }));

/** @param {number} label negative or NaN for none */
const patchInWords = (label) => (label >= 0 ? `patch ${count(label + 1)}` : '');
