/** From the command line to a task. */
import { extname } from 'node:path';
import { sampleMesh } from '../schema/file.js';
import { meshSolver, solver, threading } from '../schema/fit.js';
import { drawing, patternMesh } from '../schema/pattern.js';
import { dewarp, dewarpPage, writePhoto } from '../schema/photo.js';
import { meshPatches, rulings } from '../schema/shape.js';
import { show } from '../values.js';
import { checkFlags, commandNamed } from './commands.js';
import { flagName, flagNames, split, usage } from './flags.js';
import { filesOf } from './patterns.js';
import { refuseSameFiles } from './same-file.js';

/**
 * @typedef {import('./flags.js').Flag} Flag
 * @typedef {import('./flags.js').Values} Values
 * @typedef {Exclude<import('./commands.js').Command, 'info'>} WritingCommand
 * @typedef {import('../types.js').SolverOptions} SolverOptions
 * @typedef {typeof surfaces[number] | typeof drawings[number] | '.json' | '.mtl' | '.jpg' | '.jpeg'} Extension
 *
 * @typedef {{
 *   numbers?: import('../types.js').Intrinsics, file?: string, ray: boolean, turn?: 0 | 90 | 180 | 270,
 * }} CameraTask numbers, or a file of them
 *
 * @typedef {object} InputTask what all commands are told about the input
 * @property {string} input
 * @property {string[]} written all files that are to be written
 * @property {boolean} force whether they may replace files that are read
 * @property {string} output nothing for standard output
 * @property {Extension} extension the output's
 * @property {string} [array] of an NPZ file
 * @property {string} [mask]
 * @property {'square' | 'hex' | 'mesh'} lattice where the values are: pixels, the lattice, or a mesh to be sampled
 * @property {CameraTask} [camera] of depths that are to be sampled as a mesh
 * @property {import('../types.js').SampleMeshOptions['view']} [view]
 * @property {number} [resolution]
 * @property {number} [spacing]
 * @property {number} [pixelSize]
 * @property {number} [heightScale]
 * @property {import('../types.js').ReadMeshOptions['unit']} [unit] cm and inch of meshes only
 * @property {number} [noData]
 * @property {boolean} [assumeNoData] whether values that nobody would measure are no data (default: yes)
 * @property {boolean} normalize
 *
 * @typedef {object} KnownTask what there may be besides the heights
 * @property {boolean} design whether the input is one of constraints
 * @property {string} [confidence]
 * @property {string} [constraints]
 * @property {number} [free]
 * @property {string} [occlusionMask]
 *
 * @typedef {InputTask & KnownTask & {
 *   command: 'fit' | 'design', report?: string, texture?: string, photoCamera?: string, mtl?: string, options: SolverOptions,
 *   threads?: number,
 * }} FitTask
 * @typedef {InputTask & { command: 'occlusions', threshold?: number }} OcclusionsTask
 * @typedef {Omit<FitTask, 'command'> & { asIs: boolean }} SheetTask `asIs`: without a fit
 * @typedef {SheetTask & { command: 'analyze', threshold?: number }} AnalyzeTask
 * @typedef {SheetTask & { command: 'unroll' }} UnrollTask
 * @typedef {SheetTask & { command: 'patches', patching: import('../types.js').PatchOptions }} PatchesTask
 * @typedef {SheetTask & { command: 'rulings', tracing: import('../types.js').RulingOptions }} RulingsTask
 * @typedef {Omit<import('../types.js').MeshPatternOptions, 'assembly'>} Drawing with the options of patches
 * @typedef {SheetTask & {
 *   command: 'pattern', drawing: Drawing, assembly?: string, explore: boolean, sheets?: number,
 * }} PatternTask
 * @typedef {SheetTask & {
 *   command: 'dewarp', texture?: string, photoCamera?: string, crop?: [number, number][], dots?: number, trim?: boolean, deskew?: boolean, map?: string,
 *   quality?: number, light?: 'even' | 'keep', ink?: boolean, shape: Shape,
 * }} DewarpTask
 * @typedef {{
 *   command: 'page', inputs: string[], output: string, extension: Extension, written: string[], edges?: string, report?: string,
 *   map?: string, quality?: number,
 *   options: import('../types.js').DewarpPageOptions,
 * }} PageTask
 * @typedef {{
 *   command: 'surface', make: WholeCommand, input: string, output: string, extension: Extension, written: string[], force: boolean, unit?: import('../types.js').ReadMeshOptions['unit'], report?: string,
 *   asIs: boolean, threshold?: number, tracing: import('../types.js').MeshRulingOptions, drawing: Drawing, assembly?: string, explore: boolean, sheets?: number,
 *   options: import('../types.js').MeshSolverOptions,
 * }} MeshTask
 * @typedef {{ command: 'info', input: string, array?: string }} InfoTask
 */

