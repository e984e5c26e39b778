/** `npm run fixtures`: the native library writes what the wasm tests compare with. */
import { rust } from './setup/rust.mjs';
import { native } from './util/env.mjs';
import { root } from './util/paths.mjs';
import { main } from './util/problem.mjs';
import { succeed } from './util/process.mjs';

await main(async () => {
  await rust();
  await succeed('cargo', ['run', '--release', '--example', 'fixtures'], { env: native, cwd: root, show: true });
});
