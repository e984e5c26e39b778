/** The server of `npm start`: no request ends it, and none gets more than the folders it serves. */
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { chmod, mkdir, readFile, writeFile } from 'node:fs/promises';
import { connect } from 'node:net';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { brotliCompressSync } from 'node:zlib';
import { temporaryFolder } from './support/command.mjs';
import { root } from './support/paths.mjs';

const outside = await temporaryFolder();
const folder = join(outside, 'site');
await mkdir(join(folder, 'sub.js'), { recursive: true });
await mkdir(join(folder, 'assets'));
await writeFile(join(folder, 'assets/a.js'), 'export {};');
await writeFile(join(folder, 'assets/a.js.br'), brotliCompressSync('export {};'));
await writeFile(join(outside, 'secret.txt'), 'secret');
await writeFile(join(folder, 'index.html'), '<title>page</title>');
await writeFile(join(folder, 'a b%.js'), 'export {};');
await writeFile(join(folder, 'empty.js'), '');
await writeFile(join(folder, 'unreadable.js'), 'x');
await chmod(join(folder, 'unreadable.js'), 0);

// In a process of its own: what ends the server must not end the test.
const script = `
  const { serve } = await import(${JSON.stringify(new URL('../../tools/serve.mjs', import.meta.url).href)});
  const { url } = await serve(${JSON.stringify({ folders: { '/': folder } })});
  console.log(url);
`;
const child = spawn(process.execPath, ['--input-type=module', '-e', script], { stdio: ['ignore', 'pipe', 'inherit'] });
after(() => child.kill());
let ended = false;
child.on('exit', () => (ended = true));
const url = await new Promise((/** @type {(url: string) => void} */ resolve, reject) => {
  child.stdout.once('data', (line) => resolve(String(line).trim()));
  child.once('exit', () => reject(new Error('the server did not start')));
});
const { port } = new URL(url);

/**
 * What the server answers to these bytes until it closes the connection or falls silent.
 * @param {string} bytes
 * @param {boolean} [hangUp] whether to leave at once
 * @returns {Promise<string>}
 */
function raw(bytes, hangUp = false) {
  return new Promise((resolve) => {
    const socket = connect(Number(port), '127.0.0.1');
    let text = '';
    socket.setEncoding('latin1');
    socket.on('data', (chunk) => (text += chunk));
    socket.on('error', () => {});
    socket.on('close', () => resolve(text));
    socket.setTimeout(300, () => socket.destroy());
    socket.write(bytes, 'latin1', () => hangUp && socket.destroy());
  });
}

/** @param {string} path @param {string} [headers] @param {string} [method] */
const request = (path, headers = '', method = 'GET') =>
  `${method} ${path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n${headers}\r\n`;

async function pageIsThere() {
  const response = await fetch(url);
  assert.equal(response.status, 200);
  assert.equal(await response.text(), '<title>page</title>');
  assert.match(response.headers.get('content-type') ?? '', /^text\/html/);
  assert.match(response.headers.get('content-security-policy') ?? '', /default-src 'self'/);
}

const ranges = [
  'bytes=5-2', 'bytes=-', 'bytes=-0', 'bytes=0-', 'bytes=99999999-', 'bytes=-99999999', 'bytes=1-2,5-3', 'bytes=a-b',
  'bytes=-5--2', 'bytes=1e9-2', 'lines=1-2', 'bytes', '', `bytes=${'1-2,'.repeat(2000)}`, 'bytes=18446744073709551616-1',
];
const paths = [
  '/%', '/%zz', '/%00', '/a%00.js', '/%c0%af', '/%ff%fe', '/..', '/../secret.txt', '/%2e%2e/secret.txt', '/..%2fsecret.txt',
  '/..%5csecret.txt', '/....//secret.txt', '//secret.txt', '//', '///etc/passwd', '/%2fetc/passwd', '/./.', '/sub.js', '/sub.js/',
  '/unreadable.js', '/index.html/', '/index.html/x', `/${'a'.repeat(5000)}`, `/${'a/'.repeat(3000)}`, '*', 'x', 'http://', 'http://[/',
  'http://x/../secret.txt', '/?%', '/#%', '/index.html?..', '/\\..\\secret.txt', '/nul', '/con',
];
const methods = ['POST', 'PUT', 'DELETE', 'OPTIONS', 'PATCH', 'TRACE', 'CONNECT', 'PROPFIND', 'FOO', 'get', ''];
const broken = [
  '', '\r\n\r\n', '\0\0\0\0', 'GET', 'GET / HTTP/9.9\r\n\r\n', 'GET /\r\n\r\n', 'GET / HTTP/1.1\r\n\r\n',
  'GET / HTTP/1.1\r\nHost: x\r\nHost: y\r\n\r\n', 'GET / HTTP/1.1\r\nHost', 'GET / HTTP/1.1\r\n : x\r\n\r\n',
  request('/', `X: ${'y'.repeat(40000)}\r\n`), request('/', 'X: y\r\n'.repeat(3000)),
  request('/', 'Content-Length: -1\r\n'), request('/', 'Content-Length: 1\r\nTransfer-Encoding: chunked\r\n'),
  request('/', 'Transfer-Encoding: chunked\r\n') + 'zz\r\n', request('/', 'Expect: 100-continue\r\n'), request('/', 'Expect: tea\r\n'),
  request('/', 'Connection: Upgrade\r\nUpgrade: websocket\r\n'), '\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03',
  'PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n',
];

