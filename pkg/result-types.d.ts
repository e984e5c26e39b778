/** Results of all calls. Made of the structures in `src/` and `wasm/` by `tools/types`. *The paper* is that in `option-types.d.ts`. */

/**
 * Curvatures of a surface at the vertices of its hexagonal lattice (as in `Heightfield`), row by row and NaN where
 * there are none, with their statistics.
 */
export interface Analysis {
  /** Number of rows of the lattice. */
  rows: number;
  /** Number of columns of the lattice. */
  cols: number;
  /** Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart. */
  spacing: number;
  /**
   * Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the
   * left by half a `spacing`.
   */
  origin: [number, number];
  /**
   * Gaussian curvature at each vertex: angle deficit divided by the vertex's share of the area, in the surface's unit
   * of length to the power −2.
   */
  gaussian: Float64Array<ArrayBuffer>;
  /**
   * Principal curvature of larger magnitude at each vertex, in the inverse of the surface's unit of length; positive in
   * a hollow seen from above, negative on a hill (of a mesh it is the other way round).
   */
  kappa1: Float64Array<ArrayBuffer>;
  /** Principal curvature of smaller magnitude at each vertex; 0 on a developable surface. */
  kappa2: Float64Array<ArrayBuffer>;
  /** Density of the energy at each vertex, `|kappa1| + |kappa2|`. */
  nuclearNorm: Float64Array<ArrayBuffer>;
  /** Statistics of the curvatures. */
  summary: AnalysisSummary;
  /** Deviation of the surface from the option `reference`, if that is given. */
  deviation?: Deviation;
}

/**
 * Statistics of a surface's curvatures, as in one row of the paper's Table 1.
 *
 * Curvatures are in coordinates scaled to the unit square, as λ is, so that surfaces of any size compare: `κ` times the
 * longer side, `K` times its square.
 */
export interface AnalysisSummary {
  /** Number of vertices of the surface that have curvatures. */
  vertices: number;
  /**
   * Longer side of a heightfield seen from above, in the surface's units; for a mesh the diameter of its bounding
   * sphere.
   */
  size: number;
  /** Threshold of the Gaussian curvature `|K|` for `gaussianAbove`, in coordinates scaled to the unit square. */
  threshold: number;
  /** Share of the vertices whose Gaussian curvature `|K|` is above the threshold, from 0 to 1. */
  gaussianAbove: number;
  /** Median of the Gaussian curvature's magnitude `|K|`; 0, like all other figures, if no vertex has curvatures. */
  medianGaussian: number;
  /** Median of the smaller principal curvature's magnitude `|κ₂|`; 0 if no vertex has curvatures. */
  medianKappa2: number;
  /** Sum of the Hessians' nuclear norms `‖H‖_*` over the vertices: the energy without its fidelity term. */
  nuclearNorm: number;
  /** Histogram of `|K|`, the magnitude of the Gaussian curvature, over the vertices. */
  gaussian: Histogram;
  /** Histogram of `|κ₂|`, the magnitude of the smaller principal curvature, over the vertices. */
  kappa2: Histogram;
}

/** A seam that is joined in a step of the assembly: between two sheets, or of a sheet with itself. */
export interface AssemblyJoint {
  /** Name of the seam on the drawing: one or more letters. */
  name: string;
  /**
   * Number of the sheet already in place that the seam leads to; for a seam of the sheet with itself, the number of
   * that sheet.
   */
  to: number;
  /** Length of the seam, in the surface's units. */
  length: number;
}

/** The order in which the sheets of a pattern are put together. */
export interface AssemblyOrder {
  /**
   * Steps in which the sheets are put together, one for each sheet. The first sheet is the one with the largest patch;
   * each next one has the longest seams to the sheets already in place.
   */
  steps: AssemblyStep[];
}

/** One step of the assembly: a sheet, and the seams that join it to the sheets of earlier steps or to itself. */
export interface AssemblyStep {
  /** Number of the sheet that is added in this step, counted from 0; names of sheets count from 1. */
  sheet: number;
  /** Seams that are joined in this step, the longest first. */
  joints: AssemblyJoint[];
}

/**
 * Something that a reader assumed because the file does not say it, with the words for whoever reads the result.
 *
 * Reports list every assumption, so that nobody has to find out from a wrong size or a missing part of a surface.
 */
export interface Assumption {
  /** What kind of assumption it is, in camel case, such as `"noData"`: stable, for programs. */
  code: string;
  /**
   * One sentence without a full stop, such as `"-9999 is no data (412 pixels)"`, which follows the word "assumed".
   */
  words: string;
  /** Name of the package's option that decides it instead, such as `"noData"`; `undefined` where there is none. */
  option?: string;
}

/**
 * A curve of straight lines and cubic Bézier curves, each of which begins where the one before ends, as `3n + 1`
 * control points. A closed curve ends where it begins. The inner control points of a straight line lie at its thirds.
 */
export type BezierChain = [number, number][];

/** A crease: a curve along which two patches meet. */
export interface Crease {
  /** Numbers of the patches on either side of the crease, from 0 as in the labels, the lower one first. */
  patches: [number, number];
  /**
   * Points along the crease, in the surface's units, smoothed. The crease is closed if the last point is the first.
   */
  points: [number, number, number][];
  /** Length of the crease, in the surface's units. */
  length: number;
  /**
   * Fold angle, in radians: between the normals of the patches on either side, on average along the crease; 0 where the
   * surface is smooth.
   */
  fold: number;
}

/** Figures that describe the fit of a cylinder to heights. */
export interface CylinderReport {
  /** Verdict on whether the surface is a cylinder. */
  verdict: CylinderVerdict;
  /** Direction of the rulings: a unit vector (x, y, height) in the axes of the heights. */
  rulings: [number, number, number];
  /** Root mean square residual of the heights from the cylinder, in the heights' unit. */
  residual: number;
  /**
   * Correlation of the residuals along the rulings, divided by that of noise as smooth as the heights have it: about 1
   * if the residuals are noise alone. Up to 1.95 the verdict is a cylinder. NaN if there are too few heights to tell,
   * or too few that are independent, with the verdict that it is none.
   */
  excess: number;
  /** Number of heights that the cylinder was fitted to. */
  vertices: number;
}

/**
 * Verdict on whether the surface of heights is a cylinder.
 * - `'cylinder'`: The surface is a cylinder: residuals are no more correlated along the rulings than noise is.
 * - `'other'`: The surface has another shape, because residuals are correlated along the rulings, or there are too few
 *   heights to tell.
 */
export type CylinderVerdict = 'cylinder' | 'other';

/** A photo decoded from a file: RGBA bytes, upright. */
export interface DecodedPhoto {
  /** Number of pixels in a row. */
  width: number;
  /** Number of rows of pixels. */
  height: number;
  /** `4 * width * height` RGBA bytes, row by row, the top row first. */
  data: Uint8ClampedArray<ArrayBuffer>;
  /**
   * Focal length of the camera in millimetres, as for film of 36 by 24 mm; absent if the Exif data do not state it or
   * the photo was cropped.
   */
  film35?: number;
  /**
   * Orientation by which the photo was turned upright, as Exif numbers it from 2 to 8 (6: by 90 degrees clockwise, 3:
   * by 180, 8: by 270); absent if it was stored upright.
   */
  orientation?: number;
  /** What the reader assumed because the file does not say it. */
  assumptions: Assumption[];
}

/**
 * Whether the values of an image are depths of a camera.
 * - `'none'`: Nothing tells them from heights.
 * - `'likely'`: Their range and their occlusions are those of depths.
 * - `'certain'`: Besides, the name of the file says so, or pixels have no depth.
 */
export type DepthEvidence = 'none' | 'likely' | 'certain';

/**
 * Occlusions (jumps) that were detected in heights, at the vertices of a hexagonal lattice. As part of a heightfield,
 * `vertices` can be given as `occlusions` and `edges` as `brokenEdges`.
 */
