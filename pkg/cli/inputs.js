/** What a solve is about, from files: the heights, and what else is known. */
import { realpath, stat } from 'node:fs/promises';
import { basename, dirname, join, resolve, sep } from 'node:path';
import * as developable from '../index.js';
import { patternMesh } from '../schema/pattern.js';
import { readCamera } from './camera.js';
import { readBytes } from './files.js';
import { withFileName } from './explain.js';
import { flagOf } from './flags.js';
import { Problem, status } from './problem.js';
import { confirmSize } from './size.js';
import { optionsFrom } from './task.js';
import { during, say, streams, toStderr } from './terminal.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {import('../types.js').ReadResult} ReadResult
 * @typedef {{
 *   width: number, height: number, orientation?: number, wanted?: [number, number][], camera?: import('../types.js').PhotoCamera,
 * }} Size of a photo, which part of it is wanted, and the camera that took it
 * @typedef {import('../types.js').HeightImage | import('../types.js').Heightfield} Input
 */

/**
 * An input that is going to be fitted. Whether that is meant is asked where it would take very long.
 * @param {Task & { photo?: Size }} task
 * @param {AbortSignal} signal
 */
export async function readForFit(task, signal) {
  const input = await readInput(task);
  await confirmSize(task, input, signal);
  return input;
}

/**
 * @param {Task & { photo?: Size }} task `photo`: of one that goes with it
 * @returns {Promise<Input>}
 */
export async function readInput(task) {
  if (task.lattice === 'mesh') return readSampled(task);
  // The pins of a design say by their values which pixels are free.
  const reading = task.command === 'design' ? { ...task, assumeNoData: false } : task;
  const file = tellUndecided(task, await readImage(task.input, reading));
  const { mask, confidence, constraints, occlusions: torn } = task;
  const known = {
    mask: mask && await readBeside('mask', mask, file, task),
    confidence: confidence && await readBeside('confidence', confidence, file, task),
    occlusions: torn && await readBeside('occlusion mask', torn, file, task),
  };
  const pins = (task.command === 'design') ? file : constraints && (await readBeside('constraints', constraints, file, task));
  const heightScale = task.heightScale ?? file.heightScale;
  const { pixelSize } = file;
  if (task.lattice === 'square') {
    return /** @type {Input} */ ({
      width: file.width,
      height: file.height,
      pixelSize,
      heightScale,
      unit: task.unit ?? file.unit ?? undefined,
      georeference: file.georeference,
      ...known,
      ...(task.command === 'design' ? {} : { data: file.data }),
      constraints: pins && pinned(pins, task.free),
    });
  }
  /** @param {Float64Array} values */
  const scaled = (values) => values.map((value) => value * heightScale);
  return /** @type {Input} */ ({
    rows: file.height,
    cols: file.width,
    spacing: task.spacing ?? pixelSize,
    unit: task.unit,
    ...known,
    ...((task.command === 'design') ? {} : { heights: scaled(file.data) }),
    constraints: pins && scaled(pinned(pins, task.free)),
  });
}

/** Whether depths may have this unit. @param {string | undefined} unit @returns {unit is import('../types.js').Unit} */
const isUnit = (unit) => unit === 'mm' || unit === 'm';

/** Samples the heights of a mesh as seen from one side. @param {Task & { photo?: Size }} task */
async function readSampled(task) {
  const mesh = await during(`reading ${task.input}`, () => readMesh(task));
  const seen = task.seen ?? await seenFrom(task, mesh);
  const { hidden = 0 } = seen;
  if (hidden > 0 && !task.camera) {
    say(
      `warning: ${Math.round(100 * hidden)} % of the area of ${task.input} is not seen in this view, and not in the ` +
        'result; fit --surface fits the whole mesh as it is',
    );
  }
  return seen;
}

/**
 * The heights of a mesh as seen from one side.
 * @param {Task} task
 * @param {import('../types.js').Mesh} mesh
 */
export function seenFrom({ input, view, resolution, spacing, camera, unit }, mesh) {
  return during(`looking at ${input}`, () =>
    developable.sampleMesh({ ...mesh, unit: camera && isUnit(unit) ? unit : mesh.unit }, { view, resolution, spacing }));
}

/**
 * The mesh itself, or what a depth camera has seen. The numbers of a camera may be about the photo.
 * @param {Task & { photo?: Size }} task
 */
