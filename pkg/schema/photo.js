/** Options of photos, and of cameras that have taken them. Each comment is what the types say; the default is added there. */
import { anything, choice, corners, either, extent, flag, number, numbers, optionsIn, percentage, positive, rows, text, whole } from './kinds.js';
import { LightTreatment, Unit } from './names.js';
import { unroll } from './shape.js';

/** @typedef {import('./kinds.js').Options} Options */

/** Numbers of a camera, which `Intrinsics` and `PhotoCamera` describe. @satisfies {Options} */
const seeing = {
  fx: { kind: number },
  fy: { kind: number },
  cx: { kind: number },
  cy: { kind: number },
  width: { kind: whole },
  height: { kind: whole },
  k1: { kind: number },
  k2: { kind: number },
  p1: { kind: number },
  p2: { kind: number },
  k3: { kind: number },
  depthScale: { kind: number },
  depth: { kind: choice('planar', 'ray') },
  margin: { kind: whole },
};

/** Numbers of a camera that measures depths. @satisfies {Options} */
export const camera = { ...seeing, unit: { kind: choice(...Unit) } };

/** Numbers of a camera that takes photos. @satisfies {Options} */
export const photoCamera = {
  ...seeing,
  rotation: { kind: rows(3, numbers(3, 'three numbers'), 'three rows of three numbers: a rotation matrix') },
  translation: { kind: numbers(3, 'three numbers') },
};

/** The camera of a photo. */
const otherCamera = optionsIn(photoCamera, 'must be a camera: { fx, fy, cx, cy, width, height }');

/**
 * What is known of depths besides. Images may be finer or coarser than the depths, but must show the same.
 * @satisfies {Options}
 */
export const depths = {
  /**
   * How far each depth is to be trusted. Whole numbers up to 2 are the levels that ARKit tells: 0 discards the depth, 1
   * counts a quarter, 2 counts fully. Other whole numbers are shares of the largest of their type (255 of bytes, as
   * ARCore tells), floats are weights from 0 to 1; 0 discards the depth. `fit` takes the weights over.
   */
  confidence: { kind: anything, type: 'Pixels' },
  /** Mask, as large as the depths or with the photo's proportions: depths where it is 0 are discarded. */
  mask: { kind: anything, type: 'Pixels' },
  /**
   * Corners [x, y] of the wanted part of the photo, in its pixels. Depths outside of the corners are discarded, and so are
   * small separate pieces inside, such as background seen past a bent edge. Four are the corners of a page, whose edges may
   * be bent.
   */
  crop: { kind: corners },
  /** Size of the photo that `crop` is about, in pixels. */
  photo: { kind: anything, type: '{ width: number; height: number }' },
  /**
   * The camera of the photo to which `crop` belongs, and `mask` unless it is as large as the depths. Default: the camera of the
   * depths.
   */
  camera: { kind: otherCamera, type: 'PhotoCamera' },
  /**
   * Degrees by which the depths are turned clockwise first, with all that is about them (the camera's numbers, the
   * confidence, a mask of their size), to lie as the photo does: phones store depths as the sensor lies.
   */
  turn: { kind: whole, type: '0 | 90 | 180 | 270', default: 0 },
};

/** Options of colouring a surface by a picture. @satisfies {Options} */
export const paint = {
  /**
   * The part of the plane that the picture shows: left, bottom, right, top. Default: the picture is where the surface's
   * camera sees its points, or else where its texture coordinates say; without any, as for `dewarp`.
   */
  extent: { kind: extent },
  /**
   * The camera that took the picture, for heights that were sampled from a mesh in a camera's axes, as for `dewarp`.
   * What it does not see keeps its colour.
   */
  camera: { kind: otherCamera, type: 'PhotoCamera' },
};

