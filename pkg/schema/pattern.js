/** Options of patterns and their drawings. Each comment is what the types say; the default is added there. */
import { choice, either, flag, number, numbers, patchPairs, positive, text, whole } from './kinds.js';
import { meshUnrolling, patchesMesh, unroll } from './shape.js';

/** @typedef {import('./kinds.js').Options} Options */

const paper = either(
  choice('a4', 'letter'),
  either(numbers(2, '[width, height] of plates'), numbers(1, '[width] of a roll, in millimetres')),
);

/** How far sheets may be from the surface. @satisfies {Options} */
export const limits = {
  /**
   * Maximum strain of a sheet, as a share: root mean square over the sheet, so that single lengths may be off by more. A
   * sheet with more strain is cut.
   */
  maxStrain: {
    kind: number,
    default: 0.01,
    flag: {
      section: 'shape',
      value: 'S',
      help: 'maximum strain of a sheet, as a share (root mean square over the sheet); a sheet with more is cut (default 0.01)',
    },
  },
  /**
   * Maximum seam gap of a fold: root mean square distance between its two sides on the flat sheet, as a share of its length.
   * A quarter of the mean edge of the mesh that is cut is always allowed.
   */
  maxSeamGap: {
    kind: number,
    default: 0.005,
    flag: {
      section: 'shape',
      value: 'S',
      help: 'maximum distance between the two sides of a fold, as a share of its length; a crease with more is cut (default 0.005)',
    },
  },
  /**
   * Maximum number of flat faces that stand for the surface, whatever its shape: it is simplified to so many triangles. More are left
   * only where fewer would not leave its connections as they are; 0: it is never simplified. Default: 500 where no cut lays the
   * surface flat within the limits, which `simplified` of the summary or report tells.
   */
  faces: {
    kind: whole,
    flag: {
      section: 'shape',
      value: 'N',
      help: 'maximum number of flat faces that stand for a surface of any shape, which makes it a low-poly model; 0 for none (default: ' +
        '500 where no cut lays the surface flat)',
    },
  },
};

/** Options of the drawing of a pattern. @satisfies {Options} */
export const drawing = {
  /** Millimetres for each unit of length. Default: true size, that is 1000 where the unit is metres, else 1. */
  scale: {
    kind: number,
    flag: { section: 'shape', value: 'MM', help: 'millimetres of the pattern for each unit of length (default: true size; 1 where the unit is not known)' },
  },
  ...limits,
  /** Depth of tabs along cut creases, in millimetres; short ones where these are curved. 0 for none. */
  tabs: {
    kind: number,
    default: 0,
    flag: { section: 'shape', value: 'MM', help: 'depth of tabs to glue along creases that are cut (default: none)' },
  },
  /** Distance of marks along seams that are joined, in millimetres: the same on both sides. 0 for none. */
  marks: {
    kind: number,
    default: 0,
    flag: { section: 'shape', value: 'MM', help: 'marks along seams that are joined, so far apart, the same on both sides (default: none)' },
  },
  /** Width that a laser or a saw burns away, in millimetres: lines are cut half of it further out, slits that would close where they are. */
  kerf: {
    kind: number,
    default: 0,
    flag: {
      section: 'shape',
      value: 'MM',
      help: 'width that a laser or a saw burns away: lines are cut half of it further out, slits that would close where they are (default 0)',
    },
  },
  /** Width of the extra material outside of all edges, to be sewn or bent over, in millimetres. */
  allowance: {
    kind: number,
    default: 0,
    flag: { section: 'shape', value: 'MM', help: 'what is left outside of all edges to be sewn or bent over (default 0)' },
  },
  /**
   * Thickness of sheet metal, in millimetres. Each bend is given its bend allowance along the neutral line, and the setbacks on
   * both sides are subtracted (bend deduction). The surface is the upper side of the metal. Folds have to be straight and go from edge to edge.
   * Default: none is taken into account.
   */
  thickness: {
    kind: number,
    flag: {
      section: 'shape',
      value: 'MM',
      help: 'thickness of sheet metal: bend allowances are added and setbacks subtracted; folds must be straight from edge to edge ' +
        '(default: none)',
    },
  },
  /** Inner radius of bends, in millimetres. Default: the thickness. */
  innerRadius: { kind: number, flag: { section: 'shape', value: 'MM', help: 'inner radius of bends (default: the thickness)' } },
  /** Position of the neutral line within the thickness, from the inside of a bend, as a share. Default 0.44. */
  kFactor: {
    kind: number,
    flag: {
      section: 'shape',
      value: 'K',
      help: 'where the neutral line is within the thickness, from the inside of a bend (default 0.44)',
    },
  },
  /** Whether all texts are left out, except the names of sheets. */
  plain: { kind: flag, default: false, flag: { section: 'shape', help: 'without texts, except the names of sheets' } },
  /**
   * Paper, plates or roll that the sheets are laid on, turned where that helps. On A4 and letter a sheet that is larger than a page covers
   * several, which are joined at the printed crosses; one that is too large for the plate or roll rejects with code `UNSUPPORTED`,
   * unless its mesh has exact faces and can be cut to fit. Default: no pages, the sheets beside each other.
   */
  stock: {
    kind: paper,
    type: 'Stock',
    flag: {
      section: 'shape',
      value: 'P',
      help: 'a4, letter, WIDTHxHEIGHT of plates or WIDTHx of a roll, in millimetres: each sheet is put on one page if it fits; on a4 ' +
        'and letter a larger sheet covers several pages, which are joined at the printed crosses (default: none, all beside each ' +
        'other)',
    },
  },
  /** Whether the drawing gets an `assembly`: how the sheets are put together. */
  assembly: {
    kind: flag,
    default: false,
    flag: {
      section: 'shape',
      value: 'FILE',
      help: '.glb: the sheets going from flat to built, one after the other, as an animation; or .svg: the surface from above, ' +
        'with their numbers and the letters of seams. The order of joints is in --report',
    },
  },
};

