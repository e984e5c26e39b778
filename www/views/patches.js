/** The view of the patches, each in a colour, and of the creases between them, of heights and meshes. */
import { make } from '../dom.js';
import { areaUnit, count, number, percent } from '../format.js';
import { CREASE_COLOUR, toCss, patchColour, PATCH_COLOURS } from '../surface/colours.js';
import { nearestVertex } from '../surface/lattice.js';
import { colouredBy } from '../surface/layer.js';
import { figures, key } from './legend.js';

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

/** The patches and creases of heights. @param {Input} input @param {import('../../pkg/types.js').PatchMap} map @returns {ViewContent} */
export function patchesOfHeights({ unit }, map) {
  const { creases, labels, patches } = map;
  /** @param {number} x @param {number} y */
  const labelAt = (x, y) => {
    const vertex = nearestVertex(map, x, y);
    // At the border the nearest vertex may have no label while a neighbour has one.
    const near = vertex < 0 ? [] : [vertex, vertex - 1, vertex + 1];
    return near.map((one) => labels[one]).find((label) => label >= 0) ?? NaN;
  };
  return {
    layers: [undefined, { surface: colouredBy((_, x, y) => labelAt(x, y), patchColour), lines: creaseLines(creases), read: ({ point: [x, y] }) => patchInWords(labelAt(x, y)) }],
    about: aboutPatches(patches, creases.length, unit),
  };
}

/**
 * The patches of a mesh.
 * @param {Pick<Mesh, 'unit'>} mesh
 * @param {import('../../pkg/types.js').MeshPatchMap} found
 * @returns {ViewContent}
 */
export function patchesOfMesh({ unit }, { labels, patches, creases }) {
  const colour = colouredBy((corner) => (labels[Math.floor(corner / 3)] < 0 ? NaN : labels[Math.floor(corner / 3)]), patchColour);
  return {
    layers: [undefined, {
      // Triangles share no corners here, since patches end between triangles.
      surface: ({ triangles, positions }) => colour({
        triangles: Uint32Array.from(triangles, (_, i) => i),
        positions: Float64Array.from({ length: 3 * triangles.length }, (_, i) => positions[3 * triangles[Math.floor(i / 3)] + (i % 3)]),
      }),
      lines: creaseLines(creases),
      read: ({ triangle }) => patchInWords(labels[triangle]),
    }],
    about: aboutPatches(patches, creases.length, unit),
  };
}

/** Lines along creases, wider where the fold angle is larger. @param {readonly Pick<import('../../pkg/types.js').Crease, 'points' | 'fold'>[]} creases */
const creaseLines = (creases) => creases.map(({ points, fold }) => ({ points, colour: CREASE_COLOUR, width: 1 + 2 * Math.min(1, fold) }));

/** @param {number} label negative or NaN for none */
const patchInWords = (label) => (label >= 0 ? `patch ${count(label + 1)}` : '');
