/** The command line taken apart by commander, which writes the help, too; the schema says how the text after each flag is read. */
import { Command, CommanderError, Option } from '../vendor/commander.mjs';
import { commandNamed, commands } from './commands.js';
import { flagInfo, readFlag, sections, usage, valueName } from './flags.js';
import { version } from './version.js';

/**
 * @typedef {import('./commands.js').CommandName} CommandName
 *
 * @typedef {object} CommandLine
 * @property {CommandName} command
 * @property {string[]} inputs
 * @property {import('./task.js').Values} values
 * @property {Record<string, string | null>} texts what stands after each flag, nothing where it has no value
 */

/** Where explanations begin, and how long a line may be. */
const [COLUMN, WIDTH] = [25, 80];

const exits = `
Exit status: 0 if all went well (also when --max-iterations ended the solve,
which is said on standard error), 1 if the library failed, 2 for wrong usage, 3
if a file cannot be read, used or written, 129, 130 or 143 when the terminal was
closed, the command interrupted or terminated.
`;

/**
 * @param {readonly string[]} args
 * @returns {CommandLine | { printed: string }} `printed`: the help or the version, which was asked for
 */
export function split(args) {
  const [first, about] = args;
  // The help of a command that there is not is no help.
  const given = first !== 'help' ? args : [about, '--help'].slice(about === undefined ? 1 : 0, commandNamed(about ?? 'fit') ? 2 : 1);
  let printed = '';
  /** @type {CommandLine | undefined} */
  let line;
  const program = programFor((text) => (printed += text));
  for (const name of /** @type {CommandName[]} */ (Object.keys(commands))) {
    const command = program.command(name).summary(commands[name].summary);
    if (name === given[0]) describe(command, name, (found) => (line = found));
  }
  try {
    program.parse(given, { from: 'user' });
  } catch (error) {
    if (!(error instanceof CommanderError)) throw error;
    if (error.exitCode !== 0) throw refusal(error, given[0]);
  }
  return line ?? { printed };
}

/**
 * Says what is wrong with a command line, in commander's words where it is no flag of another command.
 * @param {CommanderError} error
 * @param {string} [command]
 */
function refusal({ code, message }, command = '') {
  if (code === 'commander.help') return usage('there is nothing to do');
  const about = commandNamed(command) && command;
  const [, flag] = /'--([^'=]*)/.exec(message) ?? [];
  if (code === 'commander.unknownOption' && flagInfo(flag) && about) {
    return usage(`--${flag} ${commandNamed(about)?.flags.includes(flag) ? 'takes no value' : `is not for "${about}"`}`, about);
  }
  return usage(message.replace('error: ', '').replace('\n', ' '), about);
}

/**
 * The program without its commands.
 * @param {(text: string) => void} print
 */
function programFor(print) {
  return new Command('developable')
    .description('Fits piecewise-developable surfaces to heightfields, with a certified bound of how far from the optimum they can be.')
    .usage('COMMAND ...')
    .version(version)
    .helpCommand('help [command]', 'explain a command, as "developable COMMAND --help" does')
    .exitOverride()
    .configureOutput({ writeOut: print, writeErr: () => {} })
    .configureHelp({
      helpWidth: WIDTH,
      subcommandTerm: (command) => command.name(),
      formatItem(term, _, description, helper) {
        const lines = helper.boxWrap(description, WIDTH - COLUMN).split('\n');
        const head = `  ${term}`;
        const beside = head.length < COLUMN ? `${head.padEnd(COLUMN)}${lines.shift()}` : head;
        return [beside, ...lines.map((line) => ' '.repeat(COLUMN) + line)].join('\n');
      },
    })
    .addHelpText('after', `
Most commands fit a surface first, and take what "fit" takes for that.

Examples:
${Object.values(commands).map(({ examples: [first] }) => `  developable ${first}\n`).join('')}${exits}`);
}

/**
 * Says what a command takes, and what becomes of it.
 * @param {Command} command
 * @param {CommandName} name
 * @param {(line: CommandLine) => void} take
 */
function describe(command, name, take) {
  /** @type {import('./commands.js').CommandInfo} */
  const { usage: shape, about, input, flags: taken, words = {}, examples } = commands[name];
  /** @type {Record<string, string | null>} */
  const texts = {};
  command.description(about).usage(shape).argument(`[${shape.split(' ')[0].replace(/[[\]]/g, '')}...]`, input);
  for (const { title, flags } of Object.values(sections)) {
    for (const [flag, { help, short, value }] of Object.entries(flags)) {
      if (!taken.includes(flag)) continue;
      const spelled = `${short === undefined ? '' : `-${short}, `}--${flag}${value === undefined ? '' : ` <${value}>`}`;
      const option = new Option(spelled, words[flag] ?? help).helpGroup(`${title}:`);
      if (flag === 'help') {
        command.addHelpOption(option);
      } else {
        command.addOption(option).on(`option:${flag}`, (text = null) => (texts[flag] = text));
      }
    }
  }
  command.addHelpText('after', `\nExamples:\n${examples.map((example) => `  developable ${example}\n`).join('')}${exits}`);
  command.action((/** @type {string[]} */ inputs) => {
    const values = Object.fromEntries(Object.entries(texts).map(([flag, text]) => [valueName(flag), readFlag(flag, text, name)]));
    take({ command: name, inputs, values, texts });
  });
}

/** The help on a command. @param {CommandName} name */
export function helpOn(name) {
  const line = split([name, '--help']);
  return 'printed' in line ? line.printed : '';
}
