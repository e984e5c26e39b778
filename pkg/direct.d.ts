/**
 * The synchronous API: runs where it is called. Meant for workers and Node; in a page it blocks.
 * @module developable/direct
 */
import type {
  Analysis, AnalyzeOptions, BookPage, Canvas, DecodedPhoto, DepthOptions, DetectedOcclusions, Dewarped, DewarpedPage, DewarpOptions,
  DewarpPageOptions, Drawing, Example, ExampleName, ExampleOptions, FittedCylinder, FlatPage, FlattenPhotoOptions, PageCorners, PageReport, FoundPage, Heightfield, HeightImage, ImageSurface, InitInput, Intrinsics, LatticeSurface, Mesh, MeshAnalysis, MeshAnalyzeOptions,
  MeshPatternOptions, MeshRulingOptions, MeshRulings, MeshSolverOptions, MeshSurface, MeshUnrolling, MeshUnrollOptions, NpzArray,
  OcclusionOptions, PageEdges, PageOutlines, Painted, PaintOptions, PatchMap, PatchOptions, PatternOptions, Photo, Picture,
  PictureOptions, Progress,
  ReadMeshOptions, ReadOptions, ReadResult, RulingField, RulingOptions, SampledMesh, SampleMeshOptions, SizedPhoto,
  SolverOptions, Surface, SurfacePicture, Unrolling, UnrollOptions, WritePdfOptions, WritePhotoOptions,
} from './types.js';
export { parseCamera } from './camera-file.js';
export * from './types.js';

/** What is not needed by everybody, each in a wasm file of its own. */
export type PartName = 'files' | 'images' | 'meshes' | 'fitmesh' | 'unroll' | 'patterns';

/** Loads the solver's wasm once; later calls (with anything) return the same promise. May be repeated after a failure. */
export function init(input?: InitInput): Promise<void>;

/**
 * Loads other parts, likewise: `load('files', 'meshes')`, or from another place, `load({ files: url })`.
 * - `files`: `read` and the `write…` functions for PNG, NPY, OBJ and MTL, photos in PNG and JPEG, `paint`, and `sampleMesh` of a
 *   mesh with textures;
 * - `images`: all other height images, and photos in WebP, GIF, BMP and TIFF;
 * - `meshes`: `readMesh`, `sampleMesh`, `backProject`, `writePly`, `writeStl` and `writeGlb`;
 * - `fitmesh`: `fitMesh`, `MeshSolver`, `analyzeMesh` and `meshRulings`;
 * - `unroll`: `analyze`, `patches`, `picture`, `draw`, `rulings`, `unroll` and `dewarp`;
 * - `patterns`: `pattern`, `patternMesh`, `hasExactFaces`, `unrollMesh`, `writeSvg`, `writePdf` and `writeDxf`.
 *
 * Where nothing can be awaited, `developable/sync` has `initSync` and `loadSync`.
 */
export function load(...parts: (PartName | Partial<Record<PartName, InitInput>>)[]): Promise<void>;

export interface WriteGlbOptions {
  /**
   * A PNG or JPEG file that the texture coordinates are about, to be embedded as it is; it takes the
   * place of colours. Default: the field's own; `null` for none.
   */
  texture?: Uint8Array | ArrayBuffer | null;
}

export interface WriteObjOptions {
  /** Name of a file that `writeMtl` has made: its picture takes the place of colours. */
  materials?: string;
}

/** A fit over a whole mesh that runs in steps. Dispose it (or use `using`) to free its memory. */
export class MeshSolver {
  constructor(mesh: Mesh, options?: MeshSolverOptions);
  /** Runs for about `milliseconds` (at least one step); true while there is more to do. */
  advance(milliseconds: number): boolean;
  /** Figures of the linearisation under way. */
  progress(): Progress;
  /** Stops; `surface()` then gives the best surface so far, marked `'cancelled'`. */
  cancel(): void;
  surface(): MeshSurface;
  readonly disposed: boolean;
  dispose(): void;
  [Symbol.dispose](): void;
}

/** A solver that runs in steps. Dispose it (or use `using`) to free its memory. */
export class Solver {
  constructor(input: HeightImage | Heightfield, options?: SolverOptions);
  /**
   * Solves the same input again with other options, from where it stands: much sooner done, where
   * they differ little. What is left out of the options has its default. Another `spacing` starts
   * from nothing. If it throws, the solver is as it was.
   */
  restart(options?: SolverOptions): void;
  /** Solves another input likewise, from where it stands if its lattice has the same shape. */
  restartWith(input: HeightImage | Heightfield, options?: SolverOptions): void;
  /** Runs for about `milliseconds` (at least one step); true while there is more to do. */
  advance(milliseconds: number): boolean;
  /** Figures of the last check. */
  progress(): Progress;
  /** Stops; `surface()` then gives the best iterate so far, marked `'cancelled'`. */
  cancel(): void;
  /** The best surface so far, as a copy. May be called at any time and repeatedly. */
  surface(): Surface;
  readonly disposed: boolean;
  /** Frees the wasm memory. Harmless when repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}

export interface DirectFitOptions extends SolverOptions {
  /** Called several times a second, and not async; `false` stops and keeps the best surface so far. */
  onProgress?: (progress: Progress) => boolean | void;
}

