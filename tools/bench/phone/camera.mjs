/** What a pinhole camera sees of a bent page: of each pixel the place on the page, and how far it is. */

/**
 * @typedef {import('./pages.mjs').Page} Page
 * @typedef {import('./pages.mjs').Point} Point
 * @typedef {{ width: number, height: number, fx: number, fy: number, cx: number, cy: number }} Camera
 * @typedef {{ distance: number, tilt: number, yaw: number, roll: number, behind: 'wall' | 'table' }} Pose
 *   metres and degrees, and what is behind the page: a wall far off, or the table that it lies on
 *
 * @typedef {object} View
 * @property {number} width
 * @property {number} height
 * @property {Float32Array} places u and v of each pixel on the page, in metres; NaN beside it
 * @property {Float32Array} depths in metres along the axis; infinite beside the page
 */

/** A LiDAR's. */
export const depthCamera = { width: 256, height: 192, fx: 205, fy: 205, cx: 126, cy: 97 };

/**
 * A camera in the same place with so many times as many pixels.
 * @param {Camera} camera
 * @param {number} times
 * @returns {Camera}
 */
export function finer({ width, height, fx, fy, cx, cy }, times) {
  const centre = (/** @type {number} */ c) => (c + 0.5) * times - 0.5;
  return { width: width * times, height: height * times, fx: fx * times, fy: fy * times, cx: centre(cx), cy: centre(cy) };
}

/**
 * From a point in the page's axes to the camera's: to the right, down, ahead.
 * @param {Page} page
 * @param {Pose} pose
 * @returns {(point: Point) => Point}
 */
function moved(page, { distance, tilt, yaw, roll }) {
  const [least, most] = box(page);
  const middle = least.map((value, k) => (value + most[k]) / 2);
  const [ct, st, cy, sy, cr, sr] = [tilt, yaw, roll].flatMap((angle) => {
    const radians = (angle * Math.PI) / 180;
    return [Math.cos(radians), Math.sin(radians)];
  });
  return ([right, up, towards]) => {
    const [x0, y0, z0] = [right - middle[0], middle[1] - up, middle[2] - towards];
    const [x1, z1] = [cy * x0 + sy * z0, cy * z0 - sy * x0];
    const [y2, z2] = [ct * y0 - st * z1, ct * z1 + st * y0];
    return [cr * x1 - sr * y2, cr * y2 + sr * x1, z2 + distance];
  };
}

/**
 * From a place on the page likewise.
 * @param {Page} page
 * @param {Pose} pose
 * @returns {(u: number, v: number) => Point}
 */
export function seenFrom(page, pose) {
  const move = moved(page, pose);
  return (u, v) => move(page.point(u, v));
}

/** How far behind the page's middle the wall is, in metres. */
const WALL = 0.25;

/**
 * How far what is behind the page is, by pixel.
 * @param {Page} page
 * @param {Pose} pose
 * @param {Camera} camera
 * @returns {(x: number, y: number) => number}
 */
export function background(page, pose, { fx, fy, cx, cy }) {
  if (pose.behind === 'wall') return () => pose.distance + WALL;
  const [[, , lowest]] = box(page);
  const move = moved(page, pose);
  const [origin, ...ends] = /** @type {Point[]} */ ([[0, 0, lowest], [1, 0, lowest], [0, 1, lowest]]).map(move);
  const [a, b] = ends.map((end) => end.map((value, k) => value - origin[k]));
  const normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (/** @type {number[]} */ p) => normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2];
  return (x, y) => dot(origin) / dot([(x - cx) / fx, (y - cy) / fy, 1]);
}

/** Least and most of the page in each direction of its axes. @param {Page} page */
function box({ width, height, point }) {
  const [least, most] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let i = 0; i <= 40; i += 1) {
    for (let j = 0; j <= 40; j += 1) {
      point((i / 40) * width, (j / 40) * height).forEach((value, k) => {
        least[k] = Math.min(least[k], value);
        most[k] = Math.max(most[k], value);
      });
    }
  }
  return [least, most];
}

/**
 * @param {Camera} camera
 * @param {Point} point
 * @returns {[x: number, y: number]}
 */
export const project = ({ fx, fy, cx, cy }, [x, y, z]) => [cx + (fx * x) / z, cy + (fy * y) / z];

/** Side of the mesh's squares, in metres. */
const CELL = 7e-4;

/**
 * By triangles, with a depth buffer.
 * @param {Page} page
 * @param {Pose} pose
 * @param {Camera} camera
 * @returns {View}
 */
export function view(page, pose, camera) {
  const { width, height } = camera;
  const places = new Float32Array(2 * width * height).fill(NaN);
  const depths = new Float32Array(width * height).fill(Infinity);
  const space = seenFrom(page, pose);
  const [cols, rows] = [page.width, page.height].map((side) => Math.ceil(side / CELL));
  /** Row by row: x and y in the photo, one over the depth, u and v. */
  const line = (/** @type {number} */ row) => Array.from({ length: cols + 1 }, (_, col) => {
    const [u, v] = [(col / cols) * page.width, (row / rows) * page.height];
    const point = space(u, v);
    return [...project(camera, point), 1 / point[2], u, v];
  });

  /** @param {number[]} a @param {number[]} b @param {number[]} c */
  const draw = (a, b, c) => {
    const area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (area === 0) return;
    const left = Math.max(0, Math.ceil(Math.min(a[0], b[0], c[0])));
    const right = Math.min(width - 1, Math.floor(Math.max(a[0], b[0], c[0])));
    const top = Math.max(0, Math.ceil(Math.min(a[1], b[1], c[1])));
    const bottom = Math.min(height - 1, Math.floor(Math.max(a[1], b[1], c[1])));
    for (let y = top; y <= bottom; y += 1) {
      for (let x = left; x <= right; x += 1) {
        const s = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
        const t = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
        const r = 1 - s - t;
        if (s < -1e-9 || t < -1e-9 || r < -1e-9) continue;
        const inverse = r * a[2] + s * b[2] + t * c[2];
        const pixel = y * width + x;
        if (1 / inverse >= depths[pixel]) continue;
        depths[pixel] = 1 / inverse;
        // What is linear on the page is so in the photo once divided by the depth.
        places[2 * pixel] = (r * a[2] * a[3] + s * b[2] * b[3] + t * c[2] * c[3]) / inverse;
        places[2 * pixel + 1] = (r * a[2] * a[4] + s * b[2] * b[4] + t * c[2] * c[4]) / inverse;
      }
    }
  };
  let above = line(0);
  for (let row = 1; row <= rows; row += 1) {
    const below = line(row);
    for (let col = 0; col < cols; col += 1) {
      draw(above[col], above[col + 1], below[col]);
      draw(above[col + 1], below[col + 1], below[col]);
    }
    above = below;
  }
  return { width, height, places, depths };
}

/**
 * The page's outline in the photo, so many points to an edge.
 * @param {Page} page
 * @param {Pose} pose
 * @param {Camera} camera
 * @param {number} [points]
 */
export function outline(page, pose, camera, points = 8) {
  const space = seenFrom(page, pose);
  const { width, height } = page;
  const shares = Array.from({ length: points }, (_, i) => i / points);
  return [
    ...shares.map((t) => [t * width, 0]),
    ...shares.map((t) => [width, t * height]),
    ...shares.map((t) => [(1 - t) * width, height]),
    ...shares.map((t) => [0, (1 - t) * height]),
  ].map(([u, v]) => project(camera, space(u, v)));
}
