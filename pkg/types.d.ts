/// <reference lib="esnext.disposable" />
/** What the direct and the worker API share: inputs, options, results. */
export { DevelopableError, type ErrorCode } from './errors.js';
export * from './option-types.js';

/** Any flat numeric array; values are converted to 64-bit floats. */
export type Numbers =
  | Float64Array | Float32Array
  | Int8Array | Int16Array | Int32Array
  | Uint8Array | Uint8ClampedArray | Uint16Array | Uint32Array
  | readonly number[];

/** A flag for each pixel or vertex: of numbers, those that are neither 0 nor NaN are set. */
export type Flags = Numbers | readonly boolean[];

/** What may be known about an input besides its heights: one value for each pixel or vertex. */
export interface Known {
  /**
   * Factors of the fidelity term: how far each height is to be trusted. 1 is what a height has
   * without it, 0 leaves it free. Finite and not below 0. Of an image they are resampled as its
   * heights are.
   */
  confidence?: Numbers;
  /**
   * Heights that must be met exactly, in the same steps as the heights; NaN and `noData` are no
   * constraint. They count within the outline only, and take the place of the height that is
   * there.
   *
   * Where there are neither `data` nor `heights` this is a *design*: the surface passes through
   * the constraints and is free everywhere else; its outline is the whole image or lattice, or
   * the `mask`. Such a surface needs three constraints that are not on a line.
   *
   * Constraints hold exactly at the vertices of the lattice. Of an image, each pixel with a
   * constraint constrains the vertex nearest to it, and in an area of such pixels all vertices
   * are constrained; heights are bilinear between the pixels around a vertex that have one.
   */
  constraints?: Numbers;
  /**
   * Not 0 where the surface is torn: no Hessian is taken there, so that it may jump or crease at
   * no cost. Of an image, each vertex has its nearest pixel's.
   */
  occlusions?: Flags;
}

/** The unit of all lengths of an input or result: what true sizes take. */
export type Unit = 'mm' | 'm';

/** Heights at the centres of square pixels, row by row, top row first. */
export interface HeightImage extends Known {
  width: number;
  height: number;
  /** `width * height` values. NaN is no data. May be left out if there are `constraints`. */
  data?: Numbers;
  /** One value for each pixel; 0 takes the pixel out. */
  mask?: Flags;
  /** A value that means "no data" (besides NaN). */
  noData?: number;
  /** Side length of a pixel, in the unit of the result. Default 1. */
  pixelSize?: number;
  /** Height of one step of `data` and `constraints`, in the same unit. Default 1. */
  heightScale?: number;
  /** That unit, where it is known; flat images and files have their true size by it. */
  unit?: Unit | null;
  /** Where the pixels lie on a map, as `read` gives it of a GeoTIFF; `writeTiff` writes it. */
  georeference?: Georeference;
}

/** Where the pixels of an image lie on a map: it is read from a GeoTIFF, and written to one. */
export interface Georeference {
  /**
   * Affine transformation `[a, b, c, d, e, f]` from the column `i` and the row `j` of a pixel's upper left corner to map
   * coordinates: `x = a i + b j + c`, `y = d i + e j + f`, in the unit of the coordinate system.
   */
  transformation: number[];
  /** Numbers of the tag GeoKeyDirectory, which names the coordinate system. */
  keys: number[];
  /** Numbers of the tag GeoDoubleParams. */
  doubles: number[];
  /** Text of the tag GeoAsciiParams. */
  text: string;
}

/** Heights at the vertices of a hexagonal lattice: row 0 at the top, odd rows half a spacing to the left. */
export interface Heightfield extends Known {
  rows: number;
  cols: number;
  /** Distance between neighbours, in the unit of the heights. */
  spacing: number;
  /** `rows * cols` heights, row by row. NaN is no data. May be left out if there are `constraints`. */
  heights?: Numbers;
  /** Position `[x, y]` of vertex (0, 0), `y` up. Default `[0, 0]`. */
  origin?: readonly [number, number];
  /** One value for each vertex; 0 takes the vertex out. */
  mask?: Flags;
  /** A value that means "no data" (besides NaN). */
  noData?: number;
  /**
   * Edges of the lattice across which the surface is torn, six bits for each vertex: bit 0 for
   * the edge to the west, then east, north-west, north-east, south-west, south-east. No Hessian
   * is taken at either end.
   */
  brokenEdges?: Uint8Array;
  /** The unit of all lengths, where it is known. */
  unit?: Unit | null;
  /** The axes of these coordinates in space, which a written mesh is turned back to. Default: x, y and z. */
  frame?: Frame;
  /** The camera that has seen the depths, which a photo from the same place is laid on by. */
  camera?: PhotoCamera;
  /** Red, green, blue of each vertex, from 0 to 1, for written meshes. */
  colors?: Float32Array;
  /** Texture coordinates of each vertex, from the left and from the bottom of the picture, likewise. */
  uvs?: Float32Array;
  /** A PNG or JPEG file that they are about, for GLB. */
  texture?: Uint8Array;
}

/**
 * Axes of a view in those of the mesh, orthonormal and right-handed: a point p of the mesh is at
 * [p·right, p·up, p·towards].
 */
export interface Frame {
  right: readonly [number, number, number];
  up: readonly [number, number, number];
  /** Towards the viewer: the axis of the heights. */
  towards: readonly [number, number, number];
}

/**
 * Something that a reader assumed because the file does not say it. The command and the page show each of them.
 */
export interface Assumption {
  /** The kind of the assumption, such as `'noData'`: stable, for programs. */
  code: string;
  /** One sentence without a full stop that follows the word "assumed", such as `'-9999 is no data (412 pixels)'`. */
  words: string;
  /** Name of the option that decides it instead, such as `'noData'`; absent where there is none. */
  option?: string;
}

/** Triangles in space, or points alone. */
export interface Mesh {
  /** x, y, z of each vertex. */
  positions: Float64Array;
  /** Three vertices of each triangle, counted from 0; none for a point cloud. */
  triangles: Uint32Array;
  /** Red, green, blue of each vertex, from 0 to 1. */
  colors?: Float32Array;
  /** Texture coordinates of each vertex, from the left and from the bottom of the picture. */
  uvs?: Float32Array;
  /** Pictures that they are about, each a PNG, JPEG or WebP file or its pixels. */
  textures?: Picture[];
  /** The number of each triangle's texture, -1 for none. Without it all have the first one. */
  textureOf?: Int32Array;
  /** Names of materials and textures that a file names and that were not given with it. */
  missing?: string[];
  /** What the reader assumed because the file does not say it; absent where it assumed nothing. */
  assumptions?: Assumption[];
  /** The camera that has seen it, if it is what one has. */
  camera?: PhotoCamera;
  /** The unit of all lengths, where it is known: what the file says, else what its size suggests, by the `assumptions`. */
  unit?: Unit | null;
  /** How far each vertex is to be trusted, from 0 to 1. */
  confidence?: Float32Array;
}

