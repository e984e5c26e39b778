/** Surfaces as meshes, read back by the loaders of three.js; directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
// @ts-expect-error three.js has no types of its own
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
// @ts-expect-error
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
// @ts-expect-error
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
// @ts-expect-error
import { STLLoader } from 'three/addons/loaders/STLLoader.js';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { run, silent, temporaryFolder } from './support/command.mjs';
import { error } from './support/error.mjs';
import { placeOf } from './support/shapes.mjs';

after(() => developable.dispose());
await Promise.all([direct.init(), direct.load('files', 'meshes')]);

/** No flip or turn leaves it as it is. @param {number} x @param {number} y */
const height = (x, y) => 0.5 * x + 2 * y;

/** A lattice seen along -y, so that its x, y, z are x, -z, y in space. */
const [rows, cols, spacing, origin] = [5, 6, 0.25, /** @type {[number, number]} */ ([1, 2])];
const count = rows * cols;
const missing = 5;
const plane = Array.from({ length: count }, (_, i) => placeOf({ cols, spacing, origin }, i));
const field = {
  rows, cols, spacing, origin,
  heights: Float64Array.from(plane, ([x, y], i) => (i === missing ? NaN : height(x, y))),
  frame: { right: /** @type {const} */ ([1, 0, 0]), up: /** @type {const} */ ([0, 0, -1]), towards: /** @type {const} */ ([0, 1, 0]) },
  colors: Float32Array.from({ length: 3 * count }, (_, i) => ((i * 37) % 256) / 255),
  uvs: Float32Array.from({ length: 2 * count }, (_, i) => i / 64),
};
const used = plane.map((_, i) => i).filter((i) => i !== missing);

/**
 * Where the vertices of the surface lie in space, and what else they have.
 * @param {number} i
 */
const expected = (i) => {
  const [x, y] = plane[i];
  return {
    position: [x, height(x, y), -y],
    normal: [-0.5, 1, 2].map((v) => v / Math.hypot(0.5, 2, 1)),
    color: [...field.colors.subarray(3 * i, 3 * i + 3)],
    uv: [...field.uvs.subarray(2 * i, 2 * i + 2)],
  };
};

/**
 * @param {any} attribute
 * @param {number} index
 * @param {number[]} values
 * @param {number} [tolerance]
 */
function close(attribute, index, values, tolerance = 1e-6) {
  values.forEach((value, k) => {
    const found = attribute.getComponent(index, k);
    assert.ok(Math.abs(found - value) <= tolerance, `${found} instead of ${value}, vertex ${index}`);
  });
}

/** @param {Uint8Array} bytes */
const bufferOf = ({ buffer, byteOffset, byteLength }) => buffer.slice(byteOffset, byteOffset + byteLength);

/** @type {Record<string, (bytes: Uint8Array) => any>} what makes a BufferGeometry of a file */
const load = {
  ply: (bytes) => new PLYLoader().parse(bufferOf(bytes)),
  stl: (bytes) => new STLLoader().parse(bufferOf(bytes)),
  obj: (bytes) => new OBJLoader().parse(new TextDecoder().decode(bytes)).children[0].geometry,
  glb: async (bytes) => (await new GLTFLoader().parseAsync(bufferOf(bytes), '')).scene.children[0].geometry,
};

/** The lattice vertex at a position in space. @param {any} attribute @param {number} index */
function vertexAt(attribute, index) {
  const [x, , z] = [0, 1, 2].map((k) => attribute.getComponent(index, k));
  const found = used.find((i) => Math.hypot(plane[i][0] - x, -plane[i][1] - z) < 1e-5);
  assert.ok(found !== undefined, `${x} ${z} is no vertex`);
  return found;
}

/**
 * Every triangle faces the viewer, and they are all there: 4 strips of 2 · 5 but for the corner.
 * @param {any} geometry
 */
function checkTriangles({ index, attributes: { position } }) {
  const corners = index ? [...index.array] : Array.from({ length: position.count }, (_, i) => i);
  assert.equal(corners.length, 3 * 39);
  for (let i = 0; i < corners.length; i += 3) {
    // x and -z are the plane's.
    const [a, b, c] = corners.slice(i, i + 3).map((v) => [position.getX(v), -position.getZ(v)]);
    const twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    assert.ok(Math.abs(twice / (spacing * spacing * Math.sqrt(0.75)) - 1) < 1e-4, `${twice}`);
  }
}

const files = {
  ply: direct.writePly(field),
  stl: direct.writeStl(field),
  obj: direct.writeObj(field),
  glb: direct.writeGlb(field),
};

