/** The help, made of what the commands and flags say of themselves. */
import { commands } from './commands.js';
import { sections } from './flags.js';

/** Where explanations begin, and how long a line may be. */
const [COLUMN, WIDTH] = [25, 80];

const exits = `\
Exit status: 0 if all went well (also when --max-iterations ended the solve,
which is said on standard error), 1 if the library failed, 2 for wrong usage, 3
if a file cannot be read, used or written, 129, 130 or 143 when the terminal was
closed, the command interrupted or terminated.
`;

/** What there is. */
export function overview() {
  const entries = Object.entries(commands);
  const listed = entries.map(([name, { summary }]) => `  ${name.padEnd(12)}${summary}\n`).join('');
  const examples = entries.map(([, { examples: [first] }]) => `  developable ${first}\n`).join('');
  return `\
Fits piecewise-developable surfaces to heightfields, with a certified bound of
how far from the optimum they can be.

Usage: developable COMMAND ...

${listed}  ${'help'.padEnd(12)}explain a command, as "developable COMMAND --help" does

Most commands fit a surface first, and take what "fit" takes for that.

Examples:
${examples}
  --version   the version

${exits}`;
}

/**
 * One command in full.
 * @param {import('./commands.js').Command} name
 */
export function helpOn(name) {
  /** @type {import('./commands.js').CommandInfo} */
  const { usage, about, terms = {}, flags, words = {}, examples } = commands[name];
  const listed = Object.values(sections)
    .map(({ title, flags: known }) => {
      const entries = Object.entries(known).filter(([flag]) => flags.includes(/** @type {any} */ (flag)));
      const lines = entries.map(([flag, info]) => item(spelled(flag, info), words[/** @type {import('./flags.js').Flag} */ (flag)] ?? info.help));
      return lines.length > 0 ? `${title}\n${lines.join('')}\n` : '';
    })
    .join('');
  return [
    `Usage: developable ${name} ${usage}\n\n`,
    `${wrapped(about, WIDTH).join('\n')}\n\n`,
    Object.entries(terms).map(([term, what]) => item(term, what)).join(''),
    Object.keys(terms).length > 0 ? '\n' : '',
    listed,
    `Examples\n${examples.map((example) => `  developable ${example}\n`).join('')}\n`,
    exits,
  ].join('');
}

/**
 * @param {string} flag
 * @param {import('./flags.js').FlagInfo} info
 */
function spelled(flag, { short, value }) {
  return `${short === undefined ? '' : `-${short}, `}--${flag}${value === undefined ? '' : ` ${value}`}`;
}

/**
 * A name and what it means, beside each other.
 * @param {string} name
 * @param {string} text
 */
function item(name, text) {
  const lines = wrapped(text, WIDTH - COLUMN);
  const head = `  ${name}`;
  const beside = head.length < COLUMN ? `${head.padEnd(COLUMN)}${lines.shift()}` : head;
  return `${[beside, ...lines.map((line) => ' '.repeat(COLUMN) + line)].join('\n')}\n`;
}

/**
 * @param {string} text
 * @param {number} width
 */
function wrapped(text, width) {
  /** @type {string[]} */
  const lines = [];
  for (const word of text.split(' ')) {
    const last = lines.at(-1);
    if (last !== undefined && last.length + 1 + word.length <= width) lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(word);
  }
  return lines;
}
