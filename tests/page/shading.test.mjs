/** The page's modules that need no browser. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { count, number, percentAtMost, shortLambda } from '../../www/format.js';
import { rmsError } from '../../www/surface/compare.js';
import { sheetStrainImage } from '../../www/surface/colour-images.js';
import { linearScale, logarithmicScale, magnitudeQuantile } from '../../www/surface/colours.js';
import { gridOverLattice, interpolateToGrid, nearestVertex } from '../../www/surface/lattice.js';
import { fillMatcap, lightFrom, MATCAP_SIDE_TEXELS } from '../../www/surface/matcap.js';
import { heightAt, reliefMesh } from '../../www/surface/relief.js';
import { fillTriangles } from '../../www/surface/triangles.js';
import { lambdaHint, certificateInWords } from '../../www/messages.js';
import { grid } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';

test('steel is brightest where it mirrors the light, paper where it faces it', () => {
  const [tilt, texels] = [0.6, new Uint8Array(4 * MATCAP_SIDE_TEXELS ** 2)];
  /** The tone of a normal that leans to the right. @param {number} angle */
  const tone = (angle) => texels[4 * ((MATCAP_SIDE_TEXELS >> 1) * MATCAP_SIDE_TEXELS + Math.round(((1 + 0.99 * Math.sin(angle)) / 2) * (MATCAP_SIDE_TEXELS - 1))) + 1];
  for (const [isMetal, brightest] of /** @type {const} */ ([[true, tilt / 2], [false, tilt]])) {
    fillMatcap(texels, [Math.sin(tilt), 0, Math.cos(tilt)], { isMetal, isPale: false });
    for (const aside of [-0.25, 0.25]) assert.ok(tone(brightest) > tone(brightest + aside), `metal ${isMetal}: ${tone(brightest)} and ${tone(brightest + aside)}`);
  }
});

test('a level surface mirrors the light from every side alike', () => {
  const [x, y, z] = lightFrom(0);
  assert.ok(Math.abs(Math.hypot(x, y, z) - 1) < 1e-12 && z > 0);
  // Tilted, the level normal leans back; mirrored there, the view meets the light at the same angle.
  const tilt = 0.7;
  const turned = lightFrom(tilt);
  assert.ok(Math.abs(turned[1] * Math.sin(2 * tilt) + turned[2] * Math.cos(2 * tilt) - z) < 1e-12 && turned[0] === x);
});

test('heights are a mesh without their holes', () => {
  const [width, height] = [40, 30];
  const heights = grid(width, height, (col, row) => (Math.hypot(col - 20, row - 15) < 4 ? NaN : 0.1 * col));
  const relief = { width, height, heights, heightScale: 2, extent: { left: 0, top: 30, width: 40, height: 30 } };
  const mesh = reliefMesh(relief);
  assert.ok(mesh);
  const { positions, triangles } = mesh;
  assert.equal(positions.length, 3 * width * height);
  assert.ok(triangles.length > 0 && triangles.every((vertex) => Number.isFinite(heights[vertex])), 'no corner in a hole');
  for (let t = 0; t < triangles.length; t += 3) {
    const [[ax, ay], [bx, by], [cx, cy]] = [0, 1, 2].map((k) => positions.subarray(3 * triangles[t + k]));
    assert.ok((bx - ax) * (cy - ay) - (by - ay) * (cx - ax) > 0, 'it faces upwards');
  }
  assert.deepEqual([...positions.subarray(0, 3)], [0.5, 29.5, 0]);
  const hills = reliefMesh({ ...relief, heights: Array.from(heights, (z) => z + 2000) });
  assert.ok(hills?.positions.every((z, i) => i % 3 !== 2 || z >= 4000), 'holes are at the height of the rest');
  assert.ok(heightAt(relief, 10.5, 5) === 2 * 0.1 * 10 && Number.isNaN(heightAt(relief, 20, 15)) && Number.isNaN(heightAt(relief, 41, 15)));
  const large = reliefMesh({ ...relief, width: 1200, height: 3, heights: Float64Array.from({ length: 3600 }, (_, i) => i % 2) });
  assert.ok(large && large.positions.length / 3 <= 3 * 512);
  const inner = [...large.positions].filter((_, i) => i % 3 === 2);
  assert.ok(inner.some((z) => z > 0 && z < 2), 'blocks are averaged');
  const sparse = grid(width, height, (col, row) => (col % 9 === 4 && row % 9 === 4 ? 1 : NaN));
  assert.equal(reliefMesh({ ...relief, heights: sparse }), null, 'nothing to draw without triangles');
});

