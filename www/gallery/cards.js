/** Cards of the gallery: common uses first, then the paper's figures. Their inputs are generated; `node tools/doors.mjs` makes their pictures. */
import { sampledInput } from './inputs.js';
import { bust, crumpledNote, hall, occludedWall, pleats, rotated, terrain, tiltedCylinder } from './shapes.js';

/**
 * @typedef {object} Card
 * @property {string} id id, which is also its address
 * @property {string} [figure] figure of the paper
 * @property {string} title
 * @property {string} words description in two sentences
 * @property {string} look what the result shows
 * @property {{ name: ExampleName, noise: number }} [example] example of the package
 * @property {(size: number, turn: number) => Input} [input] generates any other input, by the pixels along its side and the angle by which it is turned
 * @property {readonly number[]} [turns] angles by which the input may be turned, in degrees
 * @property {number} size pixels along the side of the input
 * @property {Partial<Settings>} settings settings that differ from the defaults
 * @property {string} view
 * @property {boolean} [fromAbove] whether it is seen from above at first
 * @property {'strip' | 'drawer'} [opens] part of the page that is opened with it
 */

/** Settings of the paper: the nuclear norm and a medium λ. */
const PAPER_SETTINGS = /** @type {const} */ ({ lambda: 1e6, energy: 'nuclear' });

/** All cards, in the order of the gallery. @type {readonly Card[]} */
export const CARDS = [
  {
    id: 'auto', title: 'A noisy house, cleaned by itself',
    words: 'The page measures the noise of the heights and chooses the detail (λ) by itself. You need not know what λ is.',
    look: 'The noise that was found stands below the slider.',
    example: { name: 'house', noise: 0.03 }, size: 160, settings: { lambda: 'auto', energy: 'huber' }, view: 'shaded',
  },
  {
    id: 'fig-11', figure: 'Fig. 11', title: 'A crumpled note, facet by facet',
    words: 'A phone has scanned a note that was in somebody’s pocket. The facets between its folds become flat, and the folds sharp.',
    look: 'Each facet between the sharper folds has one colour.',
    input: (size) => sampledInput('note', crumpledNote, size, { noise: 0.02 }), size: 200, settings: PAPER_SETTINGS, view: 'patches',
  },
  {
    id: 'certificate', title: 'An oloid, proven to a thousandth',
    words: 'Every result comes with a proof of how near it is to the best possible surface. Here the solve goes on until that is a thousandth.',
    look: 'The gap falls to 0.1 % of the energy.',
    example: { name: 'oloid', noise: 0.02 }, size: 200, settings: { ...PAPER_SETTINGS, gap: 0.001 }, view: 'shaded', opens: 'drawer',
  },
  {
    id: 'fig-4', figure: 'Fig. 4', title: 'A roof, coarse or fine: the same pieces',
    words: 'This is a noisy scan of two vaults and a tower. The same λ gives the same surface, on a coarse image and on a fine one.',
    look: 'Change the size under “More options”: the pieces and creases stay where they are.',
    example: { name: 'roof', noise: 0.02 }, size: 200, settings: PAPER_SETTINGS, view: 'patches',
  },
  {
    id: 'fig-5', figure: 'Fig. 5', title: 'Steel sails behind blocks',
    words: 'The input shows the steel sails of a concert hall as large blocks. The result is made of sheets that bend one way.',
    look: 'Creases appear between the sails, which no block shows.',
    input: (size) => sampledInput('hall', hall, size, { voxels: 30 }), size: 180, settings: { ...PAPER_SETTINGS, lambda: 1e5 }, view: 'shaded',
  },
  {
    id: 'fig-6', figure: 'Fig. 6', title: 'Pleats in any direction',
    words: 'These noisy pleats are turned by ten degrees against the pixels. Their creases follow the pleats and not the pixels.',
    look: 'The creases are straight, without steps along the rows.',
    input: (size) => sampledInput('pleats', rotated(pleats, 10), size, { noise: 0.02 }), size: 200, settings: PAPER_SETTINGS, view: 'shaded',
  },
  {
    id: 'fig-8', figure: 'Fig. 8', title: 'A bust, from one sheet to every hair',
    words: 'A small λ makes a bust from a few large sheets. A large one keeps every detail.',
    look: 'Click one of the five pictures to take its λ.',
    input: (size) => sampledInput('bust', bust, size), size: 240, settings: { ...PAPER_SETTINGS, lambda: 3e5 }, view: 'shaded', opens: 'strip', fromAbove: true,
  },
  {
    id: 'fig-9', figure: 'Fig. 9', title: 'A column in front of a wall',
    words: 'A depth camera sees a column and a leaf in front of a wall. The surface is torn where the heights jump, so that edges stay clean.',
    look: 'Clean edges from above: untick “Tear where it jumps” to see them smeared.',
    input: (size) => sampledInput('scene', occludedWall, size, { noise: 0.005, known: false }), size: 200, settings: { ...PAPER_SETTINGS, occlusionThreshold: 2e3 }, view: 'shaded',
  },
  {
    id: 'fig-10', figure: 'Fig. 10', title: 'The scan of a page, laid flat',
    words: 'The scan of a page has noise of a tenth of its height. The result has the lengths of the paper again.',
    look: 'The page lies flat: a rectangle with the proportions of A4, with hardly any stretch.',
    example: { name: 'page', noise: 0.1 }, size: 200, settings: { ...PAPER_SETTINGS, lambda: 1e5 }, view: 'sheet',
  },
  {
    id: 'fig-22', figure: 'Figs. 20, 22', title: 'A tilted cylinder without facets',
    words: 'The axis of a noisy cylinder lies askew to the pixels. Methods that bend along the edges of a mesh crease it; this one does not.',
    look: 'The result is one piece without a crease, however far it is turned.',
    input: (size, turn) => sampledInput('cylinder', rotated(tiltedCylinder, turn), size, { noise: 0.02 }), turns: [0, 10, 20, 30, 45], size: 200, settings: { ...PAPER_SETTINGS, lambda: 3e5 }, view: 'rulings',
  },
  {
    id: 'fig-21', figure: 'Fig. 21', title: 'A house with smeared ridges',
    words: 'An energy of squares spreads bends out. It smears the ridges of a house, which then cannot be laid flat.',
    look: 'Blue and red stand beside the ridges. They vanish with the nuclear norm under “More options”.',
    example: { name: 'house', noise: 0.01 }, size: 200, settings: { ...PAPER_SETTINGS, energy: 'squaredNuclear' }, view: 'gaussian',
  },
  {
    id: 'fig-23', figure: 'Fig. 23', title: 'Mountains as if folded from paper',
    words: 'Mountains have ridges of every size and do not bend like paper. Even so there is one best surface, and the page finds it.',
    look: 'The mountains look as if folded from paper.',
    input: (size) => sampledInput('mountains', terrain, size), size: 260, settings: PAPER_SETTINGS, view: 'shaded',
  },
  {
    id: 'fig-25', figure: 'Fig. 25', title: 'Where a bust bends both ways',
    words: 'A bust bends both ways at once. The result gathers this in narrow bands, and what is between them can be laid flat.',
    look: 'Colours are all over before, and in few bands after.',
    input: (size) => sampledInput('bust', bust, size), size: 200, settings: { ...PAPER_SETTINGS, lambda: 3e4 }, view: 'gaussian',
  },
];
