/** The gallery: what people come for first, then what the paper's figures show, each with an input made in code. */
import { designInput } from '../design.js';
import { designed, sampled } from './inputs.js';
import { bench, bust, canopy, cathedral, fandisk, hall, hidden, note, pleats, tent, terrain, tower, turned } from './shapes.js';

/** @import {ExampleName} from '../api.js' */
/** @import {Input, Settings} from '../session.js' */

/**
 * @typedef {object} Card
 * @property {string} id also its address
 * @property {string} figure of the paper, or what it goes beyond
 * @property {string} title
 * @property {string} words two sentences
 * @property {string} look what to look at
 * @property {{ name: ExampleName, size: number, noise: number }} [example] of the package
 * @property {(size: number) => Input} [input] made here, by the pixels along its side
 * @property {(size: number) => Input} [sketch] for its picture, where the input is but lines
 * @property {number} size of it
 * @property {Partial<Settings>} settings where they are not the defaults
 * @property {string} view
 * @property {'strip' | 'drawer'} [opens] what else is shown
 */

/** Away from the middle of the design's edges: the curves of a cathedral's roof. */
const RIDGES = 0.006;

/** The paper's energy and its medium λ, where the page would look for λ by itself. */
const PAPER = /** @type {const} */ ({ lambda: 1e6, energy: 'nuclear' });