test('the page is served, with its length and its type', async () => {
  await pageIsThere();
  const script = await fetch(`${url}a%20b%25.js`);
  assert.equal(await script.text(), 'export {};');
  assert.match(script.headers.get('content-type') ?? '', /^text\/javascript/);
  assert.equal((await fetch(`${url}empty.js`)).status, 200);
  assert.equal((await fetch(`${url}nowhere.js`)).status, 404);
  const head = await fetch(url, { method: 'HEAD' });
  assert.deepEqual([head.status, head.headers.get('content-length')], [200, '19']);
});

test('no request ends the server, and none leads out of the folder', async () => {
  const requests = [
    ...ranges.map((range) => request('/', `Range: ${range}\r\n`)),
    ...ranges.map((range) => request('/empty.js', `Range: ${range}\r\n`)),
    ...paths.flatMap((path) => [request(path), request(path, '', 'HEAD')]),
    ...methods.map((method) => request('/', '', method)),
    ...broken,
  ];
  for (const text of requests) {
    const answer = await raw(text);
    assert.ok(!ended, `it ended with ${JSON.stringify(text.slice(0, 80))}`);
    assert.ok(!answer.includes('secret'), text.slice(0, 80));
    assert.ok(answer === '' || answer.startsWith('HTTP/1.1 '), answer.slice(0, 80));
  }
  for (const text of requests) await raw(text, true);
  for (const text of requests) await raw(text.slice(0, text.length / 2), true);
  assert.ok(!ended);
  await pageIsThere();
});

test('only what is there is cached', async () => {
  const kept = 'public, max-age=31536000, immutable';
  /** @type {[string, Record<string, string>, [number, string, string | null]][]} */
  const cases = [
    ['assets/a.js', {}, [200, kept, 'br']],
    ['assets/a.js', { Range: 'bytes=999-' }, [416, 'no-store', null]],
    ['assets/gone.js', {}, [404, 'no-store', null]],
    ['empty.js?/assets/', {}, [200, 'no-store', null]],
  ];
  for (const [path, headers, expected] of cases) {
    const { status, headers: told } = await fetch(url + path, { headers: { 'Accept-Encoding': 'br', ...headers } });
    assert.deepEqual([status, told.get('cache-control'), told.get('content-encoding')], expected, path);
  }
});

test('a range is sent, and one that is none refused', async () => {
  const part = await fetch(url, { headers: { Range: 'bytes=1-5' } });
  assert.deepEqual([part.status, await part.text()], [206, 'title']);
  const backwards = await fetch(url, { headers: { Range: 'bytes=5-2' } });
  assert.equal(backwards.status, 416);
});

test('`npm start` serves the page itself', async () => {
  const { serve } = await import('../../tools/serve.mjs');
  const server = await serve();
  const response = await fetch(server.url);
  assert.equal(await response.text(), await readFile(join(root, 'www/index.html'), 'utf8'));
  const library = await fetch(`${server.url}pkg/index.js`);
  assert.equal(await library.text(), await readFile(join(root, 'pkg/index.js'), 'utf8'));
  await server.close();
});
