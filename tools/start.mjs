/** `npm start`: sets up, builds, and serves the page until Ctrl-C. */
import { build } from './build.mjs';
import { setupBuild } from './setup.mjs';
import { main, Problem } from './util/problem.mjs';

await main(async () => {
  const { env } = await setupBuild();
  await build(env);
  const server = await open();
  console.log(`\nThe page is at ${server.url} (Ctrl-C ends this)`);
  for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) {
    process.once(signal, async () => {
      await server.close();
      process.exit(0);
    });
  }
});

/** At the port that was asked for, or at 8080 or the first free one after it. */
async function open() {
  // Only now: on a fresh clone the server's library has just been installed.
  const { serve } = await import('./serve.mjs');
  const { PORT, HOST } = process.env;
  if (PORT && !/^\d{1,5}$/.test(PORT)) throw new Problem(`PORT is set to ${PORT}: set it to a number, or unset it.`);
  const first = PORT ? Number(PORT) : 8080;
  const last = PORT ? first : first + 100;
  for (let port = first; port <= last; port += 1) {
    try {
      return await serve({ port, host: HOST || undefined });
    } catch (error) {
      if (!isTaken(error)) throw new Problem(`Port ${port} cannot be used (${error}): choose another with PORT.`);
    }
  }
  throw new Problem(`Port ${PORT || '8080 and the hundred after it'} is in use: choose another with PORT.`);
}

/** @param {unknown} error */
function isTaken(error) {
  return error instanceof Error && 'code' in error && error.code === 'EADDRINUSE';
}
