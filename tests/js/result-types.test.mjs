/** What calls return has the properties that the types declare: all that are required, and no others. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { parse } from 'rolldown/utils';
import * as direct from '../../pkg/direct.js';
import { gridMesh, image, lattice, noisy } from './support/shapes.mjs';

/** @typedef {any} Node of the syntax tree */
/** @typedef {Map<string, { optional: boolean, type: Node }>} Members */

/** The interfaces of the package, by name. @type {Map<string, Node>} */
const interfaces = new Map();
for (const file of ['types', 'result-types']) {
  const { program } = await parse(`${file}.d.ts`, await readFile(new URL(`../../pkg/${file}.d.ts`, import.meta.url), 'utf8'));
  for (const { declaration } of /** @type {Node[]} */ (program.body)) {
    if (declaration?.type === 'TSInterfaceDeclaration') interfaces.set(declaration.id.name, declaration);
  }
}

/** @param {Node[]} members @returns {Members} */
const membersOf = (members) =>
  new Map(members.map(({ key, optional, typeAnnotation }) => [key.name, { optional, type: typeAnnotation?.typeAnnotation }]));

/** The members of a named interface, with those that it extends. @param {string} name @returns {Members | undefined} */
function interfaceOf(name) {
  const declaration = interfaces.get(name);
  if (declaration === undefined) return undefined;
  const inherited = declaration.extends.flatMap((/** @type {Node} */ { expression, typeArguments }) => {
    if (expression.name !== 'Omit') return [...(interfaceOf(expression.name) ?? [])];
    const [base, omitted] = typeArguments.params;
    const names = (omitted.types ?? [omitted]).map((/** @type {Node} */ { literal }) => literal.value);
    return [...(interfaceOf(base.typeName.name) ?? [])].filter(([member]) => !names.includes(member));
  });
  return new Map([...inherited, ...membersOf(declaration.body.body)]);
}

/** @param {Node} type @returns {Members | undefined} */
function shapeOf(type) {
  if (type?.type === 'TSTypeLiteral') return membersOf(type.members);
  return type?.type === 'TSTypeReference' ? interfaceOf(type.typeName.name) : undefined;
}

let compared = 0;

/**
 * Compares a value with its type, and what is in it.
 * @param {unknown} value
 * @param {Node} type
 * @param {string} path
 */
function compare(value, type, path) {
  if (type?.type === 'TSArrayType' && Array.isArray(value)) {
    for (const one of value.slice(0, 3)) compare(one, type.elementType, `${path}[]`);
    return;
  }
  const members = shapeOf(type);
  if (members === undefined || typeof value !== 'object' || value === null) return;
  compared += 1;
  const entries = Object.entries(value).filter(([, one]) => one !== undefined);
  const names = entries.map(([name]) => name);
  assert.deepEqual(names.filter((name) => !members.has(name)), [], `${path} has what its type does not declare`);
  const required = [...members].filter(([, { optional }]) => !optional).map(([name]) => name);
  assert.deepEqual(required.filter((name) => !names.includes(name)), [], `${path} lacks what its type declares`);
  for (const [name, one] of entries) compare(one, members.get(name)?.type, `${path}.${name}`);
}

await direct.init();
await direct.load('files', 'images', 'meshes', 'fitmesh', 'unroll', 'patterns');

const roof = (/** @type {number} */ x) => 12 - 0.6 * Math.abs(x - 20);
const scan = image(40, 32, noisy(roof, 0.1));
const field = lattice(24, 24, (x) => 3 - 0.4 * Math.abs(x - 12));
const mesh = gridMesh(13, 9, (col, row) => [col, row, -0.5 * Math.abs(col - 6)]);
const photo = { width: 40, height: 32, data: new Uint8ClampedArray(4 * 40 * 32).fill(200) };

const page = { width: 480, height: 640, data: new Uint8ClampedArray(4 * 480 * 640).fill(200) };
/** The edge of a curled page. @param {number} y */
const edge = (y) => Array.from({ length: 21 }, (_, i) => /** @type {[number, number]} */ ([60 + 18 * i, y - 20 * Math.sin((Math.PI * i) / 20)]));

/** Results by the names of their types. @type {[string, () => unknown][]} */
const results = [
  ['ImageSurface', () => direct.fit(scan)],
  ['LatticeSurface', () => direct.fit(field, { paper: true, schedule: 'paper', maxIterations: 20 })],
  ['ImageSurface', () => direct.fit({ ...scan, data: undefined, constraints: Float64Array.from(scan.data, (z, i) => (i % 7 ? NaN : z)) })],
  ['MeshSurface', () => direct.fitMesh(mesh)],
  ['DetectedOcclusions', () => direct.occlusions(scan)],
  ['FittedCylinder', () => direct.fitCylinder(field)],
  ['Analysis', () => direct.analyze(scan, { reference: scan })],
  ['MeshAnalysis', () => direct.analyze(mesh)],
  ['PatchMap', () => direct.patches(scan)],
  ['RulingField', () => direct.rulings(field)],
  ['MeshPatchMap', () => direct.patches(mesh)],
  ['MeshRulings', () => direct.rulings(mesh)],
  ['Unrolling', () => direct.unroll(field)],
  ['MeshUnrolling', () => direct.unroll(mesh)],
  ['Drawing', () => direct.pattern(field, { assembly: true, stock: 'a4', tabs: 2, marks: 5, refold: true })],
  ['Drawing', () => direct.pattern(mesh)],
  ['Dewarped', () => direct.dewarp(image(40, 32, roof), photo, { grid: true })],
  ['DewarpedPage', () => direct.dewarpPage(page, { top: edge(100), bottom: edge(560) }, { focalLength: 480, page: 'a4', grid: true })],
  ['FlatPage', () => direct.flattenPhoto(page, direct.dewarpPage(page, { top: edge(100), bottom: edge(560) }, { focalLength: 480 }))],
  ['SampledMesh', () => direct.sampleMesh(mesh)],
  ['ReadResult', () => direct.read(direct.writeImage(scan))],
  ['DecodedPhoto', () => direct.readPhoto(direct.writePhoto(photo))],
  ['Example', () => direct.example('cone', { size: 20 })],
];

test('results have the properties that the types declare', () => {
  for (const [type, result] of results) {
    assert.ok(interfaceOf(type), `there is no interface ${type}`);
    compare(result(), { type: 'TSTypeReference', typeName: { name: type } }, type);
  }
  assert.ok(compared > 60, `${compared} objects`);
});
