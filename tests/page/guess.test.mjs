/** What is guessed about a file of numbers, and what is said of a broken one. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { assumedInWords } from '../../www/messages.js';
import { coarseningFor } from '../../www/import-interpretation.js';
import { plainMessage } from '../../www/error-messages.js';
import { kindByName } from '../../www/file-kinds.js';
import { routeFiles } from '../../www/file-routing.js';
import { Book } from '../../www/page/book.js';

test('large images are solved on a coarser lattice', () => {
  assert.deepEqual([[1000, 1000], [2000, 2000], [6000, 6000]].map(([width, height]) => coarseningFor({ width, height })), [1, 2, 4]);
});

test('messages are the package’s, in the page’s own marks', () => {
  assert.equal(plainMessage(new Error('NPZ: array `prices`: an array of shape (7).')), 'NPZ: array “prices”: an array of shape (7)');
  assert.match(plainMessage(Object.assign(new Error('no interior vertex'), { code: 'NO_INTERIOR' })), /^there are too few heights/);
});

test('what a reader has assumed is one sentence', () => {
  assert.equal(assumedInWords([]), '');
  const assumptions = [{ code: 'noData', words: '-9999 is no data (412 pixels)', option: 'noData' }, { code: 'unit', words: '`mm` is meant' }];
  assert.equal(assumedInWords(assumptions), 'Assumed: -9999 is no data (412 pixels); “mm” is meant.');
  assert.equal(assumedInWords([{ code: 'square', words: 'pixels are 30.880698999242973 wide' }]), 'Assumed: pixels are 30.88 wide.');
  assert.equal(assumedInWords([{ code: 'noData', words: '0.123456 is no data (127493 pixels)' }]), 'Assumed: 0.123456 is no data (127\u202f493 pixels).');
});

/** A PNG file's beginning, of the given colour type. @param {string} name @param {number} colour @param {number} [bits] */
const pngFile = (name, colour, bits = 8) => new File([Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52, 0, 0, 0, 9, 0, 0, 0, 9, bits, colour, 0, 0, 0)], name);

test('a grey PNG beside one in colour holds its depths, but is a page among photos of pages', async () => {
  const files = [pngFile('scan.png', 0), pngFile('photo.png', 2)];
  const route = (/** @type {boolean} */ inPhotoMode) => routeFiles(files, inPhotoMode);
  assert.deepEqual([(await route(false)).to, (await route(true)).to], ['heights', 'photos']);
  assert.deepEqual((await route(true)).files, files);
  assert.equal((await routeFiles([pngFile('letter.png', 0, 1)], false)).to, 'photos', 'black and white are no heights');
});

test('cameras of COLMAP belong to depths, and its depths are no cameras', async () => {
  const [depths, cameras] = ['depth.npy', 'cameras.bin'].map((name) => new File([], name));
  assert.deepEqual(await routeFiles([cameras, depths], false), { to: 'heights', files: [cameras, depths], left: [] });
  assert.deepEqual(['cameras (1).bin', 'photo.jpg.geometric.bin', 'cameras.jpg.geometric.bin', 'scan.bin'].map((name) => kindByName({ name })), ['camera', null, null, null]);
});

test('the outline of a shown photo is kept when another one is put back before it', () => {
  const book = new Book();
  const [first, second] = ['a.jpg', 'b.jpg'].map((name) => new File([name], name));
  book.setFiles([first, second]);
  const removed = book.remove(0);
  const session = /** @type {import('../../www/page/session.js').PageSession} */ (/** @type {unknown} */ ({ photo: { file: second }, state: () => 'edited' }));
  book.photos.splice(0, 0, removed);
  book.saveState(session);
  assert.deepEqual(book.photos.map(({ state }) => state), [null, 'edited']);
  book.addFiles([new File(['third'], 'c.jpg')]);
  for (const i of [0, 2]) book.photos[i].problem = 'it is empty';
  assert.deepEqual(book.problems(), ['“a.jpg” and “c.jpg”: it is empty']);
});
