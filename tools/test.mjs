/**
 * `npm test`: sets up and runs every test there is; `npm test -- NAME...` those whose name contains one of the words;
 * `npm test -- --quick` what one minute is enough for once it was compiled.
 */
import { compileWasm } from './build/wasm.mjs';
import { setupTests } from './setup.mjs';
import { main, Problem, describe } from './util/problem.mjs';
import { shownLater } from './util/process.mjs';
import { steps } from './test/steps.mjs';
import { Skip } from './test/step.mjs';

/** @typedef {{ name: string, seconds: number, state: 'passed' | 'failed' | 'skipped', remark: string }} Outcome */

await main(async () => {
  const words = process.argv.slice(2).filter((word) => word !== '--quick');
  const among = process.argv.includes('--quick') ? steps.filter(({ quick }) => quick) : steps;
  const chosen = among.filter(({ name }) => words.length === 0 || words.some((word) => name.includes(word)));
  if (chosen.length === 0) {
    throw new Problem(`No test has such a name: there are ${among.map(({ name }) => name).join(', ')}.`);
  }
  console.log(`${chosen.length} steps: less than ${duration(total(chosen))} on two idle cores after \`npm start\`, longer where more is to be compiled.`);
  // The tools and the wasm are compiled side by side.
  const compile = chosen.some(({ name }) => name === 'build') ? compileWasm : undefined;
  const context = await timed('Set-up', () => setupTests(compile));

  /** The steps that run beside the others, each after the one before. */
  let last = Promise.resolve();
  const begun = new Map(chosen.filter(({ beside }) => beside).map((step) => {
    const own = { text: '', isShown: false };
    const outcome = last.then(() => shownLater.run(own, () => attempt(step, context)));
    last = outcome.then(() => {});
    return [step, { own, outcome }];
  }));
  /** @type {Outcome[]} */
  const outcomes = [];
  for (const step of chosen) {
    heading(`${step.name}: ${step.what} (about ${duration(step.seconds)})`);
    const started = begun.get(step);
    if (started) {
      process.stdout.write(started.own.text);
      started.own.isShown = true;
    }
    const outcome = await (started?.outcome ?? attempt(step, context));
    console.log(`${outcome.state} in ${outcome.seconds.toFixed(1)} s${outcome.remark && `: ${outcome.remark}`}`);
    outcomes.push(outcome);
  }
  summary(outcomes);
});

/**
 * @param {import('./test/step.mjs').Step} step
 * @param {import('./test/step.mjs').Context} context
 * @returns {Promise<Outcome>}
 */
async function attempt({ name, run }, context) {
  const start = performance.now();
  /** @param {Outcome['state']} state @param {string} [remark] @returns {Outcome} */
  const ended = (state, remark = '') => ({ name, state, remark, seconds: (performance.now() - start) / 1000 });
  try {
    await run(context);
    return ended('passed');
  } catch (error) {
    // In CI everything has to be there, so that nothing goes untested unnoticed.
    if (error instanceof Skip && !process.env.CI) return ended('skipped', error.message);
    return ended('failed', describe(error));
  }
}

/**
 * @template T
 * @param {string} what
 * @param {() => Promise<T>} work
 */
async function timed(what, work) {
  const start = performance.now();
  heading(what);
  const result = await work();
  console.log(`done in ${((performance.now() - start) / 1000).toFixed(1)} s`);
  return result;
}

/** @param {readonly import('./test/step.mjs').Step[]} chosen */
function total(chosen) {
  return chosen.reduce((sum, { seconds }) => sum + seconds, 0);
}

/** @param {number} seconds */
function duration(seconds) {
  return seconds < 100 ? `${seconds} s` : `${Math.ceil(seconds / 60)} minutes`;
}

/** @param {string} text */
function heading(text) {
  console.log(`\n=== ${text}`);
}

/** @param {Outcome[]} outcomes */
function summary(outcomes) {
  heading('Summary');
  const width = Math.max(...outcomes.map(({ name }) => name.length));
  for (const { name, seconds, state, remark } of outcomes) {
    const time = `${seconds.toFixed(1)} s`.padStart(8);
    console.log(`${state.padEnd(8)} ${name.padEnd(width)} ${time}  ${remark}`.trimEnd());
  }
  /** @param {Outcome['state']} state */
  const count = (state) => outcomes.filter((outcome) => outcome.state === state).length;
  console.log(`\n${count('passed')} passed, ${count('failed')} failed, ${count('skipped')} skipped`);
  if (count('failed') > 0) process.exitCode = 1;
}