/** Options of a pattern of a surface. @satisfies {Options} */
export const pattern = {
  ...patchesMesh,
  ...unroll,
  ...drawing,
  /**
   * Whether the sheets are folded back, to measure how near they come to the surface (`summary.refolding`). It takes about as long
   * as laying them flat.
   */
  refold: { kind: flag, default: false },
};

/** Options of laying a mesh flat. `bend` is the angle between triangles, by default at most 0.35. @satisfies {Options} */
export const unrollMesh = {
  ...patchesMesh,
  ...meshUnrolling,
  ...limits,
  /**
   * Whether the mesh's faces are moved into the plane as they are, without strain, and not laid flat as a smooth surface.
   * Default: what `recognizeMesh` says of the mesh; of one that was fitted say `false`, for few triangles of it are a low-poly model.
   */
  exact: { kind: flag },
};

/** Options of models with faces. @satisfies {Options} */
export const model = {
  /** Largest extent of the finished model, in millimetres, instead of `scale`. Default: what `scale` makes of it. */
  size: {
    kind: positive,
    flag: { section: 'shape', value: 'MM', help: 'largest extent of the model in millimetres, instead of --scale, for --surface' },
  },
  /**
   * Pairs of patches whose common edges are cut, for meshes with exact faces: by the numbers, from 1 on, that are drawn on the sheets
   * without `cut` and `join` (those in `sheets[].patches` are from 0 on). A pair without a common edge is refused. Default: none.
   */
  cut: {
    kind: patchPairs,
    flag: { section: 'shape', value: 'A-B,...', help: 'pairs of faces, by their numbers on the drawing, whose common edges are cut, for --surface' },
  },
  /** Pairs of patches, likewise, whose common edges are folds. Default: none. */
  join: {
    kind: patchPairs,
    flag: { section: 'shape', value: 'A-B,...', help: 'pairs of faces whose common edges are folds, for --surface' },
  },
  /**
   * Whether a solid of sheet metal is drawn as its blank: one of its two skins laid flat with bend allowances for its
   * thickness, each smooth bend as one line in its middle.
   */
  blank: {
    kind: flag,
    default: false,
    flag: { section: 'shape', help: 'draw the blank of a solid of sheet metal, with bend allowances for its thickness, for --surface' },
  },
  /** Whether the textures of a mesh with exact faces are printed on its sheets, in SVG and PDF files. */
  printed: {
    kind: flag,
    default: false,
    flag: { section: 'shape', help: 'print the textures of a mesh on its sheets, in .svg and .pdf, for --surface' },
  },
};

/** Options of a pattern of a mesh. @satisfies {Options} */
export const patternMesh = {
  ...unrollMesh,
  ...drawing,
  ...model,
};

/** Options of writing a drawing to an SVG file. @satisfies {Options} */
export const writeSvg = {
  /** Title of the document. Default: "Pattern". */
  title: { kind: text },
};

/** Options of writing a drawing to a PDF file. @satisfies {Options} */
export const writePdf = {
  /**
   * Paper, plates or roll that the sheets are arranged on for the file, as `stock` of a pattern does; the drawing itself stays as it is.
   * Default: the drawing's own pages, or one page as large as the drawing.
   */
  stock: { kind: paper, type: 'Stock' },
  /** Title of the document, which is also written on each page. Default: "Pattern", and none on the pages. */
  title: { kind: text },
};
