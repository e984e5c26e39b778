/** The schema of options beside what is made of it: the types, the flags and the help. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { commands } from '../../pkg/cli/commands.js';
import { helpOn } from '../../pkg/cli/command-line.js';
import { flagName } from '../../pkg/cli/flags.js';
import { OPTIONS } from '../../pkg/options.js';
import { optionTypes, optionTypesFile } from '../../tools/build/option-types.mjs';

/** @typedef {import('../../pkg/schema/kinds.js').Options} Options */

test('the types of options are those of the schema', async () => {
  const text = await readFile(optionTypesFile, 'utf8');
  assert.equal(text, await optionTypes(), 'build the package again');
  for (const [, members] of text.matchAll(/^export interface \w+ \{\n([^]*?)^\}/gm)) {
    const undocumented = members.replace(/ {2}\/\*\*[^]*?\*\/\n {2}\w+\?: .*;\n/g, '');
    assert.equal(undocumented, '', 'an option has no comment');
  }
});

test('each flag of the schema is in the help of a command, with its value and what it does', () => {
  const told = /** @type {import('../../pkg/cli/commands.js').CommandName[]} */ (Object.keys(commands)).map(helpOn).join('').replace(/\s+/g, ' ');
  let count = 0;
  for (const options of /** @type {Options[]} */ (Object.values(OPTIONS))) {
    for (const [name, option] of Object.entries(options)) {
      const { flag } = option;
      if (flag === undefined) continue;
      count += 1;
      const spelled = `--${flagName(name, option)}${flag.value === undefined ? '' : ` <${flag.value}>`}`;
      assert.ok(told.includes(spelled), spelled);
      // A command may have words of its own for it.
      assert.ok(told.includes(flag.help) || name === 'threshold', flag.help);
    }
  }
  assert.ok(count > 60, `${count} flags`);
});
