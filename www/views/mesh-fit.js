/** The views of a whole mesh and its result. */
import { count, number, numberAgainst, percent, strainInWords } from '../format.js';
import { COLOUR_SCALE_QUANTILE, divergingColour, logarithmicScale, magnitudeQuantile, patchColour } from '../surface/colours.js';
import { canvasFromPixels } from '../surface/layer.js';
import { imagePicture } from '../surface/picture-view.js';
import { callWorker } from '../surface/worker-client.js';
import { MESH_FIT_WORDS } from '../messages.js';
import { figures } from './legend.js';
import { aboutPatches } from './patches.js';
import { rulingContent } from './rulings.js';
import { strainColours } from './sheet.js';

/** @import {Mesh} from '../api.js' */
/** @import {Colour} from '../surface/colours.js' */
/** @import {Line} from '../surface/layer.js' */
/** @import {Picture} from '../surface/picture-view.js' */
/** @import {MeshSurface, MeshFit, Tell} from '../mesh-fit.js' */

/** @typedef {NonNullable<ReturnType<import('../surface/scene.js').SceneView['pick']>>} Place */

/**
 * @typedef {object} MeshViewContent
 * @property {Mesh} before
 * @property {Mesh} [after]
 * @property {readonly Line[]} [lines] lines on `after`
 * @property {Picture} [flat] picture in place of both meshes
 * @property {(place: Place) => string} [read] the value at a place, with its name and unit
 * @property {string} [said] sentence below the view
 * @property {import('./legend.js').Colours} [colours]
 * @property {readonly Node[]} [about] further elements below the view
 */

/** @param {MeshFit} whole @param {Mesh} mesh @param {MeshSurface} surface @returns {Promise<MeshViewContent>} */
export async function shaded(whole, mesh, surface) {
  // Without noise the result is the input.
  return { before: mesh, after: surface.report.stopReason === 'noNoise' ? undefined : surface, about: [figures(meshFacts(surface))] };
}

/** @param {MeshFit} whole @param {Mesh} mesh @param {MeshSurface} surface @returns {Promise<MeshViewContent>} */
export async function gaussian(whole, mesh, surface) {
  const [before, after] = await Promise.all([whole.curvatures(mesh), whole.curvatures(surface)]);
  const { size, threshold } = after.summary;
  const area = size ** 2;
  const inverse = `1/${mesh.unit ?? 'unit'}²`;
  const scale = logarithmicScale(1 / area, magnitudeQuantile([before.gaussian, after.gaussian], COLOUR_SCALE_QUANTILE));
  /** @param {Float64Array} values @param {Mesh} of */
  const coloured = (values, of) => ({ ...of, colors: vertexColors(values.length, (i) => divergingColour(Number.isNaN(values[i]) ? 0 : scale.place(values[i]))) });
  return {
    before: coloured(before.gaussian, mesh),
    after: coloured(after.gaussian, surface),
    read: (place) => {
      // At a border only some corners have a value.
      const value = interpolateAt(mesh, place, (vertex) => (place.after ? after : before).gaussian[vertex]);
      return Number.isNaN(value) ? '' : `K ${numberAgainst(value, 1 / area)} ${inverse}`;
    },
    colours: { title: `Gaussian curvature K in ${inverse}; figures: input → result`, scale },
    about: [
      figures([
        [`Median |K| in ${inverse}`, `${numberAgainst(before.summary.medianGaussian / area, 1 / area)} → ${numberAgainst(after.summary.medianGaussian / area, 1 / area)}`],
        // Flat faces bend at their corners only, where all vertices are.
        ...(after.summary.gaussianAbove === 1 ? [] : [/** @type {const} */ ([`|K| above ${number(threshold / area, 2)}`, `${percent(before.summary.gaussianAbove)} → ${percent(after.summary.gaussianAbove)}`])]),
      ]),
    ],
  };
}

/** @param {MeshFit} whole @param {Mesh} mesh @param {MeshSurface} surface @returns {Promise<MeshViewContent>} */
export async function rulings(whole, mesh, surface) {
  const { lines } = await whole.rulings(surface);
  return { before: mesh, after: surface, ...rulingContent(lines, mesh.unit) };
}

/** @param {MeshFit} whole @param {Mesh} mesh @param {MeshSurface} surface @param {Tell} tell @returns {Promise<MeshViewContent>} */
export async function patches(whole, mesh, surface, tell) {
  const { labels, patches: found, creases } = await whole.unrolled(surface, tell);
  const { triangles, positions } = surface;
  // Triangles share no corners here, since patches end between triangles.
  const corners = {
    triangles: Uint32Array.from(triangles, (_, i) => i),
    positions: Float64Array.from({ length: 3 * triangles.length }, (_, i) => positions[3 * triangles[Math.floor(i / 3)] + (i % 3)]),
    colors: vertexColors(triangles.length, (i) => {
      const label = labels[Math.floor(i / 3)];
      return label < 0 ? [160, 160, 160] : patchColour(label);
    }),
  };
  return {
    before: mesh,
    after: corners,
    read: ({ after, triangle }) => (after && labels[triangle] >= 0 ? `patch ${count(labels[triangle] + 1)}` : ''),
    about: aboutPatches(found, creases.length, mesh.unit),
  };
}