const surfaces = /** @type {const} */ (['.npy', '.png', '.tif', '.tiff', '.exr', '.obj', '.ply', '.stl', '.glb']);
const drawings = /** @type {const} */ (['.svg', '.pdf', '.dxf']);
const lattices = /** @type {const} */ (['square', 'hex']);
const units = /** @type {const} */ (['mm', 'm']);

/** Units of the lengths of a mesh's file, which become millimetres or metres. */
const meshUnits = /** @type {const} */ (['mm', 'cm', 'm', 'inch']);
const shapes = /** @type {const} */ (['auto', 'cylinder', 'developable']);
const formats = /** @type {const} */ (['a4', 'letter']);

/** @typedef {typeof shapes[number]} Shape what is fitted to the heights of a photo */

/** What each command can write. @type {Record<WritingCommand, readonly Extension[]>} */
const extensions = {
  fit: surfaces,
  design: surfaces,
  occlusions: ['.png', '.npy'],
  analyze: ['.json'],
  patches: ['.json', '.npy', '.obj', '.ply', '.glb'],
  rulings: ['.json', '.obj'],
  unroll: ['.obj', '.json'],
  pattern: [...drawings, '.json'],
  dewarp: ['.png', '.jpg', '.jpeg', '.pdf'],
};

/**
 * The ending of an output that is named by its folder alone: of a fit the input's own where a surface can have it.
 * @param {WritingCommand} command
 * @param {string} input
 * @param {Values} values
 */
export function defaultExtension(command, input, values) {
  const own = extname(input).toLowerCase();
  const wanted = command === 'fit' && extensions.fit.some((known) => known === own) && (!values.surface || isMesh(input));
  if (wanted) return own;
  return command === 'fit' && values.surface ? '.ply' : extensions[command][0];
}

/** Commands that tell something, for which standard output will do. */
const telling = ['analyze', 'patches', 'rulings'];

/**
 * @param {string[]} args
 * @returns {FitTask | OcclusionsTask | AnalyzeTask | PatchesTask | RulingsTask | UnrollTask | PatternTask |
 *   DewarpTask | PageTask | MeshTask | InfoTask | { command: 'help', about?: import('./commands.js').Command } | { command: 'version' }}
 */
