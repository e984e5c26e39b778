/**
 * The promise API: the solver runs in a module worker (in Node, a worker thread).
 * @module developable
 */
import type {
  CallProgress,
  Analysis, AnalyzeOptions, BookPage, Canvas, DecodedPhoto, DepthOptions, DetectedOcclusions, Dewarped, DewarpedPage, DewarpOptions,
  DewarpPageOptions, Drawing, Example, ExampleName, ExampleOptions, FittedCylinder, FlatPage, FlattenPhotoOptions, Drawable, PageCorners, PageReport, PhotoSource, FoundPage, Heightfield, HeightImage, ImageSurface, InitInput, Intrinsics, LatticeSurface, Mesh, MeshAnalysis, MeshAnalyzeOptions, MeshPatchMap, MeshPatchOptions,
  MeshPatternOptions, MeshRulingOptions, MeshRulings, MeshSolverOptions, MeshSurface, MeshUnrolling, MeshUnrollOptions, NpzArray, RecognizedMesh,
  ExploredPatterns, OcclusionOptions, PageEdges, PageOutlines, Painted, PaintOptions, PatchMap, PatchOptions, PatternOptions, PatternPlan, Photo, Picture,
  PictureOptions, Progress,
  ReadMeshOptions, ReadOptions, ReadResult, RulingField, RulingOptions, SampledMesh, SampleMeshOptions, SizedPhoto,
  SolverOptions, Surface, SurfaceOf, SurfacePicture, ThreadOptions, Unrolling, UnrollOptions, WriteBookOptions, WriteImageOptions, WriteObjOptions, WritePdfOptions, WritePhotoOptions, WriteSvgOptions,
} from './types.js';
export { parseCamera } from './camera-file.js';
export * from './types.js';

/** Options of a worker: its threads, and where its files are. Each wasm file is loaded when it is needed. */
export interface WorkerOptions extends ThreadOptions {
  /** Address of the worker's script. Default: `worker.js` beside this module, or the copy in a bundle. */
  workerUrl?: string | URL;
  /** Wasm of the solver for heights. Default: the file beside the worker. */
  wasm?: InitInput;
  /** Wasm that reads and writes PNG, NPY, OBJ and photos, and paints. Default: the file beside the worker. */
  filesWasm?: InitInput;
  /** Wasm that reads and writes all other height images and photos. Default: the file beside the worker. */
  imagesWasm?: InitInput;
  /** Wasm that reads, samples and writes meshes, except writing OBJ. Default: the file beside the worker. */
  meshesWasm?: InitInput;
  /** Wasm that fits surfaces to whole meshes. Default: the file beside the worker. */
  fitmeshWasm?: InitInput;
  /** Wasm that analyses, draws, unrolls and dewarps surfaces. Default: the file beside the worker. */
  unrollWasm?: InitInput;
  /** Wasm that makes patterns and writes them to files. Default: the file beside the worker. */
  patternsWasm?: InitInput;
}

/** Options of writing a GLB file. */
export interface WriteGlbOptions {
  /**
   * PNG or JPEG file that the texture coordinates are about. It is embedded as it is, and replaces colours. Default: the texture
   * of the mesh or surface; `null` for none.
   */
  texture?: Uint8Array | ArrayBuffer | Blob | null;
}

/** Options of a fit of an open input. */
export interface OpenFitOptions extends SolverOptions {
  /** Signal that stops the fit itself, within about 50 ms. */
  signal?: AbortSignal;
  /**
   * What happens after an abort: the call rejects with the signal's reason (`'reject'`, the default) or resolves with the best
   * surface so far (`'keep'`).
   */
  onAbort?: 'reject' | 'keep';
  /**
   * Function that is called several times a second, in the caller's thread. If it returns a promise, that is awaited before the next
   * call and before the result. If it throws or its promise rejects, so does the fit.
   */
  onProgress?: (progress: Progress) => void;
}

/** Option of the calls whose input may be large. */
export interface HandOver {
  /**
   * Whether the buffers of the input or photo are transferred to the worker instead of copied. The caller loses them, unless an
   * option or a shape is refused. Arrays that are only a part of their buffer are copied. Default false.
   */
  transfer?: boolean;
}

/** Option of the calls that take long. */
export interface Abortable {
  /**
   * Signal that stops the work itself: a call with a signal runs in another worker, at most two at a time, which an abort ends.
   * The call rejects with the signal's reason.
   */
  signal?: AbortSignal;
}

