/** Options of fits, and of the search for occlusions. Each comment is what the types say; the default is added there. */
import { bridging, choice, either, flag, flags, number, threadCount, threshold, tolerance, whole } from './kinds.js';
import { Energy } from './names.js';

/** @typedef {import('./kinds.js').Options} Options */

/** Option of the lattice that an image is resampled to. @satisfies {Options} */
export const resampling = {
  /** Lattice spacing for an image input, in units of length. Default: its pixel size. */
  spacing: { kind: number },
};

/** Options of a worker's threads. @satisfies {Options} */
export const threading = {
  /**
   * Number of threads that fits of heightfields run on, from 1 to 64; the result is the same, to rounding. More than one thread needs
   * shared memory: in Node, and in pages that are cross-origin isolated. Where they cannot be had there is one, and
   * `report.threadLimit` tells why. Default: 1.
   */
  threads: {
    kind: threadCount,
    flag: {
      section: 'output',
      value: 'N',
      help: 'number of threads of a fit, for large inputs (default 1); the result is the same, to rounding',
    },
  },
};

/** Options of a fit of heights. @satisfies {Options} */
export const solver = {
  /**
   * Whether options that are not given are those of the paper: `lambda: 'medium'` and `energy: 'nuclear'`. They approximate a
   * shape by few large sheets; a smaller `lambda` makes fewer.
   */
  paper: {
    kind: flag,
    default: false,
    flag: {
      section: 'energy',
      help: "the paper's setting, --lambda medium --energy nuclear, for what is not given otherwise: few large flat sheets",
    },
  },
  /**
   * Weight of the fidelity term, for coordinates normalised to the unit square:
   * `'small'` 1e5 (heavy noise, few large patches), `'medium'` 1e6, `'big'` 1e7
   * (nearly developable input), a number from 1e-12 to 1e15, or `'auto'`.
   *
   * `'auto'` finds it from the size of the heights' noise, and corrects it on a coarse lattice where the surface there is
   * farther from the heights than noise explains. With the energy `'huber'` it tries several sets of parameters on a coarse
   * lattice, too, and takes the one that best predicts heights that were not fitted. Heights without noise stay within
   * 0.2 % of their range; an input whose noise cannot be measured, such as a design, has 1e6.
   * `report.lambdaChoice` tells what was found.
   */
  lambda: {
    kind: either(choice('small', 'medium', 'big', 'auto'), number),
    default: 'auto',
    flag: {
      section: 'energy',
      value: 'L',
      help: 'how closely to follow the input: small (1e5), medium (1e6), big (1e7), a number from 1e-12 to 1e15, or auto, which ' +
        'measures the noise of the input (medium where there is none, as in a design) (default: auto)',
    },
  },
  /**
   * Root mean square distance from the input that the surface may have, outliers apart: lambda is then the smallest one that
   * keeps within it. A number in the unit of the heights, or a share of their range such as `'0.5%'`. For heights without
   * noise, such as terrain. Refused beside a number for `lambda`. Default: none.
   */
  tolerance: {
    kind: tolerance,
    flag: {
      section: 'energy',
      value: 'D',
      help: 'the simplest surface within this distance of the input (root mean square): in its unit, or a share of the height ' +
        'range such as 0.5%; it decides lambda',
    },
  },
  /** The penalty that is minimised besides the fidelity term. For a design the default is `'nuclear'`. */
  energy: {
    kind: choice(...Energy),
    type: 'Energy',
    default: 'huber',
    flag: {
      section: 'energy',
      value: 'E',
      help: `${Energy.join(', ')} (default: huber, for smooth bends and sharp creases; nuclear for a design)`,
    },
  },
  /**
   * Reweighting passes: each solves again with every vertex's penalty divided by its size before, which undoes a
   * part of the shrinkage of large curvatures. A whole number up to 20. Refused with the energy `'huber'`,
   * which has crease passes.
   */
  reweighting: {
    kind: whole,
    default: 0,
    flag: {
      section: 'energy',
      value: 'N',
      help: 'passes that undo a part of the shrinking of curvature, for any energy but huber (default 0)',
    },
  },
  /**
   * Bend radius of the energy `'huber'`, refused with others, as a share of the longer side, from 1e-6 to 1e6: gentler bends are
   * penalised by the square of their curvature, tighter ones in proportion to it. Default: found with `lambda: 'auto'`, else 0.1.
   */
  bendRadius: {
    kind: number,
    flag: {
      section: 'energy',
      value: 'R',
      help: 'huber: bends gentler than this radius, as a share of the longer side, are penalised by the square of their curvature ' +
        '(default: from the noise with --lambda auto, else 0.1)',
    },
  },
  /**
   * Flatness of the energy `'huber'`, refused with others: slope of the penalty at zero curvature, from 0 (no patch becomes
   * exactly flat) to 1 (the nuclear norm). Default: found with `lambda: 'auto'`; with a number for lambda 0.3, and up to 1 where
   * lambda is too large for the noise of the input.
   */
  flatness: {
    kind: number,
    flag: {
      section: 'energy',
      value: 'A',
      help: 'huber: slope of the penalty at zero curvature, from 0 (no patch becomes exactly flat) to 1 (the nuclear norm) (default: ' +
        'from the data with --lambda auto; with a number 0.3, and up to 1 where that is too large for the noise)',
    },
  },
  /**
   * For the energy `'huber'`, and refused with others: tighter bends than this radius are creases, in normalised
   * coordinates, from 1e-6 to 1e6. Default: found with `lambda: 'auto'`, else 0.1.
   */
  creaseRadius: {
    kind: number,
    flag: {
      section: 'energy',
      value: 'R',
      help: 'huber: what bends more tightly, as a share of the longer side, is a crease (default: from the noise with ' +
        '--lambda auto, else 0.1)',
    },
  },
  /**
   * Maximum number of crease passes, a whole number up to 20: further solves in which sharp bends of the solve before cost less, so
   * that creases keep their angle. The last one is the first that hardly changes the surface. For the energy `'huber'`, and refused
   * with others. Default: 2, or 0 if lambda is so large for the noise of the input that passes would turn noise into creases.
   */
  creasePasses: {
    kind: whole,
    flag: {
      section: 'energy',
      value: 'N',
      help: 'huber: maximum number of passes that restore the angles of creases (default: 2, or 0 where lambda is too large for the noise)',
    },
  },
  /**
   * Weight, in place of lambda, of the squared distance from the thin plate through the
   * constraints, at vertices without a fidelity term, where the surface need not be unique
   * otherwise. From 1e-12 to 1e15. Default 0.01. Refused where there is no such vertex.
   */
  tieBreak: {
    kind: number,
    flag: { section: 'energy', value: 'E', help: 'weight that keeps free vertices near a thin plate, where there are any (default 0.01)' },
  },
  /** Whether the coordinates x, y and z are scaled by one factor to the unit square before the solve, and back afterwards. */
  normalize: {
    kind: flag,
    default: true,
    flag: {
      section: 'energy',
      name: 'no-normalize',
      help: 'take the coordinates as they are, instead of scaling them to the unit square, for which lambda is meant',
    },
  },
  /**
   * Certified relative duality gap to stop at, between 0 and 1 (exclusive). The objective is then at most
   * 1 / (1 - gap) times the optimum. Refused with the paper's schedule, which stops on residuals.
   */
  gap: {
    kind: number,
    default: 0.01,
    flag: { section: 'stop', value: 'G', help: "certified relative gap to stop at (default 0.01); not for the paper's schedule" },
  },
  /**
   * `'default'` stops on the certified gap; `'paper'` changes ρ as Sec. 4.1 of the paper does, and stops where ADMM's primal and dual
   * residuals are small.
   */
  schedule: {
    kind: choice('default', 'paper'),
    default: 'default',
    flag: { section: 'stop', value: 'S', help: 'default, or paper: the published schedule, which stops on residuals' },
  },
  /** Maximum number of ADMM iterations. Default 20000, and 200 of these on the finest lattice unless a smaller gap than the default is asked for. */
  maxIterations: {
    kind: whole,
    default: 20000,
    flag: {
      section: 'stop',
      value: 'N',
      help: 'most iterations (default 20000, and 200 on the finest lattice with the default --gap); with --surface of each linearised problem (default 1000)',
    },
  },
  ...resampling,
  /**
   * Also finds occlusions (jumps) by their curvature, as {@link OcclusionOptions.threshold} says, and adds them to the
   * `occlusions` of the input. `'auto'` is the authors' value, 4e4. Default: no search. A design has no heights to find
   * any in.
   */
  occlusionThreshold: {
    kind: threshold,
    flag: {
      section: 'known',
      value: 'T',
      help: "find jumps where the curvature, in coordinates scaled to the unit square, exceeds T; auto is the authors' value, 4e4 " +
        '(default: no search)',
    },
  },
  /**
   * Holes up to this width are bridged, in pixels of an image or vertices of a lattice, 1 to 16:
   * dead pixels, speckle, lost rows and columns. What counts is a hole's narrow side; large holes,
   * what a mask takes out, and gaps between two levels of depth stay. Bridged places are part of
   * the surface and of its image; `report.bridged` counts them. `true` is the default, 4; `false`,
   * 0, `'none'` and `'off'` bridge none. A design has none.
   */
  bridge: {
    kind: bridging,
    default: true,
    flag: {
      section: 'known',
      value: 'N',
      help: 'holes are bridged that are up to so many pixels across their narrow side, 1 to 16 (default 4), or none; ' +
        'not between two levels of depth',
    },
  },
};

