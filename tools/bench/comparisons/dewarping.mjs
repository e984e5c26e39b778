/** How true pages are that are scanned from above, and made flat. */
import { init, load, sampleMesh } from '../../../pkg/direct.js';
import { outline, project, seenFrom, view } from '../phone/camera.mjs';
import { crumpled, pages } from '../phone/pages.mjs';
import { prints } from '../phone/print.mjs';
import { normal, photograph } from '../phone/sensor.mjs';
import { ways } from '../phone/surfaces.mjs';
import { alike, greyOf, turned } from '../phone/truth.mjs';
import { count, digits, percent } from '../text.mjs';

/** @typedef {import('../phone/surfaces.mjs').Field} Field */

/** Vertices of a scan across the page. */
const RESOLUTION = 200;
/** So far above that all is seen at right angles, in metres. */
const above = { name: 'from above', distance: 1000, tilt: 0, yaw: 0, roll: 0, behind: /** @type {const} */ ('table') };
const [width, height, pixels] = [900, 1250, 800];
const camera = { width, height, fx: (pixels / 0.21) * above.distance, fy: (pixels / 0.21) * above.distance, cx: (width - 1) / 2, cy: (height - 1) / 2 };

/** What may be wrong with a scan, by name. @type {Record<string, (field: Field) => Field>} */
const SCANS = {
  exact: (field) => field,
  'noise of 1 %': (field) => {
    const known = field.heights.filter((z) => !Number.isNaN(z));
    const [next, range] = [normal(1), known.reduce((a, b) => Math.max(a, b)) - known.reduce((a, b) => Math.min(a, b))];
    return { ...field, heights: field.heights.map((z) => z + 0.01 * range * next()) };
  },
  voxels: (field) => ({ ...field, heights: field.heights.map((z) => Math.round(z / field.spacing) * field.spacing) }),
};

/** The exact heights of a page, each with its place in the photo. @param {import('../phone/pages.mjs').Page} page */
function scan(page) {
  const space = seenFrom(page, above);
  const [cols, rows] = [page.width, page.height].map((side) => Math.round((4 * RESOLUTION * side) / page.width));
  const [positions, uvs, triangles] = [/** @type {number[]} */ ([]), /** @type {number[]} */ ([]), /** @type {number[]} */ ([])];
  for (let i = 0; i <= rows; i += 1) {
    for (let j = 0; j <= cols; j += 1) {
      const [u, v, at] = [(j / cols) * page.width, (i / rows) * page.height, positions.length / 3];
      positions.push(...page.point(u, v));
      const [x, y] = project(camera, space(u, v));
      uvs.push((x + 0.5) / width, 1 - (y + 0.5) / height);
      if (i < rows && j < cols) triangles.push(at, at + cols + 1, at + 1, at + 1, at + cols + 1, at + cols + 2);
    }
  }
  const mesh = { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles), uvs: Float32Array.from(uvs) };
  return sampleMesh(mesh, { spacing: page.width / RESOLUTION });
}

/** @param {{ quick: boolean }} bench */
export async function dewarping({ quick }) {
  await init();
  await load('files', 'images', 'meshes', 'unroll');
  const { fine, original } = (await prints()).sheet;
  const rows = [];
  for (const page of [pages[0], pages[1], crumpled(0.55)].slice(0, quick ? 1 : 3)) {
    const seen = view(page, above, camera);
    const scene = { page, seen, photo: photograph(seen, fine, page), crop: outline(page, above, camera) };
    const exact = scan(page);
    const vertices = count(exact.heights.filter((z) => !Number.isNaN(z)).length);
    for (const [name, flaws] of Object.entries(SCANS)) {
      for (const way of name === 'exact' ? ['raw depth'] : ['raw depth', 'smoothed by the truth', 'fitted at medium λ', 'fitted by default']) {
        const { flat, truth } = ways[way](flaws(exact), scene);
        const similarity = alike(turned(greyOf(flat), original, page, truth.place), original);
        rows.push([
          page.name, name, way.replace('raw depth', 'as it is'), vertices, percent(truth.rms), percent(truth.anisotropy), percent(truth.strain), percent(truth.coverage),
          Number.isNaN(similarity) ? 'none' : digits(similarity),
        ]);
        console.log(`  ${rows[rows.length - 1].join(', ')}`);
      }
    }
  }
  return {
    title: 'Pages made flat',
    text: 'Printed A4 pages, curled, folded and crumpled, seen from far above: their exact heights, 200 vertices across; the same with normal noise of 1 % '
      + 'of their range, or in whole voxels of the spacing; unrolled as they are, smoothed by averages of neighbours (as many steps as leave the least '
      + 'displacement, which takes knowing the truth), fitted by the nuclear norm at medium λ, and by default. Against the page itself as in the table '
      + "of a phone's depths: displacement, anisotropy, strain over 2 mm, coverage, and the similarity of the flat image.",
    columns: ['page', 'scan', 'surface', 'vertices', 'RMS', 'anisotropy', 'strain', 'covered', 'similarity'],
    rows,
  };
}
