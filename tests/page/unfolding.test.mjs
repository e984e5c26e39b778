/** The way from a bent surface to its sheet, against a cylinder whose way is known. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { example, initSync, loadSync, pattern } from '../../pkg/sync.js';
import { readAssemblyMesh, borderLines } from '../../www/surface/assembly-mesh.js';
import { computeUnfolding, unfoldedPositions } from '../../www/surface/unfolding.js';

test('a cylinder unfolds along straight ways of its vertices', () => {
  const [cols, rows, radius, step] = [25, 6, 3, 0.2];
  /** @type {number[]} */
  const positions = [];
  /** @type {number[]} */
  const places = [];
  /** @type {number[]} */
  const triangles = [];
  for (let row = 0; row < rows; row++) {
    for (let col = 0; col < cols; col++) {
      const s = (col - (cols - 1) / 2) * step;
      positions.push(radius * Math.sin(s / radius), row * step, radius * Math.cos(s / radius));
      // The sheet lies elsewhere on the plane.
      places.push(s + 7, row * step - 2);
      if (col + 1 === cols || row + 1 === rows) continue;
      const i = row * cols + col;
      triangles.push(i, i + 1, i + cols, i + 1, i + cols + 1, i + cols);
    }
  }
  const stretches = new Float64Array((2 * triangles.length) / 3).fill(1);
  const unfolding = computeUnfolding({
    positions: Float64Array.from(positions), places: Float64Array.from(places), triangles: Uint32Array.from(triangles), stretches,
  }, 0.01, [10, 20]);
  assert.equal(unfolding.colors.length, 3 * rows * cols);
  for (const share of [0, 0.3, 0.5, 1]) {
    const form = unfoldedPositions(unfolding, share);
    const length = (/** @type {number} */ i, /** @type {number} */ j) => Math.hypot(...[0, 1, 2].map((k) => form[3 * i + k] - form[3 * j + k]));
    for (let col = 0; col + 1 < cols; col++) {
      // An edge that slopes by an angle goes straight from its bent to its flat direction.
      const angle = ((col + 0.5 - (cols - 1) / 2) * step) / radius;
      const chord = 2 * radius * Math.sin(step / radius / 2);
      const wanted = Math.hypot((1 - share) * chord * Math.cos(angle) + share * step, (1 - share) * chord * Math.sin(angle));
      assert.ok(Math.abs(length(col, col + 1) / wanted - 1) < 1e-5, `${share}: ${length(col, col + 1)} for ${wanted}`);
      assert.ok(Math.abs(length(col, col + cols) / step - 1) < 1e-5, 'along the axis nothing changes');
    }
  }
  const [bent, flat] = [0, 1].map((share) => unfoldedPositions(unfolding, share));
  positions.forEach((value, i) => assert.ok(Math.abs(bent[i] - value - [10, 20, 0][i % 3]) < 1e-5, 'it begins where the surface is'));
  assert.ok(flat.every((value, i) => i % 3 < 2 || Math.abs(value - flat[2]) < 1e-5), 'and ends flat');
});

test('a sheet that lies elsewhere and turned keeps its size on the way', () => {
  // Two sheets of one triangle each, flat already: the second one is turned by 120° and beside the first.
  const positions = Float64Array.from([0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 1, 0, 1, 1]);
  const [c, s] = [Math.cos((2 * Math.PI) / 3), Math.sin((2 * Math.PI) / 3)];
  const places = Float64Array.from([0, 0, 2, 0, 0, 1, ...[[0, 0], [2, 0], [0, 1]].flatMap(([x, y]) => [9 + c * x - s * y, s * x + c * y])]);
  const unfolding = computeUnfolding({ positions, places, triangles: Uint32Array.from([0, 1, 2, 3, 4, 5]), stretches: new Float64Array(4).fill(1), sheets: Uint32Array.from([0, 0, 0, 1, 1, 1]) }, 0.01, [0, 0]);
  for (const share of [0, 0.4, 1]) {
    const form = unfoldedPositions(unfolding, share);
    for (const [i, j, own] of [[0, 1, 2], [0, 2, 1], [3, 4, 2], [3, 5, 1], [4, 5, Math.sqrt(5)]]) {
      const length = Math.hypot(...[0, 1, 2].map((k) => form[3 * i + k] - form[3 * j + k]));
      assert.ok(Math.abs(length - own) < 1e-5, `${share}: ${length} for ${own}`);
    }
  }
});