/** The warp map of a flat image. @satisfies {Options} */
export const mapping = {
  /** Number of pixels of the flat image per unit of length. Default: as many as the photo has of the sheet or page. */
  dots: { kind: positive, flag: { section: 'shape', value: 'D', help: 'pixels of the flat image per unit of length (default: as many as the photo has)' } },
  /** Whether the result has the full warp map, with eight bytes for each pixel. */
  map: {
    kind: flag,
    default: true,
    flag: {
      section: 'shape',
      value: 'FILE',
      help: '.npy (height, width, 2): for each pixel of the flat image its place x, y in the photo; or .json: the same for the ' +
        'points of a grid, between which it is bilinear to a quarter of a pixel',
    },
  },
  /**
   * Whether the result has the warp map on a grid as well. A number is the maximum interpolation error of the grid, in pixels of
   * the photo; `true` stands for 0.25.
   */
  grid: { kind: either(flag, positive), default: false },
};

/** Ways to treat the light of a flat image. */
const LIGHT_KIND = choice(...LightTreatment);

/** Options of making a photo of a surface flat. @satisfies {Options} */
export const dewarp = {
  ...unroll,
  ...mapping,
  /**
   * `'even'` makes paper white, without shadows and the lamp's colour, and keeps the colours of print; `'keep'` leaves the light as it
   * was photographed, as does a surface that is not mostly paper. (`dewarpPage` has the default `'even'`.)
   */
  light: {
    kind: LIGHT_KIND,
    default: 'keep',
    flag: {
      section: 'shape',
      value: 'L',
      help: "even: paper becomes white, shadows and the lamp's colour disappear, colours of print stay; keep: as " +
        'photographed (default: even for a photo of a page, keep for heights and depths)',
    },
  },
  /** Whether the flat image becomes black and white, for print: the light is evened, and each pixel becomes ink or paper. */
  ink: {
    kind: flag,
    default: false,
    flag: { section: 'shape', help: 'black and white, for print: the light is evened, and each pixel becomes ink or paper' },
  },
  /**
   * Whether the margins are cut off, which leaves the largest upright rectangle of the sheet; for a `crop` with four corners, the
   * rectangle that these are on the flat sheet.
   */
  trim: {
    kind: flag,
    default: false,
    flag: { section: 'shape', help: 'a clean rectangle: without the margins where there is no sheet, or that of the four corners of --crop' },
  },
  /** Whether the flat image is turned upright, by the sides of `crop` or by the smallest rectangle around the sheet. */
  deskew: {
    kind: flag,
    default: false,
    flag: { section: 'shape', help: 'turn the flat image upright, by the sides of --crop, or by the smallest rectangle around the sheet' },
  },
  /**
   * Corners [x, y] of the part of the photo that is wanted, in its pixels, (0, 0) the centre of the upper left one.
   * There are three or more, in order around the part. The sheet is continued up to there, by at most 6 % of the flat image's
   * longer side, and the flat image ends there. Four are the corners of a page, the upper left one as it is read first:
   * its edges are straight on the sheet, however bent they are in the photo. Default: all of it.
   */
  crop: {
    kind: corners,
    flag: {
      section: 'colours',
      value: 'x,y,x,y,x,y...',
      help: 'corners of the part of the photo that is wanted, in its pixels from the upper left; the sheet is continued ' +
        'up to there and ends there, and depths beside it are left out',
    },
  },
  /**
   * The part of the plane that the photo shows: left, bottom, right, top, in the surface's x and y and its unit of length. Default: that of the
   * height image, also of the one that a surface was made from; of heights on a lattice, what their
   * vertices cover.
   */
  extent: { kind: extent },
  /**
   * The camera that took the photo, for heights that were sampled from a mesh in a camera's axes. Default: the one that
   * has seen the depths; of other meshes, their texture coordinates say where in the photo they are.
   */
  camera: { kind: otherCamera, type: 'PhotoCamera' },
};

