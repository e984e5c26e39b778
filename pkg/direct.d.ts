/**
 * The synchronous API: runs where it is called. Meant for workers and Node; in a page it blocks.
 * @module developable/direct
 */
import type {
  CallProgress,
  Analysis, AnalyzeOptions, BookPage, Canvas, DecodedPhoto, DepthOptions, DetectedOcclusions, Dewarped, DewarpedPage, DewarpOptions,
  DewarpPageOptions, Drawing, Example, ExampleName, ExampleOptions, FittedCylinder, FlatPage, FlattenPhotoOptions, PageCorners, PageReport, FoundPage, Heightfield, HeightImage, ImageSurface, InitInput, Intrinsics, LatticeSurface, Mesh, MeshAnalysis, MeshAnalyzeOptions,
  MeshPatternOptions, MeshRulingOptions, MeshRulings, MeshSolverOptions, MeshSurface, MeshUnrolling, MeshUnrollOptions, NpzArray, RecognizedMesh,
  OcclusionOptions, PageEdges, PageOutlines, Painted, PaintOptions, PatchMap, PatchOptions, PatternOptions, Photo, Picture,
  PictureOptions, Progress,
  ReadMeshOptions, ReadOptions, ReadResult, RulingField, RulingOptions, SampledMesh, SampleMeshOptions, SizedPhoto,
  SolverOptions, Surface, SurfacePicture, Unrolling, UnrollOptions, WriteBookOptions, WritePdfOptions, WritePhotoOptions,
} from './types.js';
export { parseCamera } from './camera-file.js';
export * from './types.js';

/** Name of a part that is loaded when it is needed, each from a wasm file of its own. */
export type PartName = 'files' | 'images' | 'meshes' | 'fitmesh' | 'unroll' | 'patterns';

/**
 * Loads the solver's wasm once; later calls, with any argument, return the same promise. It may be repeated after a
 * failure.
 */
export function init(input?: InitInput): Promise<void>;

/**
 * Loads other parts once each: `load('files', 'meshes')`, or from another place, `load({ files: url })`.
 * - `files`: `read` and the `write…` functions for PNG, NPY, OBJ and MTL, photos in PNG and JPEG, `paint`, and `sampleMesh` of a
 *   mesh with textures;
 * - `images`: all other height images, and photos in WebP, GIF, BMP and TIFF;
 * - `meshes`: `readMesh`, `sampleMesh`, `backProject`, `writePly`, `writeStl` and `writeGlb`;
 * - `fitmesh`: `fitMesh`, `MeshSolver`, `analyzeMesh` and `meshRulings`;
 * - `unroll`: `analyze`, `patches`, `picture`, `draw`, `rulings`, `unroll` and `dewarp`;
 * - `patterns`: `pattern`, `patternMesh`, `recognizeMesh`, `unrollMesh`, `writeSvg`, `writePdf` and `writeDxf`.
 *
 * Where nothing can be awaited, `developable/sync` has `initSync` and `loadSync`.
 */
export function load(...parts: (PartName | Partial<Record<PartName, InitInput>>)[]): Promise<void>;

/** Options of writing a GLB file. */
export interface WriteGlbOptions {
  /**
   * PNG or JPEG file that the texture coordinates are about. It is embedded as it is, and replaces colours. Default: the texture
   * of the mesh or surface; `null` for none.
   */
  texture?: Uint8Array | ArrayBuffer | null;
}

/** Options of writing an OBJ file. */
export interface WriteObjOptions {
  /** Name of a file that `writeMtl` has written; its picture replaces colours. */
  materials?: string;
}

