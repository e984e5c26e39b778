/** Solids for 3D printers: an open surface gets a base or a thickness, and all lengths become millimetres. */
import { make } from './dom.js';
import { between, fieldsOf } from './fields.js';
import { FORMAT_WORDS, SOLID_WORDS } from './messages.js';
import { offerToSave } from './panels/save-dialog.js';
import { suggestedSide } from './pattern.js';
import { borderEdges, boxOf, sidesOf } from './surface/triangles.js';
import { zipOf } from './zip.js';

/** @import {Format} from './panels/save-dialog.js' */

/**
 * How an open surface becomes a solid; lengths in millimetres.
 * @typedef {{ side: number, thickness: number, onBase: boolean }} SolidOptions `side`: longer side of the printed piece;
 *   `onBase`: on a flat base at the least this thick, not as a shell of this thickness
 */

/**
 * A closed mesh in millimetres, which stands on z = 0.
 * @param {Pick<Mesh, 'positions' | 'triangles'>} mesh
 * @param {SolidOptions} options
 * @returns {{ positions: Float64Array, triangles: Uint32Array, wasOpen: boolean }}
 */
function solidOf({ positions, triangles }, { side, thickness, onBase }) {
  const { low } = boxOf(positions);
  const scale = side / Math.max(...sidesOf(positions));
  const front = Float64Array.from(positions, (value, i) => (value - low[i % 3]) * scale);
  const rim = borderEdges(triangles);
  if (rim.length === 0) return { positions: front, triangles, wasOpen: false };
  const count = front.length / 3;
  const directions = onBase ? null : mitreDirections(front, triangles);
  const back = front.map((value, i) => (directions ? value - thickness * directions[i] : i % 3 === 2 ? 0 : value));
  // The base lies beneath the lowest point.
  if (onBase) for (let i = 2; i < front.length; i += 3) front[i] += thickness;
  const all = new Float64Array(2 * front.length);
  all.set(front);
  all.set(back, front.length);
  const [, , lowest] = boxOf(all).low;
  for (let i = 2; i < all.length; i += 3) all[i] -= lowest;
  const faces = new Uint32Array(2 * triangles.length + 6 * rim.length);
  faces.set(triangles);
  for (let t = 0; t < triangles.length; t += 3) faces.set([triangles[t] + count, triangles[t + 2] + count, triangles[t + 1] + count], triangles.length + t);
  rim.forEach(([a, b], i) => faces.set([b, a, a + count, b, a + count, b + count], 2 * triangles.length + 6 * i));
  return { positions: all, triangles: faces, wasOpen: true };
}

/** Smallest cosine between a vertex's normal and its faces for which the shell keeps its thickness there; a sharper edge would become a spike. */
const MIN_MITRE_COSINE = 0.5;

/** Directions in which the vertices move for a shell whose faces move by 1 along their normals. @param {Float64Array} positions @param {Uint32Array} triangles */
function mitreDirections(positions, triangles) {
  const directions = new Float64Array(positions.length);
  const areas = new Float64Array(positions.length / 3);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * triangles[t + k]);
    const [u, v] = [b, c].map((end) => [0, 1, 2].map((k) => positions[end + k] - positions[a + k]));
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const corner of [a, b, c]) {
      areas[corner / 3] += Math.hypot(...normal);
      for (const k of [0, 1, 2]) directions[corner + k] += normal[k];
    }
  }
  areas.forEach((area, vertex) => {
    const mean = directions.subarray(3 * vertex, 3 * vertex + 3);
    const length = Math.hypot(...mean) || 1;
    const cosine = Math.max(MIN_MITRE_COSINE, length / (area || 1));
    mean.forEach((value, k) => (mean[k] = value / (length * cosine)));
  });
  return directions;
}