test('sheets of a pyramid are where it is, and lie flat beside each other in their true size', () => {
  const wasm = (/** @type {string} */ name) => readFileSync(new URL(`../../pkg/wasm/${name}_bg.wasm`, import.meta.url));
  initSync(wasm('solver'));
  loadSync({ patterns: wasm('patterns') });
  const [side, pixel, slope] = [41, 0.5, 0.8];
  const height = (/** @type {number} */ x, /** @type {number} */ y) => slope * (side * pixel / 2 - Math.max(Math.abs(x - side * pixel / 2), Math.abs(y - side * pixel / 2)));
  const data = Float64Array.from({ length: side * side }, (_, i) => height(((i % side) + 0.5) * pixel, (side - Math.floor(i / side) - 0.5) * pixel));
  const { assembly } = pattern({ width: side, height: side, data, pixelSize: pixel }, { scale: 10, assembly: true });
  assert.ok(assembly);
  const { positions, places, triangles, stretches } = readAssemblyMesh(assembly.model, 0.01);
  let off = 0;
  for (let i = 0; i < positions.length; i += 3) off = Math.max(off, Math.abs(positions[i + 2] - height(positions[i], positions[i + 1])));
  assert.ok(off < 0.3 * pixel, `${off} off the pyramid`);
  const strains = Array.from(stretches, (value) => Math.abs(value - 1)).toSorted((a, b) => a - b);
  assert.ok(strains[Math.floor(0.9 * strains.length)] < 0.01, `strain of ${strains[Math.floor(0.9 * strains.length)]}`);
  // The same area as the faces have, and nothing on top of anything else: all triangles lie the same way up.
  let area = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [ax, ay, bx, by, cx, cy] = [0, 1, 2].flatMap((k) => [places[2 * triangles[t + k]], places[2 * triangles[t + k] + 1]]);
    const twice = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    assert.ok(twice > 0);
    area += twice / 2;
  }
  const whole = ((side - 1) * pixel) ** 2 * Math.hypot(1, slope);
  assert.ok(Math.abs(area / whole - 1) < 0.05, `${area} for ${whole}`);
  // Borders are closed, and no edge inside is one.
  for (const line of borderLines(triangles)) assert.equal(line[0], line.at(-1));
  assert.deepEqual(borderLines(Uint32Array.from([0, 1, 2, 0, 2, 3])).map((line) => [...line]), [[0, 1, 2, 3, 0]]);
});

test('parts of an assembly are told by the numbers of their sheets, in whatever order they come', () => {
  const { input } = example('roof', { size: 80, noise: 0 });
  const { assembly, sheets: drawn } = pattern(input, { scale: 180, assembly: true });
  assert.ok(assembly && drawn.length > 2);
  const { places, sheets } = readAssemblyMesh(assembly.model, 1 / 1000);
  drawn.forEach(({ bounds: [low, high] }, sheet) => {
    const own = [...sheets.keys()].filter((vertex) => sheets[vertex] === sheet);
    for (const k of [0, 1]) {
      const along = own.map((vertex) => places[2 * vertex + k]);
      const side = Math.max(...along) - Math.min(...along);
      // The drawing's outlines are smoothed.
      assert.ok(Math.abs(side - (high[k] - low[k])) < 5, `sheet ${sheet + 1}: ${side} for ${high[k] - low[k]} mm`);
    }
  });
});