test('a sheet has a margin, an outline, and the strain of each pixel', () => {
  const places = Float64Array.of(0, 0, 2, 0, 2, 1, 0, 1);
  const { width, height, pixels, values, maxStrain } = sheetStrainImage(Uint32Array.of(0, 1, 2, 0, 2, 3), places, Float64Array.of(1.02, 1, 1.02, 1));
  assert.ok(Math.abs(width / height - 2) < 0.1 && maxStrain > 0.019);
  const middle = (height >> 1) * width + (width >> 1);
  assert.ok(Math.abs(values[middle] - 0.02) < 1e-6 && pixels[middle] !== 0);
  const [first] = [pixels.subarray((height >> 1) * width).findIndex((pixel) => pixel !== 0)];
  assert.ok(first > 10, `a margin of ${first}`);
  assert.notEqual(pixels[(height >> 1) * width + first], pixels[middle], 'an outline');
  assert.ok(Number.isNaN(values[0]));
});

test('errors are measured where both surfaces are', () => {
  assert.ok(Math.abs(rmsError([1, 2, NaN, 5], 2, [1, 2, 3, NaN], 1) - Math.sqrt((1 + 4) / 2)) < 1e-12);
});

test('a bound in percent is never understated', () => {
  for (const gap of [0.00912, 0.0099999, 0.01, 0.1234, 3.21e-7, 0.9991]) {
    const shown = parsed(percentAtMost(gap)) / 100;
    assert.ok(shown >= gap * (1 - 1e-9) && shown <= gap * 1.1, `${gap} as ${shown}`);
  }
  assert.equal(percentAtMost(NaN), '–');
});

test('numbers read well', () => {
  assert.equal(count(1234567), '1\u202f234\u202f567');
  assert.equal(number(0.012345), '0.0123');
  assert.equal(number(-2.5), '−2.5');
  assert.equal(number(1e6), '10⁶');
  assert.equal(number(2.5e-7), '2.5\u202f·\u202f10⁻⁷');
  assert.equal(shortLambda(1e6), '1e6');
  assert.equal(shortLambda(2.51e5), '2.5e5');
});

test('each λ and each way to stop has words of its own', () => {
  assert.equal(new Set([1e3, 1e5, 1e6, 1e7, 1e9].map(lambdaHint)).size, 5);
  const seconds = { setup: 0, zStep: 0, hStep: 0, certificate: 0, total: 0.42 };
  const report = /** @type {import('../../pkg/types.js').Report} */ ({ gap: 0.009, stopReason: 'gap', seconds });
  assert.equal(certificateInWords(report).replaceAll('\u00a0', ' '), 'Proven within 0.9 % of the best possible, in 0.42 s.');
  assert.match(certificateInWords({ ...report, stopReason: 'cancelled' }), /^Cancelled/);
  assert.match(certificateInWords({ ...report, stopReason: 'cancelled', gap: 1 }), /too early/);
  for (const stopReason of /** @type {const} */ (['gap', 'rounding', 'maxIterations', 'diverged', 'cancelled'])) {
    assert.doesNotMatch(certificateInWords({ ...report, stopReason, gap: undefined }), /[Pp]roven within|NaN/);
  }
});