/** What was mended of a mesh before a fit; the result has its vertices and triangles all the same. */
export interface MeshRepairs {
  /** Vertices at the place of another one, which move with it. */
  joined: number;
  /** Triangles with two corners at one place. */
  degenerate: number;
  /** Triangles that are there twice. */
  repeated: number;
  /** Triangles that faced the other side than those around them. */
  turned: number;
  /** Vertices of no triangle, which stay where they are. */
  unused: number;
}

/** One linearisation of a fit over a mesh, and the convex problem about it. */
export interface MeshPass {
  iterations: number;
  cgIterations: number;
  /** Energy of the best iterate, in the linearised problem. */
  objective: number;
  /** Certified lower bound of that problem's optimum. */
  dualBound: number;
  gap?: number;
  stopReason: StopReason;
  /** Vertices on creases, where bends cost less in this pass. */
  creases: number;
  /** How far vertices went in it: root mean square, and at most, in the input's units. */
  moved: number;
  movedMost: number;
}

/** What was solved over a mesh, how well and at what cost. */
export interface MeshReport {
  /** Vertices of the solve: those of the input, but at most one at each place. */
  vertices: number;
  /** Those with triangles all around, where the surface bends. */
  interior: number;
  /** Those on the border, put where the surface inside goes on to. */
  border: number;
  /** Those where parts of the surface touch in a point. */
  pinched: number;
  components: number;
  repairs: MeshRepairs;
  /** From one vertex to the next, on a hexagonal lattice with as many: in the input's units. */
  spacing: number;
  /** Factor from the input's units to normalised coordinates. */
  scale: number;
  /** Standard deviation of the noise along the normals, in the input's units. */
  sigma?: number;
  /** λ as a number. */
  lambda: number;
  /**
   * The linearisations, in order. A gap is a certificate for that linearised problem's best iterate alone: the energy
   * itself is not convex, and nothing is certified of it.
   */
  passes: MeshPass[];
  /** What the surface encloses before and after; nothing for open ones. */
  volume?: [number, number];
  /** Its area before and after. */
  area: [number, number];
  /** Triangles that face away from the surface around them, before and after. */
  flipped: [number, number];
  /**
   * Triangles of the result that are folded over or cross others near them: their index in the mesh, and their middle.
   * Their vertices cannot be parted within five standard deviations of the noise.
   */
  entangled: { triangle: number; position: [number, number, number] }[];
  stopReason: StopReason;
  seconds: Report['seconds'];
}

/** A mesh whose vertices were moved; all else is the input's. */
export interface MeshSurface extends Mesh {
  report: MeshReport;
}

/** A pinhole camera, in pixels: the centre of the top left one is (0, 0), rows count down. */
export interface Intrinsics {
  /** Focal length in columns. */
  fx: number;
  /** Focal length in rows. */
  fy: number;
  /** Column of the axis. */
  cx: number;
  /** Row of the axis. */
  cy: number;
  /** Length of one step of the depths; 0.001 makes metres of millimetres. Default 1. */
  depthScale?: number;
  /** The unit of these lengths, where it is known: flat images and files have their true size by it. */
  unit?: Unit;
  /** `'planar'`: distance along the axis, as most cameras give it; `'ray'`: from the camera itself. Default `'planar'`. */
  depth?: 'planar' | 'ray';
  /** Width of the images that these numbers are for, which others of the same proportions are finer or coarser than. */
  width?: number;
  /** Their height. Default for both: the image that they are used with. */
  height?: number;
  /** Distortion by the lens, with OpenCV's coefficients: radial k1, k2, k3, tangential p1, p2. Default 0. */
  k1?: number;
  k2?: number;
  p1?: number;
  p2?: number;
  k3?: number;
  /** Pixels of depths that are taken away on both sides of a jump, where sensors see mixtures of both. Default 2. */
  margin?: number;
}

/** The camera of a photo, and where it is beside that of the depths. */
export interface PhotoCamera extends Omit<Intrinsics, 'unit'> {
  /**
   * Rows of a rotation matrix R: a point p of the depths' camera is at R p + t for this one, x to the right, y down,
   * z ahead, as OpenCV has it. Default: none.
   */
  rotation?: readonly (readonly [number, number, number])[];
  /** The t of that, in the unit of the lengths. Default [0, 0, 0]. */
  translation?: readonly [number, number, number];
}

/** Values at the pixels of an image. */
export interface Pixels {
  width: number;
  height: number;
  data: Numbers;
}

/** A direction to look in: `'-z'` looks down the z axis, so that what has the largest z is in front. */
export type ViewName = '-x' | '+x' | '-y' | '+y' | '-z' | '+z' | 'best-fit';

/**
 * What is seen of a mesh: the first hit of a ray through each vertex of a lattice, NaN where there is none.
 *
 * Of a point cloud a vertex sees the points within one spacing of it, but for those more than three
 * spacings behind the foremost. Its height is that of the plane that fits them best, near ones more
 * than others; its colour the nearest one's. Where they all lie to one side there is a hole.
 */
export interface SampledMesh extends Heightfield {
  origin: [number, number];
  heights: Float64Array;
  frame: Frame;
  /**
   * Colours where the mesh was hit, three for each vertex; NaN elsewhere. Of triangles with a texture
   * they are the texture's, of others the mesh's own.
   */
  colors?: Float32Array;
  /** Its texture coordinates likewise, two for each vertex. */
  uvs?: Float32Array;
  /** How far each height is to be trusted, if that is known of the mesh. */
  confidence?: Float32Array;
  /** Its texture, where all that is seen has the same one and that is a PNG or JPEG file. */
  texture?: Uint8Array;
  /** The share of the mesh's area that lies behind these heights, where it is at least a tenth. */
  hidden?: number;
}

/**
 * What is minimised besides the fidelity term, over the vertices' Hessians H:
 * - `'nuclear'`: the sum of their nuclear norms; piecewise developable, as in the paper;
 * - `'frobenius'`, `'squaredNuclear'`: of their Frobenius norms, or squared nuclear norms, which
 *   are smooth where a developable surface creases (the paper's Fig. 21, for comparison);
 * - `'secondFormOfInput'`: of the nuclear norms of the second fundamental form, with the slopes
 *   of the input;
 * - `'secondForm'`: the same with the surface's own slopes, which is not convex: what is certified
 *   is the energy with the last slopes kept;
 * - `'huber'`: of a function of their nuclear norms that grows with the square of small ones, and with
 *   the size of large ones: smooth where the surface bends smoothly, without the flat strips that
 *   `'nuclear'` makes of it. What bends more tightly than `creaseRadius` then costs less in up to
 *   `creasePasses` further solves; what is certified is the last one's energy.
 */
