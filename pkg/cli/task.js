/** From what a command line says to what is to be done: how the input is taken, and what cannot be asked for of it. */
import { extname } from 'node:path';
import { meshSolver } from '../schema/fit.js';
import { patternMesh } from '../schema/pattern.js';
import { dewarpPage } from '../schema/photo.js';
import { Format } from '../schema/names.js';
import { rulings } from '../schema/shape.js';
import { show } from '../values.js';
import { MESH_FILES, commands, oneOf } from './commands.js';
import { flagName, flagNames, usage, valueName } from './flags.js';
import { refuseSameFiles } from './same-file.js';
import { streams } from './terminal.js';

/**
 * @typedef {import('./commands.js').CommandName} CommandName
 *
 * What the flags say. Paths are texts.
 * @typedef {Partial<Record<'output' | 'to' | 'report' | 'array' | 'mask' | 'confidence' | 'constraints' | 'occlusions' | 'texture' |
 *   'photoCamera' | 'mtl' | 'map' | 'assembly' | 'edges', string>> &
 *   Partial<Record<'overwrite' | 'force' | 'paper' | 'noNormalize' | 'surface' | 'ray' | 'asIs' | 'explore' | 'trim' | 'deskew' | 'ink' |
 *   'plain' | 'quiet' | 'blank' | 'printed', boolean>> &
 *   Partial<Record<'jobs' | 'threads' | 'spacing' | 'resolution' | 'pixelSize' | 'heightScale' | 'free' | 'threshold' | 'sheets' | 'size' | 'faces' |
 *   'smallest' | 'dots' | 'quality' | 'focalLength' | 'fieldOfView', number>> & {
 *   lattice?: 'square' | 'hex', unit?: import('../types.js').ReadMeshOptions['unit'], noData?: number | 'none',
 *   view?: import('../types.js').SampleMeshOptions['view'], intrinsics?: Omit<CameraTask, 'ray'>, turn?: CameraTask['turn'],
 *   crop?: [number, number][], cut?: [number, number][], join?: [number, number][], light?: 'even' | 'keep', shape?: Shape, lambda?: number | string,
 * }} Values
 *
 * @typedef {{ numbers?: import('../types.js').Intrinsics, file?: string, ray: boolean, turn?: 0 | 90 | 180 | 270 }} CameraTask
 *   numbers of a depth camera, or a file of them
 * @typedef {'auto' | 'cylinder' | 'developable'} Shape what is fitted to the heights of a photo
 * @typedef {'image' | 'mesh' | 'depths' | 'surface' | 'photo'} Mode how an input is taken: pixels of heights, a mesh seen from one side,
 *   depths of a camera, a whole mesh, or a photo of a page
 *
 * @typedef {Omit<Values, 'lattice' | 'noData' | 'intrinsics'> & {
 *   command: CommandName, mode: Mode, inputs: string[], input: string, output: string, extension: string, written: string[], force: boolean,
 *   lattice: 'square' | 'hex' | 'mesh', camera?: CameraTask, noData?: number, assumeNoData: boolean, normalize: boolean,
 *   mesh?: import('../types.js').Mesh, recognized?: import('../types.js').RecognizedMesh, seen?: import('../types.js').SampledMesh,
 * }} Task `inputs` are several photos of one PDF, of which `input` is the first; `written` are all files that are to be written; `mesh`,
 *   `recognized` and `seen` are what was found of the input while it was decided how to take it
 */

const MESHES = ['.obj', '.ply', '.stl', '.glb', '.gltf', '.3mf', '.off', '.xyz'];
/** Endings of photos, also of those that their reader names with what to do. */
const PHOTOS = ['.jpg', '.jpeg', '.png', '.webp', '.gif', '.bmp', '.tif', '.tiff', '.heic', '.heif', '.avif', '.jxl', '.pdf'];
/** Whether a file's name does not tell its format: that of standard input, of texts, of points, which may lie on a grid. @param {string} path */
export const isUntold = (path) => {
  const ending = extname(path).toLowerCase();
  return ending === '.xyz' || ![...MESHES, ...PHOTOS, ...Format.map((name) => `.${name}`)].includes(ending);
};

