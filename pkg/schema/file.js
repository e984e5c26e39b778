/** Options of files that are read, of meshes seen from one side, and of examples. Each comment is what the types say; the default is added there. */
import { anything, choice, either, flag, number, numbers, text, whole } from './kinds.js';
import { IMAGE_FILES } from './image-files.js';
import { Format } from './names.js';

/** @typedef {import('./kinds.js').Options} Options */

/** Options of reading a file of heights. @satisfies {Options} */
export const read = {
  /** Format of the file. Default: detected from its first bytes. */
  format: { kind: choice(...Format), type: 'Format' },
  /**
   * Name of the array to read from an NPZ file, or of the channel of an EXR file; needed only where several may have heights.
   */
  array: { kind: text },
  /** Name of the file, which may say what is in it: `depth` in it makes depths of numbers that may be some. */
  name: { kind: text },
  /**
   * Side length of a pixel, in the unit of the heights, whatever the file says of it; where that is something else, it is listed in
   * `assumptions`. Default: what the file says, else 1, or another size if the surface would be far too flat or too steep with 1.
   */
  pixelSize: { kind: number },
  /** A value that is no data and becomes NaN, rounded as the file stores numbers. */
  noData: { kind: number },
  /**
   * Whether values that nobody would measure, such as -9999 or infinity standing alone far from the rest, become NaN. Each is
   * listed in `assumptions`.
   */
  assumeNoData: { kind: flag, default: true },
};

/** Options of writing heights to a file. @satisfies {Options} */
export const writeImage = {
  /**
   * Format of the file:
   *
   * - `'npy'`: 64-bit floats, and the only one that takes heights on the lattice
   * - `'png'`: 16-bit grey. Text chunks state pixel size, height scale and offset, which `read` takes; level 0 is no data
   * - `'tiff'`: 32-bit floats, with the pixel size and the georeference if there is one
   * - `'exr'`: 32-bit floats in the channel Z, with the pixel size
   */
  format: { kind: choice(.../** @type {import('./image-files.js').ImageFile[]} */ (Object.keys(IMAGE_FILES))), default: 'npy' },
};

/** Options of reading a mesh file. @satisfies {Options} */
export const readMesh = {
  /** Format of the file. Default: detected from its first bytes. */
  format: { kind: choice('obj', 'ply', 'stl', 'gltf', 'glb', '3mf', 'off', 'xyz') },
  /**
   * The unit of the file's lengths; the mesh is in metres for `'m'`, else in millimetres. Default: what the file says,
   * else millimetres if its longest side is 10 to 5000 long, and none for others, which is among the mesh's `assumptions`.
   */
  unit: { kind: choice('mm', 'cm', 'm', 'inch') },
  /**
   * Files beside the mesh's, by name: the materials (MTL) and textures of an OBJ, the texture of a
   * PLY, the buffers and textures of a glTF. A name is looked for as it is and then without its
   * folders; what is not there is listed in the mesh's `missing`, but a glTF needs its buffers.
   */
  files: { kind: anything, type: 'Map<string, Uint8Array | ArrayBuffer> | Record<string, Uint8Array | ArrayBuffer>' },
};

/** Options of sampling a mesh from a view. @satisfies {Options} */
export const sampleMesh = {
  /** Distance between neighbouring vertices of the lattice, in the mesh's unit of length, instead of `resolution`. */
  spacing: {
    kind: number,
    flag: {
      section: 'heights',
      value: 'S',
      help: 'distance of neighbours on the lattice (default: the size of a pixel: 1 unless the file says otherwise), ' +
        "for a mesh in the place of --resolution, in the mesh's unit",
    },
  },
  /**
   * Direction to look in: a name, or a vector of any length. `'best-fit'` looks at right angles at the plane that fits the mesh
   * best, from the side that more of the triangles' area faces; of a point cloud from the side to which the plane's normal points
   * when its largest coordinate is positive. Up in the view is as close to +y as it can be; along `-y` it is -z, along `+y` +z.
   */
  view: {
    kind: either(choice('-x', '+x', '-y', '+y', '-z', '+z', 'best-fit'), numbers(3, 'a vector of three numbers')),
    type: 'ViewName | readonly [number, number, number]',
    default: '-z',
    flag: {
      section: 'mesh',
      value: 'V',
      help: 'the direction to look in: -x, +x, -y, +y, -z (the default: what has the largest z is in front), +z, a ' +
        'vector as 0,-1,-1, or best-fit: straight at the plane that fits best. Up is near +y (along -y it is -z)',
    },
  },
  /**
   * Number of vertices along the longer side of the view, at least 2. Default 200; for a point cloud fewer, if that would leave
   * less than four points for each vertex.
   */
  resolution: {
    kind: whole,
    flag: {
      section: 'mesh',
      value: 'N',
      help: 'vertices along the longer side (default 200; of a point cloud fewer, to leave each some points)',
    },
  },
};

/** Options of a procedural example. @satisfies {Options} */
export const example = {
  /** Number of pixels along the longer side. */
  size: { kind: whole, default: 200 },
  /** Standard deviation of the noise, as a share of the example's height range. */
  noise: { kind: number, default: 0.02 },
  /** Seed of the noise: an integer from 0 to 2^32 - 1. */
  seed: { kind: whole, default: 1 },
};
