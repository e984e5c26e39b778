/** Draws a picture of an assembled pattern at an angle: its sheets shaded in their colours, with numbers and letters. */
import { readAssemblyMesh, borderLines } from './assembly-mesh.js';

/** Direction of the view: angle about the vertical, and above the ground. */
const [AZIMUTH_DEGREES, ELEVATION_DEGREES] = [-28, 42];
/** Length of the picture's longer side, and the factor by which its surfaces are drawn larger and then averaged. */
const [PICTURE_PIXELS, OVERSAMPLING] = [2000, 2];
/** Maximum distance of a mark beside the surface, in pixels of the plan: lines of the plan are smoothed. */
const MAX_PLAN_OFFSET_PIXELS = 12;
/** Maximum depth of a visible line behind the surface, as a share of the picture's size. */
const MAX_HIDDEN_DEPTH_SHARE = 0.006;
/** Brightness of a surface parallel to the light; one that faces it has brightness 1. */
const AMBIENT_LIGHT = 0.5;
/** Colour of a sheet without a known colour. */
const NO_COLOUR = [160, 160, 160];
/** Direction to the light along the axes of the view: over the viewer's left shoulder. */
const LIGHT_DIRECTION = [-0.42, 0.5, 0.757];

/** @typedef {readonly [number, number, number]} Vector */
/** @typedef {{ right: Vector, up: Vector, toward: Vector }} Axes unit vectors of a view */
/** @typedef {{ positions: Float64Array, triangles: Uint32Array }} Mesh */
/**
 * @typedef {object} DepthBuffer
 * @property {number} width
 * @property {number} height
 * @property {Float32Array} depth of each pixel towards the viewer; −∞ without a surface
 * @property {Int32Array} triangle index of each pixel's triangle; −1 without one
 * @property {Float32Array} light brightness of each pixel, up to 1
 * @property {(place: ArrayLike<number>) => Vector} project maps a point in space to column, row and depth
 */

/** The axes of a view. @param {number} azimuth @param {number} elevation both in degrees @returns {Axes} */
export function axesOf(azimuth, elevation) {
  const [a, e] = [azimuth, elevation].map((degrees) => (degrees * Math.PI) / 180);
  const [ca, sa, ce, se] = [Math.cos(a), Math.sin(a), Math.cos(e), Math.sin(e)];
  return { right: [ca, sa, 0], up: [-sa * se, ca * se, ce], toward: [sa * ce, -ca * ce, se] };
}

/**
 * Rasterises a mesh in parallel projection with a depth buffer.
 * @param {Mesh} mesh
 * @param {Axes} axes
 * @param {number} size pixels along the longer side
 * @param {number} margin pixels
 * @returns {DepthBuffer}
 */
export function rasterise({ positions, triangles }, axes, size, margin) {
  const sides = [axes.right, axes.up, axes.toward];
  /** @param {ArrayLike<number>} place @returns {Vector} */
  const toViewAxes = (place) => /** @type {any} */ (sides.map((axis) => axis[0] * place[0] + axis[1] * place[1] + axis[2] * place[2]));
  const [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
  for (let i = 0; i < positions.length; i += 3) {
    const at = toViewAxes(positions.subarray(i, i + 3));
    for (const k of [0, 1]) [low[k], high[k]] = [Math.min(low[k], at[k]), Math.max(high[k], at[k])];
  }
  const scale = (size - 2 * margin) / Math.max(high[0] - low[0], high[1] - low[1]);
  const [width, height] = [0, 1].map((k) => Math.ceil(scale * (high[k] - low[k]) + 2 * margin));
  /** @param {ArrayLike<number>} place @returns {Vector} */
  const project = (place) => {
    const [x, y, z] = toViewAxes(place);
    return [margin + scale * (x - low[0]), margin + scale * (high[1] - y), scale * z];
  };
  const raster = {
    width, height, project,
    depth: new Float32Array(width * height).fill(-Infinity),
    triangle: new Int32Array(width * height).fill(-1),
    light: new Float32Array(width * height),
  };
  const corners = new Float64Array(positions.length);
  for (let i = 0; i < positions.length; i += 3) corners.set(project(positions.subarray(i, i + 3)), i);
  const lights = vertexBrightness(corners, triangles);
  for (let t = 0; t < triangles.length; t += 3) fillTriangle(raster, t / 3, [...triangles.subarray(t, t + 3)], corners, lights);
  return raster;
}

/**
 * The brightness of each vertex by its normal, the same on both sides of the surface.
 * @param {Float64Array} corners column, row and depth of each vertex
 * @param {Uint32Array} triangles
 */
function vertexBrightness(corners, triangles) {
  const normals = new Float64Array(corners.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * triangles[t + k]);
    const [e, f] = [b, c].map((to) => [0, 1, 2].map((k) => corners[to + k] - corners[a + k]));
    const normal = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
    for (const corner of [a, b, c]) for (const k of [0, 1, 2]) normals[corner + k] += normal[k];
  }
  return Float64Array.from({ length: corners.length / 3 }, (_, i) => {
    const [x, y, z] = normals.subarray(3 * i, 3 * i + 3);
    // The normal is turned towards the viewer; y is negative because rows count downwards.
    const side = z < 0 ? -1 : 1;
    const facing = (side * (LIGHT_DIRECTION[0] * x - LIGHT_DIRECTION[1] * y + LIGHT_DIRECTION[2] * z)) / (Math.hypot(x, y, z) || 1);
    return AMBIENT_LIGHT + (1 - AMBIENT_LIGHT) * Math.max(0, facing);
  });
}