/** Options of the calls that take longest. */
export interface Watchable extends Abortable {
  /**
   * Function that is called several times a second, in the caller's thread. If it returns a promise, that is awaited before the
   * next call and before the result. If it throws or its promise rejects, so does the call, when its work has ended.
   */
  onProgress?: (progress: CallProgress) => void;
}

/** Options of a fit of a whole mesh. */
export interface FitMeshOptions extends MeshSolverOptions {
  /** Signal that stops the fit itself. */
  signal?: AbortSignal;
  /**
   * What happens after an abort: the call rejects with the signal's reason (`'reject'`, the default) or resolves with the best
   * mesh so far (`'keep'`).
   */
  onAbort?: 'reject' | 'keep';
  /**
   * Function that is called several times a second, in the caller's thread. If it returns a promise, that is awaited before the next
   * call and before the result. If it throws or its promise rejects, so does the fit.
   */
  onProgress?: (progress: Progress) => void;
}

/** Options of a fit. */
export interface FitOptions extends OpenFitOptions, HandOver {}

/** Options of an exploration of patterns. */
export interface ExplorePatternOptions {
  /** Values of λ (the option `lambda` of `fit`) to try, the largest first. Default: 1e7, 3e6, 1e6, 3e5, 1e5 and 3e4. */
  lambdas?: readonly number[];
  /** Minimum sizes of a patch to try, the smallest first, as shares of all vertices, of a mesh as shares of its area. Default: 0.005, 0.02 and 0.08. */
  smallest?: readonly number[];
  /**
   * Number of sheets that is few enough: the exploration ends with the first plan of at most as many. Default: all plans are
   * tried.
   */
  sheets?: number;
  /** Options of each fit, except `lambda`. */
  solver?: Omit<SolverOptions, 'lambda'>;
  /** Options of each pattern, except `smallest`. */
  pattern?: Omit<PatternOptions, 'smallest'>;
  /** Signal that stops the exploration; the call rejects with its reason. */
  signal?: AbortSignal;
  /** Function that is called with each plan as soon as it is made. The next plan waits for a promise that it returns. What it throws ends the exploration. */
  onPlan?: (plan: PatternPlan) => unknown;
}

/** Options of an exploration of patterns of a mesh. */
export interface ExplorePatternMeshOptions extends Omit<ExplorePatternOptions, 'lambdas' | 'solver' | 'pattern'> {
  /** Values of λ (the option `lambda` of `fitMesh`) to try, the largest first. Default: the one that suits the mesh's noise, and 0.3, 0.1 and 0.03 times as much. */
  lambdas?: readonly number[];
  /** Options of each fit, except `lambda`. */
  solver?: Omit<MeshSolverOptions, 'lambda'>;
  /** Options of each pattern, except `smallest`. */
  pattern?: Omit<MeshPatternOptions, 'smallest'>;
}

/**
 * An input that stays in the worker with its solver, to be fitted repeatedly: with other options, as for a slider, or slightly
 * changed.
 *
 * If the worker ends, calls under way reject, and later ones reject with code `WORKER` (or `DISPOSED`, if the worker was disposed
 * of): then open the input again.
 */