export function parse(args) {
  const { values, positionals } = split(args);
  if (values.version) return { command: 'version' };
  const [name, ...named] = positionals;
  if (name === 'help') return { command: 'help', about: named[0] === undefined ? undefined : commandNamed(named[0]) };
  if (values.help) return { command: 'help', about: name === undefined ? undefined : commandNamed(name) };
  if (name === undefined) throw usage('there is nothing to do');
  const command = commandNamed(name);
  checkFlags(command, values);
  const [input, ...more] = named.flatMap(filesOf);
  if (input === undefined) throw usage('the input is missing', command);
  if (isBook(command, [input, ...more], values)) return page([input, ...more], values.output ?? '', undefined, values);
  if (more.length > 0) throw usage(`one input at a time: what is ${show(more[0])}?`, command);
  const { output = '', report, mask, confidence, constraints, texture, mtl, map, array } = values;
  if (command === 'info') return { command, input, array };
  if (values.output === undefined && !telling.includes(command) && !values.explore) throw usage('the output is missing: -o FILE', command);
  if (command === 'dewarp') {
    if (values.edges !== undefined || isPhotoAlone(input, values)) return page([input], output, values.edges, values);
    const stray = pageFlags.find((flag) => values[flag] !== undefined);
    if (stray !== undefined) throw usage(`--${stray} is for a photo alone, without --texture`, command);
  }
  const photoCamera = values['photo-camera'];
  const read = { input, mask, confidence, constraints, texture, camera: photoCamera, 'occlusion mask': values.occlusions };
  const kind = kindOf(input, values);
  checkKind(kind, command, values);
  const camera = kind === 'depths' ? intrinsics(values) : undefined;
  if (values.assembly !== undefined) extension('assembly', values.assembly, ['.glb', '.svg']);
  const { force = false } = values;
  refuseSameFiles({
    written: { output: values.output, report, map, mtl, assembly: values.assembly },
    read: { ...read, 'file of the intrinsics': camera?.file },
    force,
  });

  /** @type {InputTask} */
  const about = {
    input,
    output,
    written: [values.output, report, map, mtl, values.assembly].filter((path) => path !== undefined),
    force,
    extension: values.output === undefined ? '.json' : extension('output', output, extensions[command]),
    array,
    mask,
    lattice: kind !== 'image' ? 'mesh' : choice('lattice', values.lattice ?? 'square', lattices),
    camera,
    ...given(sampleMesh, values, { view }),
    pixelSize: number('pixel-size', values),
    heightScale: heightScale(values),
    unit: values.unit === undefined ? undefined : choice('unit', values.unit, kind === 'mesh' ? meshUnits : units),
    noData: values['no-data'] === 'none' ? undefined : number('no-data', values),
    assumeNoData: values['no-data'] === undefined,
    normalize: !values['no-normalize'],
  };
  if (values.surface) return whole(/** @type {WholeCommand} */ (command), about, values);
  if (command === 'occlusions') return { command, ...about, threshold: number('threshold', values) };
  if (command === 'fit' && texture !== undefined && !['.obj', '.ply', '.glb'].includes(about.extension)) {
    throw usage('--texture is for outputs that end in .obj, .ply or .glb');
  }
  if (mtl !== undefined) {
    extension('mtl', mtl, ['.mtl']);
    if (texture === undefined || about.extension !== '.obj') throw usage('--mtl is for an output .obj with a --texture');
  }
  const free = number('free', values);
  if (free !== undefined && command !== 'design' && constraints === undefined) {
    throw usage('--free says which value of --constraints means free, and there are none');
  }
  const fitting = {
    ...about,
    design: command === 'design',
    confidence,
    constraints,
    free,
    occlusionMask: values.occlusions,
    report,
    texture,
    photoCamera,
    mtl,
    options: { ...given(solver, values), normalize: about.normalize },
    ...given(threading, values),
  };
  if (photoCamera !== undefined && kind === 'image') {
    throw usage('--photo-camera is for depths and meshes, and the input is an image: --intrinsics says that it has depths');
  }
  if (photoCamera !== undefined && texture === undefined && command === 'fit') {
    throw usage('--photo-camera is about a photo, and there is none: --texture PHOTO');
  }
  const asIs = values['as-is'] === true;
  switch (command) {
    case 'analyze':
      return { command, ...fitting, asIs, threshold: number('threshold', values) };
    case 'patches':
      if (asIs && about.lattice === 'square' && isMesh(output)) {
        throw usage('--as-is of an image has no mesh: write .json or .npy, or leave it out', command);
      }
      return { command, ...fitting, asIs, patching: given(meshPatches, values) };
    case 'rulings':
      return {
        command,
        ...fitting,
        asIs,
        tracing: given(rulings, values),
      };
    case 'unroll':
      return { command, ...fitting, asIs };
    case 'pattern':
      if (values.size !== undefined) throw usage('--size is for whole meshes: add --surface, or give --scale', command);
      return { command, ...fitting, asIs, ...patterned(values), ...exploring(values, about.extension) };
    case 'dewarp':
      if (texture === undefined && kind !== 'mesh') {
        throw usage("the photo is missing: --texture PHOTO; or INPUT is a photo of a page: .jpg, .png, .webp, .gif or .bmp");
      }
      if (map !== undefined) extension('map', map, ['.npy', '.json']);
      return {
        command,
        ...fitting,
        asIs,
        texture,
        ...given(dewarp, values, { crop: corners, map: String }),
        ...given(writePhoto, values),
        shape: shape(values, about.lattice),
      };
    default:
      return { command, ...fitting };
  }
}