export async function readMesh(task) {
  if (task.mesh !== undefined) return task.mesh;
  const { input, camera, unit, mask, confidence, written, force, photo } = task;
  if (!camera) {
    const mesh = tellAssumptions(input, await readMeshFile(input, await readBytes(input), force ? [] : written, unit));
    for (const name of mesh.missing ?? []) {
      say(`warning: ${input} names ${JSON.stringify(name)}, ${await whyMissing(dirname(input), name)}`);
    }
    checkSize(task, mesh);
    return mesh;
  }
  // Of depths the camera says what a level is.
  const file = tellUndecided({ ...task, heightScale: 1, pixelSize: 1 }, await readImage(input, task));
  const { width, height, data } = file;
  const turn = camera.turn ?? turnOf(file, photo);
  const stored = photo && turn % 180 === 90 ? { width: photo.height, height: photo.width } : photo;
  return developable.backProject(
    { width, height, data },
    await depthCamera(camera, file, stored),
    {
      turn,
      mask: mask === undefined ? undefined : await readImage(mask, { assumeNoData: false }),
      confidence: confidence === undefined ? undefined : await readImage(confidence, { assumeNoData: false }),
      crop: photo?.wanted,
      photo,
      camera: photo?.camera,
    },
  );
}

/**
 * Asks for the size of a drawing of a mesh whose lengths have no unit.
 * @param {Task} task
 * @param {import('../types.js').Mesh} mesh
 */
function checkSize(task, { unit }) {
  const { scale, size } = optionsFrom(patternMesh, task);
  if (task.command !== 'pattern' || task.explore || unit !== undefined || (scale ?? size) !== undefined) return;
  throw new Problem(
    status.usage,
    `${task.input} is too small or too large for millimetres, and nothing says in what unit its lengths are: --unit mm, cm, m or inch ` +
      'does, or --scale MM for each unit of length',
  );
}

/** What Exif's orientations turn by, in degrees clockwise. @type {Record<number, 90 | 180 | 270>} */
const TURNS = { 3: 180, 6: 90, 8: 270 };

/**
 * By what the depths have to be turned to lie as the photo does: as that was, if its sides are exchanged.
 * @param {Size} depths
 * @param {Size} [photo]
 */
function turnOf(depths, photo) {
  if (photo === undefined) return 0;
  const ratio = (depths.width * photo.width) / (depths.height * photo.height);
  const across = Math.abs(depths.width / depths.height / (photo.width / photo.height) - 1) > 0.02;
  const turn = TURNS[photo.orientation ?? 1];
  const sizes = `the photo is ${photo.width} × ${photo.height} and the depths are ${depths.width} × ${depths.height}`;
  if (across && Math.abs(ratio - 1) < 0.02) {
    if (turn === 90 || turn === 270) return turn;
    throw new Problem(
      status.usage,
      `${sizes}: one of them lies on its side. --turn 90 or 270 turns the depths clockwise to lie as the photo does`,
    );
  }
  if (turn === 180) {
    toStderr(
      'developable: warning: the photo was turned upside down, as its Exif data say, and its size does not tell whether the ' +
        'depths were, too: they are taken as they are; --turn 180 turns them, and 0 says that this is right\n',
    );
  }
  return 0;
}

/**
 * The camera of depths, whose unit is that of the file if nothing says otherwise; a scale makes metres.
 * @param {import('./task.js').CameraTask} camera
 * @param {ReadResult} file
 * @param {Size} [photo]
 * @returns {Promise<import('../types.js').Intrinsics>}
 */
async function depthCamera({ numbers, file: path, ray }, file, photo) {
  const depth = ray ? 'ray' : 'planar';
  if (path === undefined) {
    const given = /** @type {import('../types.js').Intrinsics} */ (numbers);
    return { ...given, depth, unit: given.depthScale === undefined ? file.depthUnit : 'm' };
  }
  const images = [file, ...(photo ? [photo] : [])].map(({ width, height }) => ({ width, height }));
  const camera = await readCamera(path, images);
  const { rotation, translation, ...own } = camera;
  return { depthScale: file.depthUnit === 'mm' ? 0.001 : 1, ...own, depth, unit: 'm' };
}

/**
 * A mesh with the files that it names: those of them that there are, in its own folder or below.
 * @param {string} input
 * @param {Uint8Array} bytes
 * @param {string[]} [written] what is going to be written, which must be none of them
 * @param {import('../types.js').ReadMeshOptions['unit']} [unit] of its lengths, where the file does not say it
 */
export async function readMeshFile(input, bytes, written = [], unit = undefined) {
  /** @type {Map<string, Uint8Array>} */
  const files = new Map();
  /** @type {Set<string>} */
  const tried = new Set();
  let names = gltfNames(bytes);
  for (;;) {
    for (const name of names) {
      tried.add(name);
      const path = await neighbour(dirname(input), name);
      if (path === undefined) continue;
      for (const output of written) {
        if ((await realpath(output).catch(() => undefined)) === path) {
          throw new Problem(
            status.usage,
            `${output} is a file that ${input} is read with, and would be replaced: choose another name, or add --force to replace it`,
          );
        }
      }
      files.set(name, await readBytes(path));
    }
    const mesh = await withFileName(input, () => developable.readMesh(bytes, { files, unit }));
    // The materials that were found name textures in turn.
    names = (mesh.missing ?? []).filter((name) => !tried.has(name));
    if (names.length === 0) return mesh;
  }
}