/** @param {MeshFit} whole @param {Mesh} mesh @param {MeshSurface} surface @param {Tell} tell @returns {Promise<MeshViewContent>} */
export async function sheet(whole, mesh, surface, tell) {
  const { triangles, places, positions, report: { sheets, strain, seamGap } } = await whole.unrolled(surface, tell);
  const picture = await callWorker('meshStrainImage', { triangles, places, positions });
  const { width, height, pixels, extent, maxStrain, values } = picture;
  const unit = mesh.unit ?? 'units';
  const words = `${sheets === 1 ? 'One sheet' : `${count(sheets)} sheets`}, ${number(extent.width, 4)} × ${number(extent.height, 4)} ${unit}`;
  return {
    before: mesh,
    flat: imagePicture(canvasFromPixels({ width, height }, pixels), words, (x, y) => strainInWords(values[Math.floor(y) * width + Math.floor(x)])),
    said: `${words}.`,
    colours: strainColours(maxStrain),
    about: [
      figures([['Largest strain', percent(strain)], ['Seam gap of folds', `${numberAgainst(seamGap, extent.width)} ${unit}`]]),
    ],
  };
}

/**
 * The reading under the pointer: the place, its displacement by the solve, and the value of the view.
 * @param {Mesh} mesh
 * @param {MeshSurface} surface
 * @param {Place} place
 * @param {string} [value]
 */
export function readingAt(mesh, surface, place, value = '') {
  const unit = mesh.unit ?? 'units';
  /** @param {Mesh} of */
  const at = (of) => [0, 1, 2].map((k) => interpolateAt(mesh, place, (vertex) => of.positions[3 * vertex + k]));
  const [before, after] = [at(mesh), at(surface)];
  const xyz = (place.after ? after : before).map((coordinate, k) => `${'xyz'[k]} ${number(coordinate)}`).join(', ');
  const moved = Math.hypot(...after.map((coordinate, k) => coordinate - before[k]));
  return [`${xyz} ${unit}`, `moved by ${numberAgainst(moved, Math.hypot(...before))}`, value].filter(Boolean).join(' · ');
}

/**
 * A value of vertices at a place between them.
 * @param {Mesh} mesh
 * @param {Place} place
 * @param {(vertex: number) => number} value
 */
function interpolateAt({ triangles }, { triangle, shares }, value) {
  return shares.reduce((sum, share, corner) => sum + share * value(triangles[3 * triangle + corner]), 0);
}

/** The summary of a solve in sentences. @param {Mesh} mesh @param {MeshSurface} surface */
export function meshFitSummary(mesh, { report }) {
  const { passes, stopReason, flipped, entangled, repairs: { turned, degenerate, repeated } } = report;
  const gap = passes.at(-1)?.gap;
  const mended = turned + degenerate + repeated;
  return [
    gap === undefined ? '' : MESH_FIT_WORDS.proof(passes.length, percent(gap)),
    stopReason === 'maxIterations' || stopReason === 'diverged' || stopReason === 'noNoise' ? MESH_FIT_WORDS[stopReason] : '',
    mended > 0 ? MESH_FIT_WORDS.repaired(mended) : '',
    entangled.length > 0 ? MESH_FIT_WORDS.entangled(entangled.length, entangled[0].position.map((at) => number(at, 3)).join(', ')) : '',
    entangled.length === 0 && flipped[1] > 0 ? MESH_FIT_WORDS.flipped(flipped[1]) : '',
  ].filter(Boolean).join(' ');
}

/** @param {MeshSurface} surface @returns {[string, string][]} */
function meshFacts({ unit, report: { border, components, sigma, lambda, stopReason, volume, area, flipped } }) {
  const facts = [
    ['Border vertices', border === 0 ? 'none: it is closed' : count(border)],
    components > 1 && ['Parts', count(components)],
    sigma !== undefined && stopReason !== 'noNoise' && ['Noise, σ', `${numberAgainst(sigma, Math.sqrt(area[0]))} ${unit ?? 'units'}`],
    stopReason !== 'noNoise' && ['λ', number(lambda, 2)],
    ['Area', `${number(area[0])} → ${number(area[1])}`],
    volume && ['Volume', `${number(volume[0])} → ${number(volume[1])}`],
    flipped[0] + flipped[1] > 0 && ['Triangles folded over', `${count(flipped[0])} → ${count(flipped[1])}`],
  ];
  return /** @type {[string, string][]} */ (facts.filter(Boolean));
}

/**
 * Colours of vertices, as a renderer needs them.
 * @param {number} length
 * @param {(i: number) => Colour} colour
 */
function vertexColors(length, colour) {
  const colors = new Float32Array(3 * length);
  for (let i = 0; i < length; i++) {
    const rgb = colour(i);
    for (let k = 0; k < 3; k++) colors[3 * i + k] = rgb[k] / 255;
  }
  return colors;
}
