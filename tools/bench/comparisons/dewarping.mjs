/** How true pages are that are made flat. */
import { nativeOutput } from '../bench.mjs';
import { count, digits, percent } from '../text.mjs';

/**
 * @typedef {object} Row as `benches/src/bin/dewarping` writes it
 * @property {string} page
 * @property {string} scan
 * @property {string} surface
 * @property {number} vertices
 * @property {number} stretch
 * @property {number} above
 * @property {number} bend
 * @property {number} aspect
 * @property {number | null} kept
 * @property {number | null} similarity
 */

export async function dewarping() {
  /** @type {Row[]} */
  const rows = JSON.parse(await nativeOutput('dewarping'));
  return {
    title: 'Pages made flat',
    text: 'Synthetic A-sized pages with a grid and text, curled, folded and crumpled, of which every point is known: '
      + 'their exact heights, 200 vertices across; the same with normal noise of 1 % of their range, or in whole '
      + 'voxels of the spacing; unrolled as they are, smoothed by averages of neighbours (as many steps as '
      + 'leave the lines straightest, which takes knowing the truth), and fitted by the nuclear norm at medium λ, without and '
      + 'with a reweighted pass, and by `huber` with λ by itself, which is what commands do by default. Against the page itself: the mean strain of the triangles, the share of them beyond 1 %, how '
      + 'far the grid\'s lines are from straight (standard deviation in widths of the page), by how much the aspect ratio is off, the share of the true curvature at creases (tighter than a tenth of the width) '
      + 'that is kept, and the multi-scale structural similarity of '
      + 'the flat image and the page\'s own (none where they are too unlike for it to be defined).',
    columns: ['page', 'scan', 'surface', 'vertices', 'mean strain', 'beyond 1 %', 'lines', 'aspect', 'creases kept', 'similarity'],
    rows: rows.map(({ page, scan, surface, vertices, stretch, above, bend, aspect, kept, similarity }) => [
      page, scan, surface, count(vertices), percent(stretch), percent(above), percent(bend),
      `${aspect < 0 ? '-' : ''}${percent(Math.abs(aspect))}`,
      kept === null ? '' : digits(kept), similarity === null ? 'none' : digits(similarity),
    ]),
  };
}
