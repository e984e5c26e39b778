/**
 * The promise API: the solver runs in a module worker (in Node, a worker thread).
 * @module developable
 */
import type {
  Analysis, AnalyzeOptions, BookPage, Canvas, DecodedPhoto, DepthOptions, DetectedOcclusions, Dewarped, DewarpedPage, DewarpOptions,
  DewarpPageOptions, Drawing, Example, ExampleName, ExampleOptions, FittedCylinder, FlatPage, FlattenPhotoOptions, Drawable, PageCorners, PageReport, PhotoSource, FoundPage, Heightfield, HeightImage, ImageSurface, InitInput, Intrinsics, LatticeSurface, Mesh, MeshAnalysis, MeshAnalyzeOptions,
  MeshPatternOptions, MeshRulingOptions, MeshRulings, MeshSolverOptions, MeshSurface, MeshUnrolling, MeshUnrollOptions, NpzArray,
  ExploredPatterns, OcclusionOptions, PageEdges, PageOutlines, Painted, PaintOptions, PatchMap, PatchOptions, PatternOptions, PatternPlan, Photo, Picture,
  PictureOptions, Progress,
  ReadMeshOptions, ReadOptions, ReadResult, RulingField, RulingOptions, SampledMesh, SampleMeshOptions, SizedPhoto,
  SolverOptions, Surface, SurfaceOf, SurfacePicture, ThreadOptions, Unrolling, UnrollOptions, WritePdfOptions, WritePhotoOptions,
} from './types.js';
export { parseCamera } from './camera-file.js';
export * from './types.js';

export interface WorkerOptions extends ThreadOptions {
  /** Where the worker's script is; default: `worker.js` beside this module, or else the copy that a bundle has. */
  workerUrl?: string | URL;
  /** Where the solver's wasm is; default: beside the worker. */
  wasm?: InitInput;
  /**
   * Where the wasm is that reads and writes PNG, NPY, OBJ and photos, and paints, loaded when it is needed;
   * default: beside the worker.
   */
  filesWasm?: InitInput;
  /** Where the wasm is for all other height images and photos, likewise. */
  imagesWasm?: InitInput;
  /** Where the wasm is that reads, samples and writes meshes (but for OBJ out), likewise. */
  meshesWasm?: InitInput;
  /** Where the wasm is that fits surfaces to whole meshes, likewise. */
  fitmeshWasm?: InitInput;
  /** Where the wasm is that analyses, draws, unrolls and dewarps, likewise. */
  unrollWasm?: InitInput;
  /** Where the wasm is that makes patterns and writes them, likewise. */
  patternsWasm?: InitInput;
}

export interface WriteGlbOptions {
  /**
   * A PNG or JPEG file that the texture coordinates are about, to be embedded as it is; it takes the
   * place of colours. Default: the field's own; `null` for none.
   */
  texture?: Uint8Array | ArrayBuffer | Blob | null;
}

export interface WriteObjOptions {
  /** Name of a file that `writeMtl` has made: its picture takes the place of colours. */
  materials?: string;
}

export interface OpenFitOptions extends SolverOptions {
  /** Stops the work itself, not only the waiting: within about 50 ms. */
  signal?: AbortSignal;
  /** What an abort does: reject with the signal's reason (default), or resolve with the best surface so far. */
  onAbort?: 'reject' | 'keep';
  /**
   * Called in the caller's thread, several times a second. Where it returns a promise, that is awaited before the next
   * call and before the result; if it is rejected, so is the call, as with an exception.
   */
  onProgress?: (progress: Progress) => void;
}

export interface HandOver {
  /**
   * Hand the buffers of the input, or of the photo, over to the worker instead of copying them (the caller loses them,
   * but not where an option or a shape is refused). Arrays that are only a part of their buffer are copied all the same.
   */
  transfer?: boolean;
}

export interface Abortable {
  /** Stops the work itself: a call with a signal runs in a second worker, which an abort ends. The call rejects with the signal's reason. */
  signal?: AbortSignal;
}

export interface FitMeshOptions extends MeshSolverOptions {
  /** Stops the work itself, not only the waiting. */
  signal?: AbortSignal;
  /** What an abort does: reject with the signal's reason (default), or resolve with the best surface so far. */
  onAbort?: 'reject' | 'keep';
  /**
   * Called in the caller's thread, several times a second. Where it returns a promise, that is awaited before the next
   * call and before the result; if it is rejected, so is the call, as with an exception.
   */
  onProgress?: (progress: Progress) => void;
}

