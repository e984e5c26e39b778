/**
 * All options: what each call takes, and of what kind. Ranges are checked in Rust, which all its users share; what gets
 * there are plain numbers, texts and lists.
 */
import { DevelopableError } from './errors.js';
import { isRecord, reading, record, refuseUnknown, show } from './values.js';

/**
 * A kind of value; `take` gives a copy of one, and nothing for what is none.
 * @typedef {{ must: string, take: (value: unknown) => unknown }} Kind
 */

/** @type {Kind} */
const number = {
  must: 'must be a number',
  take: (value) => (typeof value === 'number' && !Number.isNaN(value) ? value : undefined),
};

/** What is checked here and not in Rust alone, since what the call is about may be handed over to a worker. @type {Kind} */
const positive = {
  must: 'must be a finite number above zero',
  take: (value) => (Number.isFinite(value) && Number(value) > 0 ? value : undefined),
};

/** @type {Kind} */
const percentage = {
  must: 'must be a whole number from 1 to 100',
  take: (value) => (Number.isInteger(value) && Number(value) >= 1 && Number(value) <= 100 ? value : undefined),
};

/** The corners of a rectangle with an area. @type {Kind} */
const extent = {
  must: 'must be four numbers: left, bottom, right and top, left less than right and bottom less than top',
  take: (value) => {
    const sides = /** @type {number[] | undefined} */ (numbers(4, '').take(value));
    return sides && sides[0] < sides[2] && sides[1] < sides[3] ? sides : undefined;
  },
};

/** @type {Kind} */
const whole = {
  must: 'must be a whole number from 0 to about 4 billion',
  take: (value) => (Number.isInteger(value) && Number(value) >= 0 && Number(value) < 2 ** 32 ? value : undefined),
};

/** @type {Kind} */
const flag = { must: 'must be true or false', take: (value) => (typeof value === 'boolean' ? value : undefined) };

/** @type {Kind} */
const text = { must: 'must be a text', take: (value) => (typeof value === 'string' ? value : undefined) };

/** @type {Kind} */
const callback = { must: 'must be a function', take: (value) => (typeof value === 'function' ? value : undefined) };

/** @type {Kind} */
const address = { must: 'must be a text or a URL', take: (value) => (typeof value === 'string' || value instanceof URL ? value : undefined) };

/** What is checked by who takes it. @type {Kind} */
const anything = { must: '', take: (value) => value };

/** One of several names, in whatever case. @type {(...names: string[]) => Kind} */
const choice = (...names) => ({
  must: `must be ${names.slice(0, -1).join(', ')} or ${names.at(-1)}`,
  take: (value) => names.find((name) => typeof value === 'string' && name.toLowerCase() === value.toLowerCase()),
});

/** @type {(length: number, what: string) => Kind} */
const numbers = (length, what) => ({
  must: `must be ${what}`,
  take: (value) => {
    const list = Array.isArray(value) ? Array.from({ length }, (_, i) => value[i]) : [];
    return list.length === Object(value).length && list.every(Number.isFinite) ? list : undefined;
  },
});

/** @type {(length: number, row: Kind, what: string) => Kind} */
const rows = (length, row, what) => ({
  must: `must be ${what}`,
  take: (value) => {
    const list = Array.isArray(value) ? Array.from({ length }, (_, i) => row.take(value[i])) : [];
    return list.length === Object(value).length && !list.includes(undefined) ? list : undefined;
  },
});

/** @type {(a: Kind, b: Kind) => Kind} */
const either = (a, b) => ({
  must: `${a.must.replace(/ or (?=\S+$)/, ', ')} or ${b.must.replace('must be ', '')}`,
  take: (value) => a.take(value) ?? b.take(value),
});

/** @type {Kind} */
const signal = {
  must: 'must be an AbortSignal',
  take: (value) => {
    const aborted = Object.getOwnPropertyDescriptor(AbortSignal.prototype, 'aborted')?.get;
    try {
      aborted?.call(value); // which throws for what is none, whatever it looks like
      const { throwIfAborted, addEventListener } = /** @type {AbortSignal} */ (value);
      return typeof throwIfAborted === 'function' && typeof addEventListener === 'function' ? value : undefined;
    } catch {
      return undefined;
    }
  },
};

/** The width of holes that are bridged; `false` for none. @type {Kind} */
const bridging = {
  must: 'must be a number, true for the default, or none (also off, 0 or false)',
  take: (value) => (value === 0 || choice('none', 'off').take(value) ? false : flag.take(value) ?? number.take(value)),
};

/** The threshold for occlusions of the paper's authors. */
const AUTHORS_THRESHOLD = 4e4;

