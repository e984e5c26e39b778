/** What is said of a whole mesh and its result. */
import { areaUnit, count, number, numberAgainst, percent } from '../format.js';
import { MESH_FIT_WORDS } from '../messages.js';
import { interpolateAt } from '../surface/triangles.js';

/** @import {Place} from '../surface/scene.js' */

/** Share of a mesh's area below which its shape is lost: flattened twice over, a surface has half of it. */
const MIN_KEPT_AREA_SHARE = 0.5;

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

/** The summary of a solve in sentences. @param {MeshSurface} surface */
export function meshFitSummary({ report }) {
  const { passes, stopReason, area, flipped, entangled, repairs: { turned, degenerate, repeated, branched } } = report;
  const gap = passes.at(-1)?.gap;
  const mended = turned + degenerate + repeated;
  const left = area[1] / area[0];
  return [
    left < MIN_KEPT_AREA_SHARE ? MESH_FIT_WORDS.collapsed(percent(left)) : '',
    gap === undefined ? '' : MESH_FIT_WORDS.proof(passes.length, percent(gap)),
    stopReason === 'maxIterations' || stopReason === 'diverged' || stopReason === 'noNoise' ? MESH_FIT_WORDS[stopReason] : '',
    mended > 0 ? MESH_FIT_WORDS.repaired(mended) : '',
    branched > 0 ? MESH_FIT_WORDS.branched(branched) : '',
    entangled.length > 0 ? MESH_FIT_WORDS.entangled(entangled.length, entangled[0].position.map((at) => number(at, 3)).join(', ')) : '',
    // Beside sharp edges a mesh as it is has triangles that face away from the mean of those around.
    stopReason !== 'noNoise' && entangled.length === 0 && flipped[1] > 0 ? MESH_FIT_WORDS.flipped(flipped[1]) : '',
  ].filter(Boolean).join(' ');
}

/** The figures of a solve. @param {MeshSurface} surface @returns {[string, string][]} */
export function meshFacts({ unit, report: { border, components, sigma, lambda, stopReason, volume, area, flipped } }) {
  /** @param {readonly [number, number]} values @param {'²' | '³'} power */
  const change = ([before, after], power) => `${stopReason === 'noNoise' ? '' : `${number(before)} → `}${number(after)} ${areaUnit(unit, power)}`;
  const facts = [
    ['Border', border === 0 ? 'none: it is closed' : `${count(border)} vertices`],
    components > 1 && ['Parts', count(components)],
    sigma !== undefined && stopReason !== 'noNoise' && ['Noise, σ', `${numberAgainst(sigma, Math.sqrt(area[0]))} ${unit ?? 'units'}`],
    stopReason !== 'noNoise' && ['λ', number(lambda, 2)],
    ['Area', change(area, '²')],
    volume && ['Volume', change(volume, '³')],
    stopReason !== 'noNoise' && flipped[0] + flipped[1] > 0 && ['Triangles folded over', `${count(flipped[0])} → ${count(flipped[1])}`],
  ];
  return /** @type {[string, string][]} */ (facts.filter(Boolean));
}
