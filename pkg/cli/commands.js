/** The commands: what each does, reads, writes and takes. */
import { sampleMesh } from '../schema/file.js';
import { solver, threading } from '../schema/fit.js';
import { IMAGE_FILES } from '../schema/image-files.js';
import { drawing } from '../schema/pattern.js';
import { dewarp, dewarpPage } from '../schema/photo.js';
import { patchesMesh, rulings } from '../schema/shape.js';
import { flagNames } from './flags.js';

/**
 * @typedef {object} CommandInfo
 * @property {string} usage what follows the command's name
 * @property {string} summary in a few words
 * @property {string} about
 * @property {string} input what it reads
 * @property {readonly string[]} writes the endings of its output, the usual one first
 * @property {boolean} [tells] whether it writes to standard output where nothing says to what file
 * @property {readonly string[]} flags
 * @property {Record<string, string>} [words] what some of them mean here
 * @property {readonly string[]} examples
 */

const heights = ['lattice', ...flagNames(sampleMesh, 'heights'), 'pixel-size', 'height-scale', 'array', 'mask', 'no-data'];
const mesh = [...flagNames(sampleMesh, 'mesh'), 'intrinsics', 'turn', 'ray'];
const energy = [...flagNames(solver, 'energy'), ...flagNames(solver, 'stop'), ...flagNames(threading)];
const known = ['confidence', 'constraints', 'free', 'occlusions', ...flagNames(solver, 'known')];
const output = ['output', 'to', 'force'];
const general = ['jobs', 'overwrite', 'quiet', 'help'];

/** Flags of all commands that fit a surface. */
const fitted = [...output, 'unit', ...energy, ...heights, ...mesh, ...known, ...general];

/** Flags of those commands that go on with the fitted surface. */
const shaped = [...fitted, 'as-is'];

/** The formats of files of heights at pixels, by their endings. */
export const IMAGE_FORMATS = /** @type {Record<string, import('../schema/image-files.js').ImageFile>} */ (
  Object.fromEntries(Object.entries(IMAGE_FILES).flatMap(([format, { endings }]) => endings.map((ending) => [ending, format]))));
/** The calls that write a mesh to a file, by its ending, the usual one first. A format is a row here. */
export const MESH_FILES = /** @type {const} */ ({ '.obj': 'writeObj', '.ply': 'writePly', '.stl': 'writeStl', '.glb': 'writeGlb' });

/** Endings of files that hold a surface. */
const SURFACES = Object.keys({ ...IMAGE_FORMATS, ...MESH_FILES });

/** Endings in words. @param {readonly string[]} endings */
export const oneOf = (endings) => (endings.length > 1 ? `${endings.slice(0, -1).join(', ')} or ${endings.at(-1)}` : endings[0]);

const INPUT =
  'heights: TIFF, EXR, PFM, NPY or NPZ, or a grey picture (PNG, JPEG, WebP); or a mesh or point cloud, seen ' +
  'from one side: .obj, .ply, .stl, .glb, .gltf. Materials, textures and buffers that it names are read from its folder ' +
  'or below; a warning names missing ones. - is standard input';

const OUTPUT =
  `${oneOf(Object.keys(IMAGE_FORMATS))} (heights at the input's pixels) or ${oneOf(Object.keys(MESH_FILES))} (a mesh). Of a mesh, the latter ` +
  'are in its own coordinates, with its colours and texture coordinates, the former heights on the lattice';