export interface DetectedOcclusions {
  /** Number of rows of the lattice. */
  rows: number;
  /** Number of columns of the lattice. */
  cols: number;
  /** Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart. */
  spacing: number;
  /**
   * Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the
   * left by half a `spacing`.
   */
  origin: [number, number];
  /** For each vertex, row by row, 1 if a solve would evaluate no Hessian there, else 0. */
  vertices: Uint8Array<ArrayBuffer>;
  /**
   * Edges of the lattice across which the surface is torn, one byte for each vertex, row by row: bit 0 is the edge to
   * the west, then east, north-west, north-east, south-west and south-east. `fit` takes it as `brokenEdges`.
   */
  edges: Uint8Array<ArrayBuffer>;
  /** Number of vertices whose flag is 1. */
  count: number;
  /**
   * For an input that is an image: for each pixel, row by row, 1 if it has data and its nearest vertex has the flag 1
   * in `vertices`, else 0.
   */
  image?: Uint8Array<ArrayBuffer>;
}

/**
 * Deviation of one surface from another on the same lattice, in the surfaces' unit of height, over the vertices where
 * both have a height.
 */
export interface Deviation {
  /** Number of vertices where both compared surfaces have a height. */
  vertices: number;
  /** Root mean square difference of height between the two surfaces, in their unit. */
  rms: number;
  /** Largest difference of height between the two surfaces, in their unit. */
  maximum: number;
}

/** Flat image of a photo of a surface, with its warp map, verdict and report. */
export interface DewarpedImage {
  /** Number of pixels in a row of the flat image. */
  width: number;
  /** Number of rows of the flat image. */
  height: number;
  /** Number of pixels of the flat image per unit of length. */
  resolution: number;
  /**
   * Position `[x, y]` of the image's upper left corner in the plane of `Unrolling.places`, x to the right and y up, in
   * the surface's unit of length; with the option `deskew` in axes that are turned with the image about the origin.
   */
  corner: [number, number];
  /**
   * RGBA bytes of the flat image, row by row, transparent where there is no sheet; `new ImageData(data, width)` shows
   * it.
   */
  data: Uint8ClampedArray<ArrayBuffer>;
  /**
   * Warp map: for each pixel of the flat image its place x, y in the photo, in pixels from the centre of the upper left
   * one; NaN where there is no sheet. Empty if the option `map` is false.
   */
  map: Float32Array<ArrayBuffer>;
  /** The warp map on a grid, if the option `grid` asks for it. */
  grid?: WarpGrid;
  /**
   * Share of the sheet that the option `trim` left out; for a `crop` with four corners, share of the page between them
   * that the flat image does not show; else 0.
   */
  loss: number;
  /**
   * Distance by which a `crop` with four corners reaches beyond the page that was found in the photo, as a share of the
   * page's side: above 0.02 the verdict is `'doubtful'`. 0 where no page is found without doubt.
   */
  overreach: number;
  /** What happened to the light: `'keep'` also where it was to be evened but the image is not mostly paper. */
  light: LightTreatment;
  /** Whether the flat image can be trusted. */
  verdict: Verdict;
  /** Report on laying the surface flat. */
  report: UnrollReport;
}

/**
 * Strain of a flat layout: relative changes of length from the surface to the plane. `σ₁ ≥ σ₂` are the singular values
 * of each triangle's map to the plane.
 */
export interface Distortion {
  /**
   * Root mean square strain over the area of all triangles: the root of the mean of `((σ₁ − 1)² + (σ₂ − 1)²) / 2`.
   */
  rms: number;
  /** Largest strain of any triangle, `max(σ₁ − 1, 1 − σ₂)`. */
  maximum: number;
  /** Share of the area in triangles whose strain is above 0.01, from 0 to 1. */
  above: number;
  /** Ratio of the layout's area to the surface's area. */
  area: number;
  /** Number of triangles that lie upside down in the layout. */
  flipped: number;
}

/** A text on a sheet of a drawing or beside it. */
export interface DrawingLabel {
  /** Subject of the text: a patch, a cut crease, a fold or a sheet. */
  kind: DrawingLabelKind;
  /** The text's characters. */
  text: string;
  /** Position of the middle of the text in the drawing, in millimetres. */
  place: [number, number];
  /** Font size of the text, in millimetres. */
  size: number;
  /** Angle of the text, in degrees counter-clockwise. */
  turn: number;
  /**
   * Numbers of the patches on either side of a cut crease, from 0, the lower one first; only its letters have them.
   */
  patches?: [number, number];
}

/**
 * Subject of a text in a drawing: what the text numbers or names.
 * - `'patch'`: The number of a patch, on it or beside its sheet.
 * - `'seam'`: The letter of a cut crease, along the cut or on a tab.
 * - `'fold'`: Direction (mountain or valley) and angle of a fold, along it.
 * - `'sheet'`: The name of a sheet, above the sheet.
 */
export type DrawingLabelKind = 'patch' | 'seam' | 'fold' | 'sheet';

/** One printed page or plate, which shows a rectangular part of the drawing. */
export interface DrawingPage {
  /**
   * Name of the page: its number if it holds whole sheets; column letter and row number from the upper left, such as
   * `A1`, if it has to be put together with others.
   */
  name: string;
  /** Lower left corner of the page's part of the drawing, in the drawing's millimetres. */
  corner: [number, number];
}

/** The printed pages or plates of a drawing, all of one size. */
export interface DrawingPages {
  /** Width and height of the paper or plate, in millimetres. */
  paper: [number, number];
  /**
   * Width of the blank margin: distance from the paper's left and lower edge to the part of the drawing on it, in
   * millimetres.
   */
  blank: number;
  /** Width and height of the part of the drawing that each page shows, in millimetres. */
  part: [number, number];
  /** The pages, each with its name and the lower left corner of its part of the drawing. */
  pages: DrawingPage[];
  /**
   * Positions of alignment marks, in the drawing's millimetres: middles and corners of the strips in which pages
   * overlap. Each mark is printed on all pages that show its position, so that the pages can be aligned.
   */
  marks: [number, number][];
}

/**
 * Summary of a drawing: numbers of sheets, seams, folds, tabs and pages; total lengths in millimetres; strain and gaps.
 */
export interface DrawingSummary {
  /** Number of sheets on the drawing. */
  sheets: number;
  /** Number of creases that are cut over their whole length or a part of it. */
  seams: number;
  /** Number of slits: cuts inside of a patch, made because the patch cannot be laid flat in one piece. */
  slits: number;
  /** Total length of the cuts along creases, in millimetres, each counted once. */
  seamLength: number;
  /** Total length of the slits (cuts inside of a patch), in millimetres, each counted once. */
  slitLength: number;
  /**
   * Largest difference between the lengths of a joint's two sides, as a share of the longer one. Joints shorter than a
   * tenth of the side of a square with the area of all sheets are ignored, as are steps of the surface, whose two sides
   * are not joined.
   */
  mismatch: number;
  /** The joint with the largest difference between the lengths of its two sides, if any joint is compared. */
  worstJoint?: WorstJoint;
  /**
   * Number of points inside of the surface where cuts or folds end and where the angles of the flat pieces were
   * compared with that of the surface. Angles are measured within four fifths of the shortest seam that ends there, and
   * within twenty spacings.
   */
  points: number;
  /** The point where the angles of the flat pieces differ most from that of the surface, if any was compared. */
  worstAngle?: WorstAngle;
  /** Number of creases along which a sheet is folded. */
  folds: number;
  /** Number of tabs (glued flaps) on the drawing. */
  tabs: number;
  /** Number of creases that are cut and have a tab on neither side, for want of room; 0 if no tabs are wanted. */
  untabbed: number;
  /** Number of cuts without a letter, for want of room on one side or both. */
  unlettered: number;
  /** Total length of all cut lines, in millimetres. */
  cutLength: number;
  /** Total length of all mountain folds, without those of tabs, in millimetres. */
  mountainLength: number;
  /** Total length of all valley folds, without those of tabs, in millimetres. */
  valleyLength: number;
  /** Total area of the sheets without tabs, in square millimetres. */
  area: number;
  /**
   * Largest strain (relative change of length) of a sheet, root mean square over its area; 0 if all sheets are exactly
   * developable.
   */
  strain: number;
  /** Largest seam gap of a fold in millimetres: root mean square distance between the fold's two sides. */
  seamGap: number;
  /**
   * Largest root mean square distance between a refolded sheet and the surface, in millimetres; `undefined` unless
   * `refold` was set.
   */
  refolding?: number;
  /** Part of the surface that is on no sheet, if it is known; areas in square millimetres. */
  missing?: MissingSurface;
  /** The flat faces that stand for the surface, if it was simplified. */
  simplified?: SimplifiedSurface;
  /** Number of pages of A4 paper that the drawing takes. */
  a4: number;
  /** Number of pages of Letter paper that the drawing takes. */
  letter: number;
}

