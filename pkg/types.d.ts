/// <reference lib="esnext.disposable" />
/**
 * What the direct and the worker API share. Options are made of `schema/`, results of the structures in Rust; here is what
 * neither can say: inputs, which take many kinds of arrays, and results to which the package adds something.
 */
import type {
  AssemblyOrder, CylinderReport, DecodedPhoto, DewarpedImage, FittedHeights, FlatImage, Georeference, MeshReport, Assumption,
  PageOutlines, PageReport, PageVerdict, PageWarp, SheetDrawing, SolveReport, SurfaceImage, ThreadLimit, Unit,
} from './result-types.js';
export { DevelopableError, type ErrorCode } from './errors.js';
export * from './option-types.js';
export * from './result-types.js';

/** How far a call is that lays something flat. */
export interface CallProgress {
  /** Fraction of the work that is done, from 0 to 1. It never falls; it is an estimate, so that the pace varies. */
  fraction: number;
}

/** Any flat array of numbers; values are converted to 64-bit floats. */
export type Numbers =
  | Float64Array | Float32Array
  | Int8Array | Int16Array | Int32Array
  | Uint8Array | Uint8ClampedArray | Uint16Array | Uint32Array
  | readonly number[];

/** One flag for each pixel or vertex, or what `read` returns. A number that is neither 0 nor NaN counts as true. */
export type Flags = Numbers | readonly boolean[] | { readonly data: Numbers };

/** Conditions of a fit besides the heights: one value for each pixel of an image or vertex of a lattice. */
export interface FitConditions {
  /**
   * Confidence in each height, as a factor of its fidelity term: finite and at least 0. 1 is the weight of a height without
   * confidence; 0 leaves the height free. The confidence of an image is resampled as its heights are. Of what `read` returns,
   * whole numbers are shares of the largest of their type, and no data is no confidence. Default: 1 everywhere.
   */
  confidence?: Numbers | { readonly data: Numbers; readonly dataType?: string };
  /**
   * Heights that the surface meets exactly, in the same steps as the heights. NaN and `noData` are no constraint. A constraint
   * replaces the height at its place, and counts only within the outline.
   *
   * Without `data` or `heights` the input is a *design*: the surface passes through the constraints and is free elsewhere. Its
   * outline is the whole image or lattice, or the `mask`. A design needs three constraints that are not on one line.
   *
   * Constraints hold exactly at the vertices of the lattice. In an image each pixel with a constraint constrains the vertex
   * nearest to it, and an area of such pixels constrains all vertices in it; the height of a vertex is interpolated bilinearly
   * between the pixels around it that have a constraint.
   */
  constraints?: Numbers;
  /**
   * Occlusions: flags of places where the surface is torn. No Hessian is evaluated there, so that the surface may jump or crease
   * at no cost. A vertex has the flag of the pixel nearest to it.
   */
  occlusions?: Flags;
}

/**
 * Heights at the centres of square pixels, row by row, the top row first. In the plane x runs to the right and y up from the image's
 * lower left corner, in `unit`: the centre of the upper left pixel is at `[0.5, height - 0.5] * pixelSize`.
 */
export interface HeightImage extends FitConditions {
  /** Number of pixels in a row. */
  width: number;
  /** Number of rows of pixels. */
  height: number;
  /** `width * height` heights, in steps of `heightScale`; NaN is no data. Optional if there are `constraints`. */
  data?: Numbers;
  /** Flags of the pixels that count. Default: all pixels. */
  mask?: Flags;
  /** Value that means "no data", besides NaN. */
  noData?: number;
  /** Side length of a pixel, in `unit`. Default 1. */
  pixelSize?: number;
  /** Height of one step of `data` and `constraints`, in `unit`. Default 1. */
  heightScale?: number;
  /** Unit of all lengths, if it is known. Flat images and files get their true size by it. */
  unit?: Unit | null;
  /** Where the pixels lie on a map, as `read` returns it for a GeoTIFF; `writeImage` writes it to a TIFF. */
  georeference?: Georeference;
}

