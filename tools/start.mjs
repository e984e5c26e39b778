/**
 * `npm start`: sets up, builds, and serves the bundled page until Ctrl-C. `npm run dev` serves its files as they are, with a
 * build that is quick to repeat.
 */
import { join } from 'node:path';
import { build } from './build.mjs';
import { bundlePage, compressFiles } from './site.mjs';
import { writeGuide } from './site/guide.mjs';
import { pkg, root, www } from './util/paths.mjs';
import { main, Problem } from './util/problem.mjs';

/** Where the guides that the page links to are written. */
const documents = join(root, 'target/documents');
/** Where the bundled page is written. */
const bundle = join(root, 'target/page');
const isQuick = process.argv.includes('--quick');

await main(async () => {
  const ports = candidates(process.env.PORT);
  await build(isQuick ? 'quick' : 'release', { threads: false });
  const server = await open(ports);
  console.log(`\nThe page is at ${server.url} (Ctrl-C ends this)`);
  for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) {
    process.once(signal, async () => {
      await server.close();
      process.exit(0);
    });
  }
});

/**
 * The port that was asked for, or 8080 and those after it.
 * @param {string | undefined} wish
 */
function candidates(wish) {
  if (!wish) return Array.from({ length: 100 }, (_, index) => 8080 + index);
  const port = Number(wish);
  if (Number.isInteger(port) && port >= 0 && port < 65536) return [port];
  throw new Problem(`PORT is set to ${wish}: set it to a number from 0 to 65535, or unset it.`);
}

/** @param {number[]} ports */
async function open(ports) {
  // Only now: on a fresh clone the server's library has just been installed.
  const { isolation, serve } = await import('./serve.mjs');
  await writeGuide(documents, { references: false });
  if (!isQuick) {
    await bundlePage(bundle);
    await compressFiles(bundle);
  }
  const folders = { '/': isQuick ? www : bundle, '/pkg/': pkg, '/guide/': join(documents, 'guide') };
  for (const port of ports) {
    try {
      return await serve({ port, host: process.env.HOST || undefined, folders, headers: isolation });
    } catch (error) {
      if (!isTaken(error)) throw new Problem(`Port ${port} cannot be used (${error}): set PORT to another.`);
    }
  }
  throw new Problem(`Port ${ports.length > 1 ? `${ports[0]} and those after it are` : `${ports[0]} is`} in use: set PORT to another.`);
}

/** @param {unknown} error */
function isTaken(error) {
  return error instanceof Error && 'code' in error && error.code === 'EADDRINUSE';
}