/**
 * A sheet of a drawing, in the drawing's millimetres. It is rotated to its smallest bounding box if that saves enough
 * area, and never mirrored.
 */
export interface DrawnSheet {
  /** Name of the sheet that is written above it: `Sheet 1` and so on. */
  name: string;
  /** Numbers of the patches that the sheet consists of. */
  patches: number[];
  /** Lower left and upper right corner of the sheet's bounding box, in the drawing's millimetres. */
  bounds: [[number, number], [number, number]];
  /**
   * Cut lines of the sheet, which also go around tabs: closed polylines whose last point is joined to the first. Points
   * lie within a fiftieth of a millimetre of `curves`.
   */
  cuts: [number, number][][];
  /** The sheet's cut lines as smooth curves. */
  curves: BezierChain[];
  /** Triangles of the sheet on which a texture is printed. */
  printed: PrintedTriangle[];
  /** Lines along which the sheet is folded, without those of tabs. */
  folds: FoldLine[];
  /** Lines along which the sheet's tabs (glued flaps) are folded. */
  tabs: FoldLine[];
  /**
   * Edges of the surface inside of the sheet's allowance: the lines along which the extra material is sewn or bent
   * over.
   */
  edges: BezierChain[];
  /** Marks: short lines across seams, which coincide when both sides of a seam are joined. */
  marks: BezierChain[];
  /** Leader lines, each from a patch that is too small for its number to the number beside the sheet. */
  leaders: BezierChain[];
  /** Texts on and beside the sheet: numbers of patches, letters of seams, angles of folds, the sheet's name. */
  labels: DrawingLabel[];
}

/**
 * Penalty of the Hessian `H` of heights, which is minimised together with the fidelity term.
 * - `'nuclear'`: Penalty `Σ ‖H‖_*`, the nuclear norm of the Hessian: piecewise developable surfaces (paper, Eq. 15).
 *   The default of a design.
 * - `'frobenius'`: Penalty `Σ ‖H‖_F`, the Frobenius norm of the Hessian: rounds off creases (paper, Fig. 21).
 * - `'squaredNuclear'`: Penalty `Σ ‖H‖_*²`, the squared nuclear norm of the Hessian: rounds off creases (paper, Fig.
 *   21).
 * - `'secondFormOfInput'`: Penalty `Σ n₃ ‖H‖_*`, the nuclear norm of the second fundamental form, with the factor `n₃ =
 *   (1 + |∇z|²)^-½` computed from the input once: convex (paper, Fig. 7, right).
 * - `'secondForm'`: Penalty `Σ n₃ ‖H‖_*` with the factor `n₃ = (1 + |∇z|²)^-½` of the surface itself, updated in each
 *   iteration: not convex (paper, Fig. 7, centre right). The duality gap is certified for the energy with the last
 *   factor kept.
 * - `'huber'`: Huber penalty `Σ φ(‖H‖_*)`: `φ` is quadratic for small bends and linear for large ones, with the slope
 *   `min(α + s/δ, 1)` at the size `s`. The surface stays smooth where it bends smoothly, without the flat strips of the
 *   nuclear norm, and can still crease and stay developable. Up to `creasePasses` further solves lower the cost of
 *   bends tighter than `creaseRadius`, so that creases keep their angle. Objective and duality gap of the report belong
 *   to the last solve's energy. The default of every input that is not a design.
 */
export type Energy = 'nuclear' | 'frobenius' | 'squaredNuclear' | 'secondFormOfInput' | 'secondForm' | 'huber';

/** A triangle of a fitted mesh that is folded over or crosses another one near it. */
export interface EntangledTriangle {
  /** Index of the triangle in the mesh. */
  triangle: number;
  /** Middle of the triangle in the fitted mesh. */
  position: [number, number, number];
}

/** Heights of a fitted surface on its hexagonal lattice, as in `Heightfield`, and the report on the fit. */
export interface FittedHeights {
  /** Number of rows of the lattice. */
  rows: number;
  /** Number of columns of the lattice. */
  cols: number;
  /** Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart. */
  spacing: number;
  /**
   * Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the
   * left by half a `spacing`.
   */
  origin: [number, number];
  /**
   * `rows * cols` heights at the vertices, in the surface's unit of length, row by row, the top row first; NaN where
   * the surface has no vertex.
   */
  heights: Float64Array<ArrayBuffer>;
  /** The surface at the pixels of the input, if that is an image. */
  image?: SurfaceImage;
  /**
   * Root mean square distance of `image` from the heights of the input, over the pixels that have both, in the
   * surface's unit of length: what neither the lattice nor the fit has kept of them.
   */
  pixelDistance?: number;
  /** Report on the fit: what was solved, how well, and at what cost. */
  report: SolveReport;
}

/** Flat image of a page, with its warp map. */
export interface FlatImage {
  /** Number of pixels in a row of the flat image. */
  width: number;
  /** Number of rows of the flat image. */
  height: number;
  /** Number of pixels of the flat image per unit of length. */
  resolution: number;
  /**
   * Position `[x, y]` of the image's upper left corner on the page laid flat, x to the right and y up, in the unit of
   * lengths.
   */
  corner: [number, number];
  /**
   * RGBA bytes of the flat image, row by row, transparent where there is no sheet; `new ImageData(data, width)` shows
   * it.
   */
  data: Uint8ClampedArray<ArrayBuffer>;
  /**
   * Warp map of `2 * width * height` numbers: for each pixel of the flat image its place x, y in the photo, in pixels
   * from the centre of the upper left one; NaN where there is no sheet. Empty if the option `map` is false.
   */
  map: Float32Array<ArrayBuffer>;
  /** The warp map on a grid, if the option `grid` asks for it. */
  grid?: WarpGrid;
  /**
   * What happened to the light: `'keep'` also where it was to be evened but the page is dark or not mostly paper.
   */
  light: LightTreatment;
}

/**
 * A smooth bend: a piece of a cylinder or cone, which is drawn as several fold lines beside each other, or as the one
 * in its middle where metal is bent.
 */
export interface FoldBend {
  /** Angle of the whole bend, in degrees. */
  angle: number;
  /** Radius in millimetres: of the surface in the bend, or of its inside where metal is bent. */
  radius: number;
  /** Whether the fold line is the one in the middle of the bend. */
  isMiddle: boolean;
}

/**
 * The direction in which a sheet is folded, seen from above.
 * - `'mountain'`: A ridge: the fold points towards the viewer.
 * - `'valley'`: A groove: the fold points away from the viewer.
 */
export type FoldDirection = 'mountain' | 'valley';

/** A fold line of a drawn sheet: a line along which the sheet is folded. */
export interface FoldLine {
  /**
   * Number of the crease that the fold line follows, from 0, its index in `creases`; of lines of a bend that are less
   * than a millimetre apart, one is drawn.
   */
  crease: number;
  /** Numbers of the patches on either side of the fold line, from 0, the lower one first. */
  patches: [number, number];
  /** Whether the fold is a mountain or a valley fold, seen from above. */
  direction: FoldDirection;
  /**
   * Fold angle in degrees: 0 where the sheet stays flat. Folds of at most half a degree are not drawn; a line of a bend
   * also has the angle of those beside it that are not.
   */
  angle: number;
  /** The smooth bend that the fold line is a part of. */
  bend?: FoldBend;
  /** Length of the fold line, in millimetres. */
  length: number;
  /** The fold line as a polyline in millimetres, within a fiftieth of a millimetre of `curve`. */
  points: [number, number][];
  /** The fold line as a smooth curve in millimetres. */
  curve: BezierChain;
}

