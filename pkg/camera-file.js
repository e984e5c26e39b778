/** Cameras from the files that programs for capturing and calibrating write. Documented in `camera-file.d.ts`. */
import { cameraTree } from './camera-text.js';
import { DevelopableError } from './errors.js';
import { count } from './input.js';
import { isRecord, reading, record } from './values.js';

/** @typedef {import('./types.js').PhotoCamera} PhotoCamera */
/** @typedef {{ width: number, height: number }} Size */
/** @typedef {Record<string, unknown>} Fields */
/** @typedef {{ camera: PhotoCamera, lens?: string }} Found a camera, and the name of its lens if the camera's numbers do not describe it */

const FORMS =
  'focal lengths and the axis (fx, fy, cx, cy, or fl_x, fl_y as in transforms.json), a matrix of three rows, four numbers, ' +
  'or a field of view, as JSON, CSV, YAML, XML, INI or as COLMAP writes it';

/** How far from the middle of an image the axis of its camera may be, as a share of the image's sides. */
const FARTHEST_AXIS = 0.25;

/** By how much the axis of another camera of a file must be nearer to the middle for that one to be preferred. */
const SURELY_NEARER = 0.1;

/** @type {typeof import('./camera-file.js').parseCamera} */
export function parseCamera(given, images = []) {
  const sizes = sizesOf(images);
  const cameras = camerasOf(cameraTree(given), sizes);
  if (cameras.length === 0) throw new DevelopableError('FORMAT', `there is no camera in it: it should have ${FORMS}`);
  const fits = cameras.map(({ camera, lens }) => {
    const stated = camera.width !== undefined && camera.height !== undefined;
    const ranked = sizes.map((size) => ({ size, off: stated ? misfit(camera, size) : axisOff(camera, size) }));
    const [nearest] = ranked.sort((a, b) => a.off - b.off);
    return { camera, lens, stated, size: nearest?.size, off: nearest?.off ?? 0 };
  });
  // Of several cameras the first one that is about as good as the best: left of a pair, the first of many frames.
  const least = Math.min(...fits.map(({ off }) => off));
  const near = fits.filter(({ off }) => off <= least + SURELY_NEARER);
  const [{ lens: foreign, camera: first }] = near;
  // One after a lens that is not known here is not meant instead unless its images have another size.
  const other = near.find(({ lens, camera }) => lens === undefined && (camera.width !== first.width || camera.height !== first.height));
  const best = (foreign !== undefined && other) || near[0];
  if (best.lens !== undefined) {
    throw problem(`its lens (${best.lens}) bends the picture in a way that is not known here: undistort the images by the program that made it`);
  }
  if (best.stated || best.size === undefined) return best.camera;
  const { camera, size: { width, height } } = best;
  if (best.off <= FARTHEST_AXIS) return { ...camera, width, height };
  throw problem(
    `the camera looks at (${camera.cx}, ${camera.cy}), which is far from the middle of ` +
      `${sizes.map((size) => `${size.width} × ${size.height}`).join(' and of ')} pixels: ` +
      'say in it which width and height its numbers are for',
  );
}

/** @param {string} words */
function problem(words) {
  return new DevelopableError('INPUT', words);
}

/** @param {PhotoCamera} camera @param {Size} size */
function axisOff({ cx, cy }, { width, height }) {
  return Math.max(Math.abs(cx / width - 0.5), Math.abs(cy / height - 0.5));
}

/**
 * How far the size that a camera states is from that of an image, up to a common factor.
 * @param {PhotoCamera} camera
 * @param {Size} size
 */
function misfit({ width = 1, height = 1 }, size) {
  const finer = Math.log(size.width / width);
  return Math.abs(Math.log(size.height / height) - finer) + Math.min(Math.abs(finer), 1) / 4;
}

/** @param {unknown} images */
function sizesOf(images) {
  return reading('INPUT', 'the images', () => {
    if (!Array.isArray(images)) throw new DevelopableError('INPUT', 'the images must be a list of { width, height }');
    return images.map((image) => {
      const { width, height } = record('INPUT', 'an image', image, ['width', 'height']);
      return { width: count('width', width), height: count('height', height) };
    });
  });
}

/**
 * All cameras of a file: one of its own, or those of the parts that it has, which have its fields, too.
 * @param {unknown} part
 * @param {Size[]} images
 * @param {Fields} [around] fields of what the part is in
 * @returns {Found[]}
 */
function camerasOf(part, images, around = {}) {
  if (typeof part !== 'object' || part === null) return [];
  if (Array.isArray(part)) {
    const own = cameraOf({ ...around, k: part }, images);
    return own ? [own] : part.flatMap((inner) => (Array.isArray(inner) ? [] : camerasOf(inner, images, around)));
  }
  const named = plainFields(part);
  const fields = Object.assign({}, around, ...groupsBeside(named), named);
  const own = cameraOf(fields, images);
  if (own) return [own];
  const inherited = Object.fromEntries(Object.entries(fields).filter(([name, value]) => typeof value !== 'object' || [...LENS, 'resolution'].includes(name)));
  return Object.values(part).flatMap((inner) => camerasOf(inner, images, inherited));
}

