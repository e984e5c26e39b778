/** Items of a Rust source with their doc comments, read line by line: the sources are formatted by rustfmt. */

/**
 * @typedef {object} Item
 * @property {string} kind  The keyword before the name, or `field` or `variant`.
 * @property {string} name  With the type that it belongs to, as in `Solver::advance`.
 * @property {string[]} doc  Lines of the doc comment, without slashes.
 * @property {string} path
 * @property {number} line  Counted from 1.
 */

const KEYWORD = /^(?:pub(?:\([^)]*\))? )?(?:default |unsafe |async |extern "C" )*(const fn|const|static|fn|struct|enum|trait|type|mod|macro_rules!|impl|union)\b ?(.*)$/;
const MEMBER = /^(?:pub(?:\([^)]*\))? )?(?:r#)?([A-Za-z_]\w*)\s*(:|,|\(|\{|=|$)/;

/**
 * @param {string} path
 * @param {string} text
 * @returns {Item[]}
 */
export function itemsOf(path, text) {
  /** @type {Item[]} */
  const items = [];
  /** @type {{ indent: number, kind: string, name: string }[]} */
  const owners = [];
  /** @type {string[]} */
  let doc = [];
  let tests = false;
  let skipBelow = Infinity;
  let attribute = false;
  text.split('\n').forEach((raw, index) => {
    const line = raw.trim();
    const indent = raw.length - raw.trimStart().length;
    if (skipBelow < Infinity) {
      if (line.startsWith('}') && indent <= skipBelow) skipBelow = Infinity;
      return;
    }
    if (line === '' || (line.startsWith('//') && !/^\/\/\/(?!\/)/.test(line))) return;
    if (line.startsWith('///')) {
      doc.push(line.slice(3).replace(/^ /, ''));
      return;
    }
    if (attribute || line.startsWith('#[')) {
      if (/^#\[cfg\((all\()?test\b/.test(line)) tests = true;
      // A comment may follow on the same line.
      attribute = !line.replace(/\s*\/\/.*$/, '').endsWith(']');
      return;
    }
    while (owners.length > 0 && indent <= owners[owners.length - 1].indent) owners.pop();
    const owner = owners[owners.length - 1];
    const [kind, name] = read(line, owner);
    if (tests) {
      if (line.endsWith('{')) skipBelow = indent;
    } else if (kind !== '' && kind !== 'impl' && name !== '_') {
      const qualified = owner && owner.kind !== 'fn' ? `${owner.name}::${name}` : name;
      items.push({ kind, name: qualified, doc, path, line: index + 1 });
    }
    if (kind !== '' && line.endsWith('{')) owners.push({ indent, kind, name });
    doc = [];
    tests = false;
  });
  return items;
}

/**
 * Kind and name of the item that begins on a line, both empty if there is none.
 * @param {string} line
 * @param {{ kind: string, name: string } | undefined} owner
 * @returns {[string, string]}
 */
function read(line, owner) {
  const [, keyword, rest] = KEYWORD.exec(line) ?? [];
  if (keyword === 'impl') return ['impl', implementer(rest)];
  if (keyword !== undefined) {
    const kind = keyword === 'const fn' ? 'fn' : keyword === 'static' ? 'const' : keyword;
    const name = /^(?:mut )?(?:r#)?(\w+)/.exec(rest)?.[1];
    return name === undefined ? ['', ''] : [kind.replace('macro_rules!', 'macro'), name];
  }
  const member = MEMBER.exec(line);
  if (member === null || owner === undefined) return ['', ''];
  if (owner.kind === 'enum') return ['variant', member[1]];
  if ((owner.kind === 'struct' || owner.kind === 'variant') && member[2] === ':') return ['field', member[1]];
  return ['', ''];
}

/**
 * The type of `impl<T> Trait for Type<T>`.
 * @param {string} rest
 */
function implementer(rest) {
  const withoutGenerics = rest.replace(/^<(?:[^<>]|<[^<>]*>)*>\s*/, '');
  const type = withoutGenerics.split(' for ').pop() ?? '';
  return /[A-Za-z_]\w*/.exec(type.replace(/^&?(?:\w+::)*/, ''))?.[0] ?? '';
}
