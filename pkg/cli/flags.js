/** The flags: what there is, in the order in which they are explained, and how the text after each is read. */
import { show } from '../values.js';
import { sampleMesh } from '../schema/file.js';
import { occlusions, solver, threading } from '../schema/fit.js';
import { choice, number, text } from '../schema/kinds.js';
import { drawing, model } from '../schema/pattern.js';
import { dewarp, dewarpPage, writePhoto } from '../schema/photo.js';
import { patchesMesh, rulings } from '../schema/shape.js';
import { Problem, status } from './problem.js';

/**
 * @typedef {import('../schema/kinds.js').Options} Options
 * @typedef {import('../schema/kinds.js').Reading} Reading
 *
 * @typedef {object} FlagInfo
 * @property {string} help
 * @property {string} [value] what follows it; without one it is there or not
 * @property {string} [short]
 * @property {string} [section] of the help, for the flag of an option
 * @property {string} [name] of the flag of an option, where that is not the option's in lower case with hyphens
 * @property {Reading} [reading] of the text after it; without one it is taken as it is
 */

/**
 * The flag of an option: its name in lower case with hyphens, unless the schema has another one.
 * @param {string} name
 * @param {Pick<import('../schema/kinds.js').Option, 'flag'>} [option]
 */
export const flagName = (name, { flag } = {}) => flag?.name ?? name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);

/** The name under which the value of a flag is kept. @param {string} flag */
export const valueName = (flag) => flag.replace(/-(\w)/g, (_, letter) => letter.toUpperCase());

/**
 * The flags that some options have in a section, or in all.
 * @param {Options} options
 * @param {string} [section]
 * @returns {Record<string, FlagInfo>}
 */
function flagsFor(options, section) {
  const found = Object.entries(options).flatMap(([name, option]) => {
    const { flag: info, kind } = option;
    if (info === undefined || (section ?? info.section) !== info.section) return [];
    // Where the library is told whether something is wanted, the command is told where to write it.
    const reading = readings[name] ?? (info.value === 'FILE' ? text : info.value === 'MM' ? millimetres : kind.typed ?? kind);
    return [[flagName(name, option), { ...info, reading }]];
  });
  return Object.fromEntries(found);
}

/**
 * Their names.
 * @param {Options} options
 * @param {string} [section]
 */
export const flagNames = (options, section) => Object.keys(flagsFor(options, section));

/** Numbers with commas between them, where these are all numbers. @param {unknown} value */
const list = (value) => String(value).split(',').map((part) => (part.trim() === '' ? NaN : Number(part)));

/** Sides with an x between them, none of which is missing but the last. @param {unknown} value */
const sides = (value) => /^(-?[\d.e]+)x(-?[\d.e]+)?$/i.exec(String(value))?.slice(1).flatMap((side) => (side === undefined ? [] : [Number(side)]));

const paper = choice('a4', 'letter');

/** Readings of options whose text is not that of their kind. @type {Record<string, Reading>} */
const readings = {
  crop: {
    must: 'must be three or more corners as in x,y,x,y,x,y',
    take(value) {
      const numbers = list(value);
      if (numbers.length < 6 || numbers.length % 2 !== 0 || numbers.some(Number.isNaN)) return undefined;
      return Array.from({ length: numbers.length / 2 }, (_, i) => [numbers[2 * i], numbers[2 * i + 1]]);
    },
  },
  view: {
    must: 'must be a name or three numbers as in 0,-1,-1',
    take(value) {
      const vector = list(value);
      // Names are checked by the call that takes them.
      if (vector.length === 1) return value;
      return vector.length === 3 && !vector.some(Number.isNaN) ? vector : undefined;
    },
  },
  page: {
    must: 'must be a4, letter or WIDTHxHEIGHT in millimetres',
    take: (value) => paper.take(value) ?? (sides(value)?.length === 2 ? sides(value) : undefined),
  },
  stock: {
    must: 'must be a4, letter, WIDTHxHEIGHT or, for a roll, WIDTHx in millimetres',
    take: (value) => paper.take(value) ?? sides(value),
  },
};

/** @type {Reading} */
const numeral = /** @type {Reading} */ (number.typed);