/**
 * Options of a fit over a whole mesh. The energy is `huber`; a mesh is scaled so that the ball about it has diameter 1.
 * @satisfies {Options}
 */
export const meshSolver = {
  /**
   * Weight of the fidelity term: how closely the surface follows the input, in coordinates in which the mesh's bounding sphere has
   * diameter 1: `'small'` 1e5, `'medium'` 1e6, `'big'` 1e7, a number from 1e-12 to 1e15 (a larger one stays nearer to the input), or
   * `'auto'`, which finds it from the noise of the mesh.
   */
  lambda: { kind: solver.lambda.kind, default: 'auto', flag: solver.lambda.flag },
  /** Certified relative duality gap of each linearised problem at which its solve stops. */
  gap: { kind: number, default: 0.01, flag: solver.gap.flag },
  /** Maximum number of ADMM iterations for each linearised problem. */
  maxIterations: { kind: whole, default: 1000, flag: solver.maxIterations.flag },
  /**
   * Bend radius, in the same coordinates as `lambda`: gentler bends are penalised by the square of their curvature, tighter ones
   * in proportion to it.
   */
  bendRadius: { kind: number, default: 0.1, flag: solver.bendRadius.flag },
  /** Slope of the penalty at zero curvature, from 0 (no patch becomes exactly flat) to 1. */
  flatness: { kind: number, default: 0.3, flag: solver.flatness.flag },
  /** Radius below which a bend is a crease, in the same coordinates as `lambda`. */
  creaseRadius: { kind: number, default: 0.1, flag: solver.creaseRadius.flag },
  /** Maximum number of crease passes, each with another linearisation. Default: 2, or 0 if `lambda` is large for the noise. */
  creasePasses: { kind: whole, flag: solver.creasePasses.flag },
  /** Flags of the vertices that keep their positions, one for each vertex. */
  held: { kind: flags },
};

/** Options of the detection of occlusions. @satisfies {Options} */
export const occlusions = {
  /**
   * Least second derivative of the heights, in magnitude and in coordinates scaled to the unit square, that counts as a jump. A jump's
   * grows with the square of the number of vertices across, so that it is larger than any fold's. Above 0. The default is the authors' value.
   */
  threshold: {
    kind: number,
    default: 4e4,
    flag: { section: 'known', value: 'T', help: 'curvature, in coordinates scaled to the unit square, above which the surface is torn (default 4e4)' },
  },
  ...resampling,
  /** Whether `threshold` is stated for coordinates scaled to the unit square. */
  normalize: { kind: flag, default: true },
};