export interface FitOptions extends OpenFitOptions, HandOver {}

export interface ExplorePatternOptions {
  /** λ to try. Default: 1e7, 3e6, 1e6, 3e5, 1e5 and 3e4. */
  lambdas?: readonly number[];
  /** Sizes that patches have at least to try, as shares of all vertices. Default: 0.005, 0.02 and 0.08. */
  smallest?: readonly number[];
  /** End with the first plan of at most so many sheets: the one nearest to the input. Default: try all. */
  sheets?: number;
  /** Of the solves, but for λ. */
  solver?: Omit<SolverOptions, 'lambda'>;
  /** Of the patterns, but for the smallest patch. */
  pattern?: Omit<PatternOptions, 'smallest'>;
  signal?: AbortSignal;
  /** Called with each plan as it is found, and awaited if it returns a promise. */
  onPlan?: (plan: PatternPlan) => void;
}

export interface ExplorePatternMeshOptions extends Omit<ExplorePatternOptions, 'lambdas' | 'solver' | 'pattern'> {
  /** λ to try. Default: what the mesh's noise asks for, and 0.3, 0.1 and 0.03 times as much. */
  lambdas?: readonly number[];
  /** Of the solves, but for λ. */
  solver?: Omit<MeshSolverOptions, 'lambda'>;
  /** Of the patterns, but for the smallest patch. */
  pattern?: Omit<MeshPatternOptions, 'smallest'>;
}

/**
 * An input that stays in the worker with its solver, to be solved again and again: with other
 * options, as for a slider, or slightly changed.
 *
 * If its worker ends, calls under way reject as they do everywhere, and later ones with code
 * `WORKER` (or `DISPOSED`, where the worker was disposed of): open the input again then.
 */
