/** Dialog of sheets to cut out: size, paper, material and tabs, with a preview of the drawing that is saved. */
import { element, make, numberField } from '../dom.js';
import { number } from '../format.js';
import { assemblyModel, assemblyPicture, drawingImage, MM_PER_UNIT, sheetFigures, sheetsInWords, smallestPiece, suggestedSide } from '../pattern.js';
import { plainMessage } from '../error-messages.js';
import { SHEET_WORDS } from '../messages.js';
import { edgeAt, parsePairs, togglePair } from '../sheet-edges.js';
import { figures } from '../views/legend.js';
import { offerToSave } from './save-dialog.js';
import { waitingPanel } from './waiting.js';

/** @import {Api} from '../api.js' */
/** @import {CutOptions, LengthUnit} from '../pattern.js' */
/** @import {TaskProgress} from './waiting.js' */
/** @typedef {import('../../pkg/types.js').Drawing} Drawing */

/** Initial depth of tabs, in millimetres. */
const DEFAULT_TAB_DEPTH_MM = 6;
/** Delay after an input before the pattern is computed, in milliseconds. */
const INPUT_DELAY_MS = 300;

/** Options that were chosen last; they are the initial ones of the next dialog. */
const lastOptions = { paper: /^en-(US|CA)/.test(navigator.language) ? 'letter' : 'a4', tabs: true, depth: DEFAULT_TAB_DEPTH_MM, metal: false, thickness: 1, radius: NaN, kFactor: 0.44 };
/** Sizes and units that were chosen last, by the stem of the file's name. @type {Map<string, { side: number, unit: string }>} */
const lastSizes = new Map();
/** Length of a piece below which it can hardly be held, folded and glued, in millimetres. */
const MIN_HANDY_PIECE_MM = 10;
/** Maximum number of pages that are printed without a question. */
const MAX_EXPECTED_PAGES = 12;
/** Bounds of the longer side, in millimetres. */
const [MIN_SIDE_MM, MAX_SIDE_MM] = [10, 5000];

/**
 * A surface that can be cut into sheets.
 * @typedef {object} SheetSource
 * @property {string} stem file name without ending
 * @property {number} length longer side, in the input's unit
 * @property {'y' | 'z'} up the axis that points upwards
 * @property {string} [note] note that says what the sheets lack
 * @property {LengthUnit | 'none' | 'unknown'} unit unit of the input; `none` for an example, which has any size
 * @property {(options: CutOptions, onProgress: (progress: TaskProgress) => void) => Promise<Drawing>} cut computes the pattern
 * @property {(drawing: Drawing) => Promise<Uint8Array<ArrayBuffer>>} svg writes a drawing as SVG
 * @property {() => Promise<number | undefined>} metalThickness thickness of a solid of sheet metal, in the input's unit
 * @property {(drawing: Drawing) => boolean} canFoldElsewhere whether other edges of a drawing may be cut and joined: of flat faces, of which nothing is stretched
 * @property {() => void} stop cancels the pattern that is being computed
 */

/**
 * Opens the dialog.
 * @param {Api} api
 * @param {SheetSource} source
 */
