/** The outline that the page suggests for a photo: that of the page, or none. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { suggested } from '../../www/page/detect.js';

/** @typedef {[x: number, y: number]} Place */
/** @typedef {(x: number, y: number) => number} Field */

/**
 * @typedef {object} Scene
 * @property {number} [ground] grey levels
 * @property {number} [grain] of wood
 * @property {Field} [light] a factor
 * @property {number} [noise]
 * @property {(x: number, y: number, page: Place | null) => number | null} [over] what lies there instead
 */

const [width, height] = [480, 360];
/** @type {Place[]} */
const corners = [[90, 54], [384, 66], [414, 312], [66, 300]];

/** Numbers from 0 to 1. @param {number} seed */
function numbers(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Random values, smooth in between. @param {number} seed @returns {Field} */
function clouds(seed) {
  const values = Float64Array.from({ length: 65536 }, numbers(seed));
  const value = (/** @type {number} */ i, /** @type {number} */ j) => values[(i & 255) + 256 * (j & 255)];
  return (x, y) => {
    const [i, j] = [Math.floor(x), Math.floor(y)];
    const [s, t] = [x - i, y - j].map((v) => v * v * (3 - 2 * v));
    return (value(i, j) * (1 - s) + value(i + 1, j) * s) * (1 - t) + (value(i, j + 1) * (1 - s) + value(i + 1, j + 1) * s) * t;
  };
}

/**
 * Where on the page a pixel is, by the homography of its corners; its upper and lower edge are bent.
 * @param {number} x
 * @param {number} y
 * @returns {Place | null}
 */
function onPage(x, y) {
  const [a, b, c, d] = corners;
  const bilinear = (/** @type {number} */ s, /** @type {number} */ t) => [0, 1].map((k) =>
    (1 - t) * ((1 - s) * a[k] + s * b[k]) + t * ((1 - s) * d[k] + s * c[k]));
  let [s, t] = [0.5, 0.5];
  for (let i = 0; i < 6; i++) {
    const [here, right, below] = [bilinear(s, t), bilinear(s + 1e-4, t), bilinear(s, t + 1e-4)];
    const [p, q, r, u] = [right[0] - here[0], below[0] - here[0], right[1] - here[1], below[1] - here[1]].map((v) => v * 1e4);
    const [dx, dy, area] = [x - here[0], y - here[1], p * u - q * r];
    s += (u * dx - q * dy) / area;
    t += (p * dy - r * dx) / area;
  }
  t += 0.04 * Math.sin(Math.PI * s);
  return s >= 0 && s <= 1 && t >= 0 && t <= 1 ? [s, t] : null;
}
const places = Array.from({ length: width * height }, (_, i) => onPage(i % width, Math.floor(i / width)));

/** @param {Scene} scene @param {number} seed */
function photo({ ground = 60, grain = 0, light = () => 1, noise = 4, over = () => null }, seed) {
  const [wood, fibres, next] = [clouds(seed), clouds(seed + 9), numbers(31 * seed)];
  const data = Float32Array.from({ length: width * height }, (_, i) => {
    const [x, y, page] = [i % width, Math.floor(i / width), places[i]];
    const desk = ground + grain * (2 * wood(x / 84, y / 3) - 1 + 0.5 * (fibres(x / 36, y / 1.2) - 0.5));
    const text = page && page[0] > 0.1 && page[0] < 0.9 && page[1] > 0.08 && page[1] < 0.92 && (40 * page[1]) % 1 < 0.5 && fibres(x / 2, 3 * y) > 0.45;
    const value = (over(x, y, page) ?? (page ? (text ? 60 : 235) : desk)) * light(x, y) + noise * 2 * (next() + next() - 1);
    return Math.min(255, Math.max(0, value));
  });
  return { width, height, scale: 1, data };
}

/** Pixels that the farthest corner is off, or none. @param {Scene} scene @param {number} seed */
function off(scene, seed) {
  const outline = suggested(photo(scene, seed));
  if (!outline) return null;
  const found = outline.edges.flatMap((nodes) => [nodes[0], nodes[nodes.length - 1]]);
  return Math.max(...corners.map(([x, y]) => Math.min(...found.map((node) => Math.hypot(node.x - x, node.y - y)))));
}

/** From 0 to 1 over so many pixels. @param {number} distance @param {number} over */
const soft = (distance, over) => 1 / (1 + Math.exp(-distance / over));

test('a page on a darker ground is found, on wood and beside other things, too', () => {
  /** @type {Scene[]} */
  const scenes = [
    {}, { noise: 10 }, { ground: 150 }, { ground: 110, grain: 25 }, { ground: 80, grain: 25 },
    { ground: 110, light: (x, y) => 1 - ((x - 240) ** 2 + (y - 180) ** 2) / 150_000 },
    { over: (x, y) => (x > 430 && x < 474 && y > 120 && y < 252 ? 230 : null) },
    { over: (x, y, page) => (page ? null : x % 120 < 114 && y % 90 < 84 ? 150 : 90) },
  ];
  for (const [number, scene] of scenes.entries()) {
    const pixels = off(scene, number + 1);
    assert.ok(pixels !== null && pixels < 4, `scene ${number}: ${pixels}`);
  }
});

test('where it is not sure nothing is suggested, rather than something wrong', () => {
  /** @type {Record<string, Scene>} */
  const scenes = {
    'a white desk': { ground: 232 },
    'a light desk': { ground: 205 },
    'light wood': { ground: 175, grain: 35 },
    'a desk lit from one side': { ground: 200, light: (x) => 0.5 + x / 960 },
    'half in shadow': { ground: 70, light: (x, y) => 0.4 + 0.6 * soft(x - 240 + 0.3 * y, 7) },
    'half in sharp shadow': { ground: 90, light: (x, y) => 0.35 + 0.65 * soft(x + y - 372, 2) },
    'a corner in shadow': { light: (x, y) => 0.2 + 0.8 * soft(Math.hypot(x - 414, y - 312) - 132, 6) },
    'the shadow of an arm': { light: (x, y) => 0.3 + 0.7 * soft(Math.abs(y - 180 - 0.2 * x) - 36, 4) },
    'sun through a window': { ground: 120, light: (x, y) => (y > 72 && y < 258 && x - 0.4 * y > 72 && x - 0.4 * y < 252 ? 1 : 0.4) },
    'a dark picture across the page': { over: (x, y, page) => (page && page[1] > 0.4 && page[1] < 0.75 ? 70 : null) },
    'a thumb on its edge': { over: (x, y) => (Math.hypot((x - 240) / 36, (y - 318) / 54) < 1 ? 150 : null) },
    'another sheet below': { over: (x, y, page) => (!page && x > 336 && x < 474 && y > 180 && y < 354 ? 225 : null) },
    'a bright screen beside': { light: (x, y) => (x > 300 && y < 132 ? 1 : 0.5), over: (x, y) => (x > 300 && x < 474 && y > 6 && y < 132 ? 250 : null) },
    'a plate': { over: (x, y) => (Math.hypot(x - 240, y - 180) < 132 ? 235 : 60) },
    'a chequered cloth': { over: (x, y, page) => (page ? null : ((x >> 4) + (y >> 4)) % 2 ? 215 : 60) },
  };
  for (const [name, scene] of Object.entries(scenes)) {
    const pixels = off(scene, 1);
    assert.ok(pixels === null || pixels < 4, `${name}: off by ${pixels} pixels`);
  }
});