export type Energy = 'nuclear' | 'frobenius' | 'squaredNuclear' | 'secondFormOfInput' | 'secondForm' | 'huber';

/**
 * Occlusions that were found in heights. On the lattice they can be given back as they are:
 * `vertices` as `occlusions`, `edges` as `brokenEdges`.
 */
export interface DetectedOcclusions {
  rows: number;
  cols: number;
  spacing: number;
  origin: [number, number];
  /** 1 for each vertex where no Hessian would be taken, 0 for the others, row by row. */
  vertices: Uint8Array;
  /** Broken edges, six bits for each vertex as in `Heightfield.brokenEdges`. */
  edges: Uint8Array;
  /** Number of vertices that are 1. */
  count: number;
  /** For an image input: 1 at the pixels with data whose nearest vertex is 1. */
  image?: Uint8Array;
}

export type StopReason = 'gap' | 'residuals' | 'rounding' | 'maxIterations' | 'cancelled' | 'diverged';

export interface Progress {
  /** How many finer lattices are still to come; 0 on the finest, whose figures alone are certified. */
  level: number;
  /** ADMM iterations so far. */
  iteration: number;
  /** Conjugate-gradient iterations so far, over all z-steps. */
  cgIterations: number;
  /** Objective of the best iterate so far; that of the input before the first check. */
  objective: number;
  /** Best certified lower bound of the optimum so far. */
  dualBound: number;
  /** `(objective - dualBound) / objective`; `undefined` where the objective is a rounding error. */
  gap?: number;
  /** ADMM penalty. */
  rho: number;
  /** Seconds since the solver was made or restarted. */
  elapsed: number;
}

/** The work on one lattice of the coarse-to-fine sequence. */
export interface LevelReport {
  /** Lattice spacing in normalised coordinates. */
  spacing: number;
  /** Interior vertices. */
  interior: number;
  iterations: number;
  cgIterations: number;
}

/** The numbers of the energy `'huber'` as they were used. */
export interface HuberReport {
  bendRadius: number;
  flatness: number;
  creaseRadius: number;
  /** Passes at creases that were made after the first solve. */
  creasePasses: number;
  /** Interior vertices that are on a crease: those where the last pass weighs bends less. */
  creases: number;
}

/** What `lambda: 'auto'` has found out. */
export interface LambdaChoice {
  /**
   * Where lambda comes from:
   * - `'prediction'`: it follows from the noise, and the parameters of the energy are those that predict held-out heights
   *   best;
   * - `'noise'`: it follows from the size and the correlation length of the noise alone: the energy has no parameters,
   *   there are too few heights to hold some out, or their noise is alike from one to the next, so that it would predict
   *   itself;
   * - `'noNoise'`: the heights have no noise to speak of, and lambda is `'big'`;
   * - `'unknown'`: there are too few heights to tell their noise, and lambda is `'medium'`.
   */
  reason: 'prediction' | 'noise' | 'noNoise' | 'unknown';
  /** Standard deviation of the heights' noise, in the input's units; `undefined` if it cannot be told. */
  sigma?: number;
  /** The step of quantised heights, where that is what their noise comes from. */
  step?: number;
  /**
   * Standard deviation of the Gaussian blur that makes noise like that of the heights of white noise, in the input's
   * units; 0 for noise that is independent from vertex to vertex.
   */
  correlationLength: number;
  /**
   * Whether the noise is correlated over distances at which the shape bends, so that noise and shape could not be told apart:
   * sigma and lambda are uncertain.
   */
  ambiguous: boolean;
  /** Noise is independent from vertex to vertex on the lattice of `2 ** merged` times the spacing. */
  merged: number;
  /**
   * Root mean square of the residual, in standard deviations of the noise and without outliers: about 1 where lambda suits
   * the shape. Far above, the surface is farther from the heights than their noise explains.
   */
  residualRatio?: number;
  /**
   * Whether the residual is larger than the noise explains although lambda was raised, so that the surface has lost a part
   * of the shape: take a larger lambda.
   */
  residualExceedsNoise: boolean;
  /** How often lambda was raised above the one of the noise, since the residual showed that one to be too small. */
  raises: number;
  /** Number of solves before the last one: for each penalty that was compared, and before each raise of lambda. */
  solves: number;
  /** Their ADMM iterations, which the report's own do not count. */
  iterations: number;
}

export interface Report {
  /** Vertices where the Hessian is evaluated. */
  interior: number;
  /** Valid vertices touched by a stencil without being interior. */
  boundary: number;
  /**
   * Valid vertices that no stencil touches, as at corners: left out of the solve, and extrapolated from the surface
   * beside them afterwards. On rough input they can stick out.
   */
  omitted: number;
  /** Vertices where no Hessian was taken because of an occlusion. */
  occluded: number;
  /** Vertices without data whose hole was bridged. */
  bridged: number;
  /** Vertices whose height was given for good. */
  constrained: number;
  /** Vertices of the solve with neither a constraint nor a fidelity term of their own. */
  free: number;
  /** Connected parts, each of which was solved for itself. */
  components: number;
  /** ADMM iterations. */
  iterations: number;
  /** Conjugate-gradient iterations over all z-steps. */
  cgIterations: number;
  /** The lattices that were worked on, the coarsest first. */
  levels: LevelReport[];
  /** What was minimised besides the fidelity term. */
  energy: Energy;
  /** Reweighted passes that were made after the first solve; the figures are the last one's. */
  reweighting: number;
  /** For the energy `'huber'`: what bends cost, whether given or chosen, and where creases are. */
  huber?: HuberReport;
  /** Value of the energy at the returned surface, in normalised coordinates; always finite. */
  objective: number;
  /** `lambda * sum (z - input)^2`, with the confidences as factors. */
  fidelity: number;
  /** `sum of nuclear norms of the Hessians`, or what `energy` has in its place. */
  nuclearNorm: number;
  /** Certified lower bound of the optimum; always finite, and 0 where nothing better is known. */
  dualBound: number;
  /**
   * `(objective - dualBound) / objective`: how far from the optimum the result can be at most. `undefined` for
   * `'rounding'`, and where the objective is no more than a rounding error: then a share of it says nothing.
   */
  gap?: number;
  /** Number of threads that the solve ran on. */
  threads: number;
  /**
   * Why there were not more: no more were asked for (`'options'`), the surface has too few vertices, the wasm for several
   * threads is not there or none were asked for (`'build'`), the page is not cross-origin isolated, the system started no more,
   * or the process has no more cores.
   */
  threadLimit: 'options' | 'vertices' | 'build' | 'isolation' | 'system' | 'cores';
  /** Lambda that was used, as a number. */
  lambda: number;
  /** How that came about, for `lambda: 'auto'`. */
  lambdaChoice?: LambdaChoice;
  /** Last ADMM penalty. */
  rho: number;
  /** Factor from the input's units to normalised coordinates. */
  scale: number;
  stopReason: StopReason;
  seconds: { setup: number; zStep: number; hStep: number; certificate: number; total: number };
}