export function offerSheets(api, { stem, note = '', length, unit, up, cut, svg, metalThickness, canFoldElsewhere, stop }) {
  const last = lastSizes.get(stem) ?? { unit: unit === 'unknown' ? 'none' : unit, side: NaN };
  const { input: side, label: sideField } = numberField(SHEET_WORDS.side, Number.isNaN(last.side) ? suggestedSide(length, last.unit) : last.side, MIN_SIDE_MM, MAX_SIDE_MM);
  const units = make('select', '', ...Object.keys(MM_PER_UNIT).map((name) => new Option(SHEET_WORDS.unit(name), name)), new Option(SHEET_WORDS.ownSize, 'none'));
  units.value = last.unit;
  const unitField = make('label', 'field', SHEET_WORDS.units, units);
  unitField.hidden = unit === 'none';
  const { input: depth, label: depthField } = numberField(SHEET_WORDS.tabDepth, lastOptions.depth, 1, 50);
  const tabs = make('input', '');
  Object.assign(tabs, { type: 'checkbox', checked: lastOptions.tabs });
  const metal = make('select', '', new Option(SHEET_WORDS.card, ''), new Option(SHEET_WORDS.metal, 'metal'));
  metal.value = lastOptions.metal ? 'metal' : '';
  const { input: thickness, label: thicknessField } = numberField(SHEET_WORDS.thickness, lastOptions.thickness, 0.05, 20);
  const { input: radius, label: radiusField } = numberField(SHEET_WORDS.radius, lastOptions.radius, 0, 100);
  Object.assign(radius, { required: false, placeholder: SHEET_WORDS.likeThickness });
  const { input: kFactor, label: kFactorField } = numberField(SHEET_WORDS.kFactor, lastOptions.kFactor, 0.1, 0.9);
  const forCard = [make('label', 'check', tabs, SHEET_WORDS.tabs), depthField];
  const metalNote = make('p', 'muted small');
  const forMetal = [metalNote, thicknessField, radiusField, kFactorField];
  const [toCut, toJoin] = [0, 1].map(() => Object.assign(make('input', ''), { type: 'text', placeholder: SHEET_WORDS.pairs }));
  // Only flat faces can be cut apart anywhere: nothing of them is stretched.
  const edges = make('div', 'sheets-options edges', make('p', 'muted small', SHEET_WORDS.edges), make('label', 'field', SHEET_WORDS.toCut, toCut), make('label', 'field', SHEET_WORDS.toJoin, toJoin));
  edges.hidden = true;
  /** @returns {CutOptions} */
  const cutOptions = () => ({
    ...(toCut.value.trim() && { cut: parsePairs(toCut.value) ?? [] }),
    ...(toJoin.value.trim() && { join: parsePairs(toJoin.value) ?? [] }),
    ...materialOptions(),
  });
  /** @returns {CutOptions} */
  const materialOptions = () => (metal.value
    ? { side: side.valueAsNumber, thickness: thickness.valueAsNumber, innerRadius: radius.value === '' ? undefined : radius.valueAsNumber, kFactor: kFactor.valueAsNumber }
    : { side: side.valueAsNumber, tabs: tabs.checked ? depth.valueAsNumber : undefined });
  const showFields = () => {
    for (const field of forCard) field.hidden = metal.value !== '';
    for (const field of forMetal) field.hidden = metal.value === '';
  };
  const paper = make('select', '', new Option('A4', 'a4'), new Option('Letter', 'letter'), new Option(SHEET_WORDS.onePage, ''));
  paper.value = lastOptions.paper;
  const preview = make('div', 'preview');
  const status = make('p', 'said');
  status.setAttribute('role', 'status');
  const waitingElement = make('div', 'waiting');
  waitingElement.id = 'cutting';
  const waiting = waitingPanel(waitingElement, () => {
    setMissing('it was cancelled');
    stop();
    waiting.end();
    preview.setAttribute('aria-busy', 'false');
    status.textContent = SHEET_WORDS.cancelled;
    again.hidden = false;
    again.focus();
    offer.renew();
  });
  const again = make('button', '', SHEET_WORDS.cut);
  Object.assign(again, { type: 'button', hidden: true });
  again.addEventListener('click', () => void draw());
  const about = make('div', '');
  const pageWarning = make('p', 'guess small');
  pageWarning.hidden = true;
  /** @type {Promise<Drawing>} */
  let drawing;
  /** Rejects the drawing: writers of files then report the reason. @param {string} reason */
  const setMissing = (reason) => {
    drawing = Promise.reject(new Error(reason));
    drawing.catch(() => {});
  };
  setMissing('');

  /** Shows the size of the finished surface and the number of pages. @param {Drawing} finished */
  const showSize = (finished) => {
    const { summary } = finished;
    const smallest = smallestPiece(finished);
    const pages = paper.value === 'a4' || paper.value === 'letter' ? summary[paper.value] : 1;
    element('save-title', HTMLElement).textContent = SHEET_WORDS.headline(number(side.valueAsNumber, 4), pages, summary.seams, finished.sheets.length > 1 ? number(smallest, 2) : undefined);
    const warnings = [...(pages > MAX_EXPECTED_PAGES ? [SHEET_WORDS.manyPages(pages)] : []), ...(smallest < MIN_HANDY_PIECE_MM ? [SHEET_WORDS.small(number(smallest, 2))] : [])];
    pageWarning.hidden = warnings.length === 0;
    pageWarning.textContent = warnings.join(' ');
  };

  const draw = async () => {
    for (const field of [toCut, toJoin]) field.setCustomValidity(parsePairs(field.value) ? '' : SHEET_WORDS.wrongPairs);
    const wrong = [toCut, toJoin].find((field) => !field.checkValidity());
    const invalid = wrong ?? [side, ...(metal.value ? [thickness, radius, kFactor] : [depth])].find((field) => !field.checkValidity());
    if (invalid) {
      stop();
      waiting.end();
      setMissing(wrong ? SHEET_WORDS.wrongPairs : SHEET_WORDS.outOfRange(invalid.labels?.[0]?.firstChild?.textContent ?? '', invalid.min, invalid.max));
      offer.renew();
      invalid.reportValidity();
      return;
    }
    lastSizes.set(stem, { side: side.valueAsNumber, unit: units.value });
    Object.assign(lastOptions, { paper: paper.value, tabs: tabs.checked, depth: depth.valueAsNumber, metal: metal.value !== '', thickness: thickness.valueAsNumber, radius: radius.valueAsNumber, kFactor: kFactor.valueAsNumber });
    depth.disabled = !tabs.checked;
    status.textContent = '';
    again.hidden = true;
    preview.setAttribute('aria-busy', 'true');
    waiting.begin('cutting');
    const requested = (drawing = cut({ ...cutOptions(), assembly: true }, waiting.tell));
    let failed = false;
    offer.renew();
    try {
      const image = await drawingImage(svg, await requested);
      if (requested !== drawing) return;
      const finished = await requested;
      waiting.end();
      showSize(finished);
      edges.hidden = !canFoldElsewhere(finished);
      const solid = await metalThickness();
      for (const field of [thicknessField, radiusField]) field.hidden = metal.value === '' || solid !== undefined;
      metalNote.textContent = solid === undefined ? SHEET_WORDS.upperSide : SHEET_WORDS.blank(number((solid * side.valueAsNumber) / length));
      image.addEventListener('click', ({ offsetX, offsetY }) => {
        if (!edges.hidden) toggleEdge(finished, [(offsetX / image.clientWidth) * finished.width, (1 - offsetY / image.clientHeight) * finished.height]);
      });
      preview.replaceChildren(image);
      status.textContent = sheetsInWords(finished);
      about.replaceChildren(figures(sheetFigures(finished)));
    } catch (error) {
      if (requested !== drawing) return;
      preview.replaceChildren();
      about.replaceChildren();
      const reason = plainMessage(error instanceof Error ? error.message : String(error));
      const isCurvedFold = error instanceof Error && 'code' in error && error.code === 'CURVED_FOLD';
      status.textContent = isCurvedFold ? SHEET_WORDS.curvedFold : SHEET_WORDS.uncut(reason);
      failed = true;
    } finally {
      if (requested === drawing) {
        preview.setAttribute('aria-busy', 'false');
        waiting.end();
      }
    }
    if (!failed) return;
    // The reason stands beside the preview.
    setMissing('');
    offer.renew();
  };
  /** Cuts the fold at a place of the drawing, or folds the cut there; again, it is as before. @param {Drawing} finished @param {[number, number]} place */
  const toggleEdge = (finished, place) => {
    const edge = edgeAt(finished, place);
    if (!edge) {
      status.textContent = SHEET_WORDS.noEdge;
      return;
    }
    const [own, other] = edge.isFold ? [toCut, toJoin] : [toJoin, toCut];
    const isUndone = (parsePairs(other.value) ?? []).some((pair) => String(pair) === String(edge.pair));
    const field = isUndone ? other : own;
    field.value = togglePair(field.value, edge.pair);
    void draw();
  };
  let inputTimer = 0;
  metal.addEventListener('change', showFields);
  showFields();
  units.addEventListener('change', () => {
    side.value = String(suggestedSide(length, units.value));
    void draw();
  });
  side.addEventListener('input', () => (units.value = 'none'));
  for (const field of [toCut, toJoin]) field.addEventListener('change', () => void draw());
  for (const field of [side, depth, tabs, metal, thickness, radius, kFactor]) {
    field.addEventListener('input', () => {
      clearTimeout(inputTimer);
      inputTimer = window.setTimeout(() => void draw(), INPUT_DELAY_MS);
    });
  }
  paper.addEventListener('change', () => {
    lastOptions.paper = paper.value;
    void drawing.then(showSize, () => {});
    offer.renew();
  });

  const offer = offerToSave(api, {
    title: SHEET_WORDS.title,
    stem: `${stem}-sheets`,
    ready: () => drawing,
    // A pattern that is still being computed would delay the next analysis.
    closed: stop,
    extra: [make('div', 'sheets',
      preview,
      make('div', 'sheets-options',
        status,
        pageWarning,
        ...(note ? [make('p', 'small', note)] : []),
        waitingElement,
        again,
        unitField,
        sideField,
        make('label', 'field', SHEET_WORDS.paper, paper),
        make('label', 'field', SHEET_WORDS.material, metal),
        ...forCard,
        ...forMetal,
        edges,
        make('details', 'more', make('summary', '', SHEET_WORDS.figures), about)))],
    formats: [
      { value: 'pdf', name: 'PDF', words: SHEET_WORDS.pdf, type: 'application/pdf',
        write: async (worker) => worker.writePdf(await drawing, { stock: paper.value === 'a4' || paper.value === 'letter' ? paper.value : undefined, title: stem }) },
      { value: 'svg', name: 'SVG', words: SHEET_WORDS.svg, type: 'image/svg+xml', write: async (worker) => worker.writeSvg(await drawing) },
      { value: 'dxf', name: 'DXF', words: SHEET_WORDS.dxf, type: 'image/vnd.dxf', write: async (worker) => worker.writeDxf(await drawing) },
      { value: 'png', name: 'PNG', words: SHEET_WORDS.png, type: 'image/png', write: async () => assemblyPicture(await drawing, up) },
      { value: 'glb', name: 'GLB', words: SHEET_WORDS.glb, type: 'model/gltf-binary', write: async () => assemblyModel(await drawing) },
    ],
  });
  void draw();
}
