/** Which folder of `src/` may import from which, that no modules import each other in a circle, and what is written about them. */
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { circles, librarySources, moduleGraph } from '../../tools/docs/modules.mjs';
import { root } from './support/paths.mjs';

/** The rooms of the library: each imports only from those before it. */
const ROOMS = [
  'error', 'progress', 'math', 'lattice', 'heights', 'scene', 'examples', 'fit', 'shape', 'unroll', 'dewarp', 'page', 'picture', 'pattern',
  'drawing', 'assembly', 'explore', 'files',
];

/** @param {string} name */
const roomOf = (name) => name.split('::')[0];

test('every room imports only from rooms before it', () => {
  const graph = moduleGraph();
  assert.ok(graph.size > 100, `only ${graph.size} modules were found`);
  const upwards = [...graph].flatMap(([from, targets]) => {
    const own = ROOMS.indexOf(roomOf(from));
    assert.ok(own >= 0, `the room of ${from} has no place in the order`);
    return [...targets].filter((to) => ROOMS.indexOf(roomOf(to)) > own).map((to) => `${from} imports ${to}`);
  });
  assert.deepEqual(upwards, []);
});

test('no modules of a room import each other in a circle', () => {
  const found = circles(moduleGraph()).map((group) => group.join(', '));
  assert.deepEqual(found, []);
});

test('every module begins with documentation that says what it is', () => {
  const modules = librarySources();
  assert.ok(modules.size > 200, `only ${modules.size} modules were found`);
  assert.deepEqual([...modules].filter(([, text]) => !/^(?:\/\/!\n)*\/\/! *\S/.test(text)).map(([path]) => path), []);
});

test('ARCHITECTURE.md is short, has every room, and names no file that is not there', () => {
  const text = readFileSync(join(root, 'ARCHITECTURE.md'), 'utf8');
  const lines = text.split('\n').length;
  assert.ok(lines <= 250, `${lines} lines`);
  assert.deepEqual(ROOMS.filter((room) => !new RegExp(`^\\| \`${room}/?\``, 'm').test(text)), []);
  const named = [...text.matchAll(/`([\w./-]+(?:\/|\.(?:rs|js|mjs|ts)))`/g)].map(([, path]) => path);
  assert.ok(named.length > 80, `${named.length} files are named`);
  const folders = ['', 'src', 'src/fit', 'src/unroll', 'src/pattern'];
  assert.deepEqual(named.filter((path) => !folders.some((folder) => existsSync(join(root, folder, path)))), []);
});