/**
 * Heights at the vertices of a hexagonal lattice, row by row, the top row first; odd rows are shifted to the left by half a
 * spacing.
 */
export interface Heightfield extends FitConditions {
  /** Number of rows of the lattice. */
  rows: number;
  /** Number of columns of the lattice. */
  cols: number;
  /** Distance between neighbouring vertices of a row, in the unit of the heights; rows are √3/2 of it apart. */
  spacing: number;
  /** `rows * cols` heights; NaN is no data. Optional if there are `constraints`. */
  heights?: Numbers;
  /** Position `[x, y]` of the vertex in row 0, column 0; `y` points up. Default `[0, 0]`. */
  origin?: readonly [number, number];
  /** Flags of the vertices that count. Default: all vertices. */
  mask?: Flags;
  /** Value that means "no data", besides NaN. */
  noData?: number;
  /**
   * Edges of the lattice across which the surface is torn, six bits for each vertex: bit 0 is the edge to the west, then follow
   * east, north-west, north-east, south-west and south-east. No Hessian is evaluated at either end of such an edge.
   */
  brokenEdges?: Uint8Array;
  /** Unit of all lengths, if it is known. */
  unit?: Unit | null;
  /** Axes of these coordinates in space; a written mesh is in the axes of space. Default: x, y and z. */
  frame?: Frame;
  /**
   * Camera that has measured the depths; a photo from the same place is registered to the surface by it. Such heights have noise:
   * by default what is rough in them is smoothed, where it may be the shape of other heights.
   */
  camera?: PhotoCamera;
  /** Red, green and blue of each vertex, from 0 to 1, for written meshes. */
  colors?: Float32Array;
  /** Texture coordinates of each vertex in shares of the picture, from its left and from its bottom, for written meshes. */
  uvs?: Float32Array;
  /** PNG or JPEG file that the texture coordinates are about, for GLB files. */
  texture?: Uint8Array;
}

/**
 * Axes of a view as unit vectors in the mesh's coordinates, at right angles to each other: a point p of the mesh has the
 * coordinates [p·right, p·up, p·towards] in the view.
 */
export interface Frame {
  /** Unit vector, in the mesh's coordinates, to the right in the view. */
  right: readonly [number, number, number];
  /** Unit vector, in the mesh's coordinates, upwards in the view. */
  up: readonly [number, number, number];
  /** Unit vector, in the mesh's coordinates, towards the viewer; heights are measured along it. */
  towards: readonly [number, number, number];
}

/** A mesh of triangles in space, or a point cloud. */
export interface Mesh {
  /** Coordinates x, y, z of each vertex. */
  positions: Float64Array;
  /** Three vertices of each triangle, counted from 0; empty for a point cloud. */
  triangles: Uint32Array;
  /** Red, green and blue of each vertex, from 0 to 1. */
  colors?: Float32Array;
  /** Texture coordinates of each vertex in shares of the picture, from its left and from its bottom. */
  uvs?: Float32Array;
  /** Pictures that the texture coordinates are about: PNG, JPEG or WebP files, or their pixels. */
  textures?: Picture[];
  /** Index in `textures` for each triangle, −1 for none. Default: 0 for all triangles. */
  textureOf?: Int32Array;
  /** Names of materials and textures that the file refers to and that were not given with it. */
  missing?: string[];
  /** What the reader assumed because the file does not say it; absent if it assumed nothing. */
  assumptions?: Assumption[];
  /** Camera that has measured the mesh, for a mesh made from a depth image. */
  camera?: PhotoCamera;
  /** Unit of all lengths, if the file states it or its size suggests it (see `assumptions`). */
  unit?: Unit | null;
  /** Confidence in each vertex, from 0 to 1. */
  confidence?: Float32Array;
}

/** A fitted mesh: the input with moved vertices, and the report. All other fields are those of the input. */
export interface MeshSurface extends Mesh {
  /** Report on the fit: what was solved, how well, and at what cost. */
  report: MeshReport;
}

