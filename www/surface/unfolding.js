/**
 * Unfolds a surface: the forms between its bent and its flat form, with as little stretch as possible.
 *
 * Each triangle's map from the sheet to space is a rotation times a stretch (polar decomposition); both are interpolated. The
 * vertices follow by least squares over the edges (as-rigid-as-possible shape interpolation, Alexa et al. 2000).
 */
import { borderLines } from './assembly-mesh.js';
import { divergingColour } from './colours.js';

/**
 * @typedef {object} Unfolding a mesh that changes between several forms
 * @property {Uint32Array} triangles
 * @property {readonly Float32Array[]} forms positions of the vertices in each form
 * @property {Float32Array} colors of the vertices, 0 to 1
 * @property {Float32Array} strains of the vertices
 * @property {readonly Uint32Array[]} borders vertices along each of its border lines
 */

/** Number of intervals between the bent and the flat form. */
const MORPH_STEPS = 20;
/** Maximum number of iterations of conjugate gradients per form. */
const MAX_CG_ITERATIONS = 400;
/** Relative residual at which conjugate gradients stop. */
const CG_TOLERANCE = 2e-4;

/**
 * Computes the forms of an unfolding, coloured by strain.
 * @param {object} unrolling
 * @param {Float64Array} unrolling.positions x, y, z of each vertex
 * @param {Float64Array} unrolling.places x, y on the sheet
 * @param {Uint32Array} unrolling.triangles
 * @param {Float64Array} unrolling.stretches singular values of each triangle's map to the sheet
 * @param {number} most strain at the end of the colour scale
 * @param {readonly [number, number]} offset added to x and y of the positions
 * @returns {Unfolding}
 */
export function computeUnfolding({ positions, places, triangles, stretches }, most, [left, bottom]) {
  const n = places.length / 2;
  const bent = positions.map((value, i) => value + [left, bottom, 0][i % 3]);
  const flat = new Float64Array(3 * n);
  const middle = mean(bent, 3);
  const [px, py] = mean(places, 2);
  for (let i = 0; i < n; i++) flat.set([places[2 * i] - px + middle[0], places[2 * i + 1] - py + middle[1], middle[2]], 3 * i);
  const maps = triangleMaps(flat, bent, triangles);
  const graph = edgeGraph(triangles, n);
  // Least squares do not determine the translation of a connected part, which is interpolated linearly instead. The solver
  // starts from the linear interpolation plus its deviation extrapolated from the two forms before.
  let [before, last] = [new Float64Array(3 * n), new Float64Array(3 * n)];
  const forms = Array.from({ length: MORPH_STEPS + 1 }, (_, step) => {
    const share = 1 - step / MORPH_STEPS;
    if (step === 0 || step === MORPH_STEPS) return Float32Array.from(step === 0 ? bent : flat);
    const straight = flat.map((value, i) => value + share * (bent[i] - value));
    const form = straight.map((value, i) => value + 2 * last[i] - before[i]);
    solveLaplacian(graph, rightHandSide(maps, flat, triangles, share), form);
    [before, last] = [last, form.map((value, i) => value - straight[i])];
    return Float32Array.from(form);
  });
  const strains = vertexStrains(triangles, stretches, n);
  const colors = Float32Array.from([...strains].flatMap((strain) => divergingColour(strain / most).map((value) => value / 255)));
  return { triangles, forms, strains, colors, borders: borderLines(triangles) };
}

/** The mean of points. @param {Float64Array} values @param {number} size number of coordinates */
function mean(values, size) {
  const sums = new Float64Array(size);
  values.forEach((value, i) => (sums[i % size] += value));
  return sums.map((sum) => (sum * size) / values.length);
}

/** @typedef {{ axis: [number, number, number], angle: number, stretch: [number, number, number] }} TriangleMap polar decomposition of a triangle's map; stretch: xx, xy, yy */

/**
 * The polar decomposition of each triangle's map from the flat to the bent form.
 * @param {Float64Array} flat
 * @param {Float64Array} bent
 * @param {Uint32Array} triangles
 * @returns {TriangleMap[]}
 */
