/** What the benchmark of pages seen by a phone counts with. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { background, depthCamera, poses, project, seenFrom, view } from '../../tools/bench/phone/camera.mjs';
import { distance, errorRate } from '../../tools/bench/phone/characters.mjs';
import { anisotropy, similarity, singular } from '../../tools/bench/phone/fitting.mjs';
import { pages, upright } from '../../tools/bench/phone/pages.mjs';
import { normal, smoothNoise } from '../../tools/bench/phone/sensor.mjs';
import { smoothed } from '../../tools/bench/phone/surfaces.mjs';
import { measure, placesOf } from '../../tools/bench/phone/truth.mjs';

/** @param {number} found @param {number} expected @param {number} within */
const near = (found, expected, within) => assert.ok(Math.abs(found - expected) <= within, `${found}, not ${expected}`);

test('characters that are wrong', () => {
  assert.equal(distance('kitten', 'sitting'), 3);
  assert.equal(distance('', 'page'), 4);
  assert.equal(distance('page', ''), 4);
  assert.equal(distance('flaw', 'lawn'), 2);
  assert.equal(distance('paage', 'page'), 1);
  assert.equal(errorRate('  Two\nlines ', 'Two lines'), 0);
  assert.equal(errorRate('Two 1ines', 'Two lines'), 1 / 9);
  assert.equal(errorRate('it\u2019s', "it's"), 0);
});

test('the best similarity, and how far a map is from one', () => {
  /** @type {(x: number, y: number) => [number, number]} */
  const turned = (x, y) => [3 * x - 4 * y + 5, 4 * x + 3 * y - 6];
  const grid = Array.from({ length: 20 }, (_, i) => /** @type {const} */ ([i % 5, Math.floor(i / 5)]));
  const { a, b, s, t, rms } = similarity(grid.map(([x, y]) => [x, y, ...turned(x, y)]));
  [[a, 3], [b, 4], [s, 5], [t, -6], [rms, 0]].forEach(([found, expected]) => near(found, expected, 1e-6));
  // Points of a square, each moved by 0.1 alternately out and in: nothing a similarity could take away.
  const square = similarity([[1, 1, 1.1, 1.1], [-1, 1, -0.9, 0.9], [-1, -1, -1.1, -1.1], [1, -1, 0.9, -0.9]]);
  near(square.rms, 0.1 * Math.SQRT2, 1e-9);
  near(anisotropy(grid.map(([x, y]) => [x, y, ...turned(x, 1.1 * y)])), 0.1, 1e-9);
  near(anisotropy(grid.map(([x, y]) => [x, y, ...turned(x, y)])), 0, 1e-9);
  // A shear by 1 has the golden ratio and its inverse.
  const golden = (1 + Math.sqrt(5)) / 2;
  singular([1, 1, 0, 1]).forEach((value, k) => near(value, [golden, 1 / golden][k], 1e-12));
});

test('pages are bent without stretch', () => {
  for (const { name, width, height, point } of [...pages, upright]) {
    let stretched = 0;
    for (let i = 0; i < 400; i += 1) {
      const [u, v] = [width * (0.013 + (i % 20) / 20.5), height * (0.017 + Math.floor(i / 20) / 20.7)];
      for (const angle of [0.3, 1.1, 2.5]) {
        const step = 1e-5;
        const here = point(u, v);
        const there = point(u + step * Math.cos(angle), v + step * Math.sin(angle));
        const length = Math.hypot(...there.map((value, k) => value - here[k]));
        stretched += Number(Math.abs(length / step - 1) > 1e-4);
      }
    }
    // Only across a crease.
    assert.ok(stretched <= 4, `${name}: ${stretched}`);
  }
});

test('a view says which place a pixel shows', () => {
  for (const page of pages) {
    for (const pose of poses) {
      const seen = view(page, pose, depthCamera);
      const [space, behind] = [seenFrom(page, pose), background(page, pose, depthCamera)];
      // A camera moves, and nothing is stretched.
      const corners = [[0, 0], [page.width, 0], [0, page.height]];
      const sides = (/** @type {(u: number, v: number) => number[]} */ at) => corners.map(([u, v], k) =>
        Math.hypot(...at(u, v).map((value, axis) => value - at(corners[(k + 1) % 3][0], corners[(k + 1) % 3][1])[axis])));
      sides(space).forEach((side, k) => near(side, sides(page.point)[k], 1e-12));
      for (let i = 0; i < seen.depths.length; i += 37) {
        if (seen.depths[i] === Infinity) continue;
        const [x, y] = [i % seen.width, Math.floor(i / seen.width)];
        const point = space(seen.places[2 * i], seen.places[2 * i + 1]);
        project(depthCamera, point).forEach((value, k) => near(value, [x, y][k], 0.05));
        near(point[2], seen.depths[i], 2e-4);
        assert.ok(behind(x, y) > seen.depths[i] - 1e-4, `${page.name}: ${behind(x, y)} ${seen.depths[i]}`);
      }
    }
  }
});

test('a photo as it is covers the page, and one of a shifted half covers half', () => {
  const [width, height] = [42, 60];
  const page = { width: 0.021, height: 0.03 };
  const places = Float32Array.from({ length: 2 * width * height }, (_, i) => {
    const [x, y] = [Math.floor(i / 2) % width, Math.floor(i / 2 / width)];
    return [(x + 0.5) * 5e-4, (y + 0.5) * 5e-4][i % 2];
  });
  const seen = { width, height, places, depths: new Float32Array(0) };
  const map = Float32Array.from({ length: 2 * width * height }, (_, i) =>
    [Math.floor(i / 2) % width, Math.floor(i / 2 / width)][i % 2]);
  const whole = measure(seen, placesOf({ width, height, map }, seen), page);
  near(whole.rms, 0, 1e-4);
  near(whole.strain, 0, 1e-3);
  assert.ok(whole.coverage > 0.95, String(whole.coverage));
  const half = map.map((value, i) => (Math.floor(i / 2 / width) < height / 2 ? value : NaN));
  near(measure(seen, placesOf({ width, height, map: half }, seen), page).coverage, 0.5, 0.03);
});

test('noise is smooth and of the size that is said', () => {
  const [width, height] = [200, 150];
  const field = smoothNoise(width, height, 2, normal(3));
  const correlation = (/** @type {number} */ shift) => {
    const rows = Array.from({ length: height }, (_, y) => y * width);
    const products = rows.flatMap((row) => Array.from({ length: width - shift }, (_, x) => field[row + x] * field[row + x + shift]));
    return products.reduce((sum, product) => sum + product, 0) / products.length;
  };
  near(correlation(0), 1, 0.1);
  // Of a Gaussian kernel: exp(−d²/4σ²).
  near(correlation(2), Math.exp(-1 / 4), 0.1);
  near(correlation(12), 0, 0.1);
});

test('averages of neighbours leave planes alone', () => {
  const [rows, cols] = [7, 8];
  const plane = Float64Array.from({ length: rows * cols }, (_, i) => {
    const [row, col] = [Math.floor(i / cols), i % cols];
    return 2 * (col - (row % 2) / 2) - 3 * row * Math.sqrt(0.75);
  });
  const { heights } = smoothed({ rows, cols, heights: plane }, 1);
  for (let row = 1; row < rows - 1; row += 1) {
    for (let col = 1; col < cols - 1; col += 1) near(heights[row * cols + col], plane[row * cols + col], 1e-12);
  }
});