/** Millimetres in a centimetre and in an inch. */
const MM_OF = { mm: 1, cm: 10, in: 25.4 };

/** A length in millimetres, or in the unit that follows it. @type {Reading} */
const millimetres = {
  must: 'must be a number of millimetres, such as 150 or 15cm',
  take(value) {
    const [, amount, unit = 'mm'] = /^(.*?)\s*(mm|cm|in)?$/.exec(String(value)) ?? [];
    const length = numeral.take(amount);
    return length === undefined ? undefined : Number(length) * MM_OF[/** @type {keyof typeof MM_OF} */ (unit)];
  },
};

/** Names of files with an ending, which lists of numbers have not. */
export const CAMERA_FILE = /\.[a-z]\w*$/i;

/** Numbers of a camera, or the name of a file of them. @type {Reading} */
const intrinsics = {
  must: 'must be fx,fy,cx,cy or fx,fy,cx,cy,scale or a file such as camera.json',
  take(value) {
    const name = String(value);
    if (CAMERA_FILE.test(name)) return { file: name };
    const numbers = list(name);
    if (numbers.length < 4 || numbers.length > 5 || numbers.some(Number.isNaN)) return undefined;
    const [fx, fy, cx, cy, depthScale] = numbers;
    return { numbers: { fx, fy, cx, cy, depthScale } };
  },
};

