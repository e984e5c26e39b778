/** Debian's packages. */
import { readFileSync } from 'node:fs';
import { run } from '../util/process.mjs';
import { which } from '../util/which.mjs';
import { quietly } from './task.mjs';

const env = { ...process.env, DEBIAN_FRONTEND: 'noninteractive' };

export const isRoot = process.getuid?.() === 0;

export const isDebian = (() => {
  try {
    return /^ID=debian$/m.test(readFileSync('/etc/os-release', 'utf8')) && Boolean(which('apt-get'));
  } catch {
    return false;
  }
})();

/** @type {Promise<unknown> | undefined} */
let updated;

/** Brings the lists up to date, once, where one may; old lists are often good enough. */
export function aptUpdate() {
  if (!isRoot) return Promise.resolve();
  updated ??= run('apt-get', ['update', '-q'], { env, limit: 300 });
  return updated;
}

/** @param {...string} packages */
export async function aptInstall(...packages) {
  await aptUpdate();
  const flags = ['-q', '-y', '--no-install-recommends', '-o', 'DPkg::Lock::Timeout=300'];
  return quietly('apt', 'apt-get', ['install', ...flags, ...packages], { env, limit: 900 });
}