/** @type {readonly Card[]} */
export const CARDS = [
  {
    id: 'dewarp', figure: 'Beyond the paper', title: 'A curled page made flat',
    words: 'A printed page that curls, and the photo that a phone takes of it. By the shape of the page the photo is made flat.',
    look: 'Lines that were bent are straight, and letters are as wide as they were printed.',
    example: { name: 'page', size: 300, noise: 0.02 }, size: 300, settings: {}, view: 'dewarped',
  },
  {
    id: 'canopy', figure: 'Beyond the paper', title: 'A canopy to cut from card',
    words: 'The edges of a canopy on four masts are held. What is between is as developable as can be, and comes as sheets to cut out.',
    look: '“Make cut-out sheets” below: print, cut, fold.',
    input: (size) => designed('canopy', canopy, size, (x, y) => Math.max(Math.abs(x), Math.abs(y)) > 0.5 - 1.1 / size || Math.hypot(x, y) < 0.8 / size), sketch: (size) => sampled('canopy', canopy, size), size: 100, settings: PAPER, view: 'sheet',
  },
  {
    id: 'auto', figure: 'Beyond the paper', title: 'A noisy house, cleaned by itself',
    words: 'The noise of the heights is measured, some heights are held out, and the λ that predicts them best is taken. Nobody has to know what λ is.',
    look: 'What was found is said beneath the slider.',
    example: { name: 'house', size: 160, noise: 0.03 }, size: 160, settings: { lambda: 'auto', energy: 'huber' }, view: 'shaded',
  },
  {
    id: 'fig-11', figure: 'Fig. 11', title: 'A crumpled note, facet by facet',
    words: 'Facets between folds in all directions, as a phone scans a note that was in somebody’s pocket. The facets come back flat, and the folds sharp.',
    look: 'One colour for each facet between the sharper folds.',
    input: (size) => sampled('note', note, size, { noise: 0.02 }), size: 200, settings: PAPER, view: 'patches',
  },
  {
    id: 'dropouts', figure: 'Beyond the paper', title: 'Pleats with dead pixels',
    words: 'A tenth of the pixels has no height, as depth sensors have it. Narrow holes are bridged, so that the surface goes on beneath them.',
    look: 'No hole is left, and the creases are where they were.',
    input: (size) => sampled('pleats', turned(pleats, 25), size, { noise: 0.02, dropouts: 0.1 }), size: 200, settings: PAPER, view: 'shaded',
  },
  {
    id: 'smooth-bends', figure: 'Beyond the paper', title: 'A noisy cone without facets',
    words: 'A nuclear norm makes facets of a bend where there is noise. An energy that is quadratic for small bends leaves it round, and creases as sharp as they were.',
    look: 'A cone without facets; set the energy back to the nuclear norm to see them.',
    example: { name: 'cone', size: 200, noise: 0.05 }, size: 200, settings: { energy: 'huber', lambda: 1e5 }, view: 'shaded',
  },
  {
    id: 'certificate', figure: 'Beyond the paper', title: 'An oloid, proven to a thousandth',
    words: 'Each result comes with a bound that no surface can beat. Here the work goes on until the two are within a thousandth.',
    look: 'The curves of both, which close in on each other.',
    example: { name: 'oloid', size: 200, noise: 0.02 }, size: 200, settings: { ...PAPER, gap: 0.001 }, view: 'shaded', opens: 'drawer',
  },
  {
    id: 'fig-4', figure: 'Fig. 4', title: 'A roof, coarse or fine: the same pieces',
    words: 'Two vaults and a tower, with noise. λ means the same surface on a coarse image and on a fine one.',
    look: 'Change the size under “Input”: the pieces and creases stay where they are.',
    example: { name: 'roof', size: 200, noise: 0.02 }, size: 200, settings: PAPER, view: 'patches',
  },
  {
    id: 'fig-5', figure: 'Fig. 5', title: 'Steel sails behind blocks',
    words: 'The steel sails of a concert hall, known only as large blocks. Sheets that bend one way are found behind the steps.',
    look: 'The creases between sails, which no block shows.',
    input: (size) => sampled('hall', hall, size, { voxels: 30 }), size: 180, settings: { ...PAPER, lambda: 1e5 }, view: 'shaded',
  },
  {
    id: 'fig-6', figure: 'Fig. 6', title: 'Pleats in any direction',
    words: 'Pleats, turned by ten degrees against the lattice, with noise. The energy knows no direction, so that creases follow the pleats and not the lattice.',
    look: 'Straight creases, without steps along the rows.',
    input: (size) => sampled('pleats', turned(pleats, 10), size, { noise: 0.02 }), size: 200, settings: PAPER, view: 'shaded',
  },
  {
    id: 'fig-7', figure: 'Fig. 7', title: 'A bench, by another energy',
    words: 'A bench whose seat folds up into its back, solved with the second fundamental form in the place of the Hessian. The result is nearly the same, at several times the work.',
    look: 'Set the energy back to the nuclear norm under “More options”: hardly anything moves.',
    input: (size) => sampled('bench', bench, size, { noise: 0.02 }), size: 160, settings: { ...PAPER, energy: 'secondForm' }, view: 'shaded',
  },
  {
    id: 'fig-8', figure: 'Fig. 8', title: 'A bust, from one sheet to every hair',
    words: 'A bust, modelled by signed distances. A small λ makes do with a few large sheets; a big one keeps what is there.',
    look: 'The five pictures below: click one to take its λ.',
    input: (size) => sampled('bust', bust, size), size: 240, settings: { ...PAPER, lambda: 3e5 }, view: 'shaded', opens: 'strip',
  },
  {
    id: 'fig-9', figure: 'Fig. 9', title: 'A column in front of a wall',
    words: 'A column and a leaf in front of a wall, as a depth camera sees them. Where the heights jump the surface is torn, so that the jump bends nothing.',
    look: 'Clean edges from above: untick “Tear where it jumps” to see them smeared.',
    input: (size) => sampled('scene', hidden, size, { noise: 0.005, known: false }), size: 200, settings: { ...PAPER, occlusionThreshold: 2e3 }, view: 'shaded',
  },
  {
    id: 'fig-10', figure: 'Fig. 10', title: 'A noisy page, laid flat',
    words: 'A page with noise of a tenth of its height. What comes out has the lengths of the paper again.',
    look: 'The page unrolled: a rectangle in the proportions of A4, with hardly any strain.',
    example: { name: 'page', size: 200, noise: 0.1 }, size: 200, settings: { ...PAPER, lambda: 1e5 }, view: 'sheet',
  },
  {
    id: 'fig-16', figure: 'Fig. 16', title: 'A machine part from few triangles',
    words: 'Flanks, a rim and a step, on a mesh with eighteen triangles along its side. Where triangles only approximate a bend, the bend is found again.',
    look: 'Round flanks in the place of facets.',
    input: (size) => sampled('part', fandisk, size, { facets: 18 }), size: 200, settings: { ...PAPER, lambda: 1e5 }, view: 'shaded',
  },
  {
    id: 'fig-18', figure: 'Fig. 18', title: 'A surface through points and curves',
    words: 'Two edges and three points are held; there is no other input. The surface through them finds its folds by itself.',
    look: 'Rulings that lead from the edges to the pins, and across.',
    input: () => designInput(), sketch: (size) => sampled('design', tent, size), size: 120, settings: PAPER, view: 'rulings',
  },
  {
    id: 'fig-19', figure: 'Fig. 19', title: 'A cathedral’s roof from its ridges',
    words: 'Only the two ridges and the pointed arches at the ends are held. The surface between them finds its pieces by itself.',
    look: 'Curved creases that nobody has drawn.',
    input: (size) => designed('cathedral', cathedral, size, (x, y) => Math.min(Math.abs(x), Math.abs(y)) < RIDGES || Math.max(Math.abs(x), Math.abs(y)) > 0.5 - 1.1 / size),
    sketch: (size) => sampled('cathedral', cathedral, size), size: 120, settings: PAPER, view: 'shaded',
  },
  {
    id: 'fig-22', figure: 'Figs. 20, 22', title: 'A tilted cylinder without facets',
    words: 'A cylinder whose axis lies askew to the lattice, with noise. Methods that bend along the edges of a mesh make creases of it; this one does not.',
    look: 'One piece without a crease, as along the rows.',
    example: { name: 'cylinder', size: 200, noise: 0.02 }, size: 200, settings: PAPER, view: 'rulings',
  },
  {
    id: 'fig-21', figure: 'Fig. 21', title: 'A house with smeared ridges',
    words: 'A house, solved with squares of the norms. They share bends out evenly, so that creases are smeared into what cannot be laid flat.',
    look: 'Blue and red beside the ridges; with the nuclear norm under “More options” they vanish.',
    example: { name: 'house', size: 200, noise: 0.01 }, size: 200, settings: { ...PAPER, energy: 'squaredNuclear' }, view: 'gaussian',
  },
  {
    id: 'fig-23', figure: 'Fig. 23', title: 'Mountains as if folded from paper',
    words: 'Ridges at every scale, and nothing developable about them. Even so there is one best surface, and it is found.',
    look: 'Mountains as if they were folded from paper.',
    input: (size) => sampled('mountains', terrain, size), size: 260, settings: PAPER, view: 'shaded',
  },
  {
    id: 'fig-24', figure: 'Fig. 24', title: 'A hall with holes',
    words: 'The hall again with noise, and with pieces missing. Nothing is made up where there is no data, and little changes beside it.',
    look: 'The same pieces as without holes.',
    input: (size) => sampled('hall', hall, size, { noise: 0.02, hole: (x, y) => Math.hypot(x - 0.1, y - 0.15) < 0.09 || Math.hypot(x + 0.2, y + 0.18) < 0.07 || (Math.abs(x - 0.28) < 0.03 && y < 0) }),
    size: 200, settings: PAPER, view: 'shaded',
  },
  {
    id: 'fig-25', figure: 'Fig. 25', title: 'Where a bust bends both ways',
    words: 'The bust again. What bends both ways at once is gathered into bands, and what is between them can be laid flat.',
    look: 'Colours all over before, in few bands after.',
    input: (size) => sampled('bust', bust, size), size: 200, settings: { ...PAPER, lambda: 3e4 }, view: 'gaussian',
  },
  {
    id: 'fig-26', figure: 'Fig. 26', title: 'A lattice tower, where it fails',
    words: 'A lattice tower, whose bars are hardly wider than the noise is fine. Nothing tells the one from the other there.',
    look: 'Noise that stays on the legs.',
    input: (size) => sampled('tower', tower, size, { noise: 0.04 }), size: 200, settings: PAPER, view: 'shaded',
  },
];