/** @satisfies {Record<string, CommandInfo>} */
export const commands = {
  fit: {
    usage: 'INPUT -o OUTPUT [options]',
    summary: 'fit a surface to heights',
    about: 'Fits a piecewise-developable surface to heights, with a certified bound of how far from the optimum it can be.',
    input: INPUT,
    writes: SURFACES,
    flags: [...fitted, 'surface', 'report', 'texture', 'photo-camera', 'mtl'],
    words: { output: OUTPUT },
    examples: [
      'fit scan.tif -o surface.obj --lambda big --report report.json',
      'fit scan.ply -o surface.glb --view -z',
      'fit scan.ply -o surface.ply --surface',
      'fit depth.png -o depth.ply --intrinsics 525,525,319.5,239.5,0.001',
    ],
  },
  design: {
    usage: 'CONSTRAINTS -o OUTPUT [options]',
    summary: 'make a surface through given heights',
    about: 'Makes a surface that passes through heights and is free elsewhere.',
    input: 'heights, as an image of any kind; transparent pixels and NaN are free',
    writes: SURFACES,
    words: { output: OUTPUT },
    flags: [
      ...output, 'report', ...energy, 'lattice', 'spacing', 'pixel-size', 'height-scale', 'array', 'mask', 'free', 'occlusions', ...general,
    ],
    examples: ['design pins.png -o surface.obj --free 0 --height-scale 0.1'],
  },
  occlusions: {
    usage: 'INPUT -o MASK [options]',
    summary: 'find tears in a surface',
    about: 'Finds tears in a surface, and prints the number of vertices beside them.',
    input: INPUT,
    writes: ['.png', '.npy'],
    flags: [...output, 'threshold', 'no-normalize', ...heights, ...mesh, ...general],
    words: {
      output: '.png or .npy, white (or 1) where the surface is torn',
      'no-normalize': 'take the coordinates as they are, instead of scaling them to the unit square',
    },
    examples: ['occlusions scan.png -o torn.png', 'occlusions scan.png -o torn.npy --threshold 1e4'],
  },
  analyze: {
    usage: 'INPUT [-o FIGURES] [options]',
    summary: 'report how developable the surface is',
    about: 'Tells how developable the input is, and the surface fitted to it.',
    input: INPUT,
    writes: ['.json'],
    tells: true,
    flags: [...shaped, 'surface', 'threshold'],
    words: { output: '.json (default: standard output)', threshold: 'Gaussian curvature that counts (default 1)' },
    examples: ['analyze scan.png -o figures.json', 'analyze scan.png --as-is'],
  },
  patches: {
    usage: 'INPUT [-o PATCHES] [options]',
    summary: 'find the smooth patches and the creases between them',
    about: 'Fits a surface, and finds its smooth patches and the creases between them.',
    input: INPUT,
    writes: ['.json', '.npy', '.obj', '.ply', '.glb'],
    tells: true,
    words: {
      report: 'JSON file for the patches and creases, beside another output',
      output:
        '.json: areas of patches, and the creases with their course, length and fold angle (default: standard output); ' +
        '.npy: the patch of each vertex on the lattice, from 0, -1 for none; .obj, .ply or .glb: the surface with a ' +
        'colour for each patch',
    },
    flags: [...shaped, 'report', ...flagNames(patchesMesh)],
    examples: ['patches roof.png -o patches.json', 'patches roof.png -o patches.ply --report patches.json'],
  },
  rulings: {
    usage: 'INPUT [-o RULINGS] [options]',
    summary: 'find the lines along which it is straight',
    about: 'Fits a surface, and traces its rulings: straight lines along which it does not bend.',
    input: INPUT,
    writes: ['.json', '.obj'],
    tells: true,
    words: {
      report: 'JSON file for the lines, beside another output',
      output: '.json: the points of each line, its length and how straight it is (default: standard output); .obj: lines',
    },
    flags: [...shaped, 'surface', 'report', ...flagNames(rulings)],
    examples: ['rulings page.tif -o rulings.obj --separation 20', 'rulings page.tif', 'rulings scan.ply -o rulings.obj --surface'],
  },
  unroll: {
    usage: 'INPUT -o SHEET [options]',
    summary: 'lay it flat',
    about: 'Fits a surface and lays it flat, as rigidly as it goes.',
    input: INPUT,
    writes: ['.obj', '.json'],
    flags: [...shaped, 'surface', 'report', 'faces'],
    words: { output: '.obj (a flat mesh) or .json (with stretch and overlaps)', report: 'JSON file for the strain and the verdict' },
    examples: ['unroll scan.png -o sheet.obj --report sheet.json', 'unroll scan.ply -o sheets.obj --surface'],
  },
  pattern: {
    usage: 'INPUT [-o PATTERN] [options]',
    summary: 'cut it into sheets of paper or metal',
    about: 'Fits a surface and cuts it along its creases into sheets to be made of paper or metal.',
    input: INPUT,
    writes: ['.svg', '.pdf', '.dxf', '.json'],
    flags: [...shaped, 'surface', 'report', ...flagNames(patchesMesh), ...flagNames(drawing), 'size', 'cut', 'join', 'blank', 'printed', 'explore', 'sheets'],
    words: { output: '.svg, .pdf or .dxf in true size, or .json', report: 'JSON file for the figures of the pattern' },
    examples: ['pattern roof.png -o roof.pdf --scale 2 --tabs 8 --stock a4', 'pattern scan.png --explore', 'pattern scan.png -o scan.svg --sheets 8', 'pattern scan.ply -o sheets.pdf --surface'],
  },
  dewarp: {
    usage: 'INPUT [--texture PHOTO] -o IMAGE [options]',
    summary: 'make a photo of it flat',
    about:
      'Fits a surface and makes a photo of it flat. What the photo shows where is known for heights seen straight from ' +
      'above, for depths by their camera, and for scans by their texture coordinates. Or makes a photo alone of a curled ' +
      'page flat, by the edges of the page, which are found in it or given.',
    input: `${INPUT}. Without --texture a photo of a page: .jpg, .png, .webp, .gif, .bmp or .tif`,
    writes: ['.png', '.jpg', '.jpeg', '.pdf'],
    words: {
      texture: 'PHOTO: a PNG, JPEG or WebP of what the heights show, with as many pixels as it likes; a textured mesh has its own',
      report: 'JSON file for the strain and the verdict',
      output:
        '.png, transparent where there is no sheet, .jpg or .pdf, white there. A page of a .pdf has the true size, and the ' +
        'others state their resolution, where the unit of lengths is known: --unit, or of a page --page. Without --page, ' +
        'photos of pages are fitted to A4. Several photos of pages become one .pdf, a page each',
    },
    flags: [...shaped, 'report', 'texture', 'photo-camera', 'shape', ...flagNames(dewarp), 'quality', 'edges', ...flagNames(dewarpPage, 'page')],
    examples: [
      'dewarp scan.png --texture photo.png -o page.png --trim',
      'dewarp d.png --intrinsics cam.csv --texture photo.jpg -o page.pdf',
      'dewarp scan.glb -o page.png --view best-fit',
      'dewarp photo.jpg -o page.png',
      'dewarp photo.jpg --edges edges.json --page a4 -o page.png',
      'dewarp photo-1.jpg photo-2.jpg photo-3.jpg -o book.pdf --ink',
    ],
  },
  info: {
    usage: 'FILE [--array NAME]',
    summary: 'tell what is in a file',
    about: 'Tells what is in a file of heights or a mesh: size, type, range, units.',
    input: 'heights or a mesh',
    writes: [],
    flags: ['array', ...general],
    examples: ['info scan.tif', 'info arrays.npz --array depth'],
  },
  completion: {
    usage: 'bash|zsh|fish',
    summary: 'print what makes a shell complete commands and options',
    about: 'Prints a script that makes a shell complete commands, options and names of files: source it where the shell starts.',
    input: 'the shell: bash, zsh or fish',
    writes: [],
    flags: ['quiet', 'help'],
    examples: ['completion bash'],
  },
};

/** @typedef {keyof typeof commands} CommandName */

/**
 * The command of a name.
 * @param {string} name
 * @returns {CommandInfo | undefined}
 */
export const commandNamed = (name) => (Object.hasOwn(commands, name) ? commands[/** @type {CommandName} */ (name)] : undefined);
