/** Lengths in drawn files, as other programs read them. */
import DxfParser from 'dxf-parser';
import { OPS, getDocument } from 'pdfjs-dist/legacy/build/pdf.mjs';

/** @typedef {[number, number]} Point */
/** @typedef {{ points: Point[], closed: boolean, corners: number }} Line points also along arcs and curves, corners as in the file */
/** @typedef {Line & { dashes: number }} Drawn how many lengths its dashes have */

/** @param {readonly Point[]} points @param {boolean} [closed] */
export function length(points, closed = false) {
  const ring = closed ? [...points, points[0]] : points;
  return ring.slice(1).reduce((sum, [x, y], i) => sum + Math.hypot(x - ring[i][0], y - ring[i][1]), 0);
}

/** Width and height of what some points enclose. @param {readonly Point[]} points */
export function extent(points) {
  return [0, 1].map((k) => Math.max(...points.map((p) => p[k])) - Math.min(...points.map((p) => p[k])));
}

/**
 * The polylines of a DXF file by their layers, its texts, and its unit ($INSUNITS; 4 is the millimetre).
 * @param {Uint8Array} file
 */
export function readDxf(file) {
  const dxf = new DxfParser().parseSync(new TextDecoder().decode(file));
  if (!dxf) throw new Error('no DXF');
  /** @type {Record<string, Line[]>} */
  const layers = {};
  /** @type {string[]} */
  const texts = [];
  for (const entity of /** @type {any[]} */ (dxf.entities)) {
    if (entity.type === 'TEXT') texts.push(entity.text);
    else {
      const closed = Boolean(entity.shape);
      (layers[entity.layer] ??= []).push({ points: traced(entity.vertices, closed), closed, corners: entity.vertices.length });
    }
  }
  return { layers, texts, unit: dxf.header.$INSUNITS };
}

/** How many points there are along an arc or a curve. */
const FINE = 24;

/**
 * The points of a polyline, also along its arcs: `bulge` is the tangent of a quarter of the angle of one.
 * @param {{ x: number, y: number, bulge?: number }[]} vertices
 * @param {boolean} closed
 */
function traced(vertices, closed) {
  /** @type {Point[]} */
  const points = [];
  vertices.forEach(({ x, y, bulge = 0 }, i) => {
    points.push([x, y]);
    const next = vertices[(i + 1) % vertices.length];
    if (bulge === 0 || (i === vertices.length - 1 && !closed)) return;
    const [dx, dy] = [next.x - x, next.y - y];
    const angle = 4 * Math.atan(bulge);
    const rise = (1 / bulge - bulge) / 4;
    const [cx, cy] = [(x + next.x) / 2 - rise * dy, (y + next.y) / 2 + rise * dx];
    for (let k = 1; k < FINE; k += 1) {
      const [sin, cos] = [Math.sin((angle * k) / FINE), Math.cos((angle * k) / FINE)];
      points.push([cx + cos * (x - cx) - sin * (y - cy), cy + sin * (x - cx) + cos * (y - cy)]);
    }
  });
  return points;
}

/** Millimetres in a point. */
const MM = 25.4 / 72;

/**
 * The pages of a PDF file: their sizes, and the lines on them, all in millimetres from the lower left corner.
 * @param {Uint8Array} file
 */
export async function readPdf(file) {
  const task = getDocument({ data: new Uint8Array(file), verbosity: 0 });
  const pdf = await task.promise;
  const pages = [];
  for (let i = 1; i <= pdf.numPages; i += 1) {
    const page = await pdf.getPage(i);
    const { fnArray, argsArray } = await page.getOperatorList();
    const { items } = await page.getTextContent();
    const texts = items.flatMap((item) => ('str' in item && item.str !== '' ? [item.str] : []));
    pages.push({ size: page.view.slice(2).map((side) => side * MM), texts, ...followed(fnArray, argsArray) });
  }
  await task.destroy();
  return pages;
}

/**
 * The only picture of a PDF file of one page: the page in millimetres, and the picture's pixels as they were decoded.
 * @param {Uint8Array} file
 */
