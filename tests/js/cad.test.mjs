/** Parts that three.js extrudes, laid flat: areas and lengths beside closed forms. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
// @ts-expect-error three.js comes without types.
import { CylinderGeometry, DodecahedronGeometry, ExtrudeGeometry, Path, Shape, SphereGeometry } from 'three';
import * as direct from '../../pkg/direct.js';
import { error } from './support/error.mjs';

await direct.init();
await direct.load('patterns');

/** Number of segments of a circle that three.js is asked to make, and makes. */
const [SEGMENTS, SIDES] = [24, 48];

/** @param {any} geometry of three.js */
function meshOf(geometry) {
  const positions = Float64Array.from(/** @type {Float32Array} */ (geometry.getAttribute('position').array));
  const index = geometry.getIndex();
  return { positions, triangles: index ? Uint32Array.from(index.array) : Uint32Array.from({ length: positions.length / 3 }, (_, i) => i) };
}

/** @param {[number, number][]} corners */
function outline(corners) {
  const shape = new Shape();
  corners.forEach(([x, y], i) => (i === 0 ? shape.moveTo(x, y) : shape.lineTo(x, y)));
  shape.closePath();
  return shape;
}

/** @param {number} found @param {number} exact @param {number} [tolerance] */
const near = (found, exact, tolerance = 1e-6) => assert.ok(Math.abs(found / exact - 1) < tolerance, `${found} for ${exact}`);

test('faces, walls and holes of extruded parts have their areas, and no strain', () => {
  const plate = outline([[0, 0], [120, 0], [120, 80], [0, 80]]);
  for (const [x, y] of [[10, 10], [110, 10], [60, 40]]) plate.holes.push(new Path().absarc(x, y, 6, 0, 2 * Math.PI, true));
  const circle = { area: (SIDES / 2) * 36 * Math.sin((2 * Math.PI) / SIDES), length: 2 * SIDES * 6 * Math.sin(Math.PI / SIDES) };
  const angle = outline([[0, 0], [40, 0], [40, 2], [2, 2], [2, 30], [0, 30]]);
  const parts = /** @type {[any, number][]} */ ([
    [new ExtrudeGeometry(plate, { depth: 3, bevelEnabled: false, curveSegments: SEGMENTS }), 2 * (9600 - 3 * circle.area) + 3 * (400 + 3 * circle.length)],
    [new ExtrudeGeometry(angle, { depth: 100, bevelEnabled: false }), 2 * 136 + 100 * 140],
    // A hexagon's side is its circumradius.
    [new CylinderGeometry(20, 20, 50, 6, 1, true), 6 * 20 * 50],
    [new DodecahedronGeometry(40), 3 * Math.sqrt(25 + 10 * Math.sqrt(5)) * (160 / (Math.sqrt(3) * (1 + Math.sqrt(5)))) ** 2],
  ]);
  for (const [geometry, area] of parts) {
    const mesh = meshOf(geometry);
    assert.equal(direct.recognizeMesh(mesh).kind, 'faces');
    const { summary } = direct.pattern(mesh, { scale: 1 });
    near(summary.area, area);
    assert.equal(summary.strain, 0);
    // Triangle by triangle it is laid flat as its sheets are.
    const { report, places, triangles } = direct.unroll(mesh);
    assert.deepEqual([report.sheets, report.strain, report.missing.area], [summary.sheets, 0, 0]);
    near(flatArea(places, triangles), area);
  }
});

/** Area of triangles in the plane. @param {Float64Array} places @param {Uint32Array} triangles */
function flatArea(places, triangles) {
  const at = (/** @type {number} */ corner) => places.subarray(2 * triangles[corner], 2 * triangles[corner] + 2);
  let area = 0;
  for (let corner = 0; corner < triangles.length; corner += 3) {
    const [[ax, ay], [bx, by], [cx, cy]] = [at(corner), at(corner + 1), at(corner + 2)];
    area += 0.5 * ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax));
  }
  return area;
}

test('a channel is bent from the blank that its bends allow', () => {
  const [width, height, thickness, inner, length] = [40, 20, 1.5, 3, 60];
  const outer = inner + thickness;
  const section = new Shape();
  section.moveTo(0, height);
  section.lineTo(0, outer);
  section.absarc(outer, outer, outer, Math.PI, 1.5 * Math.PI, false);
  section.lineTo(width - outer, 0);
  section.absarc(width - outer, outer, outer, 1.5 * Math.PI, 2 * Math.PI, false);
  section.lineTo(width, height);
  section.lineTo(width - thickness, height);
  section.lineTo(width - thickness, outer);
  section.absarc(width - outer, outer, inner, 0, -Math.PI / 2, true);
  section.lineTo(outer, thickness);
  section.absarc(outer, outer, inner, -Math.PI / 2, -Math.PI, true);
  section.lineTo(thickness, height);
  const mesh = meshOf(new ExtrudeGeometry(section, { depth: length, bevelEnabled: false, curveSegments: 12 }));
  near(/** @type {number} */ (direct.recognizeMesh(mesh).thickness), thickness);
  const { summary, sheets } = direct.pattern(mesh, { scale: 1, blank: true, kFactor: 0.44 });
  const allowance = (Math.PI / 2) * (inner + 0.44 * thickness);
  near(summary.area, length * (2 * (height - outer) + width - 2 * outer + 2 * allowance), 1e-5);
  assert.deepEqual(sheets.flatMap(({ folds }) => folds.map((fold) => Math.round(fold.angle))), [90, 90]);
});

test('a shape that no cut lays flat is built of flat faces, as many as are wanted', () => {
  const ball = meshOf(new SphereGeometry(50, 32, 24));
  const options = { scale: 1, exact: false, maxStrain: 1e-6 };
  assert.throws(() => direct.pattern(ball, { ...options, faces: 0 }), error('NOT_FLAT', /strain/));
  for (const [faces, given] of /** @type {const} */ ([[500, options], [60, { scale: 1, faces: 60 }]])) {
    const { summary } = direct.pattern(ball, given);
    const { faces: found, distance } = /** @type {import('../../pkg/types.js').SimplifiedSurface} */ (summary.simplified);
    assert.ok(found > 0.9 * faces && found <= faces, `${found}`);
    // The area of a ball, and how far equilateral triangles with so many corners on it are below it in the middle.
    near(summary.area, 4 * Math.PI * 50 ** 2, 8 / faces);
    const radius = 50 * Math.sqrt((16 * Math.PI) / (3 * Math.sqrt(3) * faces));
    assert.ok(distance > 0 && distance < 50 - Math.sqrt(50 ** 2 - radius ** 2), `${distance}`);
    assert.equal(summary.strain, 0);
    const { scale, ...unrolling } = given;
    assert.deepEqual(direct.unroll(ball, unrolling).report.simplified, summary.simplified);
  }
  assert.throws(() => direct.pattern(ball, { faces: 1.5 }), error('OPTION', /faces.*whole number/));
});
