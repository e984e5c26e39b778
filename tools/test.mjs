/**
 * `npm test`: sets up and runs every test there is; `npm test -- NAME...` those whose name contains one of the words;
 * `npm test -- --quick` what one minute is enough for once it was compiled.
 */
import { compileWasm } from './build/wasm.mjs';
import { rust } from './setup/rust.mjs';
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
  await rust();
  const [alone, beside] = [chosen.filter((step) => !step.beside), chosen.filter((step) => step.beside)];
  // The tools and the wasm are compiled side by side.
  const compile = chosen.some(({ name }) => name === 'build') ? compileWasm : undefined;
  /** @type {import('./test/step.mjs').Context | undefined} */
  let context;
  /** @type {import('./test/step.mjs').Step} */
  const setUp = { name: 'set-up', seconds: 1, what: 'tools, packages and wasm', run: async () => { context = await setupTests(compile); } };

  /** The steps that run beside the others, each after the one before. */
  let last = Promise.resolve();
  const begun = [...(beside.length > 0 ? [setUp] : []), ...beside].map((step) => {
    const one = { step, own: { text: '', isShown: false }, isDone: false };
    const outcome = last.then(() => shownLater.run(one.own, () => attempt(step, () => context)));
    last = outcome.then(() => {
      one.isDone = true;
    });
    return Object.assign(one, { outcome });
  });
  /** @type {Outcome[]} */
  const outcomes = [];
  /** @param {import('./test/step.mjs').Step} step @param {() => Promise<Outcome>} outcome */
  const show = async ({ name, what, seconds }, outcome) => {
    heading(`${name}: ${what} (about ${duration(seconds)})`);
    const found = await outcome();
    console.log(`${found.state} in ${found.seconds.toFixed(1)} s${found.remark && `: ${found.remark}`}`);
    outcomes.push(found);
  };
  const showNextBeside = async () => {
    const { step, own, outcome } = /** @type {typeof begun[number]} */ (begun.shift());
    await show(step, () => {
      process.stdout.write(own.text);
      own.isShown = true;
      return outcome;
    });
  };
  for (const step of alone) {
    await show(step, () => attempt(step, () => undefined));
    while (begun[0]?.isDone) await showNextBeside();
  }
  while (begun.length > 0) await showNextBeside();
  summary(outcomes);
});

/**
 * @param {import('./test/step.mjs').Step} step
 * @param {() => import('./test/step.mjs').Context | undefined} context what the set-up has found, which steps beside the others wait for
 * @returns {Promise<Outcome>}
 */
async function attempt({ name, beside, run }, context) {
  const start = performance.now();
  /** @param {Outcome['state']} state @param {string} [remark] @returns {Outcome} */
  const ended = (state, remark = '') => ({ name, state, remark, seconds: (performance.now() - start) / 1000 });
  try {
    const found = context();
    if (beside && !found) return ended('skipped', 'the set-up has failed');
    await run(/** @type {import('./test/step.mjs').Context} */ (found));
    return ended('passed');
  } catch (error) {
    // In CI everything has to be there, so that nothing goes untested unnoticed.
    if (error instanceof Skip && !process.env.CI) return ended('skipped', error.message);
    return ended('failed', describe(error));
  }
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
