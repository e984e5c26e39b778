/** Files in which programs write cameras, as trees of names and values. */
import { asBytes } from './input.js';

/** @typedef {Record<string, unknown>} Fields */

/** Names of the numbers of COLMAP's models, in their order; the models in that of their numbers in binary files. */
const COLMAP = /** @type {Record<string, string>} */ ({
  SIMPLE_PINHOLE: 'f cx cy',
  PINHOLE: 'fx fy cx cy',
  SIMPLE_RADIAL: 'f cx cy k1',
  RADIAL: 'f cx cy k1 k2',
  OPENCV: 'fx fy cx cy k1 k2 p1 p2',
  OPENCV_FISHEYE: 'fx fy cx cy k1 k2 k3 k4',
  FULL_OPENCV: 'fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6',
  FOV: 'fx fy cx cy omega',
  SIMPLE_RADIAL_FISHEYE: 'f cx cy k',
  RADIAL_FISHEYE: 'f cx cy k1 k2',
  THIN_PRISM_FISHEYE: 'fx fy cx cy k1 k2 p1 p2 k3 k4 sx1 sy1',
  RAD_TAN_THIN_PRISM_FISHEYE: 'fx fy cx cy k0 k1 k2 k3 k4 k5 p0 p1 s0 s1 s2 s3',
});

/**
 * What a file says: JSON, XML, COLMAP's cameras as text or binary, numbers alone, a table, or lines of names and values (YAML, INI).
 * @param {unknown} given
 * @returns {unknown}
 */
export function cameraTree(given) {
  if (typeof given === 'string') return treeOf(given);
  const bytes = asBytes(given, "the camera's file must be a text, a Uint8Array or an ArrayBuffer, but is");
  const wide = bytes[0] === 0xff && bytes[1] === 0xfe;
  return colmapCameras(bytes) ?? treeOf(new TextDecoder(wide ? 'utf-16le' : 'utf-8').decode(bytes));
}

/**
 * @param {string} given
 * @returns {unknown}
 */