function triangleMaps(flat, bent, triangles) {
  return Array.from({ length: triangles.length / 3 }, (_, t) => {
    const [i, j, k] = [3 * triangles[3 * t], 3 * triangles[3 * t + 1], 3 * triangles[3 * t + 2]];
    const [ax, ay, bx, by] = [flat[j] - flat[i], flat[j + 1] - flat[i + 1], flat[k] - flat[i], flat[k + 1] - flat[i + 1]];
    const area = ax * by - ay * bx;
    if (!(Math.abs(area) > 1e-12 * (ax * ax + ay * ay + bx * bx + by * by))) return { axis: [1, 0, 0], angle: 0, stretch: [1, 0, 1] };
    // Columns of the map: the images of the sheet's axes.
    const [first, second] = [j, k].map((corner) => [0, 1, 2].map((d) => bent[corner + d] - bent[i + d]));
    const columns = [
      first.map((value, d) => (value * by - second[d] * ay) / area),
      second.map((value, d) => (value * ax - first[d] * bx) / area),
    ];
    const [xx, xy, yy] = [dot(columns[0], columns[0]), dot(columns[0], columns[1]), dot(columns[1], columns[1])];
    // The square root of a symmetric 2×2 matrix in closed form, and its inverse.
    const root = Math.sqrt(Math.max(1e-30, xx * yy - xy * xy));
    const trace = Math.sqrt(xx + yy + 2 * root);
    const stretch = /** @type {[number, number, number]} */ ([(xx + root) / trace, xy / trace, (yy + root) / trace]);
    const inverse = [stretch[2] / root, -stretch[1] / root, stretch[0] / root];
    const [e, f] = [[inverse[0], inverse[1]], [inverse[1], inverse[2]]].map(([p, q]) => columns[0].map((value, d) => p * value + q * columns[1][d]));
    const g = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
    const skew = [f[2] - g[1], g[0] - e[2], e[1] - f[0]];
    const sine = Math.hypot(...skew);
    const angle = Math.atan2(sine, e[0] + f[1] + g[2] - 1);
    const axis = /** @type {[number, number, number]} */ (sine > 1e-12 ? skew.map((value) => value / sine) : [1, 0, 0]);
    return { axis, angle, stretch };
  });
}

/** @param {number[]} a @param {number[]} b */
function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/**
 * The right-hand side of the least-squares problem: the divergence of the interpolated edge vectors.
 * @param {TriangleMap[]} maps
 * @param {Float64Array} flat
 * @param {Uint32Array} triangles
 * @param {number} share position between flat, 0, and bent, 1
 */
function rightHandSide(maps, flat, triangles, share) {
  const out = new Float64Array(flat.length);
  maps.forEach(({ axis: [u, v, w], angle, stretch: [xx, xy, yy] }, t) => {
    const [c, s] = [Math.cos(share * angle), Math.sin(share * angle)];
    const d = 1 - c;
    const [sxx, sxy, syy] = [1 + share * (xx - 1), share * xy, 1 + share * (yy - 1)];
    for (let corner = 0; corner < 3; corner++) {
      const [i, j] = [3 * triangles[3 * t + corner], 3 * triangles[3 * t + ((corner + 1) % 3)]];
      const [ex, ey] = [flat[j] - flat[i], flat[j + 1] - flat[i + 1]];
      const [x, y] = [sxx * ex + sxy * ey, sxy * ex + syy * ey];
      // Rotation about the axis (Rodrigues' formula).
      const along = d * (u * x + v * y);
      const edge = [c * x + along * u - s * w * y, c * y + along * v + s * w * x, along * w + s * (u * y - v * x)];
      for (let k = 0; k < 3; k++) {
        out[i + k] -= edge[k];
        out[j + k] += edge[k];
      }
    }
  });
  return out;
}

/** @typedef {{ from: Uint32Array, to: Uint32Array, weight: Float64Array, degree: Float64Array }} Graph */

