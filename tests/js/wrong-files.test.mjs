/** Files of the wrong kind, given to each call that reads one: a typed error says what the file is and what to do. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import { run, succeeds, temporaryFolder } from './support/command.mjs';
import { root } from './support/paths.mjs';

after(() => developable.dispose());

/** @param {string} text in Latin-1 */
const bytes = (text) => Uint8Array.from(text, (letter) => letter.charCodeAt(0));

const CALLS = /** @type {Record<string, (file: Uint8Array) => Promise<unknown>>} */ ({
  read: developable.read,
  readPhoto: developable.readPhoto,
  readMesh: developable.readMesh,
  findPage: developable.findPage,
  dewarpPage: developable.dewarpPage,
});

/** First bytes as other programs write them, the name of the format, and what to do. @type {[string, RegExp, RegExp][]} */
const FOREIGN = [
  ['\0\0\0\x18ftypheic\0\0\0\0mif1heic', /^HEIC/, /as JPEG/],
  ['\0\0\0\x20ftypisom\0\0\x02\0isomiso2mp41', /^film/, /one of its pictures/],
  ['\xff\x0a\xfa\x7f', /^JPEG XL/, /as JPEG/],
  ['8BPS\0\x01', /^Photoshop/, /as JPEG/],
  ['%PDF-1.7\n', /^PDF/, /pdftoppm/],
  ['PK\x03\x04\x14\0\x06\0\x08\0\0\0!\0[Content_Types].xml word/document.xml', /^document of an office/, /as PDF/],
  ['PK\x03\x04\x14\0\0\0\0\0main.xml bindata/data.bin', /^X3P/, /Gwyddion/],
  ['PK\x03\x04\x14\0\0\0\0\0letter.txt', /^archive/, /unpack/],
  ['\x1f\x8b\x08\0\0\0\0\0', /^archive/, /unpack/],
  ['GWYPGwyContainer', /^Gwyddion/, /TIFF/],
  ['Lerc2 \x04\0\0\0', /^LERC/, /gdal_translate/],
  ['\x80\x04\x95\xff', /^pickle/, /numpy\.save/],
  ['ISO-10303-21;\nHEADER;\n', /^drawing or solid of CAD/, /STL or 3MF/],
  ['Kaydara FBX Binary  \0', /^FBX/, /GLB/],
  ['#usda 1.0\n', /^USD/, /GLB/],
  ['newmtl a\nKd 1 1 1\n', /^MTL/, /OBJ/],
  ['<!DOCTYPE html><html><title>404 Not Found</title></html>', /^web page/, /download/],
  ['version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n', /^pointer of Git LFS/, /git lfs pull/],
  ['Dear Sir or Madam,\nplease find attached the letter.\n', /^text/, /read from/],
  ['\x07\x07\x07\x07\x07\x07\x07\x07', /^a file of unknown format/, /read from/],
  // Numbers in 32 bits, each of whose bytes might be a letter.
  ['\xb0\xfa*\xbf\xba\x9a+\xbf', /^a file of unknown format/, /read from/],
];

/**
 * @param {string} call
 * @param {Uint8Array} file
 * @param {string} code
 * @param {...RegExp} words
 */
async function refused(call, file, code, ...words) {
  await assert.rejects(CALLS[call](file), (/** @type {unknown} */ error) => {
    assert.ok(error instanceof developable.DevelopableError, `${call}: ${error}`);
    assert.equal(error.code, code, `${call}: ${error.message}`);
    for (const word of words) assert.match(error.message, word, call);
    return true;
  });
}

test('files of other programs are named with what to do, whatever reads them', async () => {
  for (const call of Object.keys(CALLS)) {
    for (const [head, name, advice] of FOREIGN) await refused(call, bytes(head), 'UNSUPPORTED', name, advice);
    await refused(call, new Uint8Array(0), 'FORMAT', /the file is empty/);
  }
});