/** Options of flattening a photo by a page that was found in the same picture. @satisfies {Options} */
export const flattenPhoto = {
  /**
   * `'even'` makes paper white, without shadows and the lamp's colour, and keeps the colours of print; `'keep'` leaves the light as it
   * was photographed, as does a page that is dark or not mostly paper.
   */
  light: { kind: LIGHT_KIND, default: 'even' },
  /** Whether the flat image becomes black and white, for print: the light is evened, and each pixel becomes ink or paper. */
  ink: { kind: flag, default: false },
  ...mapping,
};

/** Options of making a photo of a page flat: what is known besides its edges. @satisfies {Options} */
export const dewarpPage = {
  /** The camera's focal length, in pixels of the photo. */
  focalLength: {
    kind: positive,
    flag: {
      section: 'page',
      value: 'PIXELS',
      help: "the camera's focal length, in pixels of the photo (default: what the photo's Exif data tell, or else " +
        'what the perspective tells)',
    },
  },
  /** The camera's field of view instead of `focalLength`: the angle, in degrees, that the photo's longer side covers. */
  fieldOfView: {
    kind: positive,
    flag: { section: 'page', value: 'DEGREES', help: "the same as the angle that the photo's longer side covers" },
  },
  /**
   * The focal length in millimetres, as for film of 36 by 24 mm, instead of `focalLength`. Default: the one that `readPhoto` found
   * in the file. Without any of the three it is found from the perspective, if that is strong enough.
   */
  film35: { kind: positive },
  /** Paper format of the page, of each page of a spread: a name, or width and height in millimetres. */
  page: {
    kind: either(choice('a4', 'letter'), numbers(2, 'width and height in millimetres')),
    flag: {
      section: 'page',
      value: 'P',
      help: "the page's format, each page's of a spread: a4, letter or WIDTHxHEIGHT in millimetres, in which lengths " +
        "are then (default: in the page's width)",
    },
  },
  /** A known distance on the page, in millimetres, between two places [x, y] in the photo, in pixels from the centre of the upper left one. */
  ruler: { kind: anything, type: '{ from: readonly [number, number]; to: readonly [number, number]; length: number }' },
  /**
   * Principal point, where the camera's axis meets the photo, in pixels from the centre of the upper left one. Default: the middle of the photo; for a cropped photo
   * give the middle of the whole one.
   */
  centre: { kind: numbers(2, 'two numbers: x and y in the photo') },
  /**
   * Whether to search the photo for lines of text. They make the result more exact where they agree with the edges; where
   * they do not, the verdict says so. Default: true, unless the edges of a page include `lines`.
   */
  findLines: { kind: flag },
  /**
   * Whether an edge of which only the two ends are given, as of four corners, is traced in the photo between them. False: it is
   * straight. Default: true.
   */
  traceEdges: { kind: flag },
  /**
   * Whether the outline that the edges are from is `doubtful`, as `findPage` says: then the page is no surer. Default: as the outline is
   * that is found where no edges are given.
   */
  doubtfulOutline: { kind: flag },
  ...flattenPhoto,
};

/** Options of writing a photo to a file. @satisfies {Options} */
export const writePhoto = {
  /** Format of the file. */
  format: { kind: choice('png', 'jpeg', 'pdf'), default: 'png' },
  /** Quality of the JPEG compression, in a JPEG file or a PDF, from 1 to 100. Default 90. */
  quality: {
    kind: percentage,
    flag: { section: 'shape', value: 'Q', help: 'of a .jpg, and of the picture in a .pdf: from 1 to 100 (default 90)' },
  },
  /**
   * Pixels for each millimetre of what is shown. Default: by the photo's own `resolution` and `unit`. It makes the
   * page of a PDF, and is stated in PNG (in whole pixels per metre) and JPEG (in whole pixels per inch or centimetre).
   */
  dotsPerMillimetre: { kind: positive },
  /** Title of a PDF. Default: none. */
  title: { kind: text },
};

/** Options of writing pictures to the pages of a PDF file. @satisfies {Options} */
export const writeBook = {
  title: writePhoto.title,
};