/**
 * An image file format that can be read.
 * - `'png'`: Portable Network Graphics, grey, 1 to 16 bits.
 * - `'npy'`: NumPy's file of one array (NPY).
 * - `'tiff'`: Tagged Image File Format, also BigTIFF and GeoTIFF.
 * - `'exr'`: OpenEXR, a format of pictures with several channels.
 * - `'pfm'`: Portable float map (PFM), grey.
 * - `'npz'`: NumPy's archive of several arrays (NPZ).
 * - `'jpeg'`: JPEG, only grey pictures.
 * - `'webp'`: WebP, only grey pictures.
 * - `'text'`: Text: a grid of ESRI or Surfer, points on a grid (XYZ), or a matrix.
 * - `'colmap'`: Depth map of COLMAP.
 * - `'gif'`: GIF, only grey pictures.
 * - `'bmp'`: Windows bitmap (BMP), only grey pictures.
 * - `'pgm'`: Portable grey map (PGM), binary or text.
 * - `'hgt'`: Heights of the Shuttle Radar Topography Mission (SRTM): a square of one degree, without a header.
 */
export type Format = 'png' | 'npy' | 'tiff' | 'exr' | 'pfm' | 'npz' | 'jpeg' | 'webp' | 'text' | 'colmap' | 'gif' | 'bmp' | 'pgm' | 'hgt';

/**
 * Where the pixels of an image lie on a map. It is read from a GeoTIFF and written to one unchanged, but for the rows
 * that were reversed.
 */
export interface Georeference {
  /**
   * Affine transformation `[a, b, c, d, e, f]` from the column `i` and the row `j` of a pixel's upper left corner (of
   * its middle, if the keys say so) to map coordinates: `x = a·i + b·j + c`, `y = d·i + e·j + f`, in the unit of the
   * coordinate system.
   */
  transformation: [number, number, number, number, number, number];
  /** Numbers of the tag `GeoKeyDirectory`, which names the coordinate system; empty if there is none. */
  keys: number[];
  /** Numbers of the tag `GeoDoubleParams`, to which keys refer. */
  doubles: number[];
  /** Text of the tag `GeoAsciiParams`, to which keys refer. */
  text: string;
  /**
   * Columns and rows of the file's own pixels, which the transformation is about, if the image was made of square ones;
   * files of its surface are written on them.
   */
  size?: [number, number];
}

/** Histogram of magnitudes of curvatures in bins of half a decade, which are the same for all surfaces. */
export interface Histogram {
  /**
   * Upper ends of the bins, ascending: bin `i` counts magnitudes from `edges[i − 1]` to below `edges[i]`, the first bin
   * all smaller ones, and the last bin, which has no upper end, all larger ones.
   */
  edges: number[];
  /** Number of vertices in each bin of the histogram; there is one bin more than edges. */
  counts: number[];
}

/** Parameters of the energy `'huber'` that a solve has used, whether given or chosen. */
export interface HuberReport {
  /** Bend radius in normalised coordinates: see the option `bendRadius`. */
  bendRadius: number;
  /** Flatness, from 0 to 1: see the option `flatness`. */
  flatness: number;
  /** Crease radius in normalised coordinates: see the option `creaseRadius`. */
  creaseRadius: number;
  /** Number of crease passes after the first solve. */
  creasePasses: number;
  /**
   * Number of interior vertices that lie on a crease: the last crease pass gives bends there a smaller weight, so that
   * the crease stays sharp.
   */
  creases: number;
}

/** Choice of λ by `'auto'`: its reason, what it found out about the noise, and its cost. */
export interface LambdaChoice {
  /** Reason for the chosen λ. */
  reason: LambdaReason;
  /**
   * Standard deviation σ of the heights' noise, in the input's units: of an image, that of its pixels. `undefined` if
   * it cannot be measured.
   */
  sigma?: number;
  /**
   * Quantisation step of the heights, in the input's units; `undefined` unless their noise is rounding to multiples of
   * such a step.
   */
  step?: number;
  /**
   * Correlation length of the noise, in the input's units: the standard deviation of the Gaussian blur that turns white
   * noise into noise like it. 0 for noise that is independent from vertex to vertex.
   */
  correlationLength: number;
  /**
   * Whether the noise of heights that no camera has measured is correlated and larger than 15 % of their standard
   * deviation, as the shape of a terrain looks too, so that noise and shape cannot be told apart: σ and λ are
   * uncertain.
   */
  ambiguous: boolean;
  /**
   * Root mean square distance from the heights that the surface keeps within, in the input's units: the one that was
   * asked for, or a default where heights have no noise or `ambiguous` noise; `undefined` otherwise.
   */
  tolerance?: number;
  /**
   * Root mean square of the residual, in standard deviations σ of the noise; more than 2 σ at a vertex counts as that.
   * It is about 1 where λ suits the shape. Far above, the surface is farther from the heights than their noise
   * explains. `undefined` before the end of the solve, or without noise.
   */
  residualRatio?: number;
  /** Whether the residual is larger than the noise explains, so that the surface has lost a part of the shape. */
  residualExceedsNoise: boolean;
  /**
   * Whether rows of the image had offsets of their own, as line sensors give them, which were taken out of the heights.
   */
  offsetRows: boolean;
  /** Whether columns of the image had offsets of their own, which were taken out of the heights. */
  offsetColumns: boolean;
  /**
   * Number of times that λ was raised above the one that follows from the noise, since the residual of the surface
   * showed that one to be too small.
   */
  raises: number;
  /**
   * Number of solves before the last one: those by which offset rows and columns are levelled, and those that look for
   * λ, nearly all of them on coarse lattices.
   */
  solves: number;
  /** Number of ADMM iterations of these solves, which the report's own number of iterations does not include. */
  iterations: number;
}

/**
 * Reason for the λ that `'auto'` has chosen.
 * - `'prediction'`: λ follows from size and correlation length of the noise, and the penalty is the one that best
 *   predicts held-out heights (cross-validation). Where noise is correlated, penalty and λ, up to a factor, are those
 *   that best predict heights with another draw of it (data thinning).
 * - `'noise'`: λ follows from size and correlation length of the noise, without a comparison of penalties: the energy
 *   has no parameters, or there are too few heights to predict.
 * - `'noNoise'`: The heights have hardly any noise: λ is `'big'`, or larger, so that the surface keeps within
 *   `tolerance`.
 * - `'tolerance'`: λ is the smallest one that keeps the surface within `tolerance`.
 * - `'unknown'`: There are too few heights to estimate their noise: λ is `'medium'`.
 */
export type LambdaReason = 'prediction' | 'noise' | 'noNoise' | 'tolerance' | 'unknown';

/** Work of a solve on one multigrid level. */
export interface LevelReport {
  /** Spacing of the level's lattice, in normalised coordinates. */
  spacing: number;
  /** Number of interior vertices of the level's lattice. */
  interior: number;
  /** Number of ADMM iterations on the level. */
  iterations: number;
  /** Number of conjugate-gradient iterations on the level, over all z-steps. */
  cgIterations: number;
}

/**
 * What happens to the light on a flat page.
 * - `'even'`: The light is evened: paper becomes white, shadows and the lamp's colour disappear, colours of print stay.
 * - `'keep'`: The light stays as it was photographed.
 */
export type LightTreatment = 'even' | 'keep';

/**
 * Curvatures at the vertices of a mesh, positive where it bends as a ball does and NaN where triangles do not surround
 * a vertex, with their statistics.
 */
export interface MeshAnalysis {
  /**
   * Gaussian curvature at each vertex: angle deficit divided by the vertex's share of the area, in the surface's unit
   * of length to the power −2.
   */
  gaussian: Float64Array<ArrayBuffer>;
  /** Principal curvature of larger magnitude at each vertex, in the inverse of the surface's unit of length. */
  kappa1: Float64Array<ArrayBuffer>;
  /** Principal curvature of smaller magnitude at each vertex; 0 on a developable surface. */
  kappa2: Float64Array<ArrayBuffer>;
  /** Density of the energy at each vertex, `|kappa1| + |kappa2|`. */
  nuclearNorm: Float64Array<ArrayBuffer>;
  /**
   * Unit vector x, y, z at each vertex along which the mesh bends by `kappa2`, up to its sign; `rulings` gives smoothed
   * directions.
   */
  rulings: Float64Array<ArrayBuffer>;
  /**
   * Statistics of the curvatures. `size` is the diameter of the mesh's bounding sphere, and the sum of nuclear norms is
   * weighted by area.
   */
  summary: AnalysisSummary;
}

