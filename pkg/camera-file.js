/** Cameras from the files that programs for capturing and calibrating write. Documented in `camera-file.d.ts`. */
import { DevelopableError } from './errors.js';
import { count } from './input.js';
import { asText, reading, record } from './values.js';

/** @typedef {import('./types.js').PhotoCamera} PhotoCamera */

const FORMS =
  'fx, fy, cx and cy in JSON, a matrix of three by three in JSON or CSV, or fl_x, fl_y, cx and cy as in transforms.json';

/** @type {typeof import('./camera-file.js').parseCamera} */
export function parseCamera(given, images = []) {
  const sizes = sizesOf(images);
  const found = cameraOf(asText('INPUT', 'the camera file', given));
  if (found === undefined) throw new DevelopableError('INPUT', `there is no camera in it: it should have ${FORMS}`);
  if (found.width !== undefined && found.height !== undefined) return found;
  /** @param {{ width: number, height: number }} image */
  const off = ({ width, height }) => Math.max(Math.abs(found.cx / width - 0.5), Math.abs(found.cy / height - 0.5));
  const [nearest] = [...sizes].sort((a, b) => off(a) - off(b));
  if (nearest === undefined) return found;
  if (off(nearest) <= 0.25) return { ...found, width: nearest.width, height: nearest.height };
  throw new DevelopableError(
    'INPUT',
    `the camera looks at (${found.cx}, ${found.cy}), which is far from the middle of ` +
      `${sizes.map(({ width, height }) => `${width} × ${height}`).join(' and of ')} pixels: ` +
      'say in it which width and height its numbers are for',
  );
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
 * @param {string} given
 * @returns {PhotoCamera | undefined}
 */
function cameraOf(given) {
  // A byte order mark, with which some programs begin their files, is no JSON.
  const text = given.replace(/^\uFEFF/, '');
  if (!/^\s*[{[]/.test(text)) {
    const rows = text.trim().split(/\r?\n/).map((line) => line.split(/[\s,;]+/).filter((part) => part !== '').map(Number));
    return matrix(rows);
  }
  /** @type {unknown} */
  let value;
  try {
    value = JSON.parse(text);
  } catch {
    return undefined;
  }
  return Array.isArray(value) ? matrix(value) : fields(/** @type {Record<string, unknown>} */ (value));
}

/**
 * @param {Record<string, unknown>} file
 * @returns {PhotoCamera | undefined}
 */
function fields(file) {
  /** @param {...string} names */
  const first = (...names) => names.map((name) => file[name]).find((value) => value !== undefined);
  /** @param {...string} names @returns {number | undefined} */
  const number = (...names) => {
    const value = first(...names);
    return typeof value === 'number' ? value : undefined;
  };
  const given = first('K', 'intrinsic_matrix', 'intrinsicMatrix', 'camera_matrix', 'cameraMatrix', 'intrinsics');
  const nested = /** @type {{ data?: unknown }} */ (Object(given)).data ?? given;
  const own = Array.isArray(nested) ? matrix(nested) : undefined;
  const [fx, fy] = [own?.fx ?? number('fx', 'fl_x', 'f'), own?.fy ?? number('fy', 'fl_y', 'fx', 'fl_x', 'f')];
  const [cx, cy] = [own?.cx ?? number('cx', 'ppx'), own?.cy ?? number('cy', 'ppy')];
  if (fx === undefined || fy === undefined || cx === undefined || cy === undefined) {
    // Such as those of several cameras, or one within what else is known.
    const inner = typeof given === 'object' && given !== null && !Array.isArray(nested) ? given : file.camera;
    return typeof inner === 'object' && inner !== null ? fields(/** @type {Record<string, unknown>} */ (inner)) : undefined;
  }
  const lens = first('distortion_coefficients', 'distortion', 'coeffs');
  const listed = /** @type {{ data?: unknown }} */ (Object(lens)).data ?? lens;
  const [k1, k2, p1, p2, k3] = Array.isArray(listed) ? listed.flat() : ['k1', 'k2', 'p1', 'p2', 'k3'].map((name) => number(name));
  const { rotation, translation } = file;
  const camera = {
    fx, fy, cx, cy, k1, k2, p1, p2, k3, rotation, translation,
    width: number('width', 'w', 'image_width', 'imageWidth'),
    height: number('height', 'h', 'image_height', 'imageHeight'),
    depthScale: number('depthScale', 'depth_scale'),
  };
  return /** @type {PhotoCamera} */ (Object.fromEntries(Object.entries(camera).filter(([, value]) => value !== undefined)));
}

/**
 * From a camera matrix by rows, or by columns, as Apple's programs have it.
 * @param {unknown[]} given
 * @returns {PhotoCamera | undefined}
 */
function matrix(given) {
  const values = given.flat().map(Number);
  if (values.length !== 9 || values.some((value) => !Number.isFinite(value)) || values[8] !== 1) return undefined;
  const [fx, , right, , fy, down, below, beside] = values;
  const byColumns = right === 0 && down === 0;
  return { fx, fy, cx: byColumns ? below : right, cy: byColumns ? beside : down };
}
