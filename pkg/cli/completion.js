/** `developable completion`: scripts by which shells complete commands and flags. */
import { commands } from './commands.js';
import { flagInfo, usage } from './flags.js';

/**
 * @param {string} shell
 * @returns {string}
 */
export function completionFor(shell) {
  const names = Object.keys(commands);
  const entries = Object.entries(commands).map(([name, { flags }]) => /** @type {const} */ ([name, flags]));
  const bash = `\
_developable() {
  local word=\${COMP_WORDS[COMP_CWORD]} words=
  case $COMP_CWORD:\${COMP_WORDS[1]} in
    1:*) words='${names.join(' ')} help' ;;
${entries.map(([name, flags]) => `    *:${name}) case $word in -*) words='${flags.map((flag) => `--${flag}`).join(' ')}' ;; esac ;;\n`).join('')}\
    *:help) words='${names.join(' ')}' ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _developable developable
`;
  switch (shell) {
    case 'bash': return bash;
    case 'zsh': return `autoload -U +X bashcompinit && bashcompinit\n${bash}`;
    case 'fish': {
      const quoted = (/** @type {string} */ text) => `'${text.replace(/['\\]/g, '\\$&')}'`;
      const flags = entries.flatMap(([name, taken]) => taken.map((flag) => {
        const { value, help = '' } = flagInfo(flag) ?? {};
        return `complete -c developable -n '__fish_seen_subcommand_from ${name}' -l ${flag}${value ? ' -r' : ''} -d ${quoted(help)}\n`;
      }));
      const first = Object.entries(commands).map(([name, { summary }]) =>
        `complete -c developable -n __fish_use_subcommand -f -a ${name} -d ${quoted(summary)}\n`);
      return [...first, ...flags].join('');
    }
    default: throw usage(`there are completions for bash, zsh and fish, and none for ${JSON.stringify(shell)}`, 'completion');
  }
}