/** How near heights are to a cylinder. */
export interface CylinderReport {
  /**
   * Whether they are those of one: what it leaves of them goes on along the rulings no more than noise does (`'cylinder'`),
   * or it does, or there are too few to tell: take another surface (`'other'`).
   */
  verdict: 'cylinder' | 'other';
  /** The direction of the rulings: a unit vector in the axes of the heights. */
  rulings: [number, number, number];
  /** Root of the mean square of what it leaves of the heights, in their unit. */
  residual: number;
  /** How much of what it leaves goes on along the rulings: about 1 for a cylinder and noise, and below 1.95; NaN where there is too little to tell. */
  excess: number;
  /** Heights that it was fitted to. */
  vertices: number;
}

/** A cylinder: a surface as `fit` gives it, with another report. */
export interface FittedCylinder extends Omit<LatticeSurface, 'report'> {
  report: CylinderReport;
}

/** The solved surface. Every array is a copy that belongs to the caller. */
export interface Surface {
  rows: number;
  cols: number;
  spacing: number;
  origin: [number, number];
  /** Heights on the lattice, row by row; NaN where the input had no data. */
  heights: Float64Array;
  /**
   * For an image input: the surface at the input's pixels, NaN where the input had no data. Of a
   * design, at all pixels within its outline; where there are constraints, too, it is resampled
   * from the vertices, which are what meets them exactly.
   */
  image?: SurfaceImage;
  /** The unit of all lengths, where it was known of the input. */
  unit?: Unit;
  /** The input's. */
  frame?: Frame;
  /** The input's. */
  camera?: PhotoCamera;
  /** The input's. */
  colors?: Float32Array;
  /** The input's. */
  uvs?: Float32Array;
  /** The input's. */
  texture?: Uint8Array;
  report: Report;
}

/** A surface at the pixels of its input. */
export interface SurfaceImage {
  width: number;
  height: number;
  pixelSize: number;
  data: Float64Array;
}

/** The surface of an image. */
export interface ImageSurface extends Surface {
  image: SurfaceImage;
}

/** The surface of heights on the lattice. */
export interface LatticeSurface extends Surface {
  image?: never;
}

/** The surface of an input of one kind or the other. */
export type SurfaceOf<I extends HeightImage | Heightfield> = I extends HeightImage ? ImageSurface : LatticeSurface;

export type ExampleName = 'cylinder' | 'cone' | 'roof' | 'oloid' | 'page' | 'house';

export interface Example {
  /** The noisy height image. */
  input: HeightImage & { data: Float64Array };
  /** The surface without noise, at the same pixels. */
  truth: Float64Array;
}

/** The line between two patches. */
export interface Crease {
  /** The patches on either side. */
  patches: [number, number];
  /** Its course; closed if the last point is the first. */
  points: [number, number, number][];
  length: number;
  /** The angle between the normals beside it, in radians, on average. */
  fold: number;
}

/** The smooth patches of a surface, that with the largest area first, and the creases between them. */
export interface PatchMap {
  rows: number;
  cols: number;
  spacing: number;
  origin: [number, number];
  /** The patch of each vertex, row by row; -1 where there is none. */
  labels: Int32Array;
  patches: { vertices: number; area: number }[];
  creases: Crease[];
  /** The angle that counted as a crease from one vertex to the next. */
  bend: number;
}

/** An `HTMLCanvasElement` or an `OffscreenCanvas`, with a 2d context or none yet. */
export interface Canvas {
  width: number;
  height: number;
  getContext(kind: '2d'): object | null;
}

/** RGBA bytes, transparent where there is no surface: an `ImageData`, or the same as a plain object in Node. */
export type SurfacePicture = DecodedPhoto &
  (typeof globalThis extends { ImageData: { prototype: infer I } } ? I : unknown);

/** A ruling that was traced. */
export interface Ruling {
  points: [number, number, number][];
  /** The distance between its ends. */
  length: number;
  /** How far it is from straight, as a share of its length. */
  deviation: number;
}

/** The directions in which a surface does not bend, and lines along them. */
export interface RulingField {
  rows: number;
  cols: number;
  spacing: number;
  origin: [number, number];
  /** Unit vectors x, y as seen from above, for each vertex; NaN where there are none. */
  directions: Float64Array;
  /** How far each is to be trusted, from 0 to 1. */
  confidence: Float64Array;
  lines: Ruling[];
}

/** The same of a mesh as it is. */
export interface MeshRulings {
  /** x, y, z of a unit vector for each vertex, up to its sign; NaN where triangles do not go all around one. */
  directions: Float64Array<ArrayBuffer>;
  /** How far each is to be trusted, from 0 to 1. */
  confidence: Float64Array<ArrayBuffer>;
  /** Each has a point on every edge that it crosses. */
  lines: Ruling[];
}

/** RGBA bytes of an image, row by row, top row first: an `ImageData` is one. */
export interface Photo {
  width: number;
  height: number;
  /** `4 * width * height` bytes. */
  data: Uint8ClampedArray | Uint8Array;
}

/** What of a web page a canvas can draw: an `<img>` that is loaded, a canvas, an `ImageBitmap`, a `<video>` or a `VideoFrame`. */
export type Drawable = Canvas
  | { readonly naturalWidth: number; readonly naturalHeight: number }
  | { readonly videoWidth: number; readonly videoHeight: number }
  | { readonly displayWidth: number; readonly displayHeight: number }
  | { readonly width: number; readonly height: number; close(): void };

/**
 * A photo's file: its bytes, a `Blob` or `File`, a `Response`, or its address. JPEG, PNG, WebP, GIF (the first picture), BMP and
 * TIFF files are read; HEIC and AVIF files where the browser can show them, as `await createImageBitmap(file)`.
 */
export type PhotoSource = Uint8Array | ArrayBuffer | Blob | Response | URL | string;

