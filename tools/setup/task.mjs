/** A part of the set-up that takes its time: says what it does, how long it may take and took. */
import { mkdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { cache } from '../util/paths.mjs';
import { run } from '../util/process.mjs';

/**
 * @template T
 * @param {string} what
 * @param {string} time
 * @param {() => Promise<T>} work
 */
export async function task(what, time, work) {
  console.log(`- ${what} (${time})`);
  const start = performance.now();
  const result = await work();
  console.log(`  done in ${((performance.now() - start) / 1000).toFixed(1)} s: ${what}`);
  return result;
}

/**
 * Runs a program quietly. What it printed goes to a log in the cache when it fails, and in CI,
 * whose disk is gone afterwards, to the screen; the failure names the log.
 * @param {string} log
 * @param {string} command
 * @param {readonly string[]} args
 * @param {import('../util/process.mjs').Options} [options]
 */
export async function quietly(log, command, args, options) {
  const result = await run(command, args, options);
  if (result.ok) return result;
  const file = join(cache, 'logs', `${log}.log`);
  await mkdir(join(cache, 'logs'), { recursive: true });
  await writeFile(file, result.output);
  if (process.env.CI) console.log(result.output.slice(-4000));
  return { ...result, failure: `${result.failure}, log in ${file}` };
}