/** A mesh as a 3MF file, in millimetres. @param {{ positions: Float64Array, triangles: Uint32Array }} mesh */
function threeMf({ positions, triangles }) {
  /** @param {ArrayLike<number>} values @param {string} tag @param {readonly string[]} names */
  const elements = (values, tag, names) => Array.from({ length: values.length / 3 }, (_, i) =>
    `<${tag} ${names.map((name, k) => `${name}="${Number(values[3 * i + k].toPrecision(8))}"`).join(' ')}/>`).join('\n');
  const core = 'http://schemas.microsoft.com/3dmanufacturing/core/2015/02';
  return zipOf({
    '[Content_Types].xml': '<?xml version="1.0" encoding="UTF-8"?>\n<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>',
    '_rels/.rels': '<?xml version="1.0" encoding="UTF-8"?>\n<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>',
    '3D/3dmodel.model': `<?xml version="1.0" encoding="UTF-8"?>\n<model unit="millimeter" xml:lang="en-US" xmlns="${core}"><resources><object id="1" type="model"><mesh><vertices>\n${elements(positions, 'vertex', ['x', 'y', 'z'])}\n</vertices><triangles>\n${elements(triangles, 'triangle', ['v1', 'v2', 'v3'])}\n</triangles></mesh></object></resources><build><item objectid="1"/></build></model>`,
  });
}

/**
 * Offers a surface as a 3D file, solids among them, with fields for the size of these.
 * @param {Api} api
 * @param {object} given
 * @param {string} given.stem file name without its ending
 * @param {import('../pkg/types.js').Surface | Mesh} given.surface
 * @param {Float64Array} given.positions of its vertices
 * @param {string | null} [given.unit]
 * @param {boolean} given.onBase
 * @param {(worker: PackageWorker) => Promise<Pick<Mesh, 'positions' | 'triangles'>>} given.mesh
 * @param {readonly Format[]} [given.further] further formats
 */
export function offerSurface(api, { stem, surface, positions, unit, onBase, mesh, further = [] }) {
  const fields = fieldsOf({
    'solid-side': { label: 'Longest side when printed, mm', value: String(suggestedSide(Math.max(...sidesOf(positions)), unit)), range: between(0.1, Infinity, 'of at least 0.1') },
    'solid-thickness': { label: onBase ? 'Base at its thinnest, mm' : 'Thickness, mm', value: '2', range: between(0.1, Infinity, 'of at least 0.1') },
  });
  const box = make('div', 'pair for-solid', ...fields.nodes());
  let wasOpen = true;
  /** @param {PackageWorker} worker */
  const solid = async (worker) => {
    const fault = fields.check();
    if (fault) throw new Error(fault);
    const made = solidOf(await mesh(worker), { side: fields.number('solid-side'), thickness: fields.number('solid-thickness'), onBase });
    ({ wasOpen } = made);
    return made;
  };
  const note = () => (wasOpen && !onBase ? SOLID_WORDS.shell : '');
  const { renew } = offerToSave(api, {
    title: '3D file', stem, unit, extra: [box],
    formats: [
      { value: 'obj', name: 'OBJ', words: FORMAT_WORDS.obj, type: 'model/obj', write: (worker) => worker.writeObj(surface) },
      { value: 'stl', name: 'STL', words: FORMAT_WORDS.stl, type: 'model/stl', write: (worker) => worker.writeStl(surface) },
      { value: 'solid.stl', name: 'Solid STL', words: SOLID_WORDS.words, type: 'model/stl', note, write: async (worker) => worker.writeStl(await solid(worker)) },
      { value: 'solid.3mf', name: 'Solid 3MF', words: SOLID_WORDS.words, type: 'model/3mf', note, write: async (worker) => threeMf(await solid(worker)) },
      { value: 'glb', name: 'GLB', words: FORMAT_WORDS.glb, type: 'model/gltf-binary', write: (worker) => worker.writeGlb(surface) },
      { value: 'ply', name: 'PLY', words: FORMAT_WORDS.ply, type: 'model/ply', write: (worker) => worker.writePly(surface) },
      ...further,
    ],
  });
  box.addEventListener('change', renew);
}