/** Intrinsics of a pinhole camera, in pixels from the centre of the upper left pixel; rows count down. */
export interface Intrinsics {
  /** Horizontal focal length, in widths of a pixel. */
  fx: number;
  /** Vertical focal length, in heights of a pixel. */
  fy: number;
  /** Column of the principal point, where the camera's axis meets the image. */
  cx: number;
  /** Row of the principal point, where the camera's axis meets the image. */
  cy: number;
  /** Length of one step of the depths; 0.001 converts millimetres to metres. Default 1. */
  depthScale?: number;
  /** Unit of the depths after scaling, if it is known. Flat images and files get their true size by it. */
  unit?: Unit;
  /**
   * What depths measure: the distance along the camera's axis (`'planar'`) or from the camera itself (`'ray'`). Default
   * `'planar'`.
   */
  depth?: 'planar' | 'ray';
  /**
   * Width, in pixels, of the images that the intrinsics are for; for other images of the same proportions they are scaled.
   * Default: that of the image they are used with.
   */
  width?: number;
  /** Height, in pixels, of the images that the intrinsics are for. Default: that of the image they are used with. */
  height?: number;
  /** First radial coefficient of lens distortion, as OpenCV defines it. Default 0. */
  k1?: number;
  /** Second radial coefficient of lens distortion, as OpenCV defines it. Default 0. */
  k2?: number;
  /** First tangential coefficient of lens distortion, as OpenCV defines it. Default 0. */
  p1?: number;
  /** Second tangential coefficient of lens distortion, as OpenCV defines it. Default 0. */
  p2?: number;
  /** Third radial coefficient of lens distortion, as OpenCV defines it. Default 0. */
  k3?: number;
  /** Number of pixels that are discarded on both sides of a jump in depth, where sensors mix both depths. Default 2. */
  margin?: number;
}

/** A camera that takes photos: its intrinsics, and its pose relative to the camera that measures depths. */
export interface PhotoCamera extends Omit<Intrinsics, 'unit'> {
  /**
   * Three rows of the rotation matrix R from the depth camera to this one: a point p in the axes of the depth camera is at
   * `R p + translation` in those of this camera. x points to the right, y down and z ahead, as in OpenCV. Default: no rotation.
   */
  rotation?: readonly (readonly [number, number, number])[];
  /** Translation from the depth camera to this camera, in the unit of the depths. Default `[0, 0, 0]`. */
  translation?: readonly [number, number, number];
}

/** Values at the pixels of an image. */
export interface Pixels {
  /** Number of pixels in a row. */
  width: number;
  /** Number of rows of pixels. */
  height: number;
  /** `width * height` values, row by row, the top row first. */
  data: Numbers;
}

/** Direction of a view by name: `'-z'` looks down the z axis, so that the vertices with the largest z are in front. */
export type ViewName = '-x' | '+x' | '-y' | '+y' | '-z' | '+z' | 'best-fit';

/**
 * A mesh sampled from a view: at each vertex of a lattice the height of the first hit of a ray, NaN where there is none.
 *
 * In a point cloud a vertex sees the points within one spacing, except those more than three spacings behind the foremost one. Its
 * height is that of the plane that fits these points best, near points having more weight; its colour is that of the nearest point.
 * A vertex with points on one side only is a hole.
 */
export interface SampledMesh extends Heightfield {
  /** Position `[x, y]` of the vertex in row 0, column 0, in the axes of the view and in the mesh's unit of length; `y` points up. */
  origin: [number, number];
  /** Heights along `frame.towards`, row by row, in the mesh's unit of length; NaN at holes. */
  heights: Float64Array;
  /** Axes of the view. */
  frame: Frame;
  /** Red, green and blue of each vertex, from the texture of the triangle that was hit or else from the mesh; NaN at holes. */
  colors?: Float32Array;
  /** Texture coordinates of the mesh at each vertex; NaN at holes. */
  uvs?: Float32Array;
  /** Confidence in each height, from 0 to 1, if the mesh has a confidence. */
  confidence?: Float32Array;
  /** Texture of the mesh, if all visible triangles have the same one and it is a PNG or JPEG file. */
  texture?: Uint8Array;
  /** Share of the mesh's area that is hidden behind the heights; absent if it is less than a tenth. */
  hidden?: number;
  /** Whether the mesh has no noise, as a design or a model of few faces has none: `fitMesh` leaves it as it is. */
  noNoise: boolean;
}