/**
 * @param {Values} values
 * @param {InputTask['lattice']} lattice
 */
function shape(values, lattice) {
  const wanted = choice('shape', values.shape ?? 'auto', shapes);
  if (wanted !== 'cylinder') return wanted;
  if (lattice === 'square') throw usage('--shape cylinder is for depths, meshes and heights on the lattice, and the input is an image');
  if (values['as-is']) throw usage('--as-is takes the heights without a fit, and --shape says what to fit: leave one out');
  return wanted;
}

/** Options of a fit over a whole mesh. */
const wholeFlags = ['surface', 'unit', 'output', 'force', 'report', 'jobs', 'overwrite', ...flagNames(meshSolver)];

/** What else commands take that go on with it. @satisfies {Record<string, readonly Flag[]>} */
const wholeCommands = {
  fit: [],
  analyze: ['as-is', 'threshold'],
  rulings: ['as-is', ...flagNames(rulings)],
  unroll: ['as-is'],
  pattern: ['as-is', ...flagNames(meshPatches), ...flagNames(drawing), 'size', 'explore', 'sheets'],
};

/** @typedef {keyof typeof wholeCommands} WholeCommand */

/**
 * A mesh as it is, without a view.
 * @param {WholeCommand} make
 * @param {InputTask} about
 * @param {Values} values
 * @returns {MeshTask}
 */
function whole(make, { input, output, written, force, unit, extension: kind }, values) {
  /** @type {readonly string[]} */
  const known = [...wholeFlags, ...wholeCommands[make]];
  const stray = Object.keys(values).find((flag) => !known.includes(flag));
  if (stray !== undefined) throw usage(`--${stray} is for heights, and with --surface the whole mesh is fitted`, make);
  if (make === 'fit' && (!isMesh(output) || kind === '.json')) {
    throw usage('with --surface the output is a mesh: .obj, .ply, .stl or .glb', make);
  }
  return {
    command: 'surface',
    make,
    input,
    output,
    written,
    force,
    unit,
    extension: kind,
    report: values.report,
    asIs: values['as-is'] === true,
    threshold: number('threshold', values),
    tracing: given(rulings, values),
    ...patterned(values),
    ...exploring(values, kind),
    options: given(meshSolver, values),
  };
}

const pageFlags = flagNames(dewarpPage, 'page');

/**
 * Whether an input of `dewarp` is a photo of a page, in which the page is to be found: an image with neither a photo beside
 * it nor anything said of its heights.
 * @param {string} input
 * @param {Values} values
 */
function isPhotoAlone(input, values) {
  return values.texture === undefined && ['.jpg', '.jpeg', '.png', '.webp', '.gif', '.bmp'].includes(extname(input).toLowerCase()) &&
    values.intrinsics === undefined;
}

/**
 * Whether several photos of pages are to become one PDF.
 * @param {import('./commands.js').Command} command
 * @param {string[]} inputs
 * @param {Values} values
 */
export function isBook(command, inputs, values) {
  const { output = '' } = values;
  return command === 'dewarp' && inputs.length > 1 && extname(output).toLowerCase() === '.pdf' && !output.includes('*') &&
    inputs.every((input) => isPhotoAlone(input, values));
}

