/** On what was measured. */
import { cpus } from 'node:os';
import { native } from '../util/env.mjs';
import { root } from '../util/paths.mjs';
import { run } from '../util/process.mjs';

export async function machine() {
  const [cpu, ...more] = cpus();
  const { output } = await run('rustc', ['--version'], { env: native, cwd: root });
  const rustc = /^rustc (\S+)/m.exec(output)?.[1] ?? 'of an unknown version';
  const cores = `${more.length + 1} ${more.length === 0 ? 'core' : 'cores'}`;
  return `${cpu?.model.trim() ?? 'unknown processor'}, ${cores}, `
    + `${process.platform} ${process.arch}; Node ${process.versions.node}, rustc ${rustc}`;
}