/** What some programs say of lens and image in groups beside the camera. @param {Fields} named @returns {Fields[]} */
function groupsBeside(named) {
  const beside = Object.entries(named).filter(([name, value]) => /^(dist|coeff|image|resolution|size)/.test(name) && isRecord(value));
  return beside.map(([, group]) => plainFields(Object(group))).flatMap((group) => [...groupsBeside(group), group]);
}

/**
 * Fields by names without what programs write differently: `Camera.fx`, `Camera_Matrix` and `cameraMatrix1` are `fx` and
 * `cameramatrix`.
 * @param {object} part
 * @returns {Fields}
 */
function plainFields(part) {
  return Object.fromEntries(Object.entries(part).map(([name, value]) => [
    name.replace(/^.*\./, '').replace(/[_\s-]/g, '').toLowerCase()
      .replace(/^left(camera|distort|distcoeff|intrinsic)/, '$1').replace(/(matrix|coeffs?|coefficients|intrinsics?)(1|l|left)$/, '$1').replace(/fovdeg(rees)?$/, 'fov'),
    value,
  ]));
}

/** Plain names of the matrix of a camera; the last ones are those of rectified images. */
const MATRIX = ['k', 'intrinsicmatrix', 'cameramatrix', 'intrinsics', 'intrinsic', 'mtx', 'm1', 'projectionmatrix', 'p', 'p0'];

/** Plain names of the list of a lens' distortion, in OpenCV's order. */
const LENS = [
  'distortioncoefficients', 'distortioncoeffs', 'distortion', 'distortions', 'distcoeffs', 'distcoeff', 'distcoefs', 'coefficients', 'coeffs', 'dist', 'd', 'd1',
];

/** Names of lenses that `k1` to `k3`, `p1` and `p2` do not describe. */
const OTHER_LENSES = /fish.?eye|equi|kannala|fov|prism|spherical|cylindrical|omni|^(kb\d*|mei|eucm|ds|dual)$/i;

/** Such names where they may be those of a device, too. */
const OTHER_MODELS = /^([a-z_ -]*fish.?eye\d*|equi(distant|rectangular)|kannala.*|fov|spherical|cylindrical|omni(directional)?|kb\d*|mei|eucm|ds)$/i;

/**
 * @param {Fields} file fields with plain names
 * @param {Size[]} images
 * @returns {Found | undefined}
 */
function cameraOf(file, images) {
  /** @param {...string} names */
  const number = (...names) => names.map((name) => numberOf(file[name])).find((each) => each !== undefined);
  const own = MATRIX.map((name) => matrix(listOf(file[name]))).find((found) => found !== undefined);
  const [wide, high] = listOf(file.resolution) ?? [];
  const width = number('width', 'w', 'imagewidth') ?? wide;
  const height = number('height', 'h', 'imageheight') ?? high;
  const size = width > 0 && height > 0 ? { width, height } : images[0];
  const angles = [
    number('fovx', 'xfov', 'hfov', 'fovh', 'horizontalfov', 'cameraanglex'),
    number('fovy', 'yfov', 'vfov', 'fovv', 'verticalfov', 'cameraangley'),
  ];
  if (!angles.some((angle) => angle !== undefined) && size) angles[size.width < size.height ? 1 : 0] = number('fov', 'fieldofview');
  const byWidth = size && focal(size.width, angles[0]);
  const byHeight = size && focal(size.height, angles[1]);
  const both = number('f', 'focallengthpx');
  // OpenSfM writes shares of the longer side, and the axis from the middle.
  const longer = file.projectiontype !== undefined && size ? Math.max(size.width, size.height) : NaN;
  const [shareX, shareY] = [number('focalx', 'focal'), number('focaly', 'focal')].map((share) => numberOf((share ?? NaN) * longer));
  let fx = own?.fx ?? number('fx', 'flx') ?? both ?? shareX ?? byWidth ?? byHeight;
  let fy = own?.fy ?? number('fy', 'fly', 'fx', 'flx') ?? both ?? shareY ?? byHeight ?? byWidth;
  let cx = own?.cx ?? number('cx', 'ppx');
  let cy = own?.cy ?? number('cy', 'ppy');
  if (fx === undefined || fy === undefined) {
    if (angles.some((angle) => angle !== undefined)) throw problem('a field of view makes a camera only with the size of the images that it is about');
    return undefined;
  }
  let [k1, k2, p1, p2, k3, ...more] = lens(file, number);
  const projection = file.projection ?? file.type;
  // PhotoScan, which Metashape was, wrote fx and fy, and the axis from the corner.
  const metashape = projection === 'frame' && both !== undefined;
  if (size && shareX !== undefined) [cx, cy] = [(size.width - 1) / 2 + (cx ?? 0) * longer, (size.height - 1) / 2 + (cy ?? 0) * longer];
  else if (size && metashape) [cx, cy] = [size.width / 2 + (cx ?? 0), size.height / 2 + (cy ?? 0)];
  else if (size) [cx, cy] = [cx ?? size.width / 2, cy ?? size.height / 2];
  if (projection === 'frame') [p1, p2] = [p2, p1];
  if (metashape) fx += number('b1') ?? 0;
  if (cx === undefined || cy === undefined) return undefined;
  if (size && Math.min(cx, cy) > 0 && Math.max(cx, cy) < 1) [fx, fy, cx, cy] = [fx * size.width, fy * size.height, cx * size.width, cy * size.height];
  const stated = width > 0 && height > 0 || byWidth !== undefined || byHeight !== undefined ? size : undefined;
  const [rotation, translation] = Array.isArray(file.translation) ? [file.rotation ?? undefined, file.translation] : [];
  const camera = {
    fx, fy, cx, cy, k1, k2, p1, p2, k3, rotation, translation, ...stated, depthScale: number('depthscale'),
  };
  const isFisheye = [file.isfisheye, file.fisheyemodel].some((flag) => flag === true || flag === 1);
  const models = [file.distortionmodel, file.cameramodel, file.cameratype, file.modeltype, file.projectiontype, isFisheye ? 'fisheye' : ''];
  const named = [...[...models, projection].filter((model) => OTHER_LENSES.test(String(model))), ...[file.model].filter((model) => OTHER_MODELS.test(String(model)))];
  const others = more.some((k) => k !== 0 && k !== undefined) ? [...models, file.model, 'with more than five coefficients'] : [];
  return {
    camera: /** @type {PhotoCamera} */ (/** @type {unknown} */ (Object.fromEntries(Object.entries(camera).filter(([, value]) => value !== undefined)))),
    lens: [...named, ...others].map((model) => String(model ?? '')).find((model) => model !== ''),
  };
}

