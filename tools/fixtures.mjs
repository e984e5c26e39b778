/** `npm run fixtures`: the native library writes what the wasm tests compare with. */
import { rust } from './setup/rust.mjs';
import { native } from './util/env.mjs';
import { root } from './util/paths.mjs';
import { main, Problem } from './util/problem.mjs';
import { run } from './util/process.mjs';

await main(async () => {
  await rust();
  const args = ['run', '--release', '--example', 'fixtures'];
  const { ok, failure } = await run('cargo', args, { env: native, cwd: root, show: true });
  if (!ok) throw new Problem(`The fixtures were not written (${failure}): see what cargo says above.`);
});