/** The ending of a file's name, or that of its format where the name does not tell it. @param {string} path */
const extensionOf = (path) => (isUntold(path) ? `.${streams().formats?.get(path) ?? ''}` : extname(path).toLowerCase());

/** @param {string} path */
export const isMesh = (path) => MESHES.includes(extensionOf(path));

/** @param {string} path @param {Values} values */
const isPhotoAlone = (path, values) => (values.texture ?? values.intrinsics) === undefined && PHOTOS.includes(extensionOf(path));

/**
 * Whether several photos of pages are to become one PDF.
 * @param {CommandName} command
 * @param {string[]} inputs
 * @param {Values} values
 */
export function isBook(command, inputs, values) {
  const { output = '' } = values;
  return command === 'dewarp' && inputs.length > 1 && extname(output).toLowerCase() === '.pdf' && !output.includes('*') &&
    inputs.every((input) => isPhotoAlone(input, values));
}

/**
 * The ending of an output that is named by its folder alone: of a fit the input's own where a surface can have it.
 * @param {CommandName} command
 * @param {string} input
 * @param {Values} values
 */
export function defaultExtension(command, input, { surface }) {
  const own = extname(input).toLowerCase();
  if (command !== 'fit') return commands[command].writes[0];
  return commands.fit.writes.includes(own) && (!surface || isMesh(input)) ? own : surface ? '.ply' : '.npy';
}

/** What is only said of a whole mesh. @type {(keyof Values)[]} */
const OF_WHOLE_MESHES = ['surface', 'size', 'cut', 'join', 'blank', 'printed'];

const pageFlags = flagNames(dewarpPage, 'page');
const general = ['output', 'to', 'force', 'report', 'jobs', 'overwrite', 'quiet'];
const ofImages = ['lattice', 'pixel-size', 'height-scale', 'constraints', 'free', 'occlusions'];

/**
 * Flags that a mode refuses, or the only ones that it takes, and what these are for.
 * @type {Record<Mode, { refuses?: string[], takes?: string[], words: string }>}
 */
const MODES = {
  image: { refuses: ['surface', 'view', 'resolution', 'turn', 'ray'], words: 'meshes and depths, and the input is none' },
  mesh: { refuses: [...ofImages, 'intrinsics', 'mask', 'no-data', 'confidence', 'turn', 'ray'], words: 'images, and the input is none' },
  depths: { refuses: [...ofImages, 'surface'], words: 'heights or meshes, and the input is depths' },
  photo: {
    takes: [...general, 'edges', 'map', 'dots', 'light', 'ink', 'quality', ...pageFlags],
    words: 'heights, and without --texture the input is a photo of a page',
  },
  surface: {
    takes: [
      ...general, 'surface', 'unit', 'as-is', 'threshold', 'explore', 'sheets',
      ...[meshSolver, rulings, patternMesh].flatMap((options) => flagNames(options)),
    ],
    words: 'heights, and with --surface the whole mesh is fitted',
  },
};

/**
 * A rule against a flag.
 * @param {string} flag
 * @param {(task: Task) => unknown} where
 * @param {string} words
 * @returns {[refused: (task: Task) => unknown, words: string]}
 */
const given = (flag, where, words) => [(task) => valueName(flag) in task && where(task), words];