/**
 * The kind of a mesh, which decides whether a fit gains anything and how the mesh is laid flat.
 * - `'faces'`: Its faces are exact, as in CAD and low-poly models, or few, and are moved into the plane as they are.
 * - `'bends'`: As `faces`, but some of its bends are triangulated irregularly, and are divided along their lines first.
 * - `'noisyFaces'`: Its vertices have noise about flat faces, as in scans of roofs and boxes; the faces are laid flat
 *   without it.
 * - `'surface'`: Its vertices have no noise, so that a fit gains nothing, but it is no part of planes, cylinders and
 *   cones.
 * - `'noisy'`: Its vertices have noise.
 */
export type MeshKind = 'faces' | 'bends' | 'noisyFaces' | 'surface' | 'noisy';

/** Figures of one pass of a mesh's fit: a linearisation of the energy, and the solve of its convex problem. */
export interface MeshPass {
  /** Number of ADMM iterations of the pass, on the mesh and on coarser levels together. */
  iterations: number;
  /**
   * Number of conjugate-gradient steps of the pass, over all z-steps of all levels; V-cycles on levels that are solved
   * by these.
   */
  cgIterations: number;
  /** Objective of the best iterate, in the linearised problem. */
  objective: number;
  /** Certified lower bound of the linearised problem's optimal objective. */
  dualBound: number;
  /** Relative duality gap `(objective − dualBound) / objective` of the linearised problem. */
  gap?: number;
  /** Reason why the pass stopped. */
  stopReason: StopReason;
  /** Number of vertices on creases, where bends cost less in this pass. */
  creases: number;
  /**
   * Root mean square distance by which vertices moved from the base of the linearisation, in the input's unit of
   * length.
   */
  moved: number;
  /** Largest distance by which a vertex moved from the base of the linearisation, in the input's unit of length. */
  movedMost: number;
}

/**
 * Patches of a mesh (regions without a crease inside), that with the largest area first, and the creases between them.
 */
export interface MeshPatchMap {
  /** Number of the patch of each triangle of the mesh, −1 for none. */
  labels: Int32Array<ArrayBuffer>;
  /** The patches, in the order of their numbers. */
  patches: Patch[];
  /** The creases between the patches. */
  creases: Crease[];
  /** Angle between neighbouring triangles, in radians, above which an edge counted as part of a crease. */
  bend: number;
}

/** Repairs of a mesh before its fit. The fitted mesh has the vertices and triangles of the input all the same. */
export interface MeshRepairs {
  /** Number of vertices that share their position with an earlier one and move together with it. */
  joined: number;
  /** Number of triangles with two corners at one position, which are ignored. */
  degenerate: number;
  /** Number of triangles that repeat another one, which are ignored. */
  repeated: number;
  /** Number of triangles that faced the other side than their neighbours and were reversed. */
  turned: number;
  /** Number of vertices of no triangle, which stay where they are. */
  unused: number;
  /**
   * Number of edges of three triangles or more. None of these continues another across it: it is a border of each, and
   * they move together there.
   */
  branched: number;
}

/** Report of a mesh's fit: what was solved, how well, and at what cost. */
export interface MeshReport {
  /** Number of vertices in the solve: vertices of the input at one position count as one. */
  vertices: number;
  /** Number of interior vertices of the solve: those with triangles all around, whose bends make up the energy. */
  interior: number;
  /** Number of vertices on the border of the surface, which have no bend of their own. */
  border: number;
  /** Number of pinched vertices, at which parts of the surface touch in a point. */
  pinched: number;
  /** Number of connected components of the mesh. */
  components: number;
  /** Repairs of the mesh before its fit. */
  repairs: MeshRepairs;
  /** Spacing of a hexagonal lattice with vertices of the mesh's mean area, in the input's unit of length. */
  spacing: number;
  /**
   * Factor from the input's units to normalised coordinates, in which the mesh's bounding sphere has the diameter 1.
   */
  scale: number;
  /**
   * Standard deviation of the noise along the normals, in the input's unit of length; `undefined` if there are too few
   * vertices to estimate it.
   */
  sigma?: number;
  /** Weight λ of the fidelity term, as a number, in normalised coordinates. */
  lambda: number;
  /**
   * Figures of the passes, in order. A pass's duality gap certifies the best iterate of its linearised problem alone:
   * the energy itself is not convex, and nothing is certified of it.
   */
  passes: MeshPass[];
  /**
   * Volume that the surface encloses before and after the fit, in the input's unit cubed; `undefined` for open
   * surfaces.
   */
  volume?: [number, number];
  /** Area of the surface before and after the fit, in the input's unit squared. */
  area: [number, number];
  /** Number of folded triangles, which face away from the surface around them, before and after the fit. */
  flipped: [number, number];
  /**
   * Triangles of the finished surface that are folded over or cross others near them, because their vertices cannot be
   * parted without leaving their reach: five standard deviations of the noise, and more if λ is smaller than suits it.
   */
  entangled: EntangledTriangle[];
  /** Reason why the fit stopped. */
  stopReason: StopReason;
  /** Time spent in each phase of the fit, in seconds. */
  seconds: SolveSeconds;
}

/** Rulings of a mesh: the directions in which it does not bend, and lines along them. */
export interface MeshRulings {
  /**
   * Unit vector x, y, z along the ruling at each vertex, up to its sign; NaN where triangles do not surround the
   * vertex.
   */
  directions: Float64Array<ArrayBuffer>;
  /** Confidence in the direction at each vertex, from 0 to 1. */
  confidence: Float64Array<ArrayBuffer>;
  /** Traced rulings, each with a point on every edge that it crosses. */
  lines: Ruling[];
}

/**
 * Sheets of a mesh laid flat, one to the right of the other, seen from the side that the triangles face. They have more
 * vertices than the mesh, since it is cut.
 */
export interface MeshUnrolling {
  /** Coordinates x, y, z of each vertex of the sheets on the mesh, in the mesh's unit of length. */
  positions: Float64Array<ArrayBuffer>;
  /**
   * Coordinates x, y of each vertex of the sheets in one plane, where the sheets lie side by side, in the mesh's unit
   * of length; y points up.
   */
  places: Float64Array<ArrayBuffer>;
  /** Three vertices of the sheets for each of their triangles, counted from 0, counter-clockwise. */
  triangles: Uint32Array<ArrayBuffer>;
  /** Number of the sheet of each vertex, from 0. */
  sheets: Uint32Array<ArrayBuffer>;
  /** The two singular values of each triangle's map from the mesh to the plane, the larger one first. */
  stretches: Float64Array<ArrayBuffer>;
  /** The patches of the sheets, that with the largest area first. */
  patches: Patch[];
  /** The creases and cuts between the patches. */
  creases: Crease[];
  /** Measures of the sheets: number, area, strain and gaps at folds, and what is on no sheet. */
  report: MeshUnrollingReport;
}

/** Measures of a mesh laid flat. */
export interface MeshUnrollingReport {
  /** Number of sheets. */
  sheets: number;
  /** Area of the sheets, in the mesh's unit squared. */
  area: number;
  /** Root mean square strain of the worst sheet, as a share. */
  strain: number;
  /** Root mean square distance between the two sides of a fold, in the mesh's unit of length, of the worst sheet. */
  seamGap: number;
  /** Parts of the mesh that cannot be laid flat and are on no sheet; all 0 if there are none. */
  missing: MissingSurface;
  /**
   * The flat faces that stand for the mesh, if no cut lays it flat or so few are wanted; the distance in the mesh's
   * unit.
   */
  simplified?: SimplifiedSurface;
}

/**
 * What of a surface is on no sheet: vertices that were left out, and steps, with their areas in the surface's units.
 */
export interface MissingSurface {
  /**
   * Number of vertices that were left out of the pattern because they do not lie flat and are too few to be cut
   * further, mostly at ragged steep borders and torn tips, or are on sheets of less than a thousandth of the area.
   */
  vertices: number;
  /** Area around the vertices that were left out, in the surface's units squared. */
  area: number;
  /**
   * Number of steps of the surface, which are edges where it jumps in height. The surface is cut at a step, and the
   * steep wall between its two sides is on no sheet.
   */
  steps: number;
  /** Approximate area of the walls at steps, in the surface's units squared: their lengths times their heights. */
  stepArea: number;
}