/** @type {Record<string, { title: string, flags: Record<string, FlagInfo> }>} */
export const sections = {
  output: {
    title: 'What to write',
    flags: {
      output: { short: 'o', value: 'FILE', help: 'the file to write, which appears whole or not at all; - for standard output' },
      to: {
        value: 'ENDING',
        reading: {
          must: 'must be an ending as in npy',
          take: (value) => (/^\.?\w+$/.test(String(value)) ? `.${String(value).replace('.', '').toLowerCase()}` : undefined),
        },
        help: 'what is written to standard output, as in --to ply; a file has its ending',
      },
      report: { value: 'FILE', help: 'JSON file for the figures of the solve' },
      jobs: {
        short: 'j',
        value: 'N',
        reading: {
          must: 'must be a whole number from 1 on',
          take: (value) => (Number.isInteger(Number(value)) && Number(value) > 0 ? Number(value) : undefined),
        },
        help: 'of several inputs, how many are worked on at a time, each by a process of its own (default: as many as there are cores)',
      },
      ...flagsFor(threading, 'output'),
      overwrite: { help: 'of several inputs, do those again, too, whose outputs are there and not older than they are' },
      force: {
        help: 'let an output replace a file that is read, such as INPUT; and let --resolution or --spacing make more than 2,000,000 ' +
          'vertices without a question (in a terminal) or a warning',
      },
    },
  },
  energy: {
    title: 'What to minimise',
    flags: flagsFor(solver, 'energy'),
  },
  stop: {
    title: 'When to stop',
    flags: flagsFor(solver, 'stop'),
  },
  heights: {
    title: 'How to read the heights',
    flags: {
      lattice: {
        reading: choice('square', 'hex'),
        value: 'L',
        help: 'square (the default): INPUT is an image; hex: its values are on the hexagonal lattice already (odd rows ' +
          'half a spacing to the left, 0 or NaN is no data), and so are those of OUTPUT',
      },
      ...flagsFor(sampleMesh, 'heights'),
      'pixel-size': {
        reading: numeral,
        value: 'P',
        help: 'width of a pixel in the unit of the heights (default: what the file says, or else 1)',
      },
      unit: {
        reading: choice('mm', 'cm', 'm', 'inch'),
        value: 'U',
        help: 'mm or m, of a mesh also cm or inch: the unit of these lengths, for true sizes (default: what the file says; m of ' +
          'depths in metres or with a scale, mm of others in whole numbers; of a mesh mm from 10 mm to 5 m, else none)',
      },
      'height-scale': {
        reading: { must: 'must be a number other than 0, which leaves no heights', take: (value) => numeral.take(value) || undefined },
        value: 'S',
        help: "factor from the file's values to heights (default: what the file says, 1 for floats, NPY and NPZ; for " +
          'other whole numbers white is a quarter of the longer side above black)',
      },
      array: { value: 'NAME', help: 'the array of an NPZ file or the channel of an EXR file, where several may have heights' },
      mask: {
        value: 'FILE',
        help: 'image of the same shape; heights where it is 0 are discarded. Of depths it may have any size, as one that was drawn on the photo',
      },
      'no-data': { reading: { must: 'must be none or a number', take: (value) => choice('none').take(value) ?? numeral.take(value) }, value: 'V', help: 'value that means no data, besides NaN; none: only NaN does' },
    },
  },
  mesh: {
    title: 'How to look at a mesh',
    flags: {
      surface: {
        help: 'the mesh is not projected along a view, but fitted whole as it is, closed, overhanging or open. Of "fit" OUTPUT is the ' +
          'same mesh (.obj, .ply, .stl or .glb), its vertices moved; lambda is auto unless it is given, and radii are shares ' +
          'of the diameter of a ball about it. Without it and --view a mesh is taken whole if one side hides a tenth of it, or if it has no noise',
      },
      ...flagsFor(sampleMesh, 'mesh'),
      intrinsics: {
        reading: intrinsics,
        value: 'fx,fy,cx,cy[,scale]|FILE',
        help: 'INPUT holds the depths that a camera with these numbers (in pixels; the centre of the top left one is ' +
          '0,0) has seen; 0 and below are none. It is taken for a mesh, in which jumps are not bridged; scale makes ' +
          'metres of depths. x is to the right, y up, the axis along -z. Or the file that a capture app or a ' +
          'calibration has written (.json, .yaml, .xml, .csv, .conf or .txt, as of ROS, OpenCV, COLMAP, nerfstudio or ' +
          'Metashape); whole numbers are millimetres then, others metres',
      },
      turn: {
        reading: { must: 'must be 90, 180 or 270', take: (value) => [0, 90, 180, 270].find((degrees) => String(degrees) === value) },
        value: 'DEGREES',
        help: '90, 180 or 270: turn the depths clockwise first, to lie as the photo does (default: as the Exif data of the ' +
          'photo say that it was turned, if its proportions show that the depths were not)',
      },
      ray: { help: 'depths are from the camera, not along its axis' },
    },
  },
  known: {
    title: 'What else is known (files of the same shape)',
    flags: {
      confidence: {
        value: 'FILE',
        help: 'how far each height is to be trusted: whole numbers as shares of their largest, so that white is 1 and ' +
          'black 0; others as they are. Of depths it may have any size, and whole numbers up to 2 are the levels of a ' +
          'phone: 0 discards a depth, 1 counts a quarter, 2 counts fully',
      },
      constraints: {
        value: 'FILE',
        help: "heights to be met exactly, in the input's scale; transparent pixels and NaN are free",
      },
      free: { reading: numeral, value: 'V', help: 'value of the constraints that means free, besides' },
      occlusions: { value: 'FILE', help: 'not 0 where the surface is torn' },
      ...flagsFor(solver, 'known'),
      ...flagsFor(occlusions, 'known'),
    },
  },
  colours: {
    title: 'Colours',
    flags: {
      texture: {
        value: 'FILE',
        help: 'PNG, JPEG or WebP picture with the outline of INPUT, of depths the photo from the same place, of a mesh what its ' +
          'texture coordinates are about: the colours of an .obj or .ply, the texture of a .glb (of a WebP its colours alone). A mesh with textures of its ' +
          'own does not need it',
      },
      'photo-camera': {
        value: 'FILE',
        help: 'the camera of the photo, if it is another than that of the depths: JSON with fx, fy, cx, cy, width, height, ' +
          'lens distortion k1 to k3, p1, p2, and rotation (three rows) and translation from the depths to it',
      },
      ...flagsFor(dewarp, 'colours'),
      mtl: { value: 'FILE', help: '.mtl file to be written, too, through which an .obj has that picture as its texture' },
    },
  },
  shape: {
    title: 'What is made of the surface',
    flags: {
      'as-is': { help: 'take the heights as they are, without a fit' },
      ...flagsFor(patchesMesh),
      ...flagsFor(rulings),
      ...flagsFor(drawing),
      ...flagsFor(model),
      explore: {
        help: 'try several lambda and sizes of patches, and tell for each how many sheets, folds and cuts it takes, how far the ' +
          'surface is from the input, and what time it took: as a table, or as OUTPUT.json',
      },
      sheets: { reading: numeral, value: 'N', help: 'the same, to write the pattern nearest to the input that has at most N sheets' },
      shape: {
        reading: choice('auto', 'cylinder', 'developable'),
        value: 'S',
        help: 'what is fitted: cylinder (bent about parallel rulings, as curled sheets, pages of books and parallel folds are), developable, ' +
          'or auto: of depths and meshes a cylinder where what it leaves of them is noise, and where the options of the energy ' +
          'are the defaults (default: auto)',
      },
      ...flagsFor(dewarp, 'shape'),
      ...flagsFor(writePhoto),
    },
  },
  page: {
    title: 'A photo alone',
    flags: {
      edges: {
        value: 'FILE',
        help: 'INPUT is a photo of a page, and this JSON file has its two bent edges (default: found in the photo): top and ' +
          'bottom, each a list of [x, y] from left to right, or left and right, from top to bottom; in pixels of the ' +
          'photo, with corners at the ends. Of the two pages of a spread, a list of two of these. Lines of text are found ' +
          'in the photo, unless lines says where they are',
      },
      ...flagsFor(dewarpPage, 'page'),
    },
  },
  general: {
    title: 'Besides',
    flags: {
      quiet: { short: 'q', help: 'say nothing on standard error but why it failed' },
      help: { short: 'h', help: 'this text' },
    },
  },
};