/**
 * Rasterises one triangle.
 * @param {DepthBuffer} raster
 * @param {number} number index of the triangle
 * @param {readonly number[]} vertices
 * @param {Float64Array} corners
 * @param {Float64Array} lights
 */
function fillTriangle({ width, height, depth, triangle, light }, number, vertices, corners, lights) {
  const [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = vertices.map((v) => corners.subarray(3 * v, 3 * v + 3));
  const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  if (area === 0) return;
  const [left, right] = [Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5)), Math.min(width - 1, Math.floor(Math.max(ax, bx, cx) - 0.5))];
  const [top, bottom] = [Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5)), Math.min(height - 1, Math.floor(Math.max(ay, by, cy) - 0.5))];
  for (let row = top; row <= bottom; row++) {
    for (let col = left; col <= right; col++) {
      const [x, y] = [col + 0.5, row + 0.5];
      const v = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area;
      const w = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area;
      const u = 1 - v - w;
      if (u < 0 || v < 0 || w < 0) continue;
      const z = u * az + v * bz + w * cz;
      const i = row * width + col;
      if (z <= depth[i]) continue;
      depth[i] = z;
      triangle[i] = number;
      light[i] = u * lights[vertices[0]] + v * lights[vertices[1]] + w * lights[vertices[2]];
    }
  }
}

/**
 * The largest depth at the nearest ring of pixels around a place that shows a surface; −∞ if none does.
 * @param {DepthBuffer} raster
 * @param {ArrayLike<number>} place
 * @param {number} reach maximum radius of a ring, in pixels
 */
function nearestDepth({ width, height, depth }, place, reach) {
  const [col, row] = [Math.floor(place[0]), Math.floor(place[1])];
  for (let ring = 0; ring <= reach; ring++) {
    let most = -Infinity;
    for (let r = Math.max(0, row - ring); r <= Math.min(height - 1, row + ring); r++) {
      for (let c = Math.max(0, col - ring); c <= Math.min(width - 1, col + ring); c++) most = Math.max(most, depth[r * width + c]);
    }
    if (most > -Infinity) return most;
  }
  return -Infinity;
}

/**
 * Draws a pattern's assembly.
 * @param {Uint8Array} model the assembly, a GLB file
 * @param {string} plan the assembly plan seen from above, an SVG file with colours, numbers, letters and folds
 * @returns {OffscreenCanvas}
 */