/** Four corners of a page in a photo's pixels: upper left, upper right, lower right, lower left, as the page is read. */
export type PageCorners = readonly [
  readonly [number, number], readonly [number, number], readonly [number, number], readonly [number, number],
];

/** A photo's file as bytes, or its pixels. */
export type Picture = Uint8Array | ArrayBuffer | Photo;

/** A photo that may say how large what it shows is, as flat images do. */
export interface SizedPhoto extends Photo {
  /** Pixels per unit of length. */
  resolution?: number;
  /** That unit; of others, such as widths of a page, no size follows. */
  unit?: Unit | 'page';
}

/** One page of a PDF. */
export interface BookPage {
  /** A JPEG or PNG file without transparency, as `writePhoto` writes them. */
  picture: Uint8Array | ArrayBuffer;
  /** Width and height of the page, in millimetres. */
  size: readonly [number, number];
}

/** A surface in the colours of a picture. */
export type Painted<F> = F & { uvs: Float32Array; colors: Float32Array; texture?: Uint8Array };

export interface DecodedPhoto extends Photo {
  data: Uint8ClampedArray<ArrayBuffer>;
  /**
   * Of a file whose Exif data say that it is stored as the sensor lay: by what, from 2 to 8, it was turned (6: by 90
   * degrees clockwise, 3: by 180, 8: by 270).
   */
  orientation?: number;
  /**
   * The camera's focal length, in millimetres as for a film of 36 by 24 mm, where the file's Exif data
   * tell it and the photo was not cropped.
   */
  film35?: number;
  /** What the reader assumed because the file does not say it. */
  assumptions: Assumption[];
}

/** Curvatures at the vertices of a mesh, NaN where triangles do not go all around one; above 0 where it bends as a ball. */
export interface MeshAnalysis {
  /** Discrete Gaussian curvature: angle deficit over lumped area. */
  gaussian: Float64Array<ArrayBuffer>;
  /** Eigenvalue of larger magnitude of the second fundamental form. */
  kappa1: Float64Array<ArrayBuffer>;
  /** That of smaller magnitude. */
  kappa2: Float64Array<ArrayBuffer>;
  /** `|kappa1| + |kappa2|`: the energy's density. */
  nuclearNorm: Float64Array<ArrayBuffer>;
  /**
   * x, y, z of the unit vector along which it bends by `kappa2`: that of the ruling, up to its sign.
   * `meshRulings` has them averaged with those around, and how far they are to be trusted.
   */
  rulings: Float64Array<ArrayBuffer>;
  /** `size` is the diameter of the ball about the mesh; the sum of nuclear norms is by area. */
  summary: AnalysisSummary;
}

/** How often magnitudes occur, in bins of half a decade. */
export interface Histogram {
  /** Where bins end, ascending. */
  edges: number[];
  /** Number of vertices in each bin: one bin more than edges, the first below all, the last above. */
  counts: number[];
}

/** A row of the paper's Table 1, in coordinates scaled to the unit square. */
export interface AnalysisSummary {
  /** Vertices that have curvatures. Where none has any, as in a single triangle, all figures of curvatures are 0. */
  vertices: number;
  /** The longer side of the surface seen from above, in its own units. */
  size: number;
  threshold: number;
  /** Share of the vertices with |K| above the threshold, from 0 to 1. */
  gaussianAbove: number;
  /** Median of |K|. */
  medianGaussian: number;
  /** Median of |kappa2|. */
  medianKappa2: number;
  /** Sum of the nuclear norms: the energy without its fidelity term. */
  nuclearNorm: number;
  gaussian: Histogram;
  kappa2: Histogram;
}

/** Curvatures at the vertices of the lattice, row by row, in units of the surface; NaN where there are none. */
export interface Analysis {
  rows: number;
  cols: number;
  spacing: number;
  origin: [number, number];
  /** Discrete Gaussian curvature: angle deficit over lumped area. */
  gaussian: Float64Array;
  /** Eigenvalue of larger magnitude of the Hessian. */
  kappa1: Float64Array;
  /** That of smaller magnitude. */
  kappa2: Float64Array;
  /** `|kappa1| + |kappa2|`: the energy's density. */
  nuclearNorm: Float64Array;
  summary: AnalysisSummary;
  /** Of the surface from the reference, in its units. */
  deviation?: { vertices: number; rms: number; maximum: number };
}

/** Lengths on a flat layout against those on the surface: strains, as shares. */
export interface Distortion {
  /** Root of the mean square. */
  rms: number;
  /** Of any triangle. */
  maximum: number;
  /** Share of the area where it exceeds 0.01. */
  above: number;
  /** Area of the layout over that of the surface. */
  area: number;
  /** Number of triangles that lie upside down. */
  flipped: number;
}

export interface UnrollReport {
  /** Connected parts of the surface. */
  parts: number;
  iterations: number;
  /** Mean of the squared strains, and how much the last iteration changed it. */
  energy: number;
  change: number;
  /** Area of the surface, in its units. */
  area: number;
  distortion: Distortion;
  /** That of the view from above: how far from flat the surface was to begin with. */
  plan: Distortion;
  /** Pairs of edges on the border of the layout that cross: 0 where it does not overlap. */
  crossings: number;
}

/**
 * Whether a flat layout is to be trusted: the surface was flat to begin with, and faced the viewer
 * (`'flat'`); it was bent, and lengths are right (`'unrolled'`); or it cannot be laid flat without a root mean square strain above 1 %,
 * more than 3 % of its area being strained by more than 1 %, or more than 0.3 % of it overlapping (`'stretched'`). A flat image is `'doubtful'` where what was cropped is
 * hardly the page: more than 5 % of it are missing, or the crop reaches beyond the page that the photo shows.
 */
export type Verdict = 'flat' | 'unrolled' | 'stretched' | 'doubtful';

/** A surface laid flat: its triangles, and where their corners lie on the plane. */
export interface Unrolling {
  rows: number;
  cols: number;
  spacing: number;
  origin: [number, number];
  /** Row-major index in the lattice of each vertex, ascending. */
  vertices: Uint32Array;
  /** x, y, z of each vertex. */
  positions: Float64Array;
  /** Three vertices of each triangle, counter-clockwise from above, counted from 0. */
  triangles: Uint32Array;
  /** x, y of each vertex on the plane: each part upright, where it is seen from above. */
  places: Float64Array;
  /** The connected part of each vertex; 0 is the largest. */
  parts: Uint32Array;
  /** Singular values of each triangle's map to the plane, the larger one first; below 0 where it is flipped. */
  stretches: Float64Array;
  /** Four vertices for each pair of border edges that cross. */
  overlaps: Uint32Array;
  verdict: Verdict;
  report: UnrollReport;
}