/** An array of an NPZ file. */
export interface NpzArray {
  /** Name of the array. */
  name: string;
  /** Lengths of the array's dimensions. */
  shape: number[];
  /** Type of number, such as `'f32'`; NumPy's own name for a type that is no number. */
  dataType: string;
  /** Whether it may be an image of heights: rows and columns of numbers, more than the matrix of a camera has. */
  mayBeImage: boolean;
}

/** Edges of a page in a photo, as points from corner to corner in the photo's pixels. */
export interface OutlineEdges {
  /** Upper edge, from left to right. */
  top: [number, number][];
  /** Lower edge, from left to right. */
  bottom: [number, number][];
  /** Left edge, from top to bottom. */
  left: [number, number][];
  /** Right edge, from top to bottom. */
  right: [number, number][];
}

/**
 * Reason why an outline is doubtful or was not found.
 * - `'cornerOutside'`: A corner is outside of the photo; its position is extrapolated from the edges.
 * - `'cornerCovered'`: A corner is covered, folded over or torn off; its position is extrapolated from the edges.
 * - `'edgeOutside'`: Most of an edge is outside of the photo, or on its rim.
 * - `'faintEdge'`: Part of an edge has no contrast: something covers it, or page and background look alike.
 * - `'unlikelyShape'`: The outline's shape is unlike that of a sheet of paper.
 * - `'noPage'`: Nothing in the photo looks like a page on a background.
 */
export type OutlineReason = 'cornerOutside' | 'cornerCovered' | 'edgeOutside' | 'faintEdge' | 'unlikelyShape' | 'noPage';

/**
 * Verdict of a search for the outline of a page.
 * - `'found'`: One page was found, with a clear edge all around.
 * - `'doubtful'`: One page was found, but something about its outline is uncertain: see the reasons.
 * - `'several'`: Several pages side by side were found, listed by decreasing score: choose one.
 * - `'notFound'`: No page was found that can be told from its background.
 */
export type OutlineVerdict = 'found' | 'doubtful' | 'several' | 'notFound';

/**
 * Main reason why a flat page is doubtful.
 * - `'largeError'`: The expected error is above 1.5 % of the page's width.
 * - `'hiddenPart'`: A part of the page hides another part from the camera.
 * - `'crumpled'`: The page is crumpled: its model is a sheet that is strained.
 * - `'spread'`: The page may be both pages of an open book: it is bent and wider than high, and no line of print
 *   crosses its middle.
 * - `'outline'`: The outline that was found in the photo is doubtful.
 */
export type PageDoubt = 'largeError' | 'hiddenPart' | 'crumpled' | 'spread' | 'outline';

/**
 * Model of a page's shape, from the plainest to the most general.
 * - `'plane'`: A plane seen in perspective: a homography maps it to the photo.
 * - `'cylinder'`: A cylinder over any curve: a page that is curled in one direction.
 * - `'sheet'`: An isometric sheet of any shape, bent without strain: a page that is folded, or bent both ways.
 * - `'softSheet'`: A sheet that is slightly strained: a crumpled page, whose wrinkles are too small to be visible in
 *   its outline.
 */
export type PageModel = 'plane' | 'cylinder' | 'sheet' | 'softSheet';

/** Outline of one page in a photo. */
export interface PageOutline {
  /**
   * Upper left, upper right, lower right and lower left corner of the page, in pixels of the photo; a corner may be
   * outside of the photo.
   */
  corners: [[number, number], [number, number], [number, number], [number, number]];
  /** The four edges, which `dewarpPage` takes. */
  edges: OutlineEdges;
  /** Confidence that this is the outline of a page, from 0 to 1. */
  score: number;
  /** Reasons why the outline is doubtful. */
  reasons: OutlineReason[];
}

/** Outlines of the pages that were found in a photo. */
export interface PageOutlines {
  /** Whether one page was found, one that is doubtful, several, or none. */
  verdict: OutlineVerdict;
  /** Reasons why the verdict is not `'found'`. */
  reasons: OutlineReason[];
  /**
   * The outlines, the best one first: several if the verdict is `'several'`; for `'notFound'` the best guess, if there
   * is one.
   */
  pages: PageOutline[];
}

/** Verdict on a page that was found in a photo, with the measures of its fit. */
export interface PageReport {
  /** Whether the flat page can be trusted. */
  verdict: PageVerdict;
  /** Main reason for the verdict `'doubtful'`; `undefined` for other verdicts. */
  doubt?: PageDoubt;
  /** Model that was fitted to the page's shape: plane, cylinder or sheet. */
  model: PageModel;
  /** Expected displacement of points on the flat page: the root mean square, in % of a page's width. */
  error: number;
  /** Displacement that is not exceeded in 95 of 100 cases, in % of a page's width. */
  errorBound: number;
  /** Focal length of the camera, in pixels of the photo. */
  focalLength: number;
  /** Angle between the camera's axis and the normal of the page's chord plane, in degrees. */
  tilt: number;
  /** Bound of the largest angle between the normals at two points of the page, in degrees: 0 for a plane. */
  bend: number;
  /**
   * Root mean square distance in the photo between the page's edges, given or detected, and those of the fitted page,
   * in pixels.
   */
  residual: number;
  /**
   * Root mean square distance in the photo between the page's edges, given or detected, and those of the fitted page,
   * in % of the width of one page.
   */
  disagreement: number;
  /** Number of lines of text that the fit of the page used besides the edges, traced and detected ones. */
  lines: number;
  /** Number of lines of text that were detected in the photo. */
  linesFound: number;
  /**
   * Root mean square distance of the lines of text from level lines on the flat page, which they should follow, in % of
   * a page's width.
   */
  linesDisagreement: number;
  /** Ratio of the page's height to its width. */
  ratio: number;
}

/**
 * Verdict on a flat page: whether it can be trusted.
 * - `'flat'`: The page was flat: only the perspective is removed.
 * - `'unrolled'`: The page was bent and is flat now, with lengths as on the page.
 * - `'unchecked'`: The flat page may be right, but nothing checks how it is bent: it shows too few lines of text, or it
 *   fills the photo, so that its edges are not seen.
 * - `'doubtful'`: The flat page may be wrong: the expected error is above 1.5 % of the page's width, or the page hides
 *   a part of itself.
 * - `'notThisKind'`: The edges cannot belong to a sheet of paper: they are traced wrongly. Or the edges and lines of
 *   text cannot belong to a page that is curled in one direction, the only shape that two edges determine.
 */
export type PageVerdict = 'flat' | 'unrolled' | 'unchecked' | 'doubtful' | 'notThisKind';

/** Warp map of a page by shares of its sides, which holds for any resolution of the photo and of the flat page. */
export interface PageWarp {
  /**
   * Number of nodes of the grid in each row: the first one at the page's left edge, the last one at its right edge.
   */
  columns: number;
  /** Number of rows of the grid, from the page's upper edge to its lower one. */
  rows: number;
  /**
   * Place of each node in the photo, row by row: shares of the photo's width from the left and of its height from the
   * top. It is bilinear in between; NaN where the photo cannot show the node.
   */
  places: Float32Array<ArrayBuffer>;
}

/** A patch: a region of a surface without a crease inside. */
export interface Patch {
  /** Number of vertices that belong to the patch. */
  vertices: number;
  /**
   * Area of the patch on the surface, in the surface's units squared. Each corner of a triangle counts a third of the
   * triangle's area.
   */
  area: number;
}

/**
 * Patches of a surface (regions without a crease inside), that with the largest area first, and the creases between
 * them.
 */
export interface PatchMap {
  /** Number of rows of the lattice. */
  rows: number;
  /** Number of columns of the lattice. */
  cols: number;
  /** Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart. */
  spacing: number;
  /**
   * Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the
   * left by half a `spacing`.
   */
  origin: [number, number];
  /** Number of the patch of each vertex, row by row; −1 where there is none. */
  labels: Int32Array<ArrayBuffer>;
  /** The patches, in the order of their numbers. */
  patches: Patch[];
  /** The creases between the patches. */
  creases: Crease[];
  /** Angle, in radians, above which the bend from one vertex to the next counted as a crease. */
  bend: number;
}