export interface OpenSolver<I extends HeightImage | Heightfield = HeightImage | Heightfield> {
  /**
   * Fits the surface: a cold start the first time, later a warm start from the last surface. Options that are left out have their
   * defaults. If the input or the options are wrong, the call rejects and nothing changes. A new call ends the one under way, which
   * rejects with code `REPLACED`.
   */
  fit(options?: OpenFitOptions): Promise<SurfaceOf<I>>;
  /**
   * Replaces the input for the next call of `fit`, a warm start from the last surface if the lattice keeps its shape. A call under
   * way goes on with the input before.
   */
  replace(input: I, options?: HandOver): Promise<void>;
  /** Whether the solver was disposed of, after which its methods reject. */
  readonly disposed: boolean;
  /** Frees the memory in the worker; a call under way rejects with code `DISPOSED`. It may be repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/**
 * Starts the shared worker and loads the wasm of the solver for heights, for which an `InitInput` alone stands. It is optional and may
 * be repeated: the functions below call it. Options count if no shared worker runs yet; after a failure they can be given anew.
 */
export function init(options?: WorkerOptions | InitInput): Promise<void>;
/**
 * Fits a piecewise developable surface to heights: smooth pieces that could be laid flat as paper can, without stretching, which meet at
 * creases. `report.gap` is a proven bound: the objective is above its minimum by at most this share of itself.
 */
export function fit(input: HeightImage, options?: FitOptions): Promise<ImageSurface>;
/**
 * Fits a piecewise developable surface to heights: smooth pieces that could be laid flat as paper can, without stretching, which meet at
 * creases. `report.gap` is a proven bound: the objective is above its minimum by at most this share of itself.
 */
export function fit(input: Heightfield, options?: FitOptions): Promise<LatticeSurface>;
/**
 * Fits a piecewise developable surface to heights: smooth pieces that could be laid flat as paper can, without stretching, which meet at
 * creases. `report.gap` is a proven bound: the objective is above its minimum by at most this share of itself.
 */
export function fit(input: HeightImage | Heightfield, options?: FitOptions): Promise<Surface>;
/**
 * Sends an input to the module's worker, once, and returns a solver whose `fit` can be called again and again. Nothing is fitted
 * yet. It rejects a malformed input. The solver's `dispose` frees its memory.
 */
export function open(input: HeightImage, options?: HandOver): Promise<OpenSolver<HeightImage>>;
/**
 * Sends an input to the module's worker, once, and returns a solver whose `fit` can be called again and again. Nothing is fitted
 * yet. It rejects a malformed input. The solver's `dispose` frees its memory.
 */
export function open(input: Heightfield, options?: HandOver): Promise<OpenSolver<Heightfield>>;
/**
 * Sends an input to the module's worker, once, and returns a solver whose `fit` can be called again and again. Nothing is fitted
 * yet. It rejects a malformed input. The solver's `dispose` frees its memory.
 */
export function open(input: HeightImage | Heightfield, options?: HandOver): Promise<OpenSolver>;
/**
 * Detects occlusions in heights: places where the surface is torn. `fit` takes them as `occlusions` and `brokenEdges`.
 */
export function occlusions(input: HeightImage | Heightfield, options?: OcclusionOptions): Promise<DetectedOcclusions>;
/**
 * Decodes a file of heights: PNG, NPY, TIFF, EXR, PFM, PGM, NPZ, JPEG, WebP, text, SRTM heights or a depth map of COLMAP. Meshes are read
 * by `readMesh`.
 */
export function read(bytes: Uint8Array | ArrayBuffer | Blob, options?: ReadOptions): Promise<ReadResult>;
/**
 * Detects the format of a file of heights, a photo or a mesh by what is in it, and returns its name, such as `'png'` or `'stl'`;
 * `undefined` for other files.
 */
export function formatOf(bytes: Uint8Array | ArrayBuffer | Blob): Promise<string | undefined>;
/** Lists the arrays of an NPZ file, one of which `read` takes by its name. It rejects with code `FORMAT` for another file. */
export function npzArrays(bytes: Uint8Array | ArrayBuffer | Blob): Promise<NpzArray[]>;
/**
 * Writes heights to a file: those of an image in the unit of lengths (steps times `heightScale`), NaN for no data, or those of a
 * surface's image. A surface that has none rejects with code `INPUT`, but an NPY file takes the heights at the vertices of its
 * lattice, row by row.
 */
export function writeImage(input: HeightImage | Heightfield | Surface, options?: WriteImageOptions): Promise<Uint8Array<ArrayBuffer>>;
/**
 * Writes a mesh, or the triangles of a heightfield, to an OBJ file with normals, colours and texture coordinates: in
 * the axes of its `frame`, in its unit of length.
 */
export function writeObj(input: Heightfield | Mesh, options?: WriteObjOptions): Promise<Uint8Array<ArrayBuffer>>;
/** Writes an MTL file of one material for an OBJ file. `picture` is the name of the texture's file. */
export function writeMtl(picture: string): Promise<Uint8Array<ArrayBuffer>>;
/**
 * Writes a mesh, or the triangles of a heightfield, to a binary PLY file: positions as 64-bit floats, colours as bytes.
 */
export function writePly(input: Heightfield | Mesh): Promise<Uint8Array<ArrayBuffer>>;
/**
 * Writes a mesh, or the triangles of a heightfield, to a binary STL file: positions as 32-bit floats and a normal for
 * each triangle.
 */
export function writeStl(input: Heightfield | Mesh): Promise<Uint8Array<ArrayBuffer>>;
/**
 * Writes a mesh, or the triangles of a heightfield, to a GLB file (binary glTF): positions as 32-bit floats, colours as
 * bytes, and a texture if one is given.
 */
export function writeGlb(input: Heightfield | Mesh, options?: WriteGlbOptions): Promise<Uint8Array<ArrayBuffer>>;
/**
 * Decodes a mesh file: OBJ, PLY, STL, glTF, GLB, 3MF, OFF or points in text (XYZ). Polygons become triangles; a file of points alone becomes
 * a point cloud.
 */
export function readMesh(bytes: Uint8Array | ArrayBuffer | Blob, options?: ReadMeshOptions): Promise<Mesh>;
/**
 * Fits a piecewise developable surface to a whole mesh, by moving its vertices: no view is needed, and the mesh may be
 * closed, overhanging, open or in several parts. It must be a surface; otherwise the code is `TOPOLOGY` and the message
 * says where. `confidence` of the mesh weighs how closely each vertex is followed.
 */
export function fitMesh(mesh: Mesh, options?: FitMeshOptions): Promise<MeshSurface>;
/** Samples a mesh or point cloud from a view: returns heights at the vertices of a lattice, which `fit` takes. */
export function sampleMesh(mesh: Mesh, options?: SampleMeshOptions): Promise<SampledMesh>;
/**
 * Makes a mesh of the depth image of a camera. Vertex i is pixel i, so that an image of the same size gives its
 * `colors`; neighbouring pixels are joined except at jumps, where one point is behind the other by more than ten times
 * their distance across the line of sight. `data` are depths in steps of `depthScale` (`heightScale` and `pixelSize` do
 * not count); NaN, `noData` and depths of 0 or less are none. The camera is at the origin; x points to the right, y up
 * and z to the viewer, so that the view `'-z'` is along the camera's axis.
 */
export function backProject(image: HeightImage, camera: Intrinsics, options?: DepthOptions): Promise<Mesh>;
/**
 * Returns a copy of a surface with the colours of a picture of it, and with texture coordinates. The place of a point in the picture
 * follows from the option `extent`, else from the option `camera` or the surface's own camera, else from the surface's texture
 * coordinates; without any of these the picture shows the same rectangle as the heights. The picture may have any resolution; if it
 * is a file, `texture` is set as well. Colours stay as they are
 * where the picture is transparent or the camera does not see the surface.
 */
export function paint<F extends Heightfield>(input: F, picture: Picture | Blob, options?: PaintOptions): Promise<Painted<F>>;
/**
 * Computes curvatures at a surface's vertices, and statistics that say how developable the surface is. The surface is taken as it is,
 * without a fit: give it what `fit` returned.
 */
export function analyze(input: HeightImage | Heightfield, options?: AnalyzeOptions): Promise<Analysis>;
/**
 * Computes curvatures at the vertices of a mesh, with the direction in which it bends least, and statistics that say how developable the
 * mesh is.
 */
export function analyze(mesh: Mesh, options?: MeshAnalyzeOptions): Promise<MeshAnalysis>;
/** Segments a surface into smooth patches, and finds the creases between them. The surface is taken as it is, without a fit. */
export function patches(input: HeightImage | Heightfield, options?: PatchOptions): Promise<PatchMap>;
/** Segments the triangles of a mesh into smooth patches, and finds the creases between them, which run along edges. */
export function patches(mesh: Mesh, options?: MeshPatchOptions): Promise<MeshPatchMap>;
/**
 * Draws a surface, seen from above, to an image of RGBA bytes. Where pixels are larger than the lattice's spacing, the
 * surface is sampled.
 */
export function picture(input: HeightImage | Heightfield, options?: PictureOptions): Promise<SurfacePicture>;
/** Draws a surface, seen from above, on a canvas, which is resized to the picture. */
export function draw(canvas: Canvas, input: HeightImage | Heightfield, options?: PictureOptions): Promise<void>;
/**
 * Computes the rulings of a surface: at each vertex the direction in which it does not bend, and straight lines along
 * these directions. The surface is taken as it is, without a fit.
 */
export function rulings(input: HeightImage | Heightfield, options?: RulingOptions): Promise<RulingField>;
/**
 * Computes the rulings of a mesh: at each vertex the direction in which it does not bend, and straight lines along
 * these directions.
 */
export function rulings(mesh: Mesh, options?: MeshRulingOptions): Promise<MeshRulings>;
/**
 * Fits a cylinder with any profile to heights on a lattice: for curled sheets, pages of books and parallel folds, whose
 * rulings are all parallel. `report.verdict` says whether the surface is a cylinder. Heights count by their `confidence` and `mask`;
 * `constraints` and `occlusions` do not count.
 */
export function fitCylinder(input: Heightfield): Promise<FittedCylinder>;
/** Lays a surface flat without cuts, with as little strain as possible. */
export function unroll(input: HeightImage | Heightfield, options?: UnrollOptions & Watchable): Promise<Unrolling>;
/** Lays a mesh flat as `pattern` does, and returns the triangles of its sheets, side by side. */
export function unroll(mesh: Mesh, options?: MeshUnrollOptions & Watchable): Promise<MeshUnrolling>;
/**
 * Makes a pattern of a surface: cuts it along creases into sheets that lie flat, with as few cuts as possible, and
 * draws the sheets side by side in millimetres.
 */
export function pattern(input: HeightImage | Heightfield, options?: PatternOptions & Watchable): Promise<Drawing>;
/**
 * Makes a pattern of a mesh: cuts it into sheets that lie flat, and draws them side by side in millimetres. A mesh of exact
 * faces is taken as it is, without strain.
 */
export function pattern(mesh: Mesh, options?: MeshPatternOptions & Watchable): Promise<Drawing>;
/**
 * Says what `kind` a mesh is: of exact flat faces, of noisy flat faces, without noise (which a fit would not improve), or noisy. If
 * it is closed, exact and bent of sheet metal, the metal's `thickness` is returned as well.
 */
export function recognizeMesh(mesh: Mesh): Promise<RecognizedMesh>;
/**
 * Fits heights at each of `lambdas`, and makes a cutting pattern of each fit at each of `smallest`: 6 fits and 18 patterns at most
 * by default. λ falls from plan to plan, so that the surface follows the input less and has fewer sheets as a rule. Each fit starts
 * from the one before. The plan of a surface that cannot be laid flat has a `problem` instead of a drawing; any other error rejects.
 */
export function explorePattern(input: HeightImage | Heightfield, options?: ExplorePatternOptions): Promise<ExploredPatterns>;
/**
 * Fits a mesh at each of `lambdas` by `fitMesh`, and makes a cutting pattern of each fit at each of `smallest`. `distance` of a plan
 * says how far vertices were moved.
 */
export function explorePattern(mesh: Mesh, options?: ExplorePatternMeshOptions): Promise<ExploredPatterns>;
/** Writes a drawing to an SVG file in millimetres, with the layers `picture`, `cut`, `mountain`, `valley`, `tab` and `label`. */
export function writeSvg(drawing: Drawing, options?: WriteSvgOptions): Promise<Uint8Array<ArrayBuffer>>;
/**
 * Writes a drawing to a PDF file in true size, to be printed at 100 %: one page as large as the drawing, or pages of
 * paper that overlap, with crosses by which they are laid on each other.
 */
export function writePdf(drawing: Drawing, options?: WritePdfOptions): Promise<Uint8Array<ArrayBuffer>>;
/** Writes a drawing to a DXF file (AutoCAD 2000) in millimetres, with the layers of the SVG file in capitals. */
export function writeDxf(drawing: Drawing): Promise<Uint8Array<ArrayBuffer>>;
/** Makes a photo of a surface flat, by laying the surface flat. */
export function dewarp(input: HeightImage | Heightfield, photo: Photo, options?: DewarpOptions & HandOver & Abortable): Promise<Dewarped>;
/**
 * Makes a photo of a curled, folded or crumpled page flat, or of both pages of a spread, without depths. It detects the edges of the
 * clearest page in the photo, and rejects with code `NO_PAGE` if there is none. Edges that are known are given by the other overload.
 */
export function dewarpPage(photo: (Photo & { film35?: number }) | PhotoSource | Drawable, options?: DewarpPageOptions & HandOver & Watchable): Promise<DewarpedPage>;
/**
 * Makes a photo of a curled, folded or crumpled page flat, or of both pages of a spread, without depths. `edges` are the four corners
 * of the page, its two bent edges (`top` and `bottom`, or `left` and `right`), or all four edges; for a spread they are a list, the
 * left page first. Without `edges` they are detected, as in the other overload. Coordinates are in pixels of the photo as `readPhoto`
 * decodes it, from the centre of the upper left pixel. Edges that do not outline a page, as when they cross, reject with code `EDGES`;
 * edges that no sheet of paper can have give the verdict `'notThisKind'`.
 */
export function dewarpPage(
  photo: (Photo & { film35?: number }) | PhotoSource | Drawable, edges?: PageEdges | readonly PageEdges[] | PageCorners | null, options?: DewarpPageOptions & HandOver & Watchable,
): Promise<DewarpedPage>;
/**
 * Makes a photo of any resolution flat by a page that `dewarpPage` found in the same picture: the whole photo for a
 * file, say, after a reduced one for a preview. It costs little more than resampling, and differs from the preview in
 * resolution alone.
 */
export function flattenPhoto(photo: Photo | PhotoSource | Drawable, page: FoundPage, options?: FlattenPhotoOptions & HandOver & Abortable): Promise<FlatPage>;
/** Returns the verdict on a flat page as a sentence: whether it can be trusted, why not, and how large its error is. */
export function describePage(report: PageReport): string;
/**
 * Finds the page in a photo: its corners and edges, which can be corrected and given to `dewarpPage`. Coordinates are in pixels of
 * the photo as `readPhoto` decodes it (upright; a file of more than 26 megapixels is reduced, its sides divided by a whole number), from the centre of the
 * upper left pixel. Without a page the verdict is `'notFound'`, and `pages` has the best guess, if there is one.
 */
export function findPage(photo: Photo | PhotoSource | Drawable, options?: Abortable): Promise<PageOutlines>;
/**
 * Decodes a photo: JPEG, PNG, WebP, GIF, BMP or TIFF. It is turned upright by its Exif data, which also give its focal
 * length. A photo of more than 26 megapixels is reduced, its sides divided by a whole number, which `assumptions` says (code
 * `reducedPhoto`).
 */
export function readPhoto(file: PhotoSource): Promise<DecodedPhoto>;
/**
 * Writes a photo or a flat image to a PNG, JPEG or PDF file. Transparent pixels stay so in a PNG file and are white in the
 * others. The file states the true size if that is known.
 */
export function writePhoto(photo: SizedPhoto, options?: WritePhotoOptions & HandOver): Promise<Uint8Array<ArrayBuffer>>;
/**
 * Writes a PDF file with one page for each entry, of the entry's `size`, on which its picture is centred and as large as fits. Pictures
 * are JPEG or PNG files, and are taken over without loss, those with transparency on white; others reject with code `UNSUPPORTED`, and
 * so do `words` outside of their picture. With its words a page can be searched and copied from.
 */
export function writeBook(pages: readonly BookPage[], options?: WriteBookOptions): Promise<Uint8Array<ArrayBuffer>>;
/** Generates a procedural example: a height image with noise, and the true heights. */
export function example(name: ExampleName, options?: ExampleOptions): Promise<Example>;
/** Stops the shared worker. Calls under way reject with code `DISPOSED`; a later call starts a new worker. */
export function dispose(): void;

/**
 * A separate worker, with the functions of this module as methods, but for `parseCamera` and `describePage`, which need none.
 *
 * Fits on one worker take turns of about 25 ms, on all of its threads; to run them at the same time, give each a worker of its own.
 */
export class DevelopableWorker {
  /** Prepares a worker, which starts with the first call. */
  constructor(options?: WorkerOptions);
  /** Starts the worker and loads the wasm of the solver. It is optional and may be repeated. */
  init(): Promise<void>;
  /** Whether the worker runs. It starts with the first call, and again with the first call after a crash. */
  readonly connected: boolean;
  /** Whether the worker was disposed of, after which its methods reject. */
  readonly disposed: boolean;
  /** Stops the worker; calls under way reject with code `DISPOSED`. It may be repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/** The functions of this module, as methods of a separate worker. */
export interface DevelopableWorker extends Omit<
  typeof import('./index.js'), 'DevelopableError' | 'DevelopableWorker' | 'describePage' | 'dispose' | 'init' | 'parseCamera'
> {}