/**
 * What a pattern is made from, in millimetres: paper, of whose edges a printer leaves ten millimetres blank, plates
 * or sheets of a width and a height, or a roll of a width, five millimetres of whose edges stay free.
 */
export type Stock = 'a4' | 'letter' | readonly [width: number, height: number] | readonly [width: number];

/**
 * A mesh as it is laid flat: in sheets, one to the right of the other, as they are seen from the side that its triangles
 * face. They have more vertices than the mesh, where they were cut.
 */
export interface MeshUnrolling {
  /** x, y, z of each vertex of the sheets, where it is on the mesh. */
  positions: Float64Array<ArrayBuffer>;
  /** x, y of the same vertices, flat. */
  places: Float64Array<ArrayBuffer>;
  /** Three vertices of each triangle, counter-clockwise. */
  triangles: Uint32Array<ArrayBuffer>;
  /** The sheet of each vertex, from 0. */
  sheets: Uint32Array<ArrayBuffer>;
  /** The patch of each triangle of the mesh that was given, -1 for none. */
  labels: Int32Array<ArrayBuffer>;
  /** The patches of the mesh, that with the largest area first. */
  patches: { vertices: number; area: number }[];
  /** The creases between them. */
  creases: Crease[];
  /** `strain` (root of the mean square) and `seamGap` (between the sides of folds) are those of the worst sheet. */
  report: { sheets: number; area: number; strain: number; seamGap: number };
}

/** A line to fold along. */
export interface FoldLine {
  /** The crease, by its place in what `patches` gives with the same options, if there are no slits. */
  crease: number;
  /** Which way, seen from above: a mountain is a ridge. */
  direction: 'mountain' | 'valley';
  /** By how much, in degrees: 0 is flat. */
  angle: number;
  length: number;
  /** Within 0.02 mm of the curve. */
  points: [number, number][];
  curve: BezierChain;
}

/**
 * Straight pieces and cubic Bézier curves that follow each other, as control points: 4 of them, 7, 10 and so on. The
 * control points of a straight piece lie at its thirds.
 */
export type BezierChain = [number, number][];

/** A text on a sheet. */
export interface DrawingLabel {
  /** The number of a patch (from 1), the letter of a cut crease, a fold's direction and angle, a sheet's name. */
  kind: 'patch' | 'seam' | 'fold' | 'sheet';
  text: string;
  /** Its middle. */
  place: [number, number];
  /** Size of the font. */
  size: number;
  /** Degrees counter-clockwise. */
  turn: number;
}

/** A sheet to be cut out, as it is seen from above, from where the heights point. */
export interface DrawnSheet {
  /** `'Sheet 1'` and so on. */
  name: string;
  /** Its patches, counted from 0; where there are slits, the parts that patches were cut into. */
  patches: number[];
  /** Lower left and upper right corner. */
  bounds: [[number, number], [number, number]];
  /** Closed lines to cut, around tabs, too; the last point is joined to the first. Within 0.02 mm of the curves. */
  cuts: [number, number][][];
  /** The same lines as curves, which end where they begin. */
  curves: BezierChain[];
  folds: FoldLine[];
  /** Where tabs are folded. */
  tabs: FoldLine[];
  /** The edges of the surface, where there is an allowance around them: closed. */
  edges: BezierChain[];
  /** Short lines along seams, which lie on each other when these are joined. */
  marks: BezierChain[];
  /** From places that are too small to write on to what is written beside the sheet. */
  leaders: BezierChain[];
  labels: DrawingLabel[];
}

/**
 * A pattern as it is drawn, all in millimetres, x to the right and y up from the lower left corner.
 *
 * Sheets end where the continuations of their patches meet; cut creases have the same letter on
 * both sides.
 */
export interface Drawing {
  width: number;
  height: number;
  /** Those with the largest patches first; none lies on another. */
  sheets: DrawnSheet[];
  /** How they are put together, where that is wanted. */
  assembly?: Assembly;
  /** The pages that they lie on, all of one size, where a `stock` is given. */
  pages?: DrawingPages;
  summary: {
    sheets: number;
    /** Creases that are cut, those that are folds, and tabs. */
    seams: number;
    folds: number;
    tabs: number;
    /** Seams that are cut and have a tab on neither side, for want of room; 0 if no tabs are wanted. */
    untabbed: number;
    /** Cuts through what was one patch, because it cannot be laid flat in one piece. */
    slits: number;
    /** Length of the creases that are cut, and of the slits, each line counted once. */
    seamLength: number;
    slitLength: number;
    /**
     * The most that both sides of one of these differ in length, as a share of it. Lines shorter than a tenth of the side
     * of a square as large as all sheets do not count, nor do steps, whose sides are not joined.
     */
    mismatch: number;
    /** Which one that is, by the crease, whose letter is on both sides: its patches, and how long it is on either. */
    worstJoint?: { crease: number; patches: [number, number]; lengths: [number, number] };
    /**
     * At how many points inside of the surface, where cuts or folds end, the angles of the pieces around were compared with
     * that of the surface, within the shortest of these lines or twenty cells.
     */
    points: number;
    /**
     * Where they differ most, in degrees: 360 on the surface is what lies flat in one piece. `place` is on the surface, in
     * its units, `crease` one that is cut there.
     */
    worstAngle?: { place: [number, number, number]; crease?: number; flat: number; surface: number };
    cutLength: number;
    mountainLength: number;
    valleyLength: number;
    /** In square millimetres, without tabs. */
    area: number;
    /** The largest strain of a sheet, as a share (root of the mean square). */
    strain: number;
    /** Largest seam gap of a fold, in millimetres: distance between its two sides (root of the mean square). */
    seamGap: number;
    /** Small loops in which outlines crossed themselves, and which were cut off. */
    loops: number;
    /** How far sheets that were folded back are from the surface at most (root of the mean square), with `refold`. */
    refolding?: number;
    /** What of the surface is on no sheet; areas in square millimetres. */
    missing?: {
      /** Left out because nothing around them lies flat with them: ragged steep borders and torn points of them, mostly; a fiftieth of all at most. */
      vertices: number;
      area: number;
      /** Steps of the surface, whose sides are cut apart: what would stand between them is not there. */
      steps: number;
      /** About how large that would be. */
      stepArea: number;
    };
    /** Pages of paper that it takes. */
    a4: number;
    letter: number;
  };
}