/** A triangle of a sheet on which a part of a texture is printed. */
export interface PrintedTriangle {
  /** Corners of the triangle, in the drawing's millimetres. */
  corners: [[number, number], [number, number], [number, number]];
  /** Texture coordinates of the corners: shares from the texture's left and bottom. */
  uvs: [[number, number], [number, number], [number, number]];
  /** Index of the texture, from 0, in the `textures` of the mesh. */
  texture: number;
}

/** Progress of a running solve: the figures of its last check, in which objective and dual bound are computed. */
export interface Progress {
  /** Number of finer multigrid levels still to come; 0 on the finest one. */
  level: number;
  /** Number of ADMM iterations so far, on all levels. */
  iteration: number;
  /** Number of conjugate-gradient iterations so far, over all z-steps. */
  cgIterations: number;
  /** Objective of the best surface so far; before the first check, that of the initial surface. */
  objective: number;
  /** Best lower bound of the optimal objective so far. */
  dualBound: number;
  /**
   * Relative duality gap `(objective − dualBound) / objective`; `undefined` where the objective is a rounding error.
   */
  gap?: number;
  /** Current penalty parameter ρ of ADMM. */
  rho: number;
  /** Time since the solver was made, in seconds. */
  elapsed: number;
}

/** A height image as read from a file. If the file stores integers and no scale, `heightScale` is a suggestion. */
export interface ReadResult {
  /** Format of the file. */
  format: Format;
  /** Number of pixels in a row. */
  width: number;
  /** Number of rows of pixels. */
  height: number;
  /**
   * Values as stored, plus `offset / heightScale` if the file states an offset: row by row, the top row first; NaN
   * where there is no data.
   */
  data: Float64Array<ArrayBuffer>;
  /**
   * Side length of a pixel. Where the file does not state it, it is 1, or another value if the surface would be far too
   * flat or too steep with 1, which `assumptions` says.
   */
  pixelSize: number;
  /**
   * Unit of `pixelSize`: millimetres for a resolution that a TIFF file states, metres for a map; `null` if it is not
   * known.
   */
  unit: Unit | null;
  /** Factor from values to heights, in the unit of `pixelSize`. */
  heightScale: number;
  /** Type of number that the file stores: `'u8'`, `'u16'`, `'f32'`, `'f64'` and so on. */
  dataType: string;
  /** Whether the values are depths of a camera. */
  depths: DepthEvidence;
  /**
   * Unit that the values have if they are depths of a camera: millimetres for integers and large floats, else metres.
   */
  depthUnit: Unit;
  /** Where the pixels lie on a map; absent unless the file is a GeoTIFF. */
  georeference?: Georeference;
  /** What the reader assumed because the file does not say it. */
  assumptions: Assumption[];
}

/** What a mesh is. */
export interface RecognizedMesh {
  /** Whether a fit gains anything, and how the mesh is laid flat without one. */
  kind: MeshKind;
  /** Thickness of a solid of sheet metal, in the mesh's unit. */
  thickness?: number;
  /** Number of the flat faces of a mesh with noise. */
  faces?: number;
  /** Standard deviation of the vertices from these faces, in the mesh's unit. */
  noise?: number;
}

/** A traced ruling: a nearly straight line in a surface. */
export interface Ruling {
  /** Points along the ruling on the surface: one for each edge that it crosses. */
  points: [number, number, number][];
  /** Distance between the two ends of the ruling, in the surface's units. */
  length: number;
  /**
   * Deviation of the ruling from a straight line: the largest distance of a point from the line through the ends,
   * divided by the ruling's length.
   */
  deviation: number;
}

/** Rulings of a surface: the directions in which it does not bend, and lines along them. */
export interface RulingField {
  /** Number of rows of the lattice. */
  rows: number;
  /** Number of columns of the lattice. */
  cols: number;
  /** Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart. */
  spacing: number;
  /**
   * Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the
   * left by half a `spacing`.
   */
  origin: [number, number];
  /**
   * Unit vector x, y along the ruling at each vertex, seen from above and up to its sign; NaN where there is none.
   */
  directions: Float64Array<ArrayBuffer>;
  /** Confidence in the direction at each vertex, from 0 to 1. */
  confidence: Float64Array<ArrayBuffer>;
  /** Traced rulings. */
  lines: Ruling[];
}

/**
 * A drawing of sheets beside each other, in millimetres: the lower left corner is `0, 0`, `x` goes to the right and `y`
 * up.
 */
export interface SheetDrawing {
  /** Width of the drawing, in millimetres. */
  width: number;
  /** Height of the drawing, in millimetres. */
  height: number;
  /** The drawn sheets, in the order of the pattern's sheets; none overlaps another. */
  sheets: DrawnSheet[];
  /** The printed pages or plates that the sheets lie on, if there are any. */
  pages?: DrawingPages;
  /** Summary of the drawing: numbers of sheets, seams, folds and tabs, and their total lengths. */
  summary: DrawingSummary;
}

/** Flat faces that stand for a surface which is simplified. */
export interface SimplifiedSurface {
  /** Number of the faces. */
  faces: number;
  /**
   * Root mean square distance of the surface's vertices from the faces: in the surface's unit, in drawings in
   * millimetres.
   */
  distance: number;
}

/**
 * Report of a solve: what was solved, how well, and at what cost.
 *
 * Energies are in normalised coordinates, in which the surface's longer side is 1.
 */
export interface SolveReport {
  /** Number of interior vertices, where the Hessian is evaluated: the paper's set `I`. */
  interior: number;
  /**
   * Number of boundary vertices, which are neighbours of interior vertices but not interior: the paper's set `∂I`.
   */
  boundary: number;
  /**
   * Number of omitted vertices, which have heights but neither are nor touch interior vertices: left out of the solve
   * and extrapolated afterwards.
   */
  omitted: number;
  /** Number of vertices where no Hessian was evaluated because of an occlusion. */
  occluded: number;
  /** Number of vertices without data in holes that were bridged: they have heights in the surface. */
  bridged: number;
  /** Number of vertices whose height is a constraint, which the surface meets exactly. */
  constrained: number;
  /** Number of free vertices in the solve, with neither a constraint nor a fidelity term. */
  free: number;
  /** Number of connected components, each of which was solved by itself. */
  components: number;
  /** Number of ADMM iterations on all levels. */
  iterations: number;
  /** Number of conjugate-gradient iterations over all z-steps on all levels. */
  cgIterations: number;
  /** Work on each multigrid level, the coarsest first. */
  levels: LevelReport[];
  /** Energy whose penalty was minimised. */
  energy: Energy;
  /** Number of reweighting passes after the first solve. */
  reweighting: number;
  /** Parameters of the energy `'huber'` and the number of its creases; `undefined` for other energies. */
  huber?: HuberReport;
  /** Objective (fidelity plus penalty) of the returned surface; always finite. */
  objective: number;
  /**
   * Fidelity term `λ Σ (z − z̃)²` of the objective; with the border condition `'loaded'` the work of the border's
   * moments is subtracted.
   */
  fidelity: number;
  /** Penalty term of the objective: `Σ ‖H‖_*`, or the penalty of another energy. */
  nuclearNorm: number;
  /** Certified lower bound of the optimal objective; always finite, and 0 where nothing better is known. */
  dualBound: number;
  /**
   * Relative duality gap `(objective − dualBound) / objective`: the objective exceeds the optimum by at most this share
   * of itself. `undefined` if the solve stopped by `'rounding'`, and where the objective is a rounding error.
   */
  gap?: number;
  /** Weight λ of the fidelity term, as a number. */
  lambda: number;
  /** How λ was chosen; `undefined` unless it was `'auto'`. */
  lambdaChoice?: LambdaChoice;
  /** Penalty parameter ρ of ADMM in the last iteration. */
  rho: number;
  /** Factor from the input's units to normalised coordinates. */
  scale: number;
  /** Reason why the solve stopped. */
  stopReason: StopReason;
  /** Number of threads that the solve ran on. */
  threads: number;
  /** Reason why there were not more threads. */
  threadLimit: ThreadLimit;
  /** Time spent in each phase of the solve, in seconds. */
  seconds: SolveSeconds;
}

