/** The result as sheets to cut out: how large, on what paper, with tabs or without; looked at, then saved. */
import { make } from '../dom.js';
import { handyLength, likelyUnit, MILLIMETRES, modelOf, numberedPicture, piecesInFigures, piecesInWords, previewOf } from '../pattern.js';
import { plainly } from '../error-messages.js';
import { SHEET_WORDS } from '../messages.js';
import { figures } from '../views/legend.js';
import { offerToSave } from './save-dialog.js';
import { waitingPanel } from './waiting.js';

/** @import {Api} from '../api.js' */
/** @import {Cut, LengthUnit} from '../pattern.js' */
/** @typedef {import('../../pkg/types.js').Drawing} Drawing */

/** Depth of tabs in millimetres, at first. */
const TABS = 6;
/** Milliseconds for a vertex, until that was measured. */
const EACH = 0.02;
/** How long a number rests, in milliseconds, before the sheets are drawn anew. */
const REST = 300;

/** What was chosen last, for the next time. */
const chosen = { paper: /^en-(US|CA)/.test(navigator.language) ? 'letter' : 'a4', tabs: true, depth: TABS, metal: false, thickness: 1, radius: NaN, kFactor: 0.44 };
/** The size and the unit that were chosen last, by the input's name. @type {Map<string, { side: number, unit: string }>} */
const sizes = new Map();
/** Bounds of the longer side in millimetres. */
const [MIN_SIDE, MAX_SIDE] = [10, 5000];

/**
 * What is cut, and how.
 * @typedef {object} Cutter
 * @property {string} stem of the file's name
 * @property {number} size vertices
 * @property {number} length of the longer side, in the input's unit
 * @property {string} [note] what is left out of the sheets
 * @property {LengthUnit | 'none' | 'unknown'} unit of the input; `none`: it is an example, of any size
 * @property {(options: Cut) => Promise<Drawing>} cut
 * @property {(drawing: Drawing) => Promise<Uint8Array<ArrayBuffer>>} svg
 * @property {() => void} stop what is still being cut
 */

/**
 * @param {Api} api
 * @param {Cutter} cutter
 */