/** How sheets are put together. */
export interface Assembly {
  /**
   * Sheet by sheet, first that with the largest patch, then the one with the longest seams to those that are there;
   * `sheet` counts from 0. The joints are closed when it is there, to sheets before it or of its own edges; `name` is
   * their letters on the drawing, `length` in the surface's units.
   */
  steps: { sheet: number, joints: { name: string, to: number, length: number }[] }[];
  /** A GLB file in metres, +y up: flat sheets that go to their places one after the other, as the animation `Assembly`. */
  model: Uint8Array<ArrayBuffer>;
  /** An SVG file: the surface from above, sheets in the colours of the model, with the drawing's numbers and letters. */
  picture: Uint8Array<ArrayBuffer>;
}

/** One way to make a pattern of an input. */
export interface PatternPlan {
  /** The surface's λ. */
  lambda: number;
  /** The size that patches have at least, as a share of all vertices. */
  smallest: number;
  /** Of the surface from the input: root of the mean square, in the input's units. */
  distance: number;
  /** What solve and pattern took, in seconds; the solve counts for each plan of its λ. */
  seconds: number;
  /** The pattern; its `summary` has sheets, folds, lengths of cuts and strain. */
  drawing?: Drawing;
  /** Why there is none: a part that no cut lays flat within the limits, and where it is. */
  problem?: string;
}

export interface ExploredPatterns {
  /** Those that were tried: with smaller λ, and with larger patches, later. */
  plans: PatternPlan[];
  /** The first one with at most as many sheets as were wanted, if that was said and there is one. */
  chosen?: PatternPlan;
}

/** Pages beside each other, those that are to be put together overlapping. */
export interface DrawingPages {
  /** Width and height of a page. */
  paper: [number, number];
  /** How far the part that it shows is from its edges. */
  blank: number;
  /** Width and height of that part. */
  part: [number, number];
  /** Of each its name, numbered, or with a column's letter where pages are put together, and its part's lower left corner. */
  pages: { name: string, corner: [number, number] }[];
  /** Where pages that are to be put together have crosses. */
  marks: [number, number][];
}

/**
 * A warp map in little room: places in the photo at the nodes of a grid over the flat image, to be interpolated
 * bilinearly. Node (i, j), column i of row j, lies at the pixel (i · step[0], j · step[1]), (0, 0) being the centre of
 * the upper left one; the last node at that of the lower right one.
 */
export interface WarpGrid {
  columns: number;
  rows: number;
  /** Pixels of the flat image from one node to the next, to the right and down. */
  step: [number, number];
  /**
   * x, y of each node in the photo, row by row; NaN where there is no sheet around it. Nodes just beside the sheet
   * have the place at which the map would go on.
   */
  places: Float32Array;
  /** How far what is interpolated is from the full map over the sheet, in pixels of the photo: root mean square. */
  rms: number;
  /** The same, at most. Above what was allowed where 40000 nodes are not enough for it, as with sharp creases. */
  maximum: number;
}

/** A flat image, transparent where there is no sheet; `new ImageData(data, width)` shows it. */
export interface Dewarped extends Omit<DecodedPhoto, 'orientation' | 'film35' | 'assumptions'> {
  /** Pixels per unit of length. */
  resolution: number;
  /** That unit, where the surface's is known. */
  unit?: Unit;
  /** Where the upper left corner lies on the sheet; with `deskew` in axes that are turned with it about the origin. */
  corner: [number, number];
  /**
   * The warp map: for each pixel its place x, y in the photo, in its pixels, (0, 0) being the
   * centre of the upper left one; NaN where there is no sheet. Empty where it was not wanted.
   */
  map: Float32Array;
  /** The same on a grid, where it was wanted. */
  grid?: WarpGrid;
  /**
   * Share of the sheet that `trim` left out; of a `crop` with four corners, the share of the page between them that the flat
   * image does not show. 0 otherwise.
   */
  loss: number;
  /**
   * How far a `crop` with four corners reaches beyond the one page that was found in the photo, as a share of the page's side:
   * above 0.02 the flat image shows what lies beside it, and is `'doubtful'`. 0 where no page is found without doubt.
   */
  overreach: number;
  /** What happened to the light: `'keep'` also where it was to be evened, but the image is not mostly paper. */
  light: 'even' | 'keep';
  verdict: Verdict;
  report: UnrollReport;
}

/**
 * An edge as it was traced in a photo, from one corner of the page to the next, in the photo's
 * pixels, (0, 0) being the centre of the upper left one: points with a smooth edge between them, or
 * the control points of cubic Bézier curves that follow each other (4, 7, 10 and so on).
 */
export type EdgeTrace = readonly (readonly [number, number])[] | { beziers: readonly (readonly [number, number])[] };

/**
 * The two edges of a page that are bent, with its corners at their ends: each from left to right
 * (`top`, `bottom`), or from top to bottom (`left`, `right`). Or all four: which two are bent is seen, and
 * the straight ones check the page.
 */
export type PageEdges = (
  | { top: EdgeTrace; bottom: EdgeTrace; left?: undefined; right?: undefined }
  | { left: EdgeTrace; right: EdgeTrace; top?: undefined; bottom?: undefined }
  | { top: EdgeTrace; bottom: EdgeTrace; left: EdgeTrace; right: EdgeTrace }
) & {
  /**
   * Lines of text, traced likewise from where they begin to where they end (at most 500): level on the flat page, they
   * check it, and show folds between the edges. Without this list they are looked for in the photo; an empty one says
   * that there are none.
   */
  lines?: readonly EdgeTrace[];
};

/**
 * Whether a page that was made flat by its edges is to be trusted: both edges are straight, so that it was flat
 * or is folded along them, which they do not show (`'flat'`); it was curled one way, and its edges and lines of text
 * agree (`'unrolled'`); nothing checks it, for too few points were traced or one edge looks straight however the page is
 * bent (`'unchecked'`); it is likely to be wrong by more than 1 % of its width, or hides a part of itself, or its edges
 * and lines disagree by about as much as they were meant to be traced to (`'doubtful'`); or they disagree by more: it is
 * folded, crumpled, bent both ways or wrongly traced (`'notThisKind'`).
 */
export type PageVerdict = 'flat' | 'unrolled' | 'unchecked' | 'doubtful' | 'notThisKind';

/**
 * What a page was taken for: a plane, a cylinder (curled one way), a sheet of paper of any shape, or one that is crumpled and
 * therefore strained a little.
 */
export type PageModel = 'plane' | 'cylinder' | 'sheet' | 'softSheet';

/**
 * Why a page is doubtful: its expected error is above 1 % of its width; a part hides another part; edges and lines of text
 * disagree; fewer than eight lines of text show how a sheet of any shape is bent; it is crumpled; it is bent strongly.
 */
export type PageDoubt = 'largeError' | 'hiddenPart' | 'disagreement' | 'fewLines' | 'crumpled' | 'strongBend';