/**
 * The buffers that a glTF file in JSON names, without which it cannot be read.
 * @param {Uint8Array} bytes
 * @returns {string[]}
 */
function gltfNames(bytes) {
  if (bytes.find((byte) => byte > 0x20) !== 0x7b) return [];
  try {
    /** @type {{ buffers?: { uri?: string }[] }} */
    const { buffers = [] } = JSON.parse(new TextDecoder().decode(bytes));
    return buffers.flatMap(({ uri }) => (uri === undefined || uri.startsWith('data:') ? [] : [unescaped(uri)]));
  } catch {
    return []; // what is wrong with it is said by who reads it
  }
}

/** A name as it is on disk, if its escapes are sound. @param {string} uri */
function unescaped(uri) {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
}

/**
 * Where the file is of a name that another file gives: in the same folder or below, else, where the name is a
 * path on another machine, beside it.
 * @param {string} folder
 * @param {string} name
 */
async function neighbour(folder, name) {
  const home = await realpath(folder).catch(() => folder);
  const plain = name.replaceAll('\\', '/');
  for (const path of [join(home, plain), join(home, plain.split('/').at(-1) ?? '')]) {
    const found = await realpath(path).catch(() => undefined);
    if (found?.startsWith(home.endsWith(sep) ? home : home + sep) && (await stat(found)).isFile()) return found;
  }
  return undefined;
}

/**
 * Why a file that another one names was not read.
 * @param {string} folder
 * @param {string} name
 */
async function whyMissing(folder, name) {
  const elsewhere = await stat(resolve(folder, name.replaceAll('\\', '/'))).catch(() => undefined);
  return elsewhere?.isFile()
    ? 'which is outside of its folder: only files there or below are read. Copy it there'
    : 'which is not there';
}

/**
 * @param {string} path
 * @param {Partial<Pick<Task, 'array' | 'noData' | 'assumeNoData' | 'pixelSize'>>} [task]
 * @returns {Promise<ReadResult>}
 */
async function readImage(path, { array, noData, assumeNoData, pixelSize } = {}) {
  const bytes = await readBytes(path);
  return withFileName(path, () => developable.read(bytes, { array, name: basename(path), noData, assumeNoData, pixelSize }));
}

/**
 * Tells what a reader assumed of heights and the flags do not decide.
 * @param {Task} task
 * @param {ReadResult} file
 */
function tellUndecided(task, file) {
  const decided = /** @type {Record<string, unknown>} */ (task);
  tellAssumptions(task.input, { assumptions: file.assumptions.filter(({ option }) => option === undefined || decided[option] === undefined) });
  return file;
}

/**
 * Tells what a reader assumed of a file, and which flag decides it instead.
 * @template {{ assumptions?: import('../types.js').Assumption[] }} T
 * @param {string} path
 * @param {T} file what was read of it
 * @returns {T}
 */
export function tellAssumptions(path, file) {
  for (const line of assumptionsInWords(file)) say(`${path}: assumed: ${line}`);
  streams().assumptions = file.assumptions;
  return file;
}

/**
 * What a reader assumed, a line each.
 * @param {{ assumptions?: import('../types.js').Assumption[] }} file
 */
export function assumptionsInWords({ assumptions = [] }) {
  return assumptions.map(({ words, option }) => {
    const flag = option === undefined ? undefined : flagOf(option);
    return flag === undefined ? words : `${words} (${flag} decides it)`;
  });
}

/**
 * Another file about the same pixels.
 * @param {string} what
 * @param {string} path
 * @param {ReadResult} input
 * @param {Task} task
 */
async function readBeside(what, path, input, { pixelSize }) {
  // What is beside the heights says by its values which pixels it means.
  const file = await readImage(path, { assumeNoData: false, pixelSize });
  if (file.width === input.width && file.height === input.height) return file;
  const [verb, its] = [what.endsWith('s') ? 'have' : 'has', `${file.width} × ${file.height}`];
  throw new Problem(
    status.input,
    `the ${what} ${verb} ${its} pixels and the input ${input.width} × ${input.height}`,
  );
}

/**
 * @param {ReadResult} file
 * @param {number | undefined} free
 */
function pinned(file, free) {
  // The value as the file could store it: -9999.9 is another number in 32 bits.
  const value = free !== undefined && file.dataType === 'f32' ? Math.fround(free) : free;
  const constraints = file.data.map((pin) => (pin === value ? NaN : pin));
  if (constraints.some(Number.isNaN)) return constraints;
  throw new Problem(status.input, 'every value is a constraint: --free V says which one means free');
}
