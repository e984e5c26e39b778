/** Texts in which programs write cameras, as trees of names and values. */

/** @typedef {Record<string, unknown>} Fields */

/** Names of the numbers of COLMAP's models, in their order. */
const COLMAP = /** @type {Record<string, string>} */ ({
  SIMPLE_PINHOLE: 'f cx cy',
  PINHOLE: 'fx fy cx cy',
  SIMPLE_RADIAL: 'f cx cy k1',
  RADIAL: 'f cx cy k1 k2',
  OPENCV: 'fx fy cx cy k1 k2 p1 p2',
  FULL_OPENCV: 'fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6',
});

/**
 * What a text says: JSON, XML, COLMAP's `cameras.txt`, numbers alone, or lines of names and values (YAML, INI).
 * @param {string} given
 * @returns {unknown}
 */
export function cameraTree(given) {
  // A byte order mark, with which some programs begin their files, is no JSON.
  const text = given.replace(/^\uFEFF/, '').trim();
  try {
    return JSON.parse(text);
  } catch {
    if (text.startsWith('<')) return xml(text);
  }
  const lines = text.split(/\r?\n/).map((line) => line.replace(/(^|\s)#.*$/, '')).filter((line) => line.trim() !== '');
  const colmap = lines.flatMap(colmapCamera);
  if (colmap.length > 0) return colmap;
  const numbers = valueOf(lines.join(' '));
  return Array.isArray(numbers) ? numbers : named(lines);
}

/**
 * @param {string} line
 * @returns {Fields[]}
 */
function colmapCamera(line) {
  const [, model, width, height, numbers] = /^\s*\d+\s+([A-Z_]+)\s+(\d+)\s+(\d+)\s+(.*)$/.exec(line) ?? [];
  if (numbers === undefined) return [];
  const values = numbers.trim().split(/\s+/).map(Number);
  // Of other models only that they are other ones is of use: more coefficients than a lens with five has.
  if (!Object.hasOwn(COLMAP, model)) return [{ model, width: Number(width), height: Number(height), fx: 1, cx: 1, cy: 1, k4: 1 }];
  const names = COLMAP[model].split(' ');
  return [{ model, width: Number(width), height: Number(height), ...Object.fromEntries(names.map((name, i) => [name, values[i]])) }];
}

/**
 * A number, a list of numbers, or the text itself.
 * @param {string} text
 * @returns {unknown}
 */
function valueOf(text) {
  const parts = text.replace(/[[\](),;]/g, ' ').trim().split(/\s+/);
  if (!parts.every((part) => part !== '' && Number.isFinite(Number(part)))) return text.trim().replace(/^(["'])(.*)\1$/, '$2');
  return parts.length === 1 && !text.includes('[') ? Number(parts[0]) : parts.map(Number);
}

/**
 * Elements within their parents, with their attributes; those of the same name are told apart by their `id`, and else the
 * last one counts: that of a calibration that was adjusted.
 * @param {string} text
 * @returns {Fields}
 */
function xml(text) {
  /** @type {{ name: string, fields: Fields }[]} */
  const open = [{ name: '', fields: {} }];
  for (const [, close, name, attributes, empty, content] of text.matchAll(/<(\/?)([\w.:-]+)([^<>]*?)(\/?)>([^<]*)/g)) {
    if (close) {
      if (open.length > 1) open.pop();
      continue;
    }
    const fields = Object.fromEntries([...attributes.matchAll(/([\w:-]+)="([^"]*)"/g)].map(([, key, value]) => [key, valueOf(value)]));
    const parent = open[open.length - 1].fields;
    const key = `${name}${fields.id ?? ''}`;
    parent[key] = content.trim() === '' ? fields : valueOf(content);
    // `<resolution width= height=>` is the size of what it is in.
    if (name === 'resolution') Object.assign(parent, fields);
    if (!empty) open.push({ name, fields });
  }
  return open[0].fields;
}

/**
 * Lines `name: value` or `name = value`; those that are farther in belong to the name before them, and those after `[NAME]`
 * to that.
 * @param {string[]} lines
 * @returns {Fields}
 */
function named(lines) {
  /** @type {Fields} */
  const root = {};
  let open = [{ indent: -2, fields: root }];
  /** @type {unknown[]} */
  let list = [];
  // Lists over several lines.
  const joined = lines.join('\n').replace(/\[(?:[^[\]]|\[[^[\]]*\])*\]/g, (found) => found.replace(/\s+/g, ' '));
  for (const line of joined.split('\n')) {
    const [, section] = /^\s*\[([^\],]+)\]\s*$/.exec(line) ?? [];
    if (section !== undefined) {
      /** @type {Fields} */
      const fields = {};
      root[section] = fields;
      open = [open[0], { indent: -1, fields }];
      continue;
    }
    // Lists within lists are rows of a matrix.
    const [, item] = /^\s*(?:-\s+)+([^:]*)$/.exec(line) ?? [];
    if (item !== undefined) list.push(valueOf(item));
    const [, before, name, rest] = /^(\s*(?:-\s+)?)["']?([A-Za-z][\w. -]*?)["']?\s*(?:=|:(?=\s|$))\s*(.*)$/.exec(line) ?? [];
    if (name === undefined) continue;
    while (open[open.length - 1].indent >= before.length) open.pop();
    const parent = open[open.length - 1].fields;
    if (rest === '' || rest.startsWith('!')) {
      list = [];
      const fields = { data: list };
      parent[name] = fields;
      open.push({ indent: before.length, fields });
    } else {
      parent[name] = valueOf(/^\{.*\bdata:\s*(\[[^\]]*\])/.exec(rest)?.[1] ?? rest);
    }
  }
  return root;
}