/** Report of a solve in the package. */
export interface Report extends Omit<SolveReport, 'threadLimit'> {
  /** Reason why there were not more threads; `'isolation'`: the page is not cross-origin isolated. */
  threadLimit: ThreadLimit | 'isolation';
}

/** A cylinder that was fitted to heights: a surface as `fit` returns it, with a report of its own. */
export interface FittedCylinder extends Omit<LatticeSurface, 'report'> {
  /** Report on the fit of the cylinder, with a verdict. */
  report: CylinderReport;
}

/** A fitted surface. Every array is a copy that belongs to the caller. */
export interface Surface extends Omit<FittedHeights, 'report'> {
  /** Unit of all lengths, if it was known for the input. */
  unit?: Unit;
  /** Where the pixels of the input lie on a map, passed through; `writeImage` writes it to a TIFF. */
  georeference?: Georeference;
  /** Axes of the input's coordinates in space, passed through from the input. */
  frame?: Frame;
  /** Camera of the input, passed through. */
  camera?: PhotoCamera;
  /** Colours of the input's vertices, passed through. */
  colors?: Float32Array;
  /** Texture coordinates of the input's vertices, passed through. */
  uvs?: Float32Array;
  /** Texture file of the input, passed through. */
  texture?: Uint8Array;
  /** Report on the fit: what was solved, how well, and at what cost. */
  report: Report;
}

/** The fitted surface of a height image. */
export interface ImageSurface extends Surface {
  /** The surface at the pixels of the input; NaN outside of a mask, where data is missing and was not bridged, and outside of a design's outline. */
  image: SurfaceImage;
}

/** The fitted surface of heights on a lattice. */
export interface LatticeSurface extends Surface {
  image?: never;
}

/** The fitted surface of an input: with an image if the input is one. */
export type SurfaceOf<I extends HeightImage | Heightfield> = I extends HeightImage ? ImageSurface : LatticeSurface;

/** Name of a procedural example. */
export type ExampleName = 'cylinder' | 'cone' | 'roof' | 'oloid' | 'page' | 'house';

/** A generated example: a height image with noise, and the true heights. */
export interface Example {
  /** Height image with noise, to be fitted. */
  input: HeightImage & { data: Float64Array };
  /** Heights of the surface without noise at the same pixels, row by row. */
  truth: Float64Array;
}

/** An `HTMLCanvasElement` or an `OffscreenCanvas`, with a 2D context or none yet. */
export interface Canvas {
  /** Number of pixels in a row. */
  width: number;
  /** Number of rows of pixels. */
  height: number;
  /** Returns the canvas's context. */
  getContext(kind: '2d'): object | null;
}

/**
 * RGBA bytes of a picture, transparent where there is no surface: an `ImageData`, or a plain object with the same fields in
 * Node.
 */
export type SurfacePicture = DecodedPhoto &
  (typeof globalThis extends { ImageData: { prototype: infer I } } ? I : unknown);