export interface OpenSolver<I extends HeightImage | Heightfield = HeightImage | Heightfield> {
  /**
   * Solves: from nothing the first time, later from where the last solve ended, whatever ended it.
   * What is left out of the options has its default. What is wrong with the input or the options
   * rejects, and changes nothing.
   *
   * The newest wish wins: a new call ends the one under way, which rejects with code `REPLACED`.
   */
  fit(options?: OpenFitOptions): Promise<SurfaceOf<I>>;
  /**
   * Another input for the next call of `fit`, which starts from the last answer if the lattice
   * keeps its shape; a call under way goes on with the one before.
   */
  replace(input: I, options?: HandOver): Promise<void>;
  readonly disposed: boolean;
  /** Frees the memory in the worker; a call under way rejects with code `DISPOSED`. Harmless when repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/**
 * Starts the shared worker and loads the wasm; optional, idempotent, called by the functions below.
 * Options count where no shared worker runs yet; after a failure they can be given anew.
 */
export function init(options?: WorkerOptions | InitInput): Promise<void>;
export function fit(input: HeightImage, options?: FitOptions): Promise<ImageSurface>;
export function fit(input: Heightfield, options?: FitOptions): Promise<LatticeSurface>;
export function fit(input: HeightImage | Heightfield, options?: FitOptions): Promise<Surface>;
/** Sends an input to the shared worker to stay there. It takes memory until it is disposed of. */
export function open(input: HeightImage, options?: HandOver): Promise<OpenSolver<HeightImage>>;
export function open(input: Heightfield, options?: HandOver): Promise<OpenSolver<Heightfield>>;
export function open(input: HeightImage | Heightfield, options?: HandOver): Promise<OpenSolver>;
/** The occlusions in heights, to be looked at before a solve. */
export function occlusions(input: HeightImage | Heightfield, options?: OcclusionOptions): Promise<DetectedOcclusions>;
export function read(bytes: Uint8Array | ArrayBuffer | Blob, options?: ReadOptions): Promise<ReadResult>;
export function npzArrays(bytes: Uint8Array | ArrayBuffer | Blob): Promise<NpzArray[]>;
export function writeNpy(input: HeightImage | Heightfield): Promise<Uint8Array<ArrayBuffer>>;
export function writePng(input: HeightImage | Surface): Promise<Uint8Array<ArrayBuffer>>;
export function writeTiff(input: HeightImage | Surface): Promise<Uint8Array<ArrayBuffer>>;
export function writeExr(input: HeightImage | Surface): Promise<Uint8Array<ArrayBuffer>>;
export function writeObj(input: Heightfield | Mesh, options?: WriteObjOptions): Promise<Uint8Array<ArrayBuffer>>;
export function writeMtl(picture: string): Promise<Uint8Array<ArrayBuffer>>;
export function writePly(input: Heightfield | Mesh): Promise<Uint8Array<ArrayBuffer>>;
export function writeStl(input: Heightfield | Mesh): Promise<Uint8Array<ArrayBuffer>>;
export function writeGlb(input: Heightfield | Mesh, options?: WriteGlbOptions): Promise<Uint8Array<ArrayBuffer>>;
export function readMesh(bytes: Uint8Array | ArrayBuffer | Blob, options?: ReadMeshOptions): Promise<Mesh>;
/**
 * Moves the vertices of a mesh so that it is piecewise developable: the whole of it, without a view, whether it is
 * closed, overhanging, open or in parts. The mesh must be a surface (code `TOPOLOGY` otherwise, with the place).
 * `confidence` of the mesh weighs how closely each vertex is followed.
 */
export function fitMesh(mesh: Mesh, options?: FitMeshOptions): Promise<MeshSurface>;
export function sampleMesh(mesh: Mesh, options?: SampleMeshOptions): Promise<SampledMesh>;
export function backProject(image: HeightImage, camera: Intrinsics, options?: DepthOptions): Promise<Mesh>;
/** Gives a surface the colours of a picture of it. */
export function paint<F extends Heightfield>(input: F, picture: Picture | Blob, options?: PaintOptions): Promise<Painted<F>>;
/** How developable a surface is: curvatures at its vertices, and a summary of them. */
export function analyze(input: HeightImage | Heightfield, options?: AnalyzeOptions): Promise<Analysis>;
/** The smooth patches of a surface, and the creases between them. */
export function patches(input: HeightImage | Heightfield, options?: PatchOptions): Promise<PatchMap>;
/** A surface as a picture, seen from above. Where pixels are larger than the lattice's spacing, it is sampled. */
export function picture(input: HeightImage | Heightfield, options?: PictureOptions): Promise<SurfacePicture>;
/** The same on a canvas, which becomes as large as the picture. */
export function draw(canvas: Canvas, input: HeightImage | Heightfield, options?: PictureOptions): Promise<void>;
/** The rulings of a surface: where it does not bend, and straight lines along that. */
export function rulings(input: HeightImage | Heightfield, options?: RulingOptions): Promise<RulingField>;
/**
 * The cylinder next to heights on the lattice, of whatever profile: for curled sheets, pages of books and parallel folds,
 * whose rulings are all parallel. `report.verdict` says whether they are those of one.
 */
export function fitCylinder(input: Heightfield): Promise<FittedCylinder>;
/** Lays a surface flat, as rigidly as it goes. */
export function unroll(input: HeightImage | Heightfield, options?: UnrollOptions & Abortable): Promise<Unrolling>;
/** Cuts a surface along its creases into sheets that lie flat, and draws them in millimetres. */
export function pattern(input: HeightImage | Heightfield, options?: PatternOptions & Abortable): Promise<Drawing>;
/** How developable a mesh is, as it is: curvatures and rulings at its vertices, and a summary of them. */
export function analyzeMesh(mesh: Mesh, options?: MeshAnalyzeOptions): Promise<MeshAnalysis>;
/** The rulings of a mesh, as it is: along what its surface does not bend, and straight lines along that. */
export function meshRulings(mesh: Mesh, options?: MeshRulingOptions): Promise<MeshRulings>;
/** Lays a mesh flat, as it is: in sheets, cut along its creases and where it does not lie flat otherwise. */
export function unrollMesh(mesh: Mesh, options?: MeshUnrollOptions & Abortable): Promise<MeshUnrolling>;
/** The same drawn in millimetres, as `pattern` does for heights. */
export function patternMesh(mesh: Mesh, options?: MeshPatternOptions & Abortable): Promise<Drawing>;
/**
 * Whether the faces of a mesh are exact (CAD, low-poly models), so that nothing is gained by a fit. `patternMesh` moves such faces into
 * the plane as they are.
 */
export function hasExactFaces(mesh: Mesh): Promise<boolean>;
/**
 * Patterns at several λ and sizes of patches, from the surface nearest to the input to the plainest. Takes one solve
 * for each λ, which start from each other, and one `pattern` for each plan. Surfaces that cannot be laid flat are plans
 * with a `problem`; whatever else `fit` and `pattern` have to say rejects.
 */
export function explorePattern(input: HeightImage | Heightfield, options?: ExplorePatternOptions): Promise<ExploredPatterns>;
/**
 * The same of a mesh as it is: one `fitMesh` for each λ, and one `patternMesh` for each plan. `distance` is how far vertices were
 * moved.
 */
export function explorePatternMesh(mesh: Mesh, options?: ExplorePatternMeshOptions): Promise<ExploredPatterns>;
export function writeSvg(drawing: Drawing): Promise<Uint8Array<ArrayBuffer>>;
export function writePdf(drawing: Drawing, options?: WritePdfOptions): Promise<Uint8Array<ArrayBuffer>>;
export function writeDxf(drawing: Drawing): Promise<Uint8Array<ArrayBuffer>>;
/** Makes a photo of a surface flat. */
export function dewarp(input: HeightImage | Heightfield, photo: Photo, options?: DewarpOptions & HandOver & Abortable): Promise<Dewarped>;
/**
 * Makes a photo of a page flat that is curled, folded or crumpled, or of the two pages of a spread, without depth: by the page's
 * corners, or by its edges, two of which are bent or all four. Without them, by those of the one page that is found in the photo.
 */
export function dewarpPage(photo: (Photo & { film35?: number }) | PhotoSource | Drawable, options?: DewarpPageOptions & HandOver & Abortable): Promise<DewarpedPage>;
export function dewarpPage(
  photo: (Photo & { film35?: number }) | PhotoSource | Drawable, edges?: PageEdges | readonly PageEdges[] | PageCorners | null, options?: DewarpPageOptions & HandOver & Abortable,
): Promise<DewarpedPage>;
/**
 * Makes a photo of any resolution flat by a page that `dewarpPage` has found in the same picture: the whole photo for a file,
 * after a reduced one for a preview. Costs little more than resampling, and differs from the preview in resolution alone.
 */
export function flattenPhoto(photo: Photo | PhotoSource | Drawable, page: FoundPage, options?: FlattenPhotoOptions & HandOver & Abortable): Promise<FlatPage>;
/** The verdict on a flat page in a sentence, from its `report`: whether it can be trusted, why not, and how large its error is. */
export function describePage(report: PageReport): string;
/** Finds the page in a photo: its corners and edges, which can be corrected and given to `dewarpPage`. */
export function findPage(photo: Photo | PhotoSource | Drawable, options?: Abortable): Promise<PageOutlines>;
/**
 * Reads a photo upright, with the focal length that its Exif data state. One of more than 26 megapixels is halved until it has
 * fewer, which `assumptions` says (code `reducedPhoto`).
 */
export function readPhoto(file: PhotoSource): Promise<DecodedPhoto>;
export function writePhoto(photo: SizedPhoto, options?: WritePhotoOptions & HandOver): Promise<Uint8Array<ArrayBuffer>>;
/** A PDF with a page for each picture, a file of JPEG or PNG that is taken over without loss. */
export function writeBook(pages: readonly BookPage[]): Promise<Uint8Array<ArrayBuffer>>;
export function example(name: ExampleName, options?: ExampleOptions): Promise<Example>;
/** Stops the shared worker, calls under way reject with code `DISPOSED`; a later call starts a new one. */
export function dispose(): void;

/**
 * A worker of one's own, with the same functions as methods.
 *
 * Several solves on one worker take turns on its one thread, about 25 ms each; to run them at the
 * same time, give each a worker of its own.
 */
export class DevelopableWorker {
  constructor(options?: WorkerOptions);
  init(): Promise<void>;
  /** Whether the worker runs. It starts with the first call, and anew with the first one after it crashed. */
  readonly connected: boolean;
  readonly disposed: boolean;
  /** Stops the worker; calls under way reject with code `DISPOSED`. Harmless when repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/** The functions of this module, of one's own worker. */
export interface DevelopableWorker extends Omit<
  typeof import('./index.js'), 'DevelopableError' | 'DevelopableWorker' | 'describePage' | 'dispose' | 'init' | 'parseCamera'
> {}