/** How a page was found. */
export interface PageReport {
  verdict: PageVerdict;
  /** Main reason for the verdict `doubtful`; missing with others. */
  doubt?: PageDoubt;
  model: PageModel;
  /** Expected displacement on the flat page (root mean square after the best similarity), in % of a page's width. */
  error: number;
  /** The same, not exceeded in 95 of 100 cases, if the page is curled one way and the lens does not distort. */
  pinholeErrorBound: number;
  /** In pixels of the photo, and its standard deviation in %. */
  focalLength: number;
  focalDeviation: number;
  /** Between the camera's axis and the normal of the page's chord, in degrees. */
  tilt: number;
  /** Most that the page's direction changes along its curve, in degrees. */
  bend: number;
  /** Root mean square distance of the traced points from the edge found, in pixels: of the edge that fits worst, or of all lines of text. */
  residual: number;
  /** The part of it that goes on from point to point, or from one line of text to the next, in % of a page's width as it is seen. */
  disagreement: number;
  /** Lines of text that it was found by besides the edges, given and found. */
  lines: number;
  /** Lines of text that were found in the photo by themselves. */
  linesFound: number;
  /** Those of them that it was found by, all or none: if they contradict the edges, only the verdict is theirs. */
  linesUsed: number;
  /** By how much lines of text disagree with the page: what neighbouring ones have in common of it, in % of its width as it is seen. */
  linesDisagreement: number;
  /** Height over width as it is seen, without use of a format that was given. */
  ratio: number;
}

/** The image of a flat page, or of both of a spread beside each other. */
export interface FlatPage extends Omit<Dewarped, 'verdict' | 'report' | 'unit' | 'loss' | 'overreach'> {
  /** Width and height of the flat page, or of both together. */
  size: [number, number];
  /** The unit of all lengths: millimetres where a format or a ruler is given, else a page's width. */
  unit: 'mm' | 'page';
}

/** The warp map of a page by shares, which holds for any resolution of the picture and of the flat page. */
export interface PageWarp {
  /** Number of nodes of the grid in each row: the first at the page's left edge, the last at its right edge. */
  columns: number;
  /** Number of rows of the grid, from the page's upper edge to its lower one. */
  rows: number;
  /**
   * Place of each node in the photo, row by row: pairs of shares of the photo's width from the left and of its height from the
   * top. Bilinear in between; NaN where the photo cannot show the node.
   */
  places: Float32Array;
}

/** What `flattenPhoto` needs of a page that was found in a photo: a `DewarpedPage` has it. */
export interface FoundPage extends Pick<FlatPage, 'size' | 'unit'> {
  warp: PageWarp;
}

/** A flat page, or both of a spread beside each other, with the page in space and the verdict on it. */
export interface DewarpedPage extends FlatPage {
  /** The warp map by shares, with which `flattenPhoto` flattens the same picture at another resolution. */
  warp: PageWarp;
  /**
   * The page in space, with texture coordinates for the photo, to be sampled (`{ view: 'best-fit' }`),
   * shown and written: x to the right, y up, the camera at the origin, looking along -z.
   */
  mesh: Mesh & { triangles: Uint32Array; uvs: Float32Array };
  /**
   * Lines of text that were found, for each page from left to right or from top to bottom: points in the photo, below the
   * letters. Empty where none were.
   */
  lines: [number, number][][][];
  verdict: PageVerdict;
  report: PageReport;
  /** What was found in the photo, if no edges were given. */
  outline?: PageOutlines;
}

/** Whether one page was found, one that is doubtful, several beside each other, or none that can be told from its ground. */
export type OutlineVerdict = 'found' | 'doubtful' | 'several' | 'notFound';

/**
 * Why an outline is doubtful or was not found: a corner is outside of the photo and was extrapolated; most of an edge is
 * outside or on the rim; part of an edge has no contrast; the shape is unlike that of paper; nothing looks like a page.
 */
export type OutlineReason = 'cornerOutside' | 'edgeOutside' | 'faintEdge' | 'unlikelyShape' | 'noPage';

/** The outline of one page in a photo. */
export interface PageOutline {
  /** Upper left, upper right, lower right and lower left corner, in pixels of the photo; they may be outside of it. */
  corners: [number, number][];
  /** The four edges, to be given to `dewarpPage`. */
  edges: { top: [number, number][]; bottom: [number, number][]; left: [number, number][]; right: [number, number][] };
  /** How sure the outline is, from 0 to 1. */
  score: number;
  reasons: OutlineReason[];
}

/** The pages that were found in a photo. */
export interface PageOutlines {
  verdict: OutlineVerdict;
  /** Why the verdict is not `found`. */
  reasons: OutlineReason[];
  /** The outlines, the best first: more than one if the verdict is `several`; of `notFound` the best guess, if any. */
  pages: PageOutline[];
}

/** What can be read. */
export type Format = 'png' | 'npy' | 'tiff' | 'exr' | 'pfm' | 'npz' | 'jpeg' | 'webp' | 'text' | 'colmap';

/** An array of an NPZ file. */
export interface NpzArray {
  name: string;
  shape: number[];
  /** `'f32'` and the like, or NumPy's own name for what is no number. */
  dataType: string;
}

/** A decoded file. For integers without a recorded scale `heightScale` is a suggestion (see README). */
export interface ReadResult {
  format: Format;
  width: number;
  height: number;
  /**
   * Values as stored (grey levels, numbers), plus `offset / heightScale` where the file records an
   * offset, row by row, the top row first; NaN where an alpha channel is 0, the value is NaN, or
   * the file says that it means no data.
   */
  data: Float64Array;
  /** Side length of a pixel; 1 where the file does not say. */
  pixelSize: number;
  /** The unit of `pixelSize`: millimetres of a TIFF's resolution, metres of a map; `null` where it is not known. */
  unit: 'mm' | 'm' | null;
  heightScale: number;
  /** The type the file stores: `'u8'`, `'u16'`, `'f32'`, `'f64'`, ... */
  dataType: string;
  /** Where the pixels lie on a map; absent unless the file is a GeoTIFF. */
  georeference?: Georeference;
  /** What the reader assumed because the file does not say it. */
  assumptions: Assumption[];
}

/**
 * A `WebAssembly.Module`. That namespace is declared by TypeScript's library for the DOM, without which these types
 * compile as well.
 */
export type WasmModule = typeof globalThis extends { WebAssembly: { Module: { prototype: infer M } } } ? M : object;

/** Where the solver's wasm comes from; nothing means the file beside the package's own modules. */
export type InitInput =
  | string | URL | Response | ArrayBuffer | ArrayBufferView | WasmModule
  | Promise<Response | ArrayBuffer | ArrayBufferView | WasmModule>;