/**
 * @param {Fields} file
 * @param {(...names: string[]) => number | undefined} number
 * @returns {(number | undefined)[]} k1, k2, p1, p2, k3, and what follows them
 */
function lens(file, number) {
  const listed = LENS.map((name) => listOf(file[name])).find((list) => list !== undefined);
  // As MATLAB has them.
  const [[k1, k2, k3], [p1, p2]] = [file.radialdistortion, file.tangentialdistortion].map((list) => listOf(list) ?? []);
  if (k1 !== undefined) return [k1, k2, p1, p2, k3];
  const unknown = Object.keys(file).find((name) => /distort/.test(name) && !LENS.includes(name) && listOf(file[name])?.some((k) => k !== 0));
  if (unknown !== undefined && listed === undefined) throw problem(`what its field \`${unknown}\` says of the lens is not known here: name it \`distortion\` if it is k1, k2, p1, p2, k3`);
  return listed ?? ['k1', 'k2', 'p1', 'p2', 'k3', 'k4', 'k5', 'k6', 'p3', 'p4'].map((name) => number(name));
}

/** A number, which may be written as a text or as a list of one. @param {unknown} given */
function numberOf(given) {
  const [number, ...others] = typeof given === 'object' ? listOf(given) ?? [] : [Number.parseFloat(String(given)) === Number(given) ? Number(given) : NaN];
  return others.length === 0 && Number.isFinite(number) ? number : undefined;
}

/**
 * Numbers of a list, of a list of rows, or of what OpenCV writes about a matrix.
 * @param {unknown} given
 * @returns {number[] | undefined}
 */
function listOf(given) {
  const { data } = /** @type {{ data?: unknown }} */ (Object(given));
  if (data !== undefined) return listOf(data);
  const values = Array.isArray(given) ? given.flat().map(Number) : [];
  return values.length > 0 && values.every(Number.isFinite) ? values : undefined;
}

/** @param {number} side @param {number | undefined} angle in degrees, or in radians where that is far less than any camera's */
function focal(side, angle) {
  if (angle === undefined) return undefined;
  return side / 2 / Math.tan((angle < Math.PI ? angle : angle * Math.PI / 180) / 2);
}

/**
 * From fx, fy, cx, cy, or a camera matrix of 3 × 3, 3 × 4 or 4 × 4 by rows, or of 3 × 3 by columns, as Apple's programs have it.
 * @param {number[] | undefined} values
 */
function matrix(values = []) {
  const columns = { 4: 0, 9: 3, 12: 4, 16: 4 }[values.length];
  if (columns === undefined) return undefined;
  if (columns === 0) {
    const [fx, fy, cx, cy] = values;
    return fx > 0 && fy > 0 ? { fx, fy, cx, cy } : undefined;
  }
  const [fx, right] = [values[0], values[2]];
  const [fy, down] = [values[columns + 1], values[columns + 2]];
  const [below, beside, one] = values.slice(2 * columns, 2 * columns + 3);
  if (one !== 1 || !(fx > 0 && fy > 0)) return undefined;
  const byColumns = right === 0 && down === 0;
  // A pose has no axis in the image: the one that Open3D writes before the camera.
  if (byColumns && below === 0 && beside === 0) return undefined;
  return { fx, fy, cx: byColumns ? below : right, cy: byColumns ? beside : down };
}