/** Solves to the end. */
export function fit(input: HeightImage, options?: DirectFitOptions): ImageSurface;
export function fit(input: Heightfield, options?: DirectFitOptions): LatticeSurface;
export function fit(input: HeightImage | Heightfield, options?: DirectFitOptions): Surface;
/** The occlusions in heights, to be looked at before a solve. */
export function occlusions(input: HeightImage | Heightfield, options?: OcclusionOptions): DetectedOcclusions;
/** Decodes a PNG, NPY, TIFF, EXR, PFM, NPZ, JPEG or WebP file; `readMesh` is for meshes. */
export function read(bytes: Uint8Array | ArrayBuffer, options?: ReadOptions): ReadResult;
/** What arrays an NPZ file holds, one of which `read` takes by its name. */
export function npzArrays(bytes: Uint8Array | ArrayBuffer): NpzArray[];
/** NPY file (float64) of an image or of lattice heights. */
export function writeNpy(input: HeightImage | Heightfield): Uint8Array<ArrayBuffer>;
/** 16-bit grey PNG of an image, or of the one that a surface has, whose text chunks record pixel size, height scale and offset; level 0 is no data. */
export function writePng(input: HeightImage | Surface): Uint8Array<ArrayBuffer>;
/** TIFF (float32, NaN is no data) that records the pixel size; heights are rounded to 32 bits. */
export function writeTiff(input: HeightImage | Surface): Uint8Array<ArrayBuffer>;
/** EXR (float32, channel Z, NaN is no data); heights are rounded to 32 bits. */
export function writeExr(input: HeightImage | Surface): Uint8Array<ArrayBuffer>;
/**
 * OBJ mesh: the lattice's triangles, in the units of the field and the axes of its `frame`, with
 * normals, and with the field's `colors` and `uvs`.
 */
export function writeObj(input: Heightfield | Mesh, options?: WriteObjOptions): Uint8Array<ArrayBuffer>;
/** The MTL file that goes with such an OBJ: one material, with the name of a picture's file. */
export function writeMtl(picture: string): Uint8Array<ArrayBuffer>;
/** The same mesh as PLY (binary, little-endian): positions in 64 bits, colours as bytes. */
export function writePly(input: Heightfield | Mesh): Uint8Array<ArrayBuffer>;
/** The same mesh as STL (binary): positions in 32 bits, and nothing else but each triangle's normal. */
export function writeStl(input: Heightfield | Mesh): Uint8Array<ArrayBuffer>;
/** The same mesh as GLB (binary glTF): positions in 32 bits, colours as bytes, and a texture if one is given. */
export function writeGlb(input: Heightfield | Mesh, options?: WriteGlbOptions): Uint8Array<ArrayBuffer>;
/** Decodes an OBJ, PLY, STL, glTF or GLB file, with the files beside it that it names. */
export function readMesh(bytes: Uint8Array | ArrayBuffer, options?: ReadMeshOptions): Mesh;
/**
 * What is seen of a mesh, as heights on a lattice: an input for `fit`. Textures are read as by
 * `readPhoto`, which takes `load('files')` and, but for PNG, `load('images')`.
 */
/** As in the promise API; `onProgress` may return false to stop with the best surface so far. */
export function fitMesh(
  mesh: Mesh,
  options?: MeshSolverOptions & { onProgress?: (progress: Progress) => boolean | void },
): MeshSurface;
export function sampleMesh(mesh: Mesh, options?: SampleMeshOptions): SampledMesh;
/**
 * What a depth camera has seen, as a mesh: vertex i is pixel i (so that a picture of the same size
 * gives its `colors`), and neighbours are joined but for jumps. `data` are depths in steps of
 * `depthScale` (`heightScale` and `pixelSize` do not count); NaN, `noData`, 0 and below are none.
 * The axes are x to the right, y up, z towards the viewer, the origin is the camera, so that the
 * view `'-z'` is along its axis. The texture coordinates are about a picture with the same outline.
 *
 * A jump is where one point lies behind the other by more than ten times their distance across the
 * line of sight.
 */
export function backProject(image: HeightImage, camera: Intrinsics, options?: DepthOptions): Mesh;
/**
 * Gives a surface the colours of a picture of it, and texture coordinates: where its camera, or the picture's own, sees its
 * points; without a camera those that it has, or else the picture shows what the heights show. It has as many pixels as it
 * likes. Of a file, `texture` is set, too, upright. Where the picture is transparent, and where the camera does not see,
 * colours stay as they are. Takes `load('files')`, for JPEG and WebP `load('images')`, by a camera `load('meshes')`.
 */