export function offerSheets(api, { stem, size, note = '', length, unit, cut, svg, stop }) {
  const last = sizes.get(stem) ?? { unit: unit === 'unknown' ? likelyUnit(length) : unit, side: NaN };
  const side = numberField(Number.isNaN(last.side) ? handyLength(length, last.unit) : last.side, MIN_SIDE, MAX_SIDE);
  const units = make('select', '', ...Object.keys(MILLIMETRES).map((name) => new Option(SHEET_WORDS.unit(name), name)), new Option(SHEET_WORDS.ownSize, 'none'));
  units.value = last.unit;
  const unitField = make('label', 'field', SHEET_WORDS.units, units);
  unitField.hidden = unit === 'none';
  const depth = numberField(chosen.depth, 1, 50);
  const tabs = make('input', '');
  Object.assign(tabs, { type: 'checkbox', checked: chosen.tabs });
  const metal = make('select', '', new Option(SHEET_WORDS.card, ''), new Option(SHEET_WORDS.metal, 'metal'));
  metal.value = chosen.metal ? 'metal' : '';
  const thickness = numberField(chosen.thickness, 0.05, 20);
  const radius = numberField(chosen.radius, 0, 100);
  Object.assign(radius, { required: false, placeholder: SHEET_WORDS.likeThickness });
  const kFactor = numberField(chosen.kFactor, 0.1, 0.9);
  const forCard = [make('label', 'check', tabs, SHEET_WORDS.tabs), make('label', 'field', SHEET_WORDS.tabDepth, depth)];
  const forMetal = [
    make('label', 'field', SHEET_WORDS.thickness, thickness),
    make('label', 'field', SHEET_WORDS.radius, radius),
    make('label', 'field', SHEET_WORDS.kFactor, kFactor),
  ];
  /** @returns {Cut} */
  const wish = () => (metal.value
    ? { side: side.valueAsNumber, thickness: thickness.valueAsNumber, innerRadius: radius.value === '' ? undefined : radius.valueAsNumber, kFactor: kFactor.valueAsNumber }
    : { side: side.valueAsNumber, tabs: tabs.checked ? depth.valueAsNumber : undefined });
  const suit = () => {
    for (const field of forCard) field.hidden = metal.value !== '';
    for (const field of forMetal) field.hidden = metal.value === '';
  };
  const paper = make('select', '', new Option('A4', 'a4'), new Option('Letter', 'letter'), new Option(SHEET_WORDS.onePage, ''));
  paper.value = chosen.paper;
  const sideField = make('label', 'field', SHEET_WORDS.side, side);
  const preview = make('div', 'preview');
  const words = make('p', 'said');
  words.setAttribute('role', 'status');
  const panel = make('div', 'waiting');
  panel.id = 'cutting';
  const waiting = waitingPanel(panel, () => {
    drawing = Promise.reject(new Error('it was cancelled'));
    drawing.catch(() => {});
    stop();
    waiting.end();
    preview.setAttribute('aria-busy', 'false');
    words.textContent = SHEET_WORDS.cancelled;
    again.hidden = false;
    again.focus();
    offer.renew();
  });
  const again = make('button', '', SHEET_WORDS.cut);
  Object.assign(again, { type: 'button', hidden: true });
  again.addEventListener('click', () => void draw());
  const about = make('div', '');
  const slow = { words: SHEET_WORDS.cutting, kind: 'sheets', size, each: EACH };
  /** @type {Promise<Drawing>} */
  let drawing = Promise.reject(new Error(SHEET_WORDS.nothingYet));
  drawing.catch(() => {});

  const draw = async () => {
    const wrong = [side, ...(metal.value ? [thickness, radius, kFactor] : [depth])].find((field) => !field.checkValidity());
    if (wrong) {
      stop();
      waiting.end();
      const words = SHEET_WORDS.outOfRange(wrong.labels?.[0]?.firstChild?.textContent ?? '', wrong.min, wrong.max);
      drawing = Promise.reject(new Error(words));
      drawing.catch(() => {});
      offer.renew();
      wrong.reportValidity();
      return;
    }
    sizes.set(stem, { side: side.valueAsNumber, unit: units.value });
    Object.assign(chosen, { paper: paper.value, tabs: tabs.checked, depth: depth.valueAsNumber, metal: metal.value !== '', thickness: thickness.valueAsNumber, radius: radius.valueAsNumber, kFactor: kFactor.valueAsNumber });
    depth.disabled = !tabs.checked;
    words.textContent = '';
    again.hidden = true;
    preview.setAttribute('aria-busy', 'true');
    waiting.begin(slow);
    const wanted = (drawing = cut({ ...wish(), assembly: true }));
    let uncut = false;
    offer.renew();
    try {
      const image = await previewOf(svg, await wanted);
      if (wanted !== drawing) return;
      const made = await wanted;
      waiting.end(slow);
      preview.replaceChildren(image);
      words.textContent = piecesInWords(made);
      about.replaceChildren(figures(piecesInFigures(made)));
    } catch (error) {
      if (wanted !== drawing) return;
      preview.replaceChildren();
      about.replaceChildren();
      const reason = plainly(error instanceof Error ? error.message : String(error));
      const curved = error instanceof Error && 'code' in error && error.code === 'CURVED_FOLD';
      words.textContent = curved ? SHEET_WORDS.curvedFold : SHEET_WORDS.uncut(reason);
      uncut = true;
    } finally {
      if (wanted === drawing) {
        preview.setAttribute('aria-busy', 'false');
        waiting.end();
      }
    }
    if (!uncut) return;
    // Why, is said beside the preview; beside Save it is enough that there is nothing to save.
    drawing = Promise.reject(new Error(SHEET_WORDS.nothingYet));
    drawing.catch(() => {});
    offer.renew();
  };
  let rest = 0;
  metal.addEventListener('change', suit);
  suit();
  units.addEventListener('change', () => {
    side.value = String(handyLength(length, units.value));
    void draw();
  });
  side.addEventListener('input', () => (units.value = 'none'));
  for (const field of [side, depth, tabs, metal, thickness, radius, kFactor]) {
    field.addEventListener('input', () => {
      clearTimeout(rest);
      rest = window.setTimeout(() => void draw(), REST);
    });
  }
  paper.addEventListener('change', () => {
    chosen.paper = paper.value;
    offer.renew();
  });

  const offer = offerToSave(api, {
    title: SHEET_WORDS.title,
    stem: `${stem}-sheets`,
    size,
    ready: () => drawing,
    // What is still being cut would hold up the next question.
    closed: stop,
    extra: [make('div', 'sheets',
      preview,
      make('div', 'sheets-options',
        words,
        ...(note ? [make('p', 'small', note)] : []),
        panel,
        again,
        unitField,
        sideField,
        make('label', 'field', SHEET_WORDS.paper, paper),
        make('label', 'field', SHEET_WORDS.material, metal),
        ...forCard,
        ...forMetal,
        make('details', 'more', make('summary', '', SHEET_WORDS.figures), about)))],
    formats: [
      { value: 'pdf', name: 'PDF', words: SHEET_WORDS.pdf, type: 'application/pdf',
        write: async (worker) => worker.writePdf(await drawing, { stock: paper.value === 'a4' || paper.value === 'letter' ? paper.value : undefined, title: stem }) },
      { value: 'svg', name: 'SVG', words: SHEET_WORDS.svg, type: 'image/svg+xml', write: async (worker) => worker.writeSvg(await drawing) },
      { value: 'dxf', name: 'DXF', words: SHEET_WORDS.dxf, type: 'image/vnd.dxf', write: async (worker) => worker.writeDxf(await drawing) },
      { value: 'png', name: 'PNG', words: SHEET_WORDS.png, type: 'image/png', write: async () => numberedPicture(await drawing) },
      { value: 'glb', name: 'GLB', words: SHEET_WORDS.glb, type: 'model/gltf-binary', write: async () => modelOf(await drawing) },
    ],
  });
  void draw();
}

/** @param {number} value none where it is NaN @param {number} min @param {number} max */
function numberField(value, min, max) {
  const field = make('input', '');
  Object.assign(field, { type: 'number', value: Number.isNaN(value) ? '' : String(value), min: String(min), max: String(max), step: 'any', required: true });
  return field;
}