/** What cannot be asked for, and what to say of it. @type {[refused: (task: Task) => unknown, words: string][]} */
const RULES = [
  [({ command, mode }) => command === 'design' && mode === 'mesh', '"design" takes constraints, not a mesh'],
  [({ mode, resolution, spacing }) => mode !== 'image' && resolution !== undefined && spacing !== undefined,
    '--resolution and --spacing say the same: give one of them'],
  [({ mode, unit }) => (unit === 'cm' || unit === 'inch') && mode !== 'mesh' && mode !== 'surface',
    '--unit must be mm or m, unless it is of a mesh'],
  [({ command, texture, extension }) => command === 'fit' && texture && !['.obj', '.ply', '.glb'].includes(extension),
    '--texture is for outputs that end in .obj, .ply or .glb'],
  [({ mtl, texture, extension }) => mtl && (texture === undefined || extension !== '.obj'),
    '--mtl is for an output .obj with a --texture'],
  [({ command, free, constraints }) => free !== undefined && command !== 'design' && constraints === undefined,
    '--free says which value of --constraints means free, and there are none'],
  [({ mode, photoCamera }) => photoCamera && mode === 'image',
    '--photo-camera is for depths and meshes, and the input is an image: --intrinsics says that it has depths'],
  [({ command, photoCamera, texture }) => photoCamera && texture === undefined && command === 'fit',
    '--photo-camera is about a photo, and there is none: --texture PHOTO'],
  [({ command, asIs, lattice, extension }) => command === 'patches' && asIs && lattice === 'square' && MESHES.includes(extension),
    '--as-is of an image has no mesh: write .json or .npy, or leave it out'],
  [({ mode, size }) => size !== undefined && mode !== 'surface', '--size is for meshes: give --scale'],
  ...['cut', 'join', 'blank', 'printed'].map((flag) => given(flag, ({ mode }) => mode !== 'surface', `--${flag} is for meshes, and the input is none`)),
  given('faces', ({ command, mode }) => command === 'unroll' && mode !== 'surface', '--faces is for meshes with --surface'),
  [({ command, mode, texture }) => command === 'dewarp' && texture === undefined && (mode === 'image' || mode === 'depths'),
    'the photo is missing: --texture PHOTO; or INPUT is a photo of a page: .jpg, .png, .webp, .gif, .bmp or .tif'],
  [({ shape, lattice }) => shape === 'cylinder' && lattice === 'square',
    '--shape cylinder is for depths, meshes and heights on the lattice, and the input is an image'],
  [({ shape, asIs }) => shape === 'cylinder' && asIs,
    '--as-is takes the heights without a fit, and --shape says what to fit: leave one out'],
  [({ command, mode, extension }) => command === 'fit' && mode === 'surface' && !(extension in MESH_FILES),
    `with --surface the output is a mesh: ${oneOf(Object.keys(MESH_FILES))}`],
  [({ focalLength, fieldOfView }) => focalLength !== undefined && fieldOfView !== undefined,
    '--focal-length and --field-of-view say the same: give one of them'],
  ...['edges', 'map'].map((flag) => given(flag, ({ inputs }) => inputs.length > 1, `--${flag} is for one photo: make the pages flat one by one`)),
  [({ explore, sheets }) => explore && sheets !== undefined,
    '--explore tells all plans, and --sheets writes one: give one of them'],
  ...['as-is', 'lambda', 'smallest'].map((flag) =>
    given(flag, ({ explore, sheets }) => explore || sheets !== undefined, `several lambda and sizes of patches are tried: leave --${flag} out`)),
  [({ explore, extension }) => explore && !['.json', TABLE].includes(extension),
    '--explore writes a table: -o FILE.json, or nothing for standard output'],
];

/** Ending of what is a table on standard output. */
export const TABLE = '.txt';

/**
 * @param {CommandName} command
 * @param {string[]} inputs names of files, without patterns
 * @param {Values} values
 * @returns {Task}
 */