/** RGBA bytes of an image, row by row, the top row first; an `ImageData` is one. */
export interface Photo {
  /** Number of pixels in a row. */
  width: number;
  /** Number of rows of pixels. */
  height: number;
  /** `4 * width * height` bytes: red, green, blue and alpha of each pixel, from 0 to 255. */
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

/**
 * Four corners of a page in a photo's pixels: upper left, upper right, lower right, lower left, as the page is read. The edges
 * between them are traced in the photo, unless the option `traceEdges` is false.
 */
export type PageCorners = readonly [
  readonly [number, number], readonly [number, number], readonly [number, number], readonly [number, number],
];

/** A photo's file as bytes, or its pixels. */
export type Picture = Uint8Array | ArrayBuffer | Photo;

/** A photo that may state the size of what it shows, as flat images do. */
export interface SizedPhoto extends Photo {
  /** Number of pixels per unit of length. */
  resolution?: number;
  /** Unit of length of `resolution`: `'page'` is the width of a page whose true size is not known. */
  unit?: Unit | 'page';
}

/** One page of a PDF file. */
export interface BookPage {
  /** A JPEG or PNG file, as `writePhoto` writes it; it is white where it is transparent. */
  picture: Uint8Array | ArrayBuffer;
  /** Width and height of the page, in millimetres. */
  size: readonly [number, number];
  /**
   * Words in the picture, in the order in which they are read. They lie over it as text that is not seen, so that the page can be
   * searched and copied from.
   */
  words?: readonly BookWord[];
}

/** A word that was recognised in the picture of a page (OCR), or a line of several. */
export interface BookWord {
  /** Its characters, of any script. A word of white space alone is left out. */
  text: string;
  /** Left, top, width and height, in pixels of the picture, from the picture's upper left corner. */
  box: readonly [left: number, top: number, width: number, height: number];
}

/** A surface in the colours of a picture, with texture coordinates for it. */
export type Painted<F> = F & { uvs: Float32Array; colors: Float32Array; texture?: Uint8Array };

/**
 * Material that a pattern is made from, in millimetres: paper (a printer leaves a margin of ten millimetres blank), plates of a
 * width and a height, or a roll of a width; five millimetres at the edges of plates and rolls stay free.
 */
export type Stock = 'a4' | 'letter' | readonly [width: number, height: number] | readonly [width: number];

/**
 * A drawing of a pattern, in millimetres: x points to the right and y up from the lower left corner. The sides of a sheet are where
 * the extrapolated patches meet; cut creases have the same letter on both sides.
 */
export interface Drawing extends SheetDrawing {
  /** How the sheets are put together, if the option `assembly` asks for it. */
  assembly?: Assembly;
  /** The textures that are printed on the sheets, by their numbers, if the option `printed` asks for it. */
  textures?: TextureFile[];
}

/** A texture to be printed. */
export interface TextureFile {
  /** JPEG file of three channels. */
  jpeg: Uint8Array;
  /** Width in pixels. */
  width: number;
  /** Height in pixels. */
  height: number;
}

/** How sheets are put together: the order of steps, and two files that show it. */
export interface Assembly extends AssemblyOrder {
  /** Coordinates x, y, z of each vertex of the sheets once they are put together, in the surface's unit. */
  positions: Float64Array<ArrayBuffer>;
  /** Three vertices of the sheets for each of their triangles, counted from 0. */
  triangles: Uint32Array<ArrayBuffer>;
  /** Number of the sheet of each vertex, from 0; names of sheets count from 1. */
  sheets: Uint32Array<ArrayBuffer>;
  /** GLB file in metres, with +y up: flat sheets that move to their places one after the other, in the animation `Assembly`. */
  model: Uint8Array<ArrayBuffer>;
  /** SVG file: the surface from above, with sheets in the colours of the model and the drawing's numbers and letters. */
  picture: Uint8Array<ArrayBuffer>;
}

/** One way to make a pattern of an input. */
export interface PatternPlan {
  /** Weight λ of the fitted surface. */
  lambda: number;
  /** Minimum size of a patch, as a share of all vertices, of a mesh as a share of its area. */
  smallest: number;
  /** Root mean square distance of the surface from the input, in the input's unit of length. */
  distance: number;
  /** Time for the fit and the pattern, in seconds; the fit counts for each plan with its λ. */
  seconds: number;
  /** The pattern, with numbers of sheets and folds, lengths of cuts and strain in its `summary`; absent if there is a `problem`. */
  drawing?: Drawing;
  /** Why there is no pattern: a part that no cut lays flat within the limits, and where it is. */
  problem?: string;
}

/** Patterns of one input at several λ and minimum sizes of patches. */
export interface ExploredPatterns {
  /** The plans that were tried, in order: plans with smaller λ and with larger patches come later. */
  plans: PatternPlan[];
  /** First plan with at most as many sheets as the option `sheets` allows; absent without that option or without such a plan. */
  chosen?: PatternPlan;
}

/** A photo made flat by the surface that it shows: the flat image, with its warp map and a verdict. */
export interface Dewarped extends DewarpedImage {
  /** Unit of length of `resolution` and `corner`, if that of the surface is known. */
  unit?: Unit;
}

/**
 * An edge as traced in a photo from one corner of the page to the next, in pixels from the centre of the upper left one: points with
 * a smooth edge between them, or control points of cubic Bézier curves that follow each other (4, 7, 10 and so on).
 */
export type EdgeTrace = readonly (readonly [number, number])[] | { beziers: readonly (readonly [number, number])[] };

/**
 * The two edges of a page that are bent, from corner to corner: each from left to right (`top`, `bottom`) or from top to bottom
 * (`left`, `right`). Or all four edges: which two are bent is detected, and the straight ones check the page. An edge of which
 * only the two ends are given is traced in the photo.
 */
export type PageEdges = (
  | { top: EdgeTrace; bottom: EdgeTrace; left?: undefined; right?: undefined }
  | { left: EdgeTrace; right: EdgeTrace; top?: undefined; bottom?: undefined }
  | { top: EdgeTrace; bottom: EdgeTrace; left: EdgeTrace; right: EdgeTrace }
) & {
  /**
   * At most 500 lines of text, traced from where they begin to where they end. They are level on the flat page: they check it, and
   * show folds between the edges. Without this list lines are detected in the photo; an empty list says that there are none.
   */
  lines?: readonly EdgeTrace[];
};

/** The flat image of a page, or of both pages of a spread side by side. */
export interface FlatPage extends FlatImage {
  /** Width and height of the flat page, or of both pages together, in `unit`. */
  size: [number, number];
  /** Unit of all lengths: millimetres if a format or a ruler is given, else the width of a page. */
  unit: 'mm' | 'page';
}

/** What `flattenPhoto` needs of a page that was found in a photo; a `DewarpedPage` has it. */
export interface FoundPage extends Pick<FlatPage, 'size' | 'unit'> {
  /** Warp map of the page by shares. */
  warp: PageWarp;
}

/** A flat page, or both pages of a spread side by side, with the page in space and a verdict. */
export interface DewarpedPage extends FlatPage {
  /** Warp map by shares, with which `flattenPhoto` flattens the same picture at another resolution. */
  warp: PageWarp;
  /**
   * The page in space, with texture coordinates for the photo, to be sampled (`{ view: 'best-fit' }`), shown and written: x points to
   * the right and y up; the camera is at the origin and looks along −z.
   */
  mesh: Mesh & { triangles: Uint32Array; uvs: Float32Array };
  /**
   * Detected lines of text, a list for each page, from left to right or from top to bottom: points below the letters, in pixels of the
   * photo. Empty if none were detected.
   */
  lines: [number, number][][][];
  /** Edges of each page by which it was found: those that were given, or traced in the photo. An edge of two points is straight. */
  edges: PageEdges[];
  /** Whether the flat page can be trusted. */
  verdict: PageVerdict;
  /** Report on the page: its model, expected error and what supports it. */
  report: PageReport;
  /** Outlines of pages that were found in the photo, if no edges were given. */
  outline?: PageOutlines;
}

/** A `WebAssembly.Module`; these types also compile without TypeScript's library for the DOM, which declares that namespace. */
export type WasmModule = typeof globalThis extends { WebAssembly: { Module: { prototype: infer M } } } ? M : object;

/**
 * Source of a wasm file: its address, a response, its bytes or a compiled module. Default: the file beside the package's
 * modules.
 */
export type InitInput =
  | string | URL | Response | ArrayBuffer | ArrayBufferView | WasmModule
  | Promise<Response | ArrayBuffer | ArrayBufferView | WasmModule>;

/** Options of writing an OBJ file. */
export interface WriteObjOptions {
  /** Name of a file that `writeMtl` has written; its picture replaces colours. */
  materials?: string;
}