test('`info` names archives that are none of NumPy, too', async () => {
  const folder = await temporaryFolder();
  for (const [head, name] of FOREIGN.filter(([head]) => head.startsWith('PK'))) {
    await writeFile(join(folder, 'a.bin'), bytes(head));
    const { status, stderr } = await run(folder, ['info', 'a.bin']);
    assert.equal(status, 3);
    assert.match(stderr.replace('developable: a.bin: ', ''), name);
  }
});

test('what another call reads is named with it', async () => {
  const [jpeg, npy, stl] = [await readFile(join(root, 'tests/data/grey.jpg')), await readFile(join(root, 'tests/data/f4-le.npy')), bytes('solid a\nfacet normal 0 0 1\n')];
  for (const call of ['read', 'readPhoto', 'dewarpPage']) await refused(call, stl, 'UNSUPPORTED', /^STL: it is a mesh/);
  for (const call of ['readPhoto', 'dewarpPage']) await refused(call, npy, 'UNSUPPORTED', /^NPY: it has heights/);
  for (const file of [jpeg, npy]) await refused('readMesh', file, 'UNSUPPORTED', /^(JPEG|NPY): it is an image/);
});

test('the command names a photo that is not read with what to do', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'IMG_1.HEIC'), '\0\0\0\x18ftypheic\0\0\0\0mif1heic');
  await writeFile(join(folder, 'scan.pdf'), '%PDF-1.7\n');
  for (const [name, words] of /** @type {[string, RegExp][]} */ ([['IMG_1.HEIC', /HEIC: save it as JPEG/], ['scan.pdf', /PDF: .*pdftoppm/]])) {
    const { status, stderr } = await run(folder, ['dewarp', name, '-o', 'flat.png']);
    assert.equal(status, 3, stderr);
    assert.match(stderr, words);
  }
});

test('the command takes a file by what is in it where its name does not tell', async () => {
  const folder = await temporaryFolder();
  const triangle = 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 60 0 0\nvertex 0 60 0\nendloop\nendfacet\nendsolid a\n';
  // A scanner's cloud of points that are on no grid.
  const cloud = Array.from({ length: 90 }, (_, i) => [i, (i * i) % 91, (i * 7) % 13].map((x, k) => (x + 0.013 * i * (k + 1)).toFixed(3)).join(' ')).join('\n');
  const matrix = Array.from({ length: 9 }, (_, row) => Array.from({ length: 12 }, (_, col) => row + 2 * col).join(' ')).join('\n');
  for (const [name, text, told] of /** @type {[string, string, RegExp][]} */ ([
    ['part', triangle, /triangles: +1/], ['part.STL.txt', triangle, /triangles: +1/], ['scan.txt', cloud, /none: a point cloud/],
    ['scan.asc', cloud, /none: a point cloud/], ['matrix.txt', matrix, /12 × 9 pixels/],
  ])) {
    await writeFile(join(folder, name), text);
    const { stdout } = await succeeds(folder, ['info', name]);
    assert.match(stdout, told);
  }
});

test('a file that is cut short is said to be, and nothing else', async () => {
  for (const name of ['grey.jpg', 'grey16.png', 'f4.tif', 'grey.webp', 'f4-le.npy']) {
    const file = await readFile(join(root, 'tests/data', name));
    await refused('read', file.subarray(0, file.length - 20), 'FORMAT', /cut short.*; copy, download or export it again$/);
  }
  // What a decoder says of itself comes after what it means.
  await refused('readMesh', bytes('{"asset":{"version":"2.0"},'), 'FORMAT', /glTF: it is cut short: it ends before all of it is there; copy/);
  await refused('readMesh', bytes('{"asset":?}'), 'FORMAT', /glTF: a part of it cannot be read \(.*\); copy/);
  const old = bytes('{"asset":{"version":"1.0"},"meshes":{}}');
  await refused('readMesh', old, 'UNSUPPORTED', /^glTF: only version 2 is read; `gltf-pipeline /);
  const far = bytes('{"asset":{"version":"2.0"},"buffers":[{"uri":"https://example.com/b.bin","byteLength":4}]}');
  await refused('readMesh', far, 'UNSUPPORTED', /on another machine, and is not fetched/);
});