/** @type {Record<string, FlagInfo>} */
const flags = Object.assign({}, ...Object.values(sections).map((section) => section.flags));

/** Flags by the names of their options, where those differ. */
const renamed = new Map([solver, rulings].flatMap((options) =>
  Object.entries(/** @type {Options} */ (options)).flatMap(([name, { flag }]) => (flag?.name ? [[name, flag.name]] : []))));

/**
 * How an option of the library is called here: `maxIterations` is `--max-iterations`. Nothing for those that have no flag.
 * @param {string} option
 */
export function flagOf(option) {
  const flag = renamed.get(option) ?? flagName(option);
  return flag in flags ? `--${flag}` : undefined;
}

/** Numbers of a camera, which --intrinsics, --photo-camera or their files give. */
const CAMERA_NUMBERS = ['fx', 'fy', 'cx', 'cy', 'depthScale'];

/** A message of the library with the options by their names here. @param {string} message */
export function asFlags(message) {
  return message.replace(/(?:\bthe )?\boptions? (`\w+`(?:(?:, | and )`\w+`)*)/g, (whole, names) =>
    names.replace(/`(\w+)`/g, (/** @type {string} */ name, /** @type {string} */ option) => {
      if (CAMERA_NUMBERS.includes(option)) return `${option === 'depthScale' ? 'scale' : option} of the camera (--intrinsics or --photo-camera)`;
      return flagOf(option) ?? name;
    }));
}

/** @param {string | undefined} name */
export const flagInfo = (name = '') => (Object.hasOwn(flags, name) ? flags[name] : undefined);

/**
 * The value of a flag.
 * @param {string} name
 * @param {string | null} written nothing where no text follows the flag
 * @param {string} command
 */
export function readFlag(name, written, command) {
  const { value, reading = text } = flags[name];
  if (value === undefined || written === null) return true;
  if (written === '') throw usage(`--${name} is empty: it needs a value, as in --${name} ${value}`, command);
  if (written.startsWith('--')) throw usage(`--${name} needs a value, as in --${name} ${value}, and ${written} follows it`, command);
  const read = reading.take(written);
  if (read === undefined) throw usage(`--${name} ${reading.must}, but is ${show(written)}`, command);
  return read;
}

/**
 * @param {string} message
 * @param {string} [command] whose help there is
 */
export function usage(message, command) {
  return new Problem(status.usage, `${message}\nTry "developable ${command === undefined ? '' : `${command} `}--help".`);
}
