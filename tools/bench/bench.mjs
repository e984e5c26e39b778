/** Measurements, each in a process of its own and each made once, however many tables use it. */
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { native } from '../util/env.mjs';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run, succeed } from '../util/process.mjs';
import { exampleInput } from './inputs.mjs';
import { count, seconds } from './text.mjs';

/**
 * @typedef {import('./task.mjs').Input} Input
 * @typedef {import('./task.mjs').Settings} Settings
 * @typedef {import('./task.mjs').Method} Method
 * @typedef {import('./task.mjs').Measurement} Measurement
 * @typedef {{ method?: Method, from?: Partial<Settings> }} How by which method, and from where
 * @typedef {import('../../pkg/types.js').ExampleName} ExampleName
 */

const wasmProgram = fileURLToPath(new URL('wasm.mjs', import.meta.url));
const target = join(root, 'target/bench');
const nativeProgram = join(target, 'release', process.platform === 'win32' ? 'developable-bench.exe' : 'developable-bench');

/** @type {Omit<Settings, 'normalize'>} */
const defaults = { lambda: 1e6, schedule: 'default', gap: 0.01, maxIterations: 20_000 };

/** A measurement that takes longer than this hangs. */
const limit = 15 * 60;

/** Compiles the native program. */
export function buildNative() {
  const args = ['build', '--release', '--manifest-path', join(root, 'benches/Cargo.toml'), '--target-dir', target];
  return succeed('cargo', args, { env: native, cwd: root, show: true });
}

export class Bench {
  /** @type {Map<string, Promise<any>>} */
  #known = new Map();
  #folder;

  /**
   * @param {string} folder for inputs
   * @param {boolean} quick
   */
  constructor(folder, quick) {
    this.#folder = folder;
    this.quick = quick;
  }

  /**
   * @param {ExampleName} name
   * @param {number} vertices about so many
   * @param {Input['lattice']} [lattice]
   * @returns {Promise<Input>}
   */
  example(name, vertices, lattice) {
    return this.#once({ name, vertices, lattice }, () =>
      exampleInput(this.#folder, name, vertices, lattice));
  }

  /**
   * @param {Input} input
   * @param {Partial<Settings>} [options]
   * @param {How} [how]
   */
  native(input, options, how) {
    return this.#measure('native', nativeProgram, [], input, options, how);
  }

  /**
   * @param {Input} input
   * @param {Partial<Settings>} [options]
   * @param {Pick<How, 'from'>} [how]
   */
  wasm(input, options, how) {
    return this.#measure('wasm', process.execPath, [wasmProgram], input, options, how);
  }

  /**
   * @param {string} where
   * @param {string} program
   * @param {string[]} args
   * @param {Input} input
   * @param {Partial<Settings> | undefined} options
   * @param {How} [how]
   * @returns {Promise<Measurement>}
   */
  #measure(where, program, args, input, options, { method = 'library', from } = {}) {
    const all = { ...defaults, normalize: input.normalize };
    const settings = { ...all, ...options };
    const task = JSON.stringify({ method, input, options: settings, from: from && { ...all, ...from } });
    return this.#once({ where, task }, async () => {
      const { ok, output, failure } = await run(program, [...args, task], { cwd: root, limit });
      const result = output.split('\n').find((line) => line.startsWith('{'));
      if (!ok || !result) throw new Problem(`The measurement ${where} ${task} gave nothing (${failure}): ${output}`);
      /** @type {Measurement} */
      const measurement = JSON.parse(result);
      const what = from ? 'restart' : method === 'library' ? `${settings.schedule} schedule` : method;
      const to = `lambda ${settings.lambda.toExponential()}, gap ${settings.gap.toExponential(1)}`;
      console.log(`  ${where}, ${what}, ${input.name} of ${count(measurement.vertices)}, ${to}: ${seconds(measurement.seconds)}`);
      return measurement;
    });
  }

  /**
   * @template T
   * @param {object} key
   * @param {() => Promise<T>} make
   * @returns {Promise<T>}
   */
  #once(key, make) {
    const name = JSON.stringify(key);
    const found = this.#known.get(name) ?? make();
    this.#known.set(name, found);
    return found;
  }
}