export function builtPicture(model, plan) {
  const mesh = readAssemblyMesh(model, 1);
  const drawn = new DOMParser().parseFromString(plan, 'image/svg+xml');
  const margin = PICTURE_PIXELS / 40;
  const raster = rasterise(mesh, axesOf(AZIMUTH_DEGREES, ELEVATION_DEGREES), OVERSAMPLING * PICTURE_PIXELS, OVERSAMPLING * margin);
  const canvas = new OffscreenCanvas(Math.round(raster.width / OVERSAMPLING), Math.round(raster.height / OVERSAMPLING));
  const context = context2d(canvas);
  context.fillStyle = 'white';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.imageSmoothingQuality = 'high';
  context.drawImage(drawShaded(raster, mesh, sheetColours(drawn)), 0, 0, canvas.width, canvas.height);

  const hidden = MAX_HIDDEN_DEPTH_SHARE * OVERSAMPLING * PICTURE_PIXELS;
  /** The pixel of a point, null if the surface hides it. @param {ArrayLike<number>} place */
  const visible = (place) => {
    const at = raster.project(place);
    if (!at.every(Number.isFinite)) return null;
    return nearestDepth(raster, at, 2) <= at[2] + hidden ? [at[0] / OVERSAMPLING, at[1] / OVERSAMPLING] : null;
  };
  /** @param {(number[] | null)[]} places */
  const stroke = (places) => {
    context.beginPath();
    places.forEach((at, i) => {
      if (at && places[i - 1]) context.lineTo(at[0], at[1]);
      else if (at) context.moveTo(at[0], at[1]);
    });
    context.stroke();
  };
  Object.assign(context, { strokeStyle: '#222', lineWidth: 2.5, lineJoin: 'round', lineCap: 'round' });
  const { corners, lengths } = borderLines(mesh.triangles);
  for (let line = 0, first = 0; line < lengths.length; first += lengths[line++]) {
    stroke(Array.from({ length: lengths[line] }, (_, i) => {
      const vertex = 3 * corners[3 * (first + i)];
      return visible(mesh.positions.subarray(vertex, vertex + 3));
    }));
  }

  const marks = planMarks(drawn, mesh);
  context.setLineDash([10, 8]);
  context.lineWidth = 2;
  for (const fold of marks.folds) stroke(fold.map(visible));
  context.setLineDash([]);
  Object.assign(context, { textAlign: 'center', textBaseline: 'middle', fillStyle: 'black', strokeStyle: 'white' });
  for (const { text, place, size } of marks.texts) {
    const at = visible(place);
    if (!at) continue;
    context.font = `600 ${size}px Helvetica, Arial, sans-serif`;
    context.lineWidth = size / 5;
    context.strokeText(text, at[0], at[1]);
    context.fillText(text, at[0], at[1]);
  }
  return canvas;
}

/** @param {OffscreenCanvas} canvas */
function context2d(canvas) {
  const context = canvas.getContext('2d');
  if (!context) throw new Error('this browser draws no pictures');
  return context;
}

/** The colour of each sheet in the plan. @param {Document} plan */
function sheetColours(plan) {
  /** @type {number[][]} */
  const colours = [];
  for (const path of plan.querySelectorAll('path[data-sheet]')) {
    const fill = Number.parseInt((path.getAttribute('fill') ?? '').slice(1), 16);
    colours[Number(path.getAttribute('data-sheet')) - 1] = [fill >> 16, (fill >> 8) & 255, fill & 255];
  }
  return colours;
}

/**
 * @param {DepthBuffer} raster
 * @param {Mesh & { sheets: Uint32Array }} mesh
 * @param {readonly number[][]} colours
 */
function drawShaded({ width, height, triangle, light }, { triangles, sheets }, colours) {
  const pixels = new ImageData(width, height);
  const { data } = pixels;
  for (let i = 0; i < triangle.length; i++) {
    if (triangle[i] < 0) continue;
    const colour = colours[sheets[triangles[3 * triangle[i]]]] ?? NO_COLOUR;
    for (let k = 0; k < 3; k++) data[4 * i + k] = colour[k] * light[i];
    data[4 * i + 3] = 255;
  }
  const canvas = new OffscreenCanvas(width, height);
  context2d(canvas).putImageData(pixels, 0, 0);
  return canvas;
}

/**
 * The folds and texts of the plan, lifted onto the surface.
 * @param {Document} plan
 * @param {Mesh} mesh
 */
function planMarks(plan, mesh) {
  // The first number of the view box is the negative margin around the plan.
  const [margin, , width, height] = (plan.documentElement.getAttribute('viewBox') ?? '').split(/[ ,]+/).map(Number);
  const size = Math.round(Math.max(width, height) + 2 * margin);
  // A raster of the plan's size gives the heights of its marks.
  const raster = rasterise(mesh, axesOf(0, 90), size, 0);
  const [left, top, zero] = raster.project([0, 0, 0]);
  const perUnit = raster.project([1, 0, 0])[0] - left;
  /** The point of the surface at a place of the plan. @param {readonly (string | null)[]} at */
  const liftToSurface = (at) => {
    const [x, y] = at.map(Number);
    return [(x - left) / perUnit, (top - y) / perUnit, (nearestDepth(raster, [x, y], MAX_PLAN_OFFSET_PIXELS) - zero) / perUnit];
  };
  const folds = [...plan.querySelectorAll('#folds polyline')].map((line) =>
    (line.getAttribute('points') ?? '').trim().split(/\s+/).map((pair) => liftToSurface(pair.split(','))));
  const texts = [...plan.querySelectorAll('#numbers text')].map((text) => ({
    text: text.textContent ?? '',
    place: liftToSurface([text.getAttribute('x'), text.getAttribute('y')]),
    size: (Number(text.getAttribute('font-size')) * PICTURE_PIXELS) / size,
  }));
  return { folds, texts };
}