/** @type {Kind} */
const threshold = {
  must: 'must be auto or a number',
  take: (value) => (choice('auto').take(value) ? AUTHORS_THRESHOLD : number.take(value)),
};

/** @type {Kind} */
const corners = {
  must: 'must be a list of three or more corners [x, y]',
  take: (value) => {
    const corner = numbers(2, 'two numbers');
    const list = Array.isArray(value) ? Array.from(value, corner.take) : [];
    return list.length > 2 && !list.includes(undefined) ? list : undefined;
  },
};

/** @type {Kind} */
const several = {
  must: 'must be a list of one or more numbers',
  take: (value) => {
    const list = Array.isArray(value) || ArrayBuffer.isView(value) ? Array.from(/** @type {ArrayLike<unknown>} */ (value)) : [];
    return list.length > 0 && list.every(Number.isFinite) ? list : undefined;
  },
};

/** The options of another call. @type {(call: 'solver' | 'pattern' | 'meshSolver' | 'patternMesh') => Kind} */
const optionsFor = (call) => ({
  must: 'must be an object of options',
  take: (value) => (isRecord(value) ? optionsOf(call, /** @type {object} */ (value)) : undefined),
});

/** @type {Kind} */
const flags = {
  must: 'must be a list of true and false (or 1 and 0), one for each vertex',
  take: (value) => {
    const list = Array.isArray(value) || ArrayBuffer.isView(value) ? Array.from(/** @type {ArrayLike<unknown>} */ (value)) : [];
    const known = list.every((one) => one === true || one === false || one === 1 || one === 0);
    return known && list.length > 0 ? Uint8Array.from(list, Number) : undefined;
  },
};

/** @type {Kind} */
const photoCamera = {
  must: 'must be a camera: { fx, fy, cx, cy, width, height }',
  take: (value) => (isRecord(value) ? optionsOf('photoCamera', /** @type {object} */ (value)) : undefined),
};

const resampled = { spacing: number };
const handOver = { transfer: flag };
const control = { signal, onAbort: choice('reject', 'keep'), onProgress: callback };
const lens = { fx: number, fy: number, cx: number, cy: number, width: whole, height: whole, k1: number, k2: number, p1: number, p2: number, k3: number };
const seeing = { ...lens, depthScale: number, depth: choice('planar', 'ray'), margin: whole };
const patching = { bend: number, fold: number, smallest: number };
const mapping = { dots: positive, map: flag, grid: either(flag, positive) };
const unrolling = { tolerance: positive, maxIterations: whole };

const solver = {
  ...resampled,
  paper: flag,
  lambda: either(choice('small', 'medium', 'big', 'auto'), number),
  schedule: choice('default', 'paper'),
  gap: number,
  maxIterations: whole,
  normalize: flag,
  energy: choice('nuclear', 'frobenius', 'squaredNuclear', 'secondFormOfInput', 'secondForm', 'huber'),
  reweighting: whole,
  bendRadius: number,
  flatness: number,
  creaseRadius: number,
  creasePasses: whole,
  tieBreak: number,
  occlusionThreshold: threshold,
  bridge: bridging,
};

const meshFit = {
  lambda: either(choice('small', 'medium', 'big', 'auto'), number),
  gap: number,
  maxIterations: whole,
  bendRadius: number,
  flatness: number,
  creaseRadius: number,
  creasePasses: whole,
  held: flags,
};

const stock = either(
  choice('a4', 'letter'),
  either(numbers(2, '[width, height] of plates'), numbers(1, '[width] of a roll, in millimetres')),
);

const drawing = {
  scale: number,
  tabs: number,
  marks: number,
  kerf: number,
  allowance: number,
  thickness: number,
  innerRadius: number,
  kFactor: number,
  smoothing: number,
  stock,
  assembly: flag,
};

const tracing = { separation: number, confidence: number, crease: number };

const directions = ['-x', '+x', '-y', '+y', '-z', '+z', 'best-fit'];