for (const [name, bytes] of Object.entries(files)) {
  test(`another library reads our ${name}`, async () => {
    const geometry = await load[name](bytes);
    const { position, normal, color, uv } = geometry.attributes;
    checkTriangles(geometry);
    const indexed = geometry.index !== null;
    assert.equal(position.count, indexed ? used.length : 3 * 39);
    for (let v = 0; v < position.count; v++) {
      const i = vertexAt(position, v);
      if (indexed) assert.equal(i, used[v]);
      const vertex = expected(i);
      close(position, v, vertex.position);
      close(normal, v, vertex.normal, 1e-5);
      if (name === 'stl') continue;
      // three.js takes the colours of PLY and OBJ for sRGB and makes them linear, those of PLY in bytes.
      const linear = (/** @type {number} */ c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
      close(color, v, name === 'glb' ? vertex.color : vertex.color.map(linear), name === 'ply' ? 0.6 / 255 : 1e-5);
      close(uv, v, name === 'glb' ? [vertex.uv[0], 1 - vertex.uv[1]] : vertex.uv);
    }
  });
}

test('our own reader reads them, too', () => {
  for (const [name, bytes] of Object.entries(files)) {
    const mesh = direct.readMesh(bytes);
    assert.equal(mesh.triangles.length, 3 * 39, name);
    assert.equal(mesh.colors !== undefined, name !== 'stl');
  }
  // Exactly, where the format is exact.
  const { positions, uvs } = direct.readMesh(files.ply);
  assert.deepEqual([...positions], used.flatMap((i) => [plane[i][0], field.heights[i], -plane[i][1]]));
  assert.deepEqual([...(uvs ?? [])], used.flatMap((i) => expected(i).uv));
});

test('the promise API writes the same', async () => {
  const texture = await readFile(new URL('../data/grey.jpg', import.meta.url));
  const file = direct.writeGlb(field, { texture });
  assert.deepEqual(await developable.writeGlb(field, { texture: new Blob([new Uint8Array(texture)]) }), file);
  const embedded = Buffer.from(file).indexOf(texture);
  assert.ok(embedded > 0, 'the picture as it is');
  assert.match(Buffer.from(file).toString('latin1'), /"mimeType":"image\/jpeg"/);
});

test('colours and texture coordinates go through a solve', async () => {
  for (const surface of [direct.fit(field), await developable.fit(field)]) {
    assert.deepEqual([surface.frame, surface.colors, surface.uvs], [field.frame, field.colors, field.uvs]);
  }
  const image = { width: 6, height: 5, data: new Float64Array(30) };
  assert.equal('colors' in direct.fit(image), false);
});

test('what is wrong is said', async () => {
  const any = /** @type {any} */ (field);
  assert.throws(() => direct.writePly({ ...field, colors: new Float32Array(9) }), error('SHAPE', /colors has 9 values.*90/));
  assert.throws(() => direct.writePly({ ...field, uvs: new Float32Array(7) }), error('SHAPE', /uvs has 7 values.*60/));
  assert.throws(() => direct.writeStl({ ...any, colors: 'red' }), error('INPUT', /colors/));
  const texture = new TextEncoder().encode('GIF89a');
  assert.throws(() => direct.writeGlb(field, { texture }), error('UNSUPPORTED', /PNG or JPEG/));
  assert.throws(() => direct.writeGlb(field, /** @type {any} */ ({ texture: 'photo.png' })), error('INPUT', /bytes/));
  assert.throws(() => direct.writeGlb(field, /** @type {any} */ ({ image: texture })), error('OPTION', /`image`/));
  await assert.rejects(developable.writeGlb({ ...field, uvs: undefined }, { texture }), error('UNSUPPORTED', /texture coordinates/));
  const nothing = { ...field, heights: new Float64Array(count).fill(NaN) };
  for (const write of [direct.writeObj, direct.writePly, direct.writeStl]) {
    assert.throws(() => write(nothing), error('UNSUPPORTED', /no triangle/));
  }
});

test('the command writes each by its ending', async () => {
  const folder = await temporaryFolder();
  const heights = direct.writeImage({ ...field, heights: field.heights.map((z) => (Number.isNaN(z) ? 9 : z)) });
  await writeFile(join(folder, 'in.npy'), heights);
  for (const name of ['ply', 'stl', 'glb', 'obj']) {
    const args = ['fit', 'in.npy', '--lattice', 'hex', '-o', `out.${name}`, '--no-data', '9'];
    assert.deepEqual(await run(folder, args), silent);
    const { attributes: { position }, index } = await load[name](await readFile(join(folder, `out.${name}`)));
    assert.equal(index ? position.count : position.count / 3, index ? used.length : 39, name);
    // Row 0 is at y = 0 here, and above it there is nothing.
    const ys = Array.from({ length: position.count }, (_, i) => position.getY(i));
    assert.ok(Math.max(...ys) < 1e-6 && Math.min(...ys) < -3);
  }
  // A mesh's colours stay with it.
  await writeFile(join(folder, 'coloured.ply'), files.ply);
  const args = ['fit', 'coloured.ply', '--unit', 'mm', '--view', '-y', '--spacing', '0.1', '--lambda', 'big', '-o', 'again.ply'];
  assert.deepEqual(await run(folder, args), silent);
  const { colors, positions } = direct.readMesh(await readFile(join(folder, 'again.ply')));
  assert.equal(colors?.length, positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = positions.subarray(i, i + 3);
    assert.ok(Math.abs(y - height(x, -z)) < 1e-5);
  }
});
