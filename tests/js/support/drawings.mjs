/** Lengths in drawn files, as other programs read them. */
import DxfParser from 'dxf-parser';
import { OPS, getDocument } from 'pdfjs-dist/legacy/build/pdf.mjs';

/** @typedef {[number, number]} Point */
/** @typedef {{ points: Point[], closed: boolean }} Line */
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
      const points = entity.vertices.map((/** @type {{ x: number, y: number }} */ { x, y }) => [x, y]);
      (layers[entity.layer] ??= []).push({ points, closed: Boolean(entity.shape) });
    }
  }
  return { layers, texts, unit: dxf.header.$INSUNITS };
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
    pages.push({ size: page.view.slice(2).map((side) => side * MM), texts, ...traced(fnArray, argsArray) });
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
 * Follows the operators of a page.
 * @param {number[]} operators
 * @param {any[][]} operands
 */
function traced(operators, operands) {
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
          const [x, y] = [data[k + 1], data[k + 2]];
          k += 3;
          /** @type {Point} */
          const point = [(a * x + c * y + e) * MM, (b * x + d * y + f) * MM];
          if (kind === 0) {
            line = { points: [point], closed: false, dashes: state.dashes };
            if (paint === OPS.stroke || paint === OPS.closeStroke) lines.push(line);
          } else line?.points.push(point);
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