/** The edges of a mesh, weighted by their number of triangles. @param {Uint32Array} triangles @param {number} n number of vertices @returns {Graph} */
function edgeGraph(triangles, n) {
  /** @type {Map<number, number>} */
  const edges = new Map();
  const degree = new Float64Array(n);
  for (let t = 0; t < triangles.length; t += 3) {
    for (let corner = 0; corner < 3; corner++) {
      const [i, j] = [triangles[t + corner], triangles[t + ((corner + 1) % 3)]];
      const key = Math.min(i, j) * n + Math.max(i, j);
      edges.set(key, (edges.get(key) ?? 0) + 1);
      degree[i]++;
      degree[j]++;
    }
  }
  const keys = Float64Array.from(edges.keys());
  return {
    from: Uint32Array.from(keys, (key) => Math.floor(key / n)),
    to: Uint32Array.from(keys, (key) => key % n),
    weight: Float64Array.from(edges.values()),
    degree: degree.map((value) => value || 1),
  };
}

/**
 * Solves a system with the graph's Laplacian for three coordinates at once, by conjugate gradients with Jacobi preconditioning.
 * @param {Graph} graph
 * @param {Float64Array} right
 * @param {Float64Array} x initial guess, replaced by the solution
 */
function solveLaplacian(graph, right, x) {
  const { degree } = graph;
  const [residual, scaled, image] = [right.slice(), new Float64Array(x.length), new Float64Array(x.length)];
  applyLaplacian(graph, x, image);
  for (let i = 0; i < x.length; i++) residual[i] -= image[i];
  const scale = () => {
    let sum = 0;
    for (let i = 0; i < x.length; i++) {
      scaled[i] = residual[i] / degree[(i / 3) | 0];
      sum += residual[i] * scaled[i];
    }
    return sum;
  };
  let residualSize = scale();
  const direction = scaled.slice();
  let squaredTolerance = 0;
  for (let i = 0; i < x.length; i++) squaredTolerance += (CG_TOLERANCE ** 2 * right[i] ** 2) / degree[(i / 3) | 0];
  for (let iteration = 0; iteration < MAX_CG_ITERATIONS && residualSize > squaredTolerance; iteration++) {
    const step = residualSize / applyLaplacian(graph, direction, image);
    for (let i = 0; i < x.length; i++) {
      x[i] += step * direction[i];
      residual[i] -= step * image[i];
    }
    const next = scale();
    for (let i = 0; i < x.length; i++) direction[i] = scaled[i] + (next / residualSize) * direction[i];
    residualSize = next;
  }
}

/**
 * Applies the graph's Laplacian.
 * @param {Graph} graph
 * @param {Float64Array} values
 * @param {Float64Array} out gets the result
 * @returns {number} dot product of `values` and `out`
 */
function applyLaplacian({ from, to, weight }, values, out) {
  out.fill(0);
  let product = 0;
  for (let e = 0; e < from.length; e++) {
    const [i, j, w] = [3 * from[e], 3 * to[e], weight[e]];
    for (let k = 0; k < 3; k++) {
      const difference = values[i + k] - values[j + k];
      out[i + k] += w * difference;
      out[j + k] -= w * difference;
      product += w * difference * difference;
    }
  }
  return product;
}

/**
 * The strain of each vertex: the mean over its triangles.
 * @param {Uint32Array} triangles
 * @param {Float64Array} stretches
 * @param {number} n
 */
function vertexStrains(triangles, stretches, n) {
  const [sums, counts] = [new Float64Array(n), new Float64Array(n)];
  triangles.forEach((vertex, i) => {
    sums[vertex] += triangleStrain(stretches, Math.floor(i / 3));
    counts[vertex]++;
  });
  return Float32Array.from(sums, (sum, i) => sum / (counts[i] || 1));
}

/**
 * The principal strain of larger magnitude of a triangle; positive where it is stretched.
 * @param {Float64Array} stretches singular values, two for each triangle
 * @param {number} t index of the triangle
 */
export function triangleStrain(stretches, t) {
  const [large, small] = [stretches[2 * t] - 1, stretches[2 * t + 1] - 1];
  return Math.abs(large) >= Math.abs(small) ? large : small;
}