export function taskOf(command, inputs, values) {
  const { noData, intrinsics, ray = false, turn, lattice = 'square', ...others } = values;
  const [input, ...more] = inputs;
  if (input === undefined) throw usage('the input is missing', command);
  if (more.length > 0 && !isBook(command, inputs, values)) throw usage(`one input at a time: what is ${show(more[0])}?`, command);
  const mode = modeOf(command, input, values);
  refuseStrangers(command, mode, values);
  const camera = intrinsics && { ...intrinsics, ray, turn };
  const { output, report, map, mtl, assembly } = values;
  if (map !== undefined) extension(command, 'map', map, ['.npy', '.json']);
  if (mtl !== undefined) extension(command, 'mtl', mtl, ['.mtl']);
  if (assembly !== undefined) extension(command, 'assembly', assembly, ['.glb', '.svg']);
  /** @type {Task} */
  const task = {
    ...others,
    command,
    mode,
    inputs,
    input,
    output: output ?? '-',
    extension: outputExtension(command, values),
    written: [output, report, map, mtl, assembly].filter((path) => path !== undefined),
    force: values.force ?? false,
    lattice: mode === 'image' ? lattice : 'mesh',
    camera,
    noData: noData === 'none' ? undefined : noData,
    assumeNoData: noData === undefined,
    normalize: !values.noNormalize,
  };
  for (const [refused, words] of RULES) if (refused(task)) throw usage(words, command);
  const { mask, confidence, constraints, texture, photoCamera, occlusions, edges, force } = task;
  const named = { 'occlusion mask': occlusions, edges, 'file of the intrinsics': camera?.file };
  const read = { mask, confidence, constraints, texture, camera: photoCamera, ...named };
  const numbered = inputs.map((path, i) => [inputs.length > 1 ? `input ${i + 1}` : 'input', path]);
  // What no output is named for goes to standard output, as `-` does.
  const out = commands[command].writes.length > 0 ? task.output : output;
  refuseSameFiles({ written: { output: out, report, map, mtl, assembly }, read: { ...Object.fromEntries(numbered), ...read }, force });
  return task;
}

/**
 * @param {CommandName} command
 * @param {string} input
 * @param {Values} values
 * @returns {Mode}
 */
function modeOf(command, input, values) {
  if (command === 'dewarp' && (values.edges !== undefined || isPhotoAlone(input, values))) return 'photo';
  if (isMesh(input)) return OF_WHOLE_MESHES.some((name) => values[name] !== undefined) ? 'surface' : 'mesh';
  return values.intrinsics === undefined ? 'image' : 'depths';
}

/**
 * Refuses flags that are for another kind of input.
 * @param {CommandName} command
 * @param {Mode} mode
 * @param {Values} values
 */
function refuseStrangers(command, mode, values) {
  const { refuses = [], takes, words } = MODES[mode];
  for (const name of Object.keys(values)) {
    const flag = flagName(name);
    if (mode !== 'photo' && pageFlags.includes(flag)) throw usage(`--${flag} is for a photo alone, without --texture`, command);
    if (refuses.includes(flag) || takes?.includes(flag) === false) throw usage(`--${flag} is for ${words}`, command);
  }
}

/**
 * @param {CommandName} command
 * @param {Values} values
 */
function outputExtension(command, { output, to, explore }) {
  /** @type {import('./commands.js').CommandInfo} */
  const { writes, tells } = commands[command];
  if (writes.length === 0) return '';
  if (output !== undefined && output !== '-') {
    if (to !== undefined) throw usage('--to says what is written to standard output: leave it out, or give -o -', command);
    return extension(command, 'output', output, writes);
  }
  if (to !== undefined) return extension(command, 'output', `-${to}`, writes);
  if (explore && output === undefined) return TABLE;
  if (tells || explore) return '.json';
  throw usage(output === undefined ? 'the output is missing: -o FILE' : `--to says what is written to standard output: ${writes.join(', ')}`, command);
}

/**
 * @param {CommandName} command
 * @param {string} what
 * @param {string} path
 * @param {readonly string[]} known
 */
function extension(command, what, path, known) {
  const found = extname(path).toLowerCase();
  if (known.includes(found)) return found;
  throw usage(`the ${what} must end in ${oneOf(known)}, but is ${show(path)}`, command);
}

/**
 * The options of a call that the flags give.
 * @template {import('../schema/kinds.js').Options} O
 * @param {O} options
 * @param {object} task
 * @returns {Partial<Record<keyof O, any>>}
 */
export function optionsFrom(options, task) {
  /** @type {Record<string, unknown>} */
  const said = { ...task };
  const found = Object.entries(options).flatMap(([name, option]) => {
    // Where files are written is told in no option.
    if (option.flag === undefined || option.flag.value === 'FILE') return [];
    const flag = flagName(name, option);
    const value = said[valueName(flag)];
    return value === undefined ? [] : [[name, flag.startsWith('no-') ? !value : value]];
  });
  return /** @type {Partial<Record<keyof O, any>>} */ (Object.fromEntries(found));
}