/**
 * Photos alone.
 * @param {string[]} inputs
 * @param {string} output
 * @param {string | undefined} edges
 * @param {Values} values
 * @returns {PageTask}
 */
function page(inputs, output, edges, values) {
  const { report, map } = values;
  const known = ['edges', 'output', 'force', 'report', 'jobs', 'overwrite', 'map', 'dots', 'light', 'ink', 'quality', ...pageFlags];
  const stray = Object.keys(values).find((flag) => !known.includes(flag));
  if (stray !== undefined) throw usage(`--${stray} is for heights, and without --texture the input is a photo of a page`, 'dewarp');
  if (values['focal-length'] !== undefined && values['field-of-view'] !== undefined) {
    throw usage('--focal-length and --field-of-view say the same: give one of them', 'dewarp');
  }
  const kind = extension('output', output, extensions.dewarp);
  const single = ['edges', 'map'].find((flag) => inputs.length > 1 && Object.hasOwn(values, flag));
  if (single !== undefined) throw usage(`--${single} is for one photo: make the pages flat one by one`, 'dewarp');
  if (map !== undefined) extension('map', map, ['.npy', '.json']);
  const read = Object.fromEntries(inputs.map((input, i) => [inputs.length > 1 ? `input ${i + 1}` : 'input', input]));
  refuseSameFiles({ written: { output, report, map }, read: { ...read, edges }, force: values.force });
  return {
    command: 'page',
    inputs,
    output,
    extension: kind,
    written: [output, report, map].filter((path) => path !== undefined),
    edges,
    report,
    map,
    ...given(writePhoto, values),
    options: (({ map: _, ...options }) => options)({ ...given({ light: dewarp.light, ink: dewarp.ink }, values), ...given(dewarpPage, values, { map: String, page: format }) }),
  };
}

/**
 * The format of a page.
 * @param {string} text
 * @returns {'a4' | 'letter' | [number, number]}
 */
function format(text) {
  const name = formats.find((known) => isWord(text, known));
  if (name !== undefined) return name;
  const [width, height, ...more] = text.split(/x/i).map((side) => (side.trim() === '' ? NaN : Number(side)));
  if (more.length > 0 || !Number.isFinite(width) || !Number.isFinite(height)) {
    throw usage(`--page must be a4, letter or WIDTHxHEIGHT in millimetres, but is ${show(text)}`, 'dewarp');
  }
  return [width, height];
}

/**
 * How a pattern is made.
 * @param {Values} values
 */
function patterned(values) {
  const { assembly, ...drawn } = given(patternMesh, values, { assembly: String, stock });
  return { drawing: drawn, assembly };
}

/**
 * What is tried instead of one pattern.
 * @param {Values} values
 * @param {Extension} extension
 */
function exploring(values, extension) {
  const { explore = false } = values;
  const sheets = number('sheets', values);
  const flag = explore ? '--explore' : '--sheets';
  if (explore && sheets !== undefined) throw usage('--explore tells all plans, and --sheets writes one: give one of them', 'pattern');
  if (!explore && sheets === undefined) return { explore };
  const stray = /** @type {const} */ (['as-is', 'lambda', 'smallest']).find((name) => values[name] !== undefined);
  if (stray !== undefined) throw usage(`${flag} tries several lambda and sizes of patches: leave --${stray} out`, 'pattern');
  if (explore && extension !== '.json') throw usage('--explore writes a table: -o FILE.json, or nothing for standard output', 'pattern');
  return { explore, sheets };
}

/**
 * What a pattern is made from.
 * @param {string} text
 * @returns {import('../types.js').Stock | undefined}
 */