function treeOf(given) {
  // A byte order mark, with which some programs begin their files, is no JSON.
  const text = given.replace(/^\uFEFF/, '').trim();
  const found = braced(text);
  if (found !== undefined) return found;
  if (text.startsWith('<')) return xml(text);
  const lines = text.split(/\r?\n/).map((line) => line.replace(/(^|\s)#.*$/, '')).filter((line) => line.trim() !== '');
  const colmap = lines.flatMap(colmapLine);
  if (colmap.length > 0) return colmap;
  const numbers = valueOf(lines.join(' '));
  // Four numbers, and those of the lens.
  if (Array.isArray(numbers) && [8, 9].includes(numbers.length) && numbers[1] > 0 && numbers[3] > 0) return { k: numbers.slice(0, 4), d: numbers.slice(4) };
  if (Array.isArray(numbers)) return numbers;
  const [names, values] = lines.map((line) => line.split(/[,;\t]/));
  if (names?.length > 3 && names.length === values?.length && !/[:=[{]/.test(lines[0])) {
    return Object.fromEntries(names.map((name, i) => [String(valueOf(name)), valueOf(values[i])]));
  }
  return named(lines);
}

/**
 * What is between brackets: JSON, a map of YAML in one line, or what Python prints; `undefined` for another text.
 * @param {string} text
 * @returns {unknown}
 */
function braced(text) {
  if (!/^[{[]/.test(text)) return undefined;
  const quoted = () => text.replaceAll("'", '"').replace(/([{[,:]\s*)([A-Za-z_][^,:{}[\]"]*?)(?=\s*[,:}\]])/g, '$1"$2"');
  for (const json of [() => text, quoted]) {
    try {
      return JSON.parse(json());
    } catch {} // perhaps the other one
  }
  return undefined;
}

/** The cameras of COLMAP's `cameras.bin`; `undefined` for another file. @param {Uint8Array} bytes */
function colmapCameras(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const cameras = [];
  try {
    let at = 8;
    for (let left = view.getBigUint64(0, true); left > 0n; left -= 1n) {
      const model = Object.keys(COLMAP)[view.getInt32(at + 4, true)];
      const [width, height] = [8, 16].map((offset) => Number(view.getBigUint64(at + offset, true)));
      const begin = at + 24;
      at = begin + 8 * COLMAP[model].split(' ').length;
      cameras.push(colmapCamera(model, width, height, (i) => view.getFloat64(begin + 8 * i, true)));
    }
    return at === bytes.length && cameras.length > 0 ? cameras : undefined;
  } catch {
    return undefined; // there is no such model, or the file ends too early
  }
}

/** @param {string} line */
function colmapLine(line) {
  const [, model, width, height, numbers] = /^\s*\d+\s+([A-Z_]+)\s+(\d+)\s+(\d+)\s+(.*)$/.exec(line) ?? [];
  if (numbers === undefined) return [];
  const values = numbers.trim().split(/\s+/).map(Number);
  return [colmapCamera(model, Number(width), Number(height), (i) => values[i])];
}

/** @param {string} model @param {number} width @param {number} height @param {(i: number) => number} number @returns {Fields} */
function colmapCamera(model, width, height, number) {
  // Of other models only that they are other ones is of use: more coefficients than a lens with five has.
  if (!Object.hasOwn(COLMAP, model)) return { model, width, height, fx: 1, cx: 1, cy: 1, k4: 1 };
  return { model, width, height, ...Object.fromEntries(COLMAP[model].split(' ').map((name, i) => [name, number(i)])) };
}

/**
 * A number, a list of numbers, or the text itself.
 * @param {string} text
 * @returns {unknown}
 */
function valueOf(text) {
  const map = text.startsWith('{') ? braced(text) : undefined;
  if (map !== undefined) return map;
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
 * A line for each pair of a name and a value that a line has, as in `fx=525 fy=520` and `fx: 525, fy: 520`.
 * @param {string} line
 */
function pairs(line) {
  if (line.includes('{')) return [line];
  const [indent] = /^\s*/.exec(line) ?? [''];
  const [first, ...rest] = line.split(/(?:\s*,\s*(?=["']?[A-Za-z]\w*["']?\s*[:=])|\s+(?=[A-Za-z]\w*\s*=\s*[-\d.[]))/);
  return [first, ...rest.map((part) => indent + part)];
}

/** Puts what is between brackets in one line. @param {string[]} lines */
function joinBracketed(lines) {
  let open = 0;
  /** @type {string[]} */
  const whole = [];
  for (const line of lines) {
    whole.push(open > 0 ? `${whole.pop()} ${line.trim()}` : line);
    open += line.replace(/[^[{]/g, '').length - line.replace(/[^\]}]/g, '').length;
  }
  return whole;
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
  /** @param {string} name @param {number} indent @param {Fields} [fields] */
  const begin = (name, indent, fields = {}) => {
    open[open.length - 1].fields[name] = fields;
    open.push({ indent, fields });
  };
  /** @type {unknown[]} */
  let list = [];
  for (const line of joinBracketed(lines).flatMap(pairs)) {
    const [, section] = /^\s*\[([^\],]+)\]\s*$/.exec(line) ?? [];
    if (section !== undefined) {
      open = [open[0]];
      begin(section, -1);
      continue;
    }
    const [, map] = /^\s*-\s+(\{.*)$/.exec(line) ?? [];
    if (map !== undefined) list.push(braced(map));
    // Lists within lists are rows of a matrix.
    const [, item] = /^\s*(?:-\s+)+([^:]*)$/.exec(line) ?? [];
    if (item !== undefined) list.push(valueOf(item));
    // In ROS' INI files what a name stands for follows on lines of its own.
    else if (/^(?=.*\d)[\s\d.,;eE+-]+$/.test(line)) list.push(valueOf(line));
    const [, title] = /^\s*([A-Za-z][\w ]*)$/.exec(line) ?? [];
    if (title !== undefined) open[open.length - 1].fields[title.trim()] = { data: list = [] };
    const [, before, name, rest] = /^(\s*(?:-\s+)?)["']?([A-Za-z][\w. -]*?)["']?\s*(?:=|:(?=\s|$))\s*(.*)$/.exec(line) ?? [];
    if (name === undefined) continue;
    const dash = before.indexOf('-');
    while (open[open.length - 1].indent >= (dash < 0 ? before.length : dash)) open.pop();
    // A map of a list, which has a number for a name.
    if (dash >= 0) begin(`- ${Object.keys(open[open.length - 1].fields).length}`, dash);
    list = [];
    if (rest === '' || rest.startsWith('!')) begin(name, before.length, { data: list });
    else open[open.length - 1].fields[name] = valueOf(rest);
  }
  return root;
}
