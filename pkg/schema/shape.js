/** Options of what is found in a surface, and of pictures of it. Each comment is what the types say; the default is added there. */
import { anything, choice, extent, number, numbers, positive, whole } from './kinds.js';
import { resampling } from './fit.js';

/** @typedef {import('./kinds.js').Options} Options */

/** Options of an analysis of a surface. @satisfies {Options} */
export const analyze = {
  /**
   * Gaussian curvature, in coordinates scaled to the unit square, above which a vertex counts.
   * The default is that of a sphere whose radius is the longer side.
   */
  threshold: { kind: number, default: 1 },
  /** Another surface on the same lattice, such as the input, to tell the deviation from. */
  reference: { kind: anything, type: 'HeightImage | Heightfield' },
  ...resampling,
};

/** Options of an analysis of a mesh. @satisfies {Options} */
export const analyzeMesh = {
  /** Gaussian curvature, in coordinates in which the ball about the mesh has the diameter 1, above which a vertex counts. */
  threshold: { kind: number, default: 1 },
};

/** Options of the segmentation of a mesh into patches. `bend` is the angle between triangles, by default at most 0.35. @satisfies {Options} */
export const patchesMesh = {
  /**
   * Angle, in radians, by which the surface bends from one vertex to the next on a crease. Default:
   * six times its median, and at least 0.035.
   */
  bend: {
    kind: number,
    flag: {
      section: 'shape',
      value: 'A',
      help: 'angle, in radians, by which the surface bends from one vertex to the next on a crease (default: six ' +
        'times its median, and at least 0.035)',
    },
  },
  /** Minimum fold angle of a crease, in radians: patches that fold by less are merged. */
  fold: {
    kind: number,
    default: 0.15,
    flag: { section: 'shape', value: 'A', help: 'patches that fold by less, in radians, are one (default 0.15)' },
  },
  /** Minimum size of a patch, as a share of all vertices, of a mesh as a share of its area; a smaller patch is merged with a neighbour. */
  smallest: {
    kind: number,
    default: 0.005,
    flag: { section: 'shape', value: 'S', help: 'share of all vertices, of a mesh of its area, that a patch has at least (default 0.005)' },
  },
};

/** Options of the segmentation of a surface into patches. @satisfies {Options} */
export const patches = { ...patchesMesh, ...resampling };

/** Options of traced rulings of a mesh. @satisfies {Options} */
export const rulingsMesh = {
  /**
   * Distance from other lines at which a line begins, in three dimensions and in the surface's unit of length; along their courses two
   * lines may come as near as half of it. Default: ten times the mean length of an edge.
   */
  separation: {
    kind: number,
    flag: {
      section: 'shape',
      value: 'D',
      help: 'distance between lines in space (default: ten mean lengths of an edge)',
    },
  },
  /**
   * Minimum confidence of a ruling's direction, from 0 to 1: a line ends where it is lower. It is near 1 where the surface clearly bends
   * in one direction only, and near 0 where it is almost plane or bends in all directions.
   */
  confidence: {
    kind: number,
    default: 0.3,
    flag: {
      section: 'shape',
      name: 'min-confidence',
      value: 'C',
      help: 'a line ends where its direction is trusted by less, from 0 to 1 (default 0.3)',
    },
  },
  /** Maximum bend from one vertex to the next, in radians: a line ends where the surface bends by more. */
  crease: {
    kind: number,
    default: 0.2,
    flag: {
      section: 'shape',
      value: 'A',
      help: 'a line ends where the surface bends by more from one vertex to the next, in radians (default 0.2)',
    },
  },
};

/** Options of traced rulings. @satisfies {Options} */
export const rulings = { ...rulingsMesh, ...resampling };

/** Options of laying a mesh flat. @satisfies {Options} */
export const meshUnrolling = {
  /** Change of the mean squared strain in one iteration below which the iterations stop. */
  tolerance: { kind: positive, default: 1e-10 },
  /** Maximum number of iterations of laying each sheet flat. */
  maxIterations: { kind: whole, default: 500 },
};

/** Options of laying a surface flat. @satisfies {Options} */
export const unroll = { ...meshUnrolling, ...resampling };

/** Options of a picture of a surface. @satisfies {Options} */
export const picture = {
  ...patches,
  /**
   * Style of the picture:
   * - `'shaded'`: matt steel under one light;
   * - `'curvature'`: from blue (below 0) over white to red (above 0); grey where there is none, beside
   *   borders;
   * - `'patches'`: a colour for each patch, darker where they meet; `bend`, `fold` and `smallest` are
   *   for this one.
   */
  style: { kind: choice('shaded', 'curvature', 'patches'), default: 'shaded' },
  /**
   * For `'shaded'`, towards the light: x to the right, y up, z towards the viewer and above 0; of any
   * length. Brightness is 0.15 + 0.85 times the cosine of the angle to the normal. Default: above to
   * the left.
   */
  light: { kind: numbers(3, 'three numbers: a vector towards the light') },
  /** Curvature that the style `'curvature'` shows: Gaussian, or the smaller principal curvature, as `analyze` computes them. */
  curvature: { kind: choice('gaussian', 'kappa2'), default: 'gaussian' },
  /**
   * Curvature at the ends of the colours, in the inverse of the surface's unit of length (squared for the Gaussian one); beyond it
   * the colours stay the same. Default: that of a sphere as wide as the longer side of the surface.
   */
  limit: { kind: number },
  /** Number of pixels in a row; the number of rows follows. Default: one pixel for each lattice spacing. */
  width: { kind: whole },
  /**
   * The part of the plane that is drawn: left, bottom, right, top. Default: that of the height
   * image, also of the one that a surface was made from; of other lattices, half a spacing around
   * their vertices.
   */
  extent: { kind: extent },
};