function stock(text) {
  if (isWord(text, 'none')) return undefined;
  const name = formats.find((known) => isWord(text, known));
  if (name !== undefined) return name;
  const [, width, height] = /^(\d*\.?\d+)x(\d*\.?\d+)?$/i.exec(text) ?? [];
  if (width === undefined) {
    throw usage(`--stock must be a4, letter, none, WIDTHxHEIGHT or, for a roll, WIDTHx in millimetres, but is ${show(text)}`, 'pattern');
  }
  return height === undefined ? [Number(width)] : [Number(width), Number(height)];
}

/** @param {string} input */
export function isMesh(input) {
  return ['.obj', '.ply', '.stl', '.glb', '.gltf', '.3mf', '.off'].includes(extname(input).toLowerCase());
}

/** Flags that are not for an input of this kind. @type {Record<'image' | 'mesh' | 'depths', readonly Flag[]>} */
const strangers = {
  image: ['surface', 'view', 'resolution', 'turn', 'ray'],
  mesh: ['lattice', 'pixel-size', 'height-scale', 'mask', 'no-data', 'confidence', 'constraints', 'free', 'occlusions', 'turn', 'ray'],
  depths: ['surface', 'lattice', 'pixel-size', 'height-scale', 'constraints', 'free', 'occlusions'],
};

const plurals = { image: 'meshes and depths', mesh: 'images', depths: 'heights or meshes, and the input is depths' };

/**
 * @param {string} input
 * @param {Values} values
 */
function kindOf(input, { intrinsics }) {
  if (!isMesh(input)) return intrinsics === undefined ? 'image' : 'depths';
  if (intrinsics === undefined) return 'mesh';
  throw usage('--intrinsics is for images of depths, and the input is none');
}

/**
 * @param {'image' | 'mesh' | 'depths'} kind of the input
 * @param {string} command
 * @param {Values} values
 */
function checkKind(kind, command, values) {
  if (kind === 'mesh' && command === 'design') throw usage('"design" takes constraints, not a mesh');
  const stray = strangers[kind].find((flag) => values[flag] !== undefined);
  if (stray) throw usage(`--${stray} is for ${plurals[kind]}${kind === 'depths' ? '' : ', and the input is none'}`);
  if (kind !== 'image' && values.spacing !== undefined && values.resolution !== undefined) {
    throw usage('--resolution and --spacing say the same: give one of them');
  }
}

/** Endings of the files that `parseCamera` reads. */
export const CAMERA_FILE = /\.(json|ya?ml|xml|csv|conf|ini|txt)$/i;

/**
 * Four or five numbers with commas between them, or a file.
 * @param {Values} values
 * @returns {CameraTask}
 */
function intrinsics({ intrinsics: text = '', ray = false, turn: rotate }) {
  const turn = [0, 90, 180, 270].find((degrees) => rotate !== undefined && String(degrees) === rotate);
  if (rotate !== undefined && turn === undefined) throw usage(`--turn must be 90, 180 or 270, but is ${show(rotate)}`);
  if (CAMERA_FILE.test(text)) return { file: text, ray, turn: /** @type {CameraTask['turn']} */ (turn) };
  const numbers = list(text);
  if (numbers.length < 4 || numbers.length > 5 || numbers.some(Number.isNaN)) {
    throw usage(`--intrinsics must be fx,fy,cx,cy or fx,fy,cx,cy,scale or a file .json, .yaml, .xml, .csv, .conf or .txt, but is ${show(text)}`);
  }
  const [fx, fy, cx, cy, depthScale] = numbers;
  return { numbers: { fx, fy, cx, cy, depthScale }, ray, turn: /** @type {CameraTask['turn']} */ (turn) };
}

/**
 * Pairs of numbers.
 * @param {string} text
 * @returns {[number, number][]}
 */
function corners(text) {
  const numbers = list(text);
  if (numbers.length < 6 || numbers.length % 2 !== 0 || numbers.some(Number.isNaN)) {
    throw usage(`--crop must be three or more corners as in x,y,x,y,x,y, but is ${show(text)}`);
  }
  return Array.from({ length: numbers.length / 2 }, (_, i) => [numbers[2 * i], numbers[2 * i + 1]]);
}

