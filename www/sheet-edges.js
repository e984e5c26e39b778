/** Which edge of a drawing lies at a place: a fold, which may be cut, or a cut, which may be joined. */

/** @typedef {import('../pkg/types.js').Drawing} Drawing */
/** @typedef {readonly [number, number]} Place in the drawing's millimetres */
/** @typedef {[number, number]} Pair numbers of two patches as they are drawn, the smaller one first */

/** Side of the raster on which patches are told apart, in pixels. */
const RASTER_SIDE_PIXELS = 900;
/** Maximum distance of a click from its edge, and of an edge from the pixels of its patches, in pixels of the raster. */
const MAX_CLICK_PIXELS = 24;
const MAX_LINE_PIXELS = 6;
/** Pixels of a line and outside of all patches. */
const [LINE, NOTHING] = [-1, 0];

/**
 * The edge nearest to a place.
 * @param {Drawing} drawing
 * @param {Place} place
 * @returns {{ pair: Pair, isFold: boolean } | null} null without an edge there
 */
export function edgeAt(drawing, place) {
  const { scale, patchNear } = patchRaster(drawing);
  const reach = MAX_CLICK_PIXELS / scale;
  const folds = drawing.sheets.flatMap((sheet) => sheet.folds.flatMap(({ points }) => points.slice(1).map((to, i) => nearestOn(points[i], to, place))));
  const labels = drawing.sheets.flatMap((sheet) => sheet.labels);
  const seams = labels.filter(({ kind }) => kind === 'seam').map(({ text, place: at }) => ({ text, distance: Math.hypot(at[0] - place[0], at[1] - place[1]) }));
  const [fold] = folds.sort((a, b) => a.distance - b.distance);
  const [seam] = seams.sort((a, b) => a.distance - b.distance);
  if (!(Math.min(fold?.distance ?? Infinity, seam?.distance ?? Infinity) <= reach)) return null;
  const isFold = (fold?.distance ?? Infinity) < (seam?.distance ?? Infinity);
  /** @param {number} side @returns {Place} */
  const beside = (side) => [fold.at[0] + (side * fold.normal[0] * MAX_LINE_PIXELS) / 2 / scale, fold.at[1] + (side * fold.normal[1] * MAX_LINE_PIXELS) / 2 / scale];
  // A cut has the same letters on both sides.
  const places = isFold ? [beside(1), beside(-1)] : labels.filter(({ kind, text }) => kind === 'seam' && text === seam.text).map((label) => label.place);
  const [a, b] = [...new Set(places.map(patchNear))].filter((patch) => patch > NOTHING).sort((p, q) => p - q);
  return b === undefined ? null : { pair: [a, b], isFold };
}

/**
 * The nearest point of a segment, its distance and the segment's normal.
 * @param {Place} a
 * @param {Place} b
 * @param {Place} place
 */
function nearestOn([ax, ay], [bx, by], [x, y]) {
  const [dx, dy] = [bx - ax, by - ay];
  const length = Math.hypot(dx, dy) || 1;
  const share = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length ** 2));
  const at = /** @type {Place} */ ([ax + share * dx, ay + share * dy]);
  return { at, distance: Math.hypot(x - at[0], y - at[1]), normal: [-dy / length, dx / length] };
}

/** Rasterises the patches of a drawing: lines are drawn, then each patch is filled from its number. @param {Drawing} drawing */
function patchRaster({ width, height, sheets }) {
  const scale = RASTER_SIDE_PIXELS / Math.max(width, height);
  const [cols, rows] = [width, height].map((side) => Math.ceil(side * scale) + 3);
  const pixels = new Int32Array(cols * rows).fill(NOTHING);
  /** @param {Place} place */
  const pixelOf = ([x, y]) => (1 + Math.round(y * scale)) * cols + 1 + Math.round(x * scale);
  /** @param {readonly Place[]} points */
  const draw = (points) => points.slice(1).forEach(([x, y], i) => {
    const [fromX, fromY] = points[i];
    const steps = Math.ceil(2 * scale * Math.hypot(x - fromX, y - fromY)) + 1;
    for (let step = 0; step <= steps; step++) pixels[pixelOf([fromX + (step / steps) * (x - fromX), fromY + (step / steps) * (y - fromY)])] = LINE;
  });
  for (const { cuts, folds } of sheets) {
    for (const cut of cuts) draw([...cut, cut[0]]);
    for (const { points } of folds) draw(points);
  }
  for (const { labels, leaders } of sheets) {
    for (const { kind, text, place } of labels) {
      if (kind !== 'patch') continue;
      // The number of a small patch stands beside the sheet, at the end of a line from the patch.
      const leader = leaders.find((points) => Math.hypot(...points[points.length - 1].map((value, k) => value - place[k])) < Math.hypot(...points[0].map((value, k) => value - place[k])) && nearLabel(points, place));
      fill(pixels, cols, pixelOf(leader ? leader[0] : place), Number(text));
    }
  }
  return {
    scale,
    /** The number of the patch nearest to a place. @param {Place} place */
    patchNear: (place) => {
      const middle = pixelOf(place);
      for (let reach = 0; reach <= MAX_LINE_PIXELS; reach++) {
        for (let down = -reach; down <= reach; down++) {
          for (let across = -reach; across <= reach; across++) {
            const patch = pixels[middle + down * cols + across];
            if (patch > NOTHING) return patch;
          }
        }
      }
      return NOTHING;
    },
  };
}

/** Whether a leader ends at a label. @param {readonly Place[]} points @param {Place} place */
function nearLabel(points, place) {
  const [from, to] = [points[0], points[points.length - 1]];
  return Math.hypot(to[0] - place[0], to[1] - place[1]) < 0.5 * Math.hypot(to[0] - from[0], to[1] - from[1]);
}

/** Fills the pixels around one up to the lines. @param {Int32Array} pixels @param {number} cols @param {number} first @param {number} value */
function fill(pixels, cols, first, value) {
  const open = [first];
  for (let pixel = open.pop(); pixel !== undefined; pixel = open.pop()) {
    if (pixels[pixel] !== NOTHING) continue;
    pixels[pixel] = value;
    open.push(pixel - 1, pixel + 1, pixel - cols, pixel + cols);
  }
}

/** Pairs of numbers in a text such as `1-7, 2-3`; null for another text. @param {string} text @returns {Pair[] | null} */
export function parsePairs(text) {
  const parts = text.split(/[,;]/).map((part) => part.trim()).filter(Boolean);
  const pairs = parts.map((part) => /^(\d+)\s*[-–]\s*(\d+)$/.exec(part)?.slice(1).map(Number).sort((a, b) => a - b));
  return pairs.every((pair) => pair !== undefined) ? /** @type {Pair[]} */ (pairs) : null;
}

/** A text with or without a pair: the other one than before. @param {string} text @param {Pair} pair */
export function togglePair(text, pair) {
  const pairs = (parsePairs(text) ?? []).map((one) => one.join('-'));
  const own = pair.join('-');
  return (pairs.includes(own) ? pairs.filter((one) => one !== own) : [...pairs, own]).join(', ');
}