/** Fit of a whole mesh that runs in steps. Dispose of it (or use `using`) to free its memory. */
export class MeshSolver {
  /** Prepares the fit of a mesh. */
  constructor(mesh: Mesh, options?: MeshSolverOptions);
  /** Runs for about `milliseconds`, at least one step; returns whether there is more to do. */
  advance(milliseconds: number): boolean;
  /**
   * Returns the progress of the fit, which solves several problems in turn: `objective`, `dualBound`, `gap` and `rho` are those of the
   * current one, iterations count over all of them, and `level` is the number of problems still to come at most.
   */
  progress(): Progress;
  /** Stops the fit; `surface()` then returns the best surface of the pass under way, with the stop reason `'cancelled'`. */
  cancel(): void;
  /**
   * Returns the mesh after the last finished pass, or as it was when the fit was cancelled, as a copy. Before the first pass has ended it
   * is the input.
   */
  surface(): MeshSurface;
  /** Whether the solver was disposed of, after which its methods throw. */
  readonly disposed: boolean;
  /** Frees the memory in the wasm. It may be repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/** Fit of heights that runs in steps. Dispose of it (or use `using`) to free its memory. */
export class Solver {
  /** Prepares the fit of an input. */
  constructor(input: HeightImage | Heightfield, options?: SolverOptions);
  /**
   * Restarts with other options on the same input, warm-started from the current surface, which takes less time if they differ
   * little. Options that are left out have their defaults. Another `spacing` is a cold start. If this throws, nothing has changed.
   */
  restart(options?: SolverOptions): void;
  /** Restarts with another input, warm-started from the current surface if the lattices have the same shape. */
  restartWith(input: HeightImage | Heightfield, options?: SolverOptions): void;
  /** Runs for about `milliseconds`, at least one step; returns whether there is more to do. */
  advance(milliseconds: number): boolean;
  /** Returns the figures of the last check. */
  progress(): Progress;
  /** Stops the fit; `surface()` then returns the best surface of the pass under way, with the stop reason `'cancelled'`. */
  cancel(): void;
  /** Returns the best surface so far, as a copy. It may be called at any time. */
  surface(): Surface;
  /** Whether the solver was disposed of, after which its methods throw. */
  readonly disposed: boolean;
  /** Frees the memory in the wasm. It may be repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/** Option of the calls that take longest. */
export interface Watched {
  /** Function that is called several times a second; it must not be async. If it throws, so does the call, when its work has ended. */
  onProgress?: (progress: CallProgress) => void;
}

/** Options of a fit that runs where it is called. */
export interface DirectFitOptions extends SolverOptions {
  /**
   * Function that is called several times a second; it must not be async. If it returns false the fit stops with the best
   * surface so far.
   */
  onProgress?: (progress: Progress) => boolean | void;
}

/**
 * Fits a piecewise developable surface to heights: smooth pieces that could be laid flat as paper can, without stretching, which meet at
 * creases. `report.gap` is a proven bound: the objective is above its minimum by at most this share of itself.
 */
export function fit(input: HeightImage, options?: DirectFitOptions): ImageSurface;
/**
 * Fits a piecewise developable surface to heights: smooth pieces that could be laid flat as paper can, without stretching, which meet at
 * creases. `report.gap` is a proven bound: the objective is above its minimum by at most this share of itself.
 */
export function fit(input: Heightfield, options?: DirectFitOptions): LatticeSurface;
/**
 * Fits a piecewise developable surface to heights: smooth pieces that could be laid flat as paper can, without stretching, which meet at
 * creases. `report.gap` is a proven bound: the objective is above its minimum by at most this share of itself.
 */
export function fit(input: HeightImage | Heightfield, options?: DirectFitOptions): Surface;
/**
 * Detects occlusions in heights: places where the surface is torn. `fit` takes them as `occlusions` and `brokenEdges`.
 */
export function occlusions(input: HeightImage | Heightfield, options?: OcclusionOptions): DetectedOcclusions;
/**
 * Decodes a file of heights: PNG, NPY, TIFF, EXR, PFM, PGM, NPZ, JPEG, WebP, text, SRTM heights or a depth map of COLMAP. Meshes are read
 * by `readMesh`.
 */
export function read(bytes: Uint8Array | ArrayBuffer, options?: ReadOptions): ReadResult;
/**
 * Detects the format of a file of heights, a photo or a mesh by what is in it, and returns its name, such as `'png'` or `'stl'`;
 * `undefined` for other files.
 */
export function formatOf(bytes: Uint8Array | ArrayBuffer): string | undefined;
/** Lists the arrays of an NPZ file, one of which `read` takes by its name. It throws with code `FORMAT` for another file. */
export function npzArrays(bytes: Uint8Array | ArrayBuffer): NpzArray[];
/**
 * Writes heights, of an image or on a lattice, to an NPY file of 64-bit floats with as many rows and columns, the top row first: in the
 * unit of lengths (of an image steps times `heightScale`), and NaN for no data. Of a surface it writes the lattice; `surface.image` are
 * its pixels.
 */
export function writeNpy(input: HeightImage | Heightfield): Uint8Array<ArrayBuffer>;
/**
 * Writes an image, or the image of a surface, to a 16-bit grey PNG file. Its text chunks state pixel size, height scale
 * and offset, which `read` takes; level 0 is no data. A surface without an image throws with code `INPUT`.
 */
export function writePng(input: HeightImage | Surface): Uint8Array<ArrayBuffer>;
/**
 * Writes an image, or the image of a surface, to a TIFF file of 32-bit floats in the unit of lengths (steps times `heightScale`), with the
 * pixel size and the georeference if there is one; NaN is no data. A surface without an image throws with code `INPUT`.
 */
export function writeTiff(input: HeightImage | Surface): Uint8Array<ArrayBuffer>;
/** Writes an image, or the image of a surface, likewise to an EXR file of 32-bit floats in the channel Z. */
export function writeExr(input: HeightImage | Surface): Uint8Array<ArrayBuffer>;
/**
 * Writes a mesh, or the triangles of a heightfield, to an OBJ file with normals, colours and texture coordinates: in
 * the axes of its `frame`, in its unit of length.
 */
export function writeObj(input: Heightfield | Mesh, options?: WriteObjOptions): Uint8Array<ArrayBuffer>;
/** Writes an MTL file of one material for an OBJ file. `picture` is the name of the texture's file. */
export function writeMtl(picture: string): Uint8Array<ArrayBuffer>;
/**
 * Writes a mesh, or the triangles of a heightfield, to a binary PLY file: positions as 64-bit floats, colours as bytes.
 */
export function writePly(input: Heightfield | Mesh): Uint8Array<ArrayBuffer>;
/**
 * Writes a mesh, or the triangles of a heightfield, to a binary STL file: positions as 32-bit floats and a normal for
 * each triangle.
 */
export function writeStl(input: Heightfield | Mesh): Uint8Array<ArrayBuffer>;
/**
 * Writes a mesh, or the triangles of a heightfield, to a GLB file (binary glTF): positions as 32-bit floats, colours as
 * bytes, and a texture if one is given.
 */
export function writeGlb(input: Heightfield | Mesh, options?: WriteGlbOptions): Uint8Array<ArrayBuffer>;
/**
 * Decodes a mesh file: OBJ, PLY, STL, glTF, GLB, 3MF, OFF or points in text (XYZ). Polygons become triangles; a file of points alone becomes
 * a point cloud.
 */
export function readMesh(bytes: Uint8Array | ArrayBuffer, options?: ReadMeshOptions): Mesh;
/**
 * What is seen of a mesh, as heights on a lattice: an input for `fit`. Textures are read as by
 * `readPhoto`, which takes `load('files')` and, but for PNG, `load('images')`.
 */
/**
 * Fits a piecewise developable surface to a whole mesh, by moving its vertices: no view is needed, and the mesh may be
 * closed, overhanging, open or in several parts. It must be a surface; otherwise the code is `TOPOLOGY` and the message
 * says where. `confidence` of the mesh weighs how closely each vertex is followed. `onProgress` may return false to
 * stop with the best surface so far.
 */
export function fitMesh(
  mesh: Mesh,
  options?: MeshSolverOptions & { onProgress?: (progress: Progress) => boolean | void },
): MeshSurface;
/** Samples a mesh or point cloud from a view: returns heights at the vertices of a lattice, which `fit` takes. */
export function sampleMesh(mesh: Mesh, options?: SampleMeshOptions): SampledMesh;
/**
 * Makes a mesh of the depth image of a camera. Vertex i is pixel i, so that an image of the same size gives its
 * `colors`; neighbouring pixels are joined except at jumps, where one point is behind the other by more than ten times
 * their distance across the line of sight. `data` are depths in steps of `depthScale` (`heightScale` and `pixelSize` do
 * not count); NaN, `noData` and depths of 0 or less are none. The camera is at the origin; x points to the right, y up
 * and z to the viewer, so that the view `'-z'` is along the camera's axis.
 */
export function backProject(image: HeightImage, camera: Intrinsics, options?: DepthOptions): Mesh;
/**
 * Returns a copy of a surface with the colours of a picture of it, and with texture coordinates. The place of a point in the picture
 * follows from the option `extent`, else from the option `camera` or the surface's own camera, else from the surface's texture
 * coordinates; without any of these the picture shows the same rectangle as the heights. The picture may have any resolution; if it
 * is a file, `texture` is set as well. Colours stay as they are
 * where the picture is transparent or the camera does not see the surface. It needs `load('files')`, for WebP pictures
 * `load('images')`, and with a camera `load('meshes')`.
 */
export function paint<F extends Heightfield>(input: F, picture: Picture, options?: PaintOptions): Painted<F>;
/**
 * Computes curvatures at a surface's vertices, and statistics that say how developable the surface is. The surface is taken as it is,
 * without a fit: give it what `fit` returned.
 */
export function analyze(input: HeightImage | Heightfield, options?: AnalyzeOptions): Analysis;
/** Segments a surface into smooth patches, and finds the creases between them. The surface is taken as it is, without a fit. */
export function patches(input: HeightImage | Heightfield, options?: PatchOptions): PatchMap;
/**
 * Draws a surface, seen from above, to an image of RGBA bytes. Where pixels are larger than the lattice's spacing, the
 * surface is sampled.
 */
export function picture(input: HeightImage | Heightfield, options?: PictureOptions): SurfacePicture;
/** Draws a surface, seen from above, on a canvas, which is resized to the picture. */
export function draw(canvas: Canvas, input: HeightImage | Heightfield, options?: PictureOptions): void;
/**
 * Computes the rulings of a surface: at each vertex the direction in which it does not bend, and straight lines along
 * these directions. The surface is taken as it is, without a fit.
 */
export function rulings(input: HeightImage | Heightfield, options?: RulingOptions): RulingField;
/**
 * Fits a cylinder with any profile to heights on a lattice: for curled sheets, pages of books and parallel folds, whose
 * rulings are all parallel. `report.verdict` says whether the surface is a cylinder. Heights count by their `confidence` and `mask`;
 * `constraints` and `occlusions` do not count.
 */
export function fitCylinder(input: Heightfield): FittedCylinder;
/** Lays a surface flat without cuts, with as little strain as possible. */
export function unroll(input: HeightImage | Heightfield, options?: UnrollOptions & Watched): Unrolling;
/**
 * Makes a pattern of a surface: cuts it along creases into sheets that lie flat, with as few cuts as possible, and
 * draws the sheets side by side in millimetres.
 */
export function pattern(input: HeightImage | Heightfield, options?: PatternOptions & Watched): Drawing;
/** Computes curvatures and rulings at the vertices of a mesh, and statistics that say how developable the mesh is. */
export function analyzeMesh(mesh: Mesh, options?: MeshAnalyzeOptions): MeshAnalysis;
/**
 * Computes the rulings of a mesh: at each vertex the direction in which it does not bend, and straight lines along
 * these directions.
 */
export function meshRulings(mesh: Mesh, options?: MeshRulingOptions): MeshRulings;
/** Lays a mesh flat: cuts it into sheets along its creases, and where it does not lie flat otherwise. */
export function unrollMesh(mesh: Mesh, options?: MeshUnrollOptions & Watched): MeshUnrolling;
/**
 * Makes a pattern of a mesh: cuts it into sheets that lie flat, and draws them side by side in millimetres, as
 * `pattern` does for heights.
 */
export function patternMesh(mesh: Mesh, options?: MeshPatternOptions & Watched): Drawing;
/**
 * Says what `kind` a mesh is: of exact flat faces, of noisy flat faces, without noise (which a fit would not improve), or noisy. If
 * it is closed, exact and bent of sheet metal, the metal's `thickness` is returned as well.
 */
export function recognizeMesh(mesh: Mesh): RecognizedMesh;
/** Writes a drawing to an SVG file in millimetres, with the layers `picture`, `cut`, `mountain`, `valley`, `tab` and `label`. */
export function writeSvg(drawing: Drawing): Uint8Array<ArrayBuffer>;
/**
 * Writes a drawing to a PDF file in true size, to be printed at 100 %: one page as large as the drawing, or pages of
 * paper that overlap, with crosses by which they are laid on each other.
 */
export function writePdf(drawing: Drawing, options?: WritePdfOptions): Uint8Array<ArrayBuffer>;
/** Writes a drawing to a DXF file (AutoCAD 2000) in millimetres, with the layers of the SVG file in capitals. */
export function writeDxf(drawing: Drawing): Uint8Array<ArrayBuffer>;
/** Makes a photo of a surface flat, by laying the surface flat. */
export function dewarp(input: HeightImage | Heightfield, photo: Photo, options?: DewarpOptions): Dewarped;
/**
 * Makes a photo of a curled, folded or crumpled page flat, or of both pages of a spread, without depths. It detects the edges of the
 * clearest page in the photo, and throws with code `NO_PAGE` if there is none. Edges that are known are given by the other overload.
 */
export function dewarpPage(photo: Picture | (Photo & { film35?: number }), options?: DewarpPageOptions & Watched): DewarpedPage;
/**
 * Makes a photo of a curled, folded or crumpled page flat, or of both pages of a spread, without depths. `edges` are the four corners
 * of the page, its two bent edges (`top` and `bottom`, or `left` and `right`), or all four edges; for a spread they are a list, the
 * left page first. Without `edges` they are detected, as in the other overload. Coordinates are in pixels of the photo as `readPhoto`
 * decodes it, from the centre of the upper left pixel. Edges that do not outline a page, as when they cross, throw with code `EDGES`;
 * edges that no sheet of paper can have give the verdict `'notThisKind'`.
 */
export function dewarpPage(
  photo: Picture | (Photo & { film35?: number }), edges?: PageEdges | readonly PageEdges[] | PageCorners | null, options?: DewarpPageOptions & Watched,
): DewarpedPage;
/**
 * Makes a photo of any resolution flat by a page that `dewarpPage` found in the same picture: the whole photo for a
 * file, say, after a reduced one for a preview. It costs little more than resampling, and differs from the preview in
 * resolution alone.
 */
export function flattenPhoto(photo: Picture, page: FoundPage, options?: FlattenPhotoOptions): FlatPage;
/** Returns the verdict on a flat page as a sentence: whether it can be trusted, why not, and how large its error is. */
export function describePage(report: PageReport): string;
/**
 * Finds the page in a photo: its corners and edges, which can be corrected and given to `dewarpPage`. Coordinates are in pixels of
 * the photo as `readPhoto` decodes it (upright; a file of more than 26 megapixels is reduced, its sides divided by a whole number), from the centre of the
 * upper left pixel. Without a page the verdict is `'notFound'`, and `pages` has the best guess, if there is one.
 */
export function findPage(photo: Picture): PageOutlines;
/**
 * Decodes a photo: JPEG, PNG, WebP, GIF, BMP or TIFF. It is turned upright by its Exif data, which also give its focal
 * length. It needs `load('files')`, for other files than JPEG and PNG `load('images')`.
 */
export function readPhoto(bytes: Uint8Array | ArrayBuffer): DecodedPhoto;
/**
 * Writes a photo or a flat image to a PNG, JPEG or PDF file. Transparent pixels stay so in a PNG file and are white in the
 * others. The file states the true size if that is known.
 */
export function writePhoto(photo: SizedPhoto, options?: WritePhotoOptions): Uint8Array<ArrayBuffer>;
/**
 * Writes a PDF file with one page for each entry, of the entry's `size`, on which its picture is centred and as large as fits. Pictures
 * are JPEG files, or PNG files without transparency, and are taken over without loss; others throw with code `UNSUPPORTED`.
 */
export function writeBook(pages: readonly BookPage[], options?: WriteBookOptions): Uint8Array<ArrayBuffer>;
/** Generates a procedural example: a height image with noise, and the true heights. */
export function example(name: ExampleName, options?: ExampleOptions): Example;
