/** What is guessed about a file of numbers, and what is said of a broken one. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { assumedInWords } from '../../www/messages.js';
import { coarseningFor, depthUnitOf, guessPixelSize, isHexagonal, isZeroNoData } from '../../www/metadata-guess.js';
import { plainMessage } from '../../www/error-messages.js';
import { grid } from './support/files.mjs';

/** @param {number} width @param {number} height @param {(col: number, row: number) => number} value @param {string} [dataType] */
const image = (width, height, value, dataType = 'f32') =>
  ({ width, height, data: Float64Array.from(grid(width, height, value)), pixelSize: 1, heightScale: 1, dataType });
/** Hills, as a function of places. @param {number} x @param {number} y */
const hills = (x, y) => 30 * Math.sin(x / 17) + 20 * Math.cos(y / 13 + x / 31);

test('the size of a pixel is guessed where 1 makes a slab or a needle of the relief, and only there', () => {
  const scaled = (/** @type {number} */ factor) => guessPixelSize(image(600, 400, (x, y) => factor * hills(x, y)));
  assert.equal(scaled(1), null);
  assert.equal(guessPixelSize(image(200, 200, (x) => 4 * Math.min(x, 199 - x))), null, 'a steep fold is as high as it says');
  const unit = scaled(0.005);
  assert.ok(unit && Math.abs(unit.pixelSize * 600 - 1) < 1e-3);
  assert.match(unit.words, /longer side is 1 long.*too flat/);
  const steep = scaled(100);
  assert.ok(steep && steep.pixelSize > 10 && steep.pixelSize < 200);
  assert.match(steep.words, /too steep/);
  assert.equal(guessPixelSize(image(60, 40, () => 3)), null, 'a plane says nothing');
  assert.equal(guessPixelSize({ ...image(600, 400, (x, y) => 0.005 * hills(x, y)), unit: 'm' }), null, 'the file says it');
});

test('a hexagonal lattice shows in its rows, with noise, too', () => {
  const noise = (/** @type {number} */ col, /** @type {number} */ row) => 0.2 * Math.sin(91.7 * col + 47.3 * row * row);
  const lattice = image(150, 120, (col, row) => hills(col - 0.5 * (row % 2), row * Math.sqrt(0.75)) + noise(col, row));
  assert.ok(isHexagonal(lattice));
  assert.ok(!isHexagonal(image(150, 120, (col, row) => hills(col, row) + noise(col, row))));
  assert.ok(!isHexagonal(image(150, 120, (col, row) => hills(col + 0.5 * (row % 2), row * Math.sqrt(0.75)))), 'shifted the other way');
  assert.ok(!isHexagonal(image(20, 20, () => 1)));
  // Its rows are closer than its columns: 120 of them span less than 110 columns.
  const upright = guessPixelSize({ ...image(110, 120, (x, y) => 0.005 * hills(x, y)), rowSpacing: Math.sqrt(0.75) });
  assert.ok(upright && Math.abs(upright.pixelSize * 110 - 1) < 1e-3);
});

test('depths are told from heights by their unit and their edges', () => {
  const scene = (/** @type {number} */ unit, /** @type {number} */ beyond) => (/** @type {number} */ col, /** @type {number} */ row) =>
    Math.hypot(col - 80, row - 60) < 40 ? unit * (0.5 + 0.001 * col) : row < 20 ? beyond : unit * (1.6 + 0.002 * row);
  assert.equal(depthUnitOf('a.png', image(160, 120, scene(1000, 0), 'u16')), 'mm');
  assert.equal(depthUnitOf('a.exr', image(160, 120, scene(1, 1e10))), 'm', 'a far background');
  assert.equal(depthUnitOf('a.npy', image(160, 120, (col, row) => 0.1 * col + 0.15 * row)), null, 'a ramp from 0');
  assert.equal(depthUnitOf('dem.tif', image(160, 120, (col, row) => 900 + 10 * hills(col, row), 'u16')), null, 'terrain');
  assert.equal(depthUnitOf('depth.png', image(160, 120, (col) => 800 + col, 'u16')), 'mm', 'by its name');
  assert.equal(depthUnitOf('grey.png', image(160, 120, scene(100, 0), 'u8')), null);
});

test('0 is no data where heights are far from it', () => {
  const framed = (/** @type {number} */ base) => Float64Array.from(grid(60, 40, (col, row) => (col < 5 ? 0 : base + hills(col, row))));
  assert.ok(isZeroNoData(framed(2000)) && isZeroNoData(framed(-2000)));
  assert.ok(!isZeroNoData(framed(0)) && !isZeroNoData(framed(2000).map((z) => z || 7)));
  assert.deepEqual([[1000, 1000], [2000, 2000], [6000, 6000]].map(([width, height]) => coarseningFor({ width, height })), [1, 2, 4]);
});

test('no message has the words of a library', () => {
  for (const [said, means] of /** @type {const} */ ([
    ['cannot read this as PLY: Line 3: Couldn\'t parse line. Error: ParseError { location: LineCol { line: 1 } }', /PLY.*line 3/],
    ['cannot read this as PNG: unexpected end of file', /cut short/],
    ['cannot read this as NPZ: invalid Zip archive: Could not find EOCD', /cut short/],
    ['cannot read this as JPEG: "[strict-mode]: Extra bytes between headers"', /JPEG/],
    ['cannot read this as glTF: expected value at line 1 column 360', /glTF/],
    ['cannot read this as OBJ: face vertex index out of bounds', /corner that is not in the file/],
    ['vertex position of the mesh is inf at row 9, column 0; rows are vertices', /vertex 10/],
  ])) {
    assert.match(plainMessage(said), means);
    assert.doesNotMatch(plainMessage(said), /[{}[\]"]|Error|EOCD|parse|strict|column/);
  }
  assert.equal(plainMessage('cannot read this as PFM: it is cut short: 4 × 4 pixels take 64 bytes, 26 are there'), 'it is cut short: 4 × 4 pixels take 64 bytes, 26 are there');
});

test('what a reader has assumed is one sentence', () => {
  assert.equal(assumedInWords([]), '');
  const assumptions = [{ code: 'noData', words: '-9999 is no data (412 pixels)', option: 'noData' }, { code: 'unit', words: 'lengths are in millimetres' }];
  assert.equal(assumedInWords(assumptions), 'Assumed: -9999 is no data (412 pixels); lengths are in millimetres.');
});