/** Time spent in each phase of a solve, in seconds. */
export interface SolveSeconds {
  /** Time for the set-up: domain, normalisation, allocation, in seconds. */
  setup: number;
  /** Time for z-steps, that is for conjugate gradients, in seconds. */
  zStep: number;
  /** Time for the Hessians, their soft threshold and the dual update, in seconds. */
  hStep: number;
  /** Time for objective, dual bound and residuals, in seconds. */
  certificate: number;
  /** Total time in seconds, from the solver's construction to the surface, pauses between calls included. */
  total: number;
}

/**
 * Reason why a solve stopped.
 * - `'gap'`: The certified relative duality gap reached the option `gap`.
 * - `'residuals'`: The residuals fell below the tolerances of the schedule `'paper'`.
 * - `'rounding'`: Objective and dual bound differ by no more than rounding errors: the surface is optimal as far as
 *   double precision can tell. This is the reason for an affine input.
 * - `'maxIterations'`: The number of iterations reached the option `maxIterations` before the duality gap was as small
 *   as asked for.
 * - `'cancelled'`: The progress callback, or `cancel`, asked to stop; in JavaScript the option `signal` with `onAbort:
 *   'keep'`.
 * - `'noNoise'`: A mesh has no noise, or less than a hundredth of the spacing of its vertices, and λ was to suit its
 *   noise: the surface is the mesh as it is.
 * - `'diverged'`: ADMM's iterates diverged, and did so again with more accurate z-steps. The surface is the best one
 *   from before, and its dual bound holds.
 */
export type StopReason = 'gap' | 'residuals' | 'rounding' | 'maxIterations' | 'cancelled' | 'noNoise' | 'diverged';

/** Heights of a surface at the pixels of an image. */
export interface SurfaceImage {
  /** Number of pixels in a row. */
  width: number;
  /** Number of rows of pixels. */
  height: number;
  /** Side length of a pixel, in the surface's unit of length. */
  pixelSize: number;
  /**
   * `width * height` heights at the pixels, row by row, the top row first: in the surface's unit of length, that is the
   * input's steps times its `heightScale`; NaN where there is no surface.
   */
  data: Float64Array<ArrayBuffer>;
}

/**
 * Reason why a solve did not use more threads.
 * - `'options'`: No more were asked for by the option `threads`.
 * - `'cores'`: The process may use no more cores.
 * - `'vertices'`: The surface has too few vertices: each thread gets at least some thousand.
 * - `'build'`: The library was built without a feature for threads, or no other threads were started for it.
 * - `'system'`: The system did not start more threads.
 */
export type ThreadLimit = 'options' | 'cores' | 'vertices' | 'build' | 'system';

/**
 * Unit of the lengths of a file or a surface.
 * - `'mm'`: Millimetre, 10⁻³ m.
 * - `'m'`: Metre, the SI unit of length.
 */
export type Unit = 'mm' | 'm';

/** Figures of an `Unrolling`: iterations, energy, strain and overlaps of the flat layout. */
export interface UnrollReport {
  /** Number of connected components of the surface. Each component is laid flat by itself. */
  parts: number;
  /** Number of iterations made, each of a local and a global step. */
  iterations: number;
  /** Energy of the layout over its area, without unit: the mean of the sum of both squared principal strains. */
  energy: number;
  /** Decrease of the energy over the area in the last iteration of laying the surface flat. */
  change: number;
  /** Area of the surface, in the surface's units squared. */
  area: number;
  /** Strain of the flat layout (relative changes of length): 0 for a developable surface. */
  distortion: Distortion;
  /** Strain of the view from above, taken as a flat layout: a measure of how far from flat the surface is. */
  plan: Distortion;
  /** Number of pairs of border edges of the layout that cross: 0 if the layout does not cover itself. */
  crossings: number;
}

/** A surface laid flat: its triangles, and the positions of their corners in the plane. */
export interface Unrolling {
  /** Number of rows of the lattice. */
  rows: number;
  /** Number of columns of the lattice. */
  cols: number;
  /** Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart. */
  spacing: number;
  /**
   * Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the
   * left by half a `spacing`.
   */
  origin: [number, number];
  /** Row-major index in the lattice of each vertex of the triangles, ascending. */
  vertices: Uint32Array<ArrayBuffer>;
  /** Coordinates x, y, z of each vertex on the surface. */
  positions: Float64Array<ArrayBuffer>;
  /** Three vertices of each triangle, counted from 0, counter-clockwise seen from above. */
  triangles: Uint32Array<ArrayBuffer>;
  /**
   * Coordinates x, y of each vertex in the plane. Each connected component lies as near to its place in the view from
   * above as it can.
   */
  places: Float64Array<ArrayBuffer>;
  /** Number of the connected component of each vertex; 0 is the largest one. */
  parts: Uint32Array<ArrayBuffer>;
  /**
   * The two singular values of each triangle's map to the plane, the larger one first; the smaller one is negative
   * where the triangle is flipped.
   */
  stretches: Float64Array<ArrayBuffer>;
  /** Four vertices for each pair of border edges that cross in the plane: the ends of both edges. */
  overlaps: Uint32Array<ArrayBuffer>;
  /** Whether the flat layout can be trusted. */
  verdict: Verdict;
  /** Report on the layout: iterations, strain and overlaps. */
  report: UnrollReport;
}

/**
 * Verdict on a flat image: whether it can be trusted.
 * - `'flat'`: The page was flat to begin with, and faced the camera: the photo can be used as it is.
 * - `'unrolled'`: The page was bent and is flat now, with lengths as on the page.
 * - `'stretched'`: The surface cannot be laid flat without stretching, or its sheet overlaps itself: some lengths are
 *   wrong.
 * - `'doubtful'`: The flat image hardly shows the page: depths of a part of it are missing, or the crop reaches beyond
 *   the page in the photo.
 */
export type Verdict = 'flat' | 'unrolled' | 'stretched' | 'doubtful';

/**
 * Warp map on a grid over the flat image, bilinear between its nodes. The node in column i of row j is at the pixel `(i
 * * step[0], j * step[1])`, counted from the centre of the upper left one; the last node is at the lower right pixel.
 */
export interface WarpGrid {
  /** Number of nodes in each row of the grid. */
  columns: number;
  /** Number of rows of the grid. */
  rows: number;
  /** Distance between neighbouring nodes to the right and down, in pixels of the flat image. */
  step: [number, number];
  /**
   * Place x, y of each node in the photo, in pixels, row by row; NaN where there is no sheet around the node. Nodes
   * just outside of the sheet have an extrapolated place.
   */
  places: Float32Array<ArrayBuffer>;
  /** Root mean square error of the interpolation over the sheet, in pixels of the photo. */
  rms: number;
  /**
   * Largest error of the interpolation over the sheet, in pixels of the photo. It is above the tolerance where 40000
   * nodes are not enough, as at sharp creases.
   */
  maximum: number;
}

/**
 * Point of the surface where the sum of the angles of the flat pieces around it differs most from the angle of the
 * surface around it; angles in degrees.
 */
export interface WorstAngle {
  /** Position of the point on the surface in space, in the surface's units. */
  place: [number, number, number];
  /**
   * Number, from 0, of the crease that is cut at the point, the lowest of several, if any; its letter is on the
   * drawing.
   */
  crease?: number;
  /** Sum of the angles of the flat pieces that meet at the point, in degrees. */
  flat: number;
  /** Angle of the surface around the point, in degrees: 360° where the surface could be laid flat in one piece. */
  surface: number;
}

/** The joint whose two sides differ most in length on the drawing. */
export interface WorstJoint {
  /** Number of the joint's crease, whose letter is on both sides of it. */
  crease: number;
  /**
   * Numbers, from 0, of the patches on the two sides of the cut crease, in the order of `lengths`; on the drawing they
   * are counted from 1.
   */
  patches: [number, number];
  /** Lengths of the joint's two sides, in millimetres. */
  lengths: [number, number];
}