/** Numbers with commas between them. @param {string} text */
function list(text) {
  return text.split(',').map((part) => (part.trim() === '' ? NaN : Number(part)));
}

/** The height of one step of the file's values. @param {Values} values */
function heightScale(values) {
  const scale = number('height-scale', values);
  if (scale === 0) throw usage('--height-scale must not be 0, which leaves no heights');
  return scale;
}

/**
 * A name, or three numbers with commas between them. Names are checked where they are used.
 * @param {string} text
 * @returns {import('../types.js').SampleMeshOptions['view']}
 */
function view(text) {
  if (!text.includes(',')) return /** @type {import('../types.js').ViewName} */ (text);
  const vector = list(text);
  if (vector.length !== 3 || vector.some(Number.isNaN)) {
    throw usage(`--view must be a name or three numbers as in 0,-1,-1, but is ${show(text)}`);
  }
  return /** @type {[number, number, number]} */ (/** @type {unknown} */ (vector));
}

/**
 * @param {string} what
 * @param {string} output
 * @param {readonly Extension[]} known
 * @returns {Extension}
 */
function extension(what, output, known) {
  const found = extname(output).toLowerCase();
  const extension = known.find((one) => one === found);
  if (extension) return extension;
  const choices = known.length > 1 ? `${known.slice(0, -1).join(', ')} or ${known.at(-1)}` : known[0];
  throw usage(`the ${what} must end in ${choices}, but is ${show(output)}`);
}

/**
 * Whether the value is one of these words, in whatever case.
 * @param {string | undefined} value
 * @param {...string} words
 */
function isWord(value, ...words) {
  return value !== undefined && words.includes(value.toLowerCase());
}

/**
 * @template {string} T
 * @param {string} name
 * @param {string} value
 * @param {readonly T[]} choices
 * @returns {T}
 */
function choice(name, value, choices) {
  const chosen = choices.find((known) => isWord(value, known));
  if (chosen !== undefined) return chosen;
  throw usage(`--${name} must be ${choices.slice(0, -1).join(', ')} or ${choices.at(-1)}, but is ${show(value)}`);
}

/**
 * The options that flags give, each read from its text by the kind of the option, unless a reader is given.
 * @template {import('../schema/kinds.js').Options} O
 * @param {O} options
 * @param {Values} values
 * @param {{ [N in keyof O]?: (text: string) => unknown }} [readers]
 * @returns {Partial<Record<keyof O, any>>}
 */
function given(options, values, readers = {}) {
  /** @type {Record<string, unknown>} */
  const said = values;
  const found = Object.entries(options).flatMap(([name, option]) => {
    const flag = flagName(name, option);
    const text = option.flag && said[flag];
    if (text === undefined) return [];
    const reader = readers[name];
    if (reader !== undefined) return [[name, reader(String(text))]];
    const { must, take } = option.kind.typed ?? option.kind;
    const value = take(text);
    if (value === undefined) throw usage(`--${flag} ${must}, but is ${show(text)}`);
    return [[name, value]];
  });
  return /** @type {Partial<Record<keyof O, any>>} */ (Object.fromEntries(found));
}

/**
 * @param {Exclude<Flag, import('./flags.js').PlainFlag>} name
 * @param {Values} values
 */
function number(name, values) {
  const text = values[name];
  if (text === undefined) return undefined;
  // `Number` takes blanks for 0.
  const value = text.trim() === '' ? NaN : Number(text);
  if (!Number.isNaN(value)) return value;
  throw usage(`--${name} must be a number, but is ${show(text)}`);
}

/**
 * A number of things, at least one.
 * @param {string} name of the flag
 * @param {string} text
 */
export function wholeNumber(name, text) {
  const value = Number(text);
  if (Number.isInteger(value) && value > 0) return value;
  throw usage(`--${name} must be a whole number from 1 on, but is ${show(text)}`);
}
