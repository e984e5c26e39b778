/** Which edge of a drawing lies at a place: a fold, which may be cut, or a cut, which may be joined. */

/** @typedef {readonly [number, number]} Place in the drawing's millimetres */
/** @typedef {[number, number]} Pair numbers of two patches as they are drawn, the smaller one first */

/** Maximum distance of a click from its edge, as a share of the drawing's longer side. */
const MAX_CLICK_SHARE = 0.027;

/** The edge nearest to a place, with the lines where it is drawn: for a cut, those are its letters. @param {Drawing} drawing @param {Place} place @returns {{ pair: Pair, isFold: boolean, lines: (readonly Place[])[] } | null} null without an edge there */
export function edgeAt({ width, height, sheets }, place) {
  const edges = [
    ...sheets.flatMap(({ folds }) => folds).map(({ points, patches }) => ({ points, patches, isFold: true })),
    ...sheets.flatMap(({ labels }) => labels).flatMap(({ patches, place: at }) => (patches ? [{ points: [at, at], patches, isFold: false }] : [])),
  ].map((edge) => ({ ...edge, distance: Math.min(...edge.points.slice(1).map((to, i) => distanceFrom(edge.points[i], to, place))) }));
  const [nearest] = edges.toSorted((one, other) => one.distance - other.distance);
  if (!nearest || nearest.distance > MAX_CLICK_SHARE * Math.max(width, height)) return null;
  const { patches: [a, b], isFold } = nearest;
  // A slit has the same patch on both sides.
  if (a === b) return null;
  return { pair: [a + 1, b + 1], isFold, lines: edges.filter((one) => one.isFold === isFold && String(one.patches) === String([a, b])).map(({ points }) => points) };
}

/** The distance of a place from a segment. @param {Place} a @param {Place} b @param {Place} place */
function distanceFrom([ax, ay], [bx, by], [x, y]) {
  const [dx, dy] = [bx - ax, by - ay];
  const share = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(x - ax - share * dx, y - ay - share * dy);
}

/** Pairs of numbers in a text such as `1-7, 2-3`; null for another text. @param {string} text @returns {Pair[] | null} */
export function parsePairs(text) {
  const parts = text.split(/[,;]/).map((part) => part.trim()).filter(Boolean);
  const pairs = parts.map((part) => /^([1-9]\d*)\s*[-–]\s*([1-9]\d*)$/.exec(part)?.slice(1).map(Number).sort((a, b) => a - b));
  return pairs.every((pair) => pair !== undefined) ? /** @type {Pair[]} */ (pairs) : null;
}

/** A text with or without a pair: the other one than before. @param {string} text @param {Pair} pair */
export function togglePair(text, pair) {
  const pairs = (parsePairs(text) ?? []).map((one) => one.join('-'));
  const own = pair.join('-');
  return (pairs.includes(own) ? pairs.filter((one) => one !== own) : [...pairs, own]).join(', ');
}