export function paint<F extends Heightfield>(input: F, picture: Picture, options?: PaintOptions): Painted<F>;
/** How developable a surface is: curvatures at its vertices, and a summary of them. */
export function analyze(input: HeightImage | Heightfield, options?: AnalyzeOptions): Analysis;
/** The smooth patches of a surface, and the creases between them. */
export function patches(input: HeightImage | Heightfield, options?: PatchOptions): PatchMap;
/** A surface as a picture, seen from above. Where pixels are larger than the lattice's spacing, it is sampled. */
export function picture(input: HeightImage | Heightfield, options?: PictureOptions): SurfacePicture;
/** The same on a canvas, which becomes as large as the picture. */
export function draw(canvas: Canvas, input: HeightImage | Heightfield, options?: PictureOptions): void;
/** The rulings of a surface: where it does not bend, and straight lines along that. */
export function rulings(input: HeightImage | Heightfield, options?: RulingOptions): RulingField;
/**
 * The cylinder next to heights on the lattice, of whatever profile: for curled sheets, pages of books and parallel folds,
 * whose rulings are all parallel. `report.verdict` says whether they are those of one.
 */
export function fitCylinder(input: Heightfield): FittedCylinder;
/** Lays a surface flat, as rigidly as it goes. */
export function unroll(input: HeightImage | Heightfield, options?: UnrollOptions): Unrolling;
/**
 * Cuts a surface along its creases into sheets that lie flat, with as few cuts as possible, and
 * draws them beside each other in millimetres.
 */
export function pattern(input: HeightImage | Heightfield, options?: PatternOptions): Drawing;
/** How developable a mesh is, as it is: curvatures and rulings at its vertices, and a summary of them. */
export function analyzeMesh(mesh: Mesh, options?: MeshAnalyzeOptions): MeshAnalysis;
/** The rulings of a mesh, as it is: along what its surface does not bend, and straight lines along that. */
export function meshRulings(mesh: Mesh, options?: MeshRulingOptions): MeshRulings;
/** Lays a mesh flat, as it is: in sheets, cut along its creases and where it does not lie flat otherwise. */
export function unrollMesh(mesh: Mesh, options?: MeshUnrollOptions): MeshUnrolling;
/** The same drawn in millimetres, as `pattern` does for heights. */
export function patternMesh(mesh: Mesh, options?: MeshPatternOptions): Drawing;
/**
 * Whether the faces of a mesh are exact (CAD, low-poly models), so that nothing is gained by a fit. `patternMesh` moves such faces into
 * the plane as they are.
 */
export function hasExactFaces(mesh: Mesh): boolean;
/** SVG of a drawing, in millimetres, with the layers `cut`, `mountain`, `valley`, `tab` and `label`. */
export function writeSvg(drawing: Drawing): Uint8Array<ArrayBuffer>;
/**
 * PDF of a drawing in true size, to be printed at 100 %: one page as large as the drawing, or pages
 * of paper that overlap, with crosses by which they are laid on each other.
 */
export function writePdf(drawing: Drawing, options?: WritePdfOptions): Uint8Array<ArrayBuffer>;
/** DXF (AutoCAD 2000) of a drawing, in millimetres, with the same layers in capitals. */
export function writeDxf(drawing: Drawing): Uint8Array<ArrayBuffer>;
/** Makes a photo of a surface flat. */
export function dewarp(input: HeightImage | Heightfield, photo: Photo, options?: DewarpOptions): Dewarped;
/**
 * Makes a photo of a page flat that is curled, folded or crumpled, or of the two pages of a spread, without depth: by the page's
 * corners, or by its edges, two of which are bent or all four. Without them, by those of the one page that is found in the photo.
 */
export function dewarpPage(photo: Picture | (Photo & { film35?: number }), options?: DewarpPageOptions): DewarpedPage;
export function dewarpPage(
  photo: Picture | (Photo & { film35?: number }), edges?: PageEdges | readonly PageEdges[] | PageCorners | null, options?: DewarpPageOptions,
): DewarpedPage;
/**
 * Makes a photo of any resolution flat by a page that `dewarpPage` has found in the same picture: the whole photo for a file,
 * after a reduced one for a preview. Costs little more than resampling, and differs from the preview in resolution alone.
 */
export function flattenPhoto(photo: Picture, page: FoundPage, options?: FlattenPhotoOptions): FlatPage;
/** The verdict on a flat page in a sentence, from its `report`: whether it can be trusted, why not, and how large its error is. */
export function describePage(report: PageReport): string;
/** Finds the page in a photo: its corners and edges, which can be corrected and given to `dewarpPage`. */
export function findPage(photo: Picture): PageOutlines;
/**
 * Decodes a PNG, JPEG (the way up that its Exif data state) or WebP file as RGBA bytes; all but PNG
 * take `load('images')`.
 */
export function readPhoto(bytes: Uint8Array | ArrayBuffer): DecodedPhoto;
/**
 * A photo or flat image as PNG (with alpha where something is transparent), JPEG or PDF (white there), which state
 * how large it is where that is known.
 */
export function writePhoto(photo: SizedPhoto, options?: WritePhotoOptions): Uint8Array<ArrayBuffer>;
/**
 * A PDF with a page for each picture, which is as large as fits, in the middle. Pictures are files of JPEG or PNG without
 * transparency, as `writePhoto` writes them, and are taken over without loss.
 */
export function writeBook(pages: readonly BookPage[]): Uint8Array<ArrayBuffer>;
/** One of the procedural examples. */
export function example(name: ExampleName, options?: ExampleOptions): Example;