export async function readPdfPicture(file) {
  const task = getDocument({ data: new Uint8Array(file), verbosity: 0 });
  const pdf = await task.promise;
  const page = await pdf.getPage(1);
  const { fnArray, argsArray } = await page.getOperatorList();
  const at = fnArray.indexOf(OPS.paintImageXObject);
  const matrix = argsArray[fnArray.indexOf(OPS.transform)].map((/** @type {number} */ value) => value * MM);
  /** @type {{ width: number, height: number, data: Uint8ClampedArray }} */
  const { width, height, data } = await new Promise((resolve) => page.objs.get(argsArray[at][0], resolve));
  const found = { pages: pdf.numPages, size: page.view.slice(2).map((side) => side * MM), matrix, width, height, data };
  await task.destroy();
  return found;
}

/**
 * The words on a page of a PDF file, each with its box on the page, in millimetres from the upper left corner.
 * @param {Uint8Array} file
 * @param {number} number of the page, from 1
 */
export async function readPdfWords(file, number) {
  const task = getDocument({ data: new Uint8Array(file), verbosity: 0 });
  const page = await (await task.promise).getPage(number);
  const { items } = await page.getTextContent();
  const words = items.flatMap((item) => {
    if (!('str' in item) || item.str.trim() === '') return [];
    const { str, transform: [, , , , left, bottom], width, height } = item;
    return [{ text: str, box: [left, page.view[3] - bottom - height, width, height].map((side) => side * MM) }];
  });
  await task.destroy();
  return words;
}

/** Points along a cubic Bézier curve, but its first. @param {Point[]} controls */
function along([p, q, r, s]) {
  return Array.from({ length: FINE }, (_, i) => {
    const t = (i + 1) / FINE;
    const weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t ** 2 * (1 - t), t ** 3];
    /** @param {0 | 1} k */
    const sum = (k) => [p, q, r, s].reduce((total, point, j) => total + weights[j] * point[k], 0);
    return /** @type {Point} */ ([sum(0), sum(1)]);
  });
}

/**
 * Follows the operators of a page.
 * @param {number[]} operators
 * @param {any[][]} operands
 */
function followed(operators, operands) {
  let state = { matrix: [1, 0, 0, 1, 0, 0], dashes: 0 };
  /** @type {(typeof state)[]} */
  const saved = [];
  /** @type {Drawn[]} */
  const lines = [];
  /** @type {Point[] | undefined} */
  let clip;
  /** @param {number[]} m */
  const transform = ([a, b, c, d, e, f]) => {
    const [p, q, r, s, t, u] = state.matrix;
    state = {
      ...state,
      matrix: [p * a + r * b, q * a + s * b, p * c + r * d, q * c + s * d, p * e + r * f + t, q * e + s * f + u],
    };
  };
  let clipping = false;
  operators.forEach((operator, i) => {
    const args = operands[i];
    switch (operator) {
      case OPS.save: saved.push(state); break;
      case OPS.restore: state = saved.pop() ?? state; break;
      case OPS.transform: transform(args); break;
      case OPS.paintFormXObjectBegin:
        saved.push(state);
        if (args[0]) transform([...args[0]]);
        break;
      case OPS.paintFormXObjectEnd: state = saved.pop() ?? state; break;
      case OPS.setDash: state = { ...state, dashes: args[0].length }; break;
      case OPS.clip: clipping = true; break;
      case OPS.constructPath: {
        const [paint, [data]] = args;
        if (!data) break;
        const [a, b, c, d, e, f] = state.matrix;
        /** @type {Drawn | undefined} */
        let line;
        for (let k = 0; k < data.length;) {
          const kind = data[k];
          if (kind === 4) {
            if (line) line.closed = true;
            k += 1;
            continue;
          }
          /** @type {(at: number) => Point} */
          const point = (at) => {
            const [x, y] = [data[at], data[at + 1]];
            return [(a * x + c * y + e) * MM, (b * x + d * y + f) * MM];
          };
          if (kind === 0) {
            line = { points: [point(k + 1)], closed: false, corners: 1, dashes: state.dashes };
            if (paint === OPS.stroke || paint === OPS.closeStroke) lines.push(line);
          } else if (line) {
            line.corners += 1;
            const [from] = line.points.slice(-1);
            const controls = [from, ...(kind === 2 ? [point(k + 1), point(k + 3)] : []), point(k + (kind === 2 ? 5 : 1))];
            line.points.push(...(kind === 2 ? along(controls) : controls.slice(1)));
          }
          k += kind === 2 ? 7 : 3;
        }
        if (clipping && paint === OPS.endPath) clip = line?.points;
        clipping = false;
        break;
      }
      default:
    }
  });
  return { lines, clip };
}