/** A lattice with the value of a function at each vertex. @param {(x: number, y: number) => number} value */
function latticeOf(value) {
  const lattice = { rows: 9, cols: 12, spacing: 0.5, origin: /** @type {const} */ ([3, 7]) };
  const values = grid(lattice.cols, lattice.rows, (col, row) =>
    value(3 + 0.5 * (col - 0.5 * (row % 2)), 7 - 0.5 * Math.sqrt(0.75) * row));
  return { lattice, values };
}

test('what is linear on the lattice is so on the pixels that show it', () => {
  const plane = (/** @type {number} */ x, /** @type {number} */ y) => 2 * x - 3 * y;
  const { lattice, values } = latticeOf(plane);
  const whole = gridOverLattice(lattice);
  for (const area of [whole, { ...whole, pixelSize: whole.pixelSize / 3, width: 3 * whole.width, height: 3 * whole.height }]) {
    const found = interpolateToGrid(lattice, values, area);
    let inner = 0;
    found.forEach((z, i) => {
      const [x, y] = [area.left + (i % area.width + 0.5) * area.pixelSize, area.top - (Math.floor(i / area.width) + 0.5) * area.pixelSize];
      const inside = x >= 3 && x <= 3 + 0.5 * 10.5 && y <= 7 && y >= 7 - 0.5 * Math.sqrt(0.75) * 8;
      if (!inside) return;
      inner++;
      assert.ok(Math.abs(z - plane(x, y)) < 1e-9, `${z} at ${x}, ${y}`);
    });
    assert.ok(inner > 0.75 * found.length);
  }
});

test('a hole in the lattice is a hole in the image, and as large', () => {
  const { lattice, values } = latticeOf(() => 1);
  values[4 * 12 + 6] = NaN;
  const grid = gridOverLattice(lattice);
  const holes = interpolateToGrid(lattice, values, grid).filter(Number.isNaN).length;
  assert.ok(holes >= 1 && holes <= 4, `${holes}`);
  assert.equal(nearestVertex(lattice, grid.left + 0.5 * grid.pixelSize, grid.top - 0.5 * grid.pixelSize), 0, 'the first pixel shows the first vertex');
  assert.equal(nearestVertex(lattice, grid.left - 2 * grid.pixelSize, grid.top), -1, 'nothing is beside the lattice');
});

test('scales are symmetric, and a share of the values is within them', () => {
  for (const scale of [logarithmicScale(1e-3, 250), linearScale(0.02, String)]) {
    const places = scale.ticks.map(({ value }) => scale.place(value));
    assert.ok(places.every((place, i) => Math.abs(place + places[places.length - 1 - i]) < 1e-12));
    assert.ok(places.every((place, i) => Math.abs(place) <= 1 + 1e-12 && (i === 0 || place > places[i - 1])));
  }
  const log = logarithmicScale(1e-3, 250);
  assert.ok(Math.abs(log.place(250) - 1) < 1e-9 && log.place(1e-5) < 0.01);
  assert.equal(magnitudeQuantile([[-5, 1, NaN], [2, -3, 4]], 0.5), 3);
  assert.equal(magnitudeQuantile([[NaN]], 0.5), 0);
});

test('triangles that share an edge leave no gap, and their weights say where a pixel lies', () => {
  const [width, height] = [20, 15];
  const seen = new Uint8Array(width * height);
  const places = [0, 0, width, 0, width, height, 0, height];
  fillTriangles({ width, height }, [0, 1, 2, 0, 3, 2], places, (pixel, triangle, a, b, c) => {
    seen[pixel]++;
    const corners = triangle === 0 ? [0, 1, 2] : [0, 3, 2];
    const x = [a, b, c].reduce((sum, weight, k) => sum + weight * places[2 * corners[k]], 0);
    assert.ok(Math.abs(x - (pixel % width + 0.5)) < 1e-9);
  });
  assert.ok(seen.every((times) => times >= 1));
});