/** What each call takes. @satisfies {Record<string, Record<string, Kind>>} */
export const OPTIONS = {
  solver,
  directFit: { ...solver, onProgress: callback },
  fit: { ...solver, ...control, ...handOver },
  openFit: { ...solver, ...control },
  meshSolver: meshFit,
  directFitMesh: { ...meshFit, onProgress: callback },
  fitMesh: { ...meshFit, ...control },
  handOver,
  occlusions: { ...resampled, threshold: number, normalize: flag },
  read: { format: choice('png', 'npy', 'tiff', 'exr', 'pfm', 'npz', 'jpeg', 'webp'), array: text },
  readMesh: { format: choice('obj', 'ply', 'stl', 'gltf', 'glb'), files: anything },
  sampleMesh: {
    ...resampled,
    view: either(choice(...directions), numbers(3, 'a vector of three numbers')),
    resolution: whole,
  },
  depths: { confidence: anything, mask: anything, crop: corners, photo: anything, camera: photoCamera, turn: whole },
  camera: { ...seeing, unit: choice('mm', 'm') },
  photoCamera: {
    ...seeing,
    rotation: rows(3, numbers(3, 'three numbers'), 'three rows of three numbers: a rotation matrix'),
    translation: numbers(3, 'three numbers'),
  },
  paint: { extent, camera: photoCamera },
  analyze: { ...resampled, threshold: number, reference: anything },
  patches: { ...resampled, ...patching },
  picture: {
    ...resampled,
    ...patching,
    style: choice('shaded', 'curvature', 'patches'),
    light: numbers(3, 'three numbers: a vector towards the light'),
    curvature: choice('gaussian', 'kappa2'),
    limit: number,
    width: whole,
    extent,
  },
  rulings: { ...resampled, ...tracing },
  unroll: { ...resampled, ...unrolling },
  pattern: { ...resampled, ...patching, ...unrolling, ...drawing, gap: number, maxStrain: number, refold: flag },
  analyzeMesh: { threshold: number },
  meshRulings: tracing,
  unrollMesh: { ...patching, ...unrolling, gap: number, maxStrain: number },
  patternMesh: { ...patching, ...unrolling, ...drawing, gap: number, maxStrain: number },
  explorePattern: {
    lambdas: several, smallest: several, sheets: whole, solver: optionsFor('solver'), pattern: optionsFor('pattern'), signal, onPlan: callback,
  },
  explorePatternMesh: {
    lambdas: several, smallest: several, sheets: whole, solver: optionsFor('meshSolver'), pattern: optionsFor('patternMesh'), signal, onPlan: callback,
  },
  dewarp: { ...resampled, ...unrolling, ...mapping, ...handOver, trim: flag, deskew: flag, crop: corners, extent, camera: photoCamera },
  dewarpPage: {
    focalLength: positive,
    fieldOfView: positive,
    film35: positive,
    page: either(choice('a4', 'letter'), numbers(2, 'width and height in millimetres')),
    ruler: anything,
    centre: numbers(2, 'two numbers: x and y in the photo'),
    accuracy: positive,
    findLines: flag,
    ...mapping,
    ...handOver,
  },
  writePhoto: { format: choice('png', 'jpeg', 'pdf'), quality: percentage, dotsPerMillimetre: positive, ...handOver },
  writeObj: { materials: text },
  writePdf: { stock },
  writeGlb: { texture: anything },
  example: { size: whole, noise: number, seed: whole },
  worker: {
    workerUrl: address,
    wasm: anything,
    filesWasm: anything,
    imagesWasm: anything,
    meshesWasm: anything,
    fitmeshWasm: anything,
    unrollWasm: anything,
    patternsWasm: anything,
  },
};

/** Names of options that have another one now, and go on working. @type {Record<string, string>} */
const FORMER_NAMES = { paper: 'stock' };

/**
 * The options of a call, as a plain object without anything that is undefined.
 * @template {object} T
 * @param {keyof typeof OPTIONS} call
 * @param {T | undefined} given
 * @returns {Partial<T>}
 */
export function optionsOf(call, given) {
  if (given === undefined) return {};
  return reading('OPTION', 'the options', () => {
    if (!isRecord(given)) {
      throw new DevelopableError('OPTION', `the options must be an object, but are ${show(given)}`);
    }
    /** @type {Record<string, Kind>} */
    const kinds = OPTIONS[call];
    const names = Object.keys(kinds);
    const former = Object.keys(FORMER_NAMES).filter((name) => !(name in kinds) && FORMER_NAMES[name] in kinds);
    refuseUnknown('OPTION', 'option', given, names, former);
    const entries = Object.entries(record('OPTION', 'the options', given, [...names, ...former]));
    const copies = entries.map(([given, value]) => {
      const name = given in kinds ? given : FORMER_NAMES[given];
      return [name, taken(given, kinds[name], value)];
    });
    return /** @type {Partial<T>} */ (Object.fromEntries(copies));
  });
}

/**
 * @param {string} name
 * @param {Kind} kind
 * @param {unknown} value
 */
function taken(name, kind, value) {
  const copy = reading('OPTION', `option \`${name}\``, () => kind.take(value));
  if (copy !== undefined) return copy;
  throw new DevelopableError('OPTION', `option \`${name}\` is ${show(value)}, but ${kind.must}`);
}
