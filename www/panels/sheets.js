/** Dialog of sheets to cut out: size, paper, material and tabs, with a preview of the drawing that is saved. */
import { element, make, makeButton, SETTLING_MS } from '../dom.js';
import { between, fieldsOf } from '../fields.js';
import { number } from '../format.js';
import { History } from '../history.js';
import { keep, kept } from '../kept.js';
import { assemblyOf, buildSteps, countsInWords, drawingImage, faultsInWords, MAX_SIDE_MM, MIN_SIDE_MM, MM_PER_UNIT, sheetFigures, suggestedSide, trueSide } from '../pattern.js';
import { hasCode, plainMessage } from '../error-messages.js';
import { SAVE_WORDS, SHEET_WORDS } from '../messages.js';
import { PAPERS } from '../page/paper.js';
import { edgeAt, parsePairs, togglePair } from '../sheet-edges.js';
import { builtPicture } from '../surface/built-picture.js';
import { figures } from '../views/legend.js';
import { offerToSave } from './save-dialog.js';
import { waitingPanel } from './waiting.js';

/** @import {CutOptions, LengthUnit} from '../pattern.js' */
/** @import {TaskProgress} from './waiting.js' */

/** Returns the error message for a text of pairs of pieces; empty if it is valid. @param {string} text */
const faultOfPairs = (text) => (parsePairs(text) ? '' : SHEET_WORDS.wrongPairs);
/** Fields of the dialog; the first is a slider. @satisfies {Record<string, import('../fields.js').Field>} */
const FIELDS = {
  'sheet-detail': { label: 'Pieces: simpler ↔ closer to the input' },
  'sheet-unit': { label: 'Unit of its lengths', options: { ...Object.fromEntries(Object.keys(MM_PER_UNIT).map((name) => [name, SHEET_WORDS.unit(name)])), none: 'none: choose the size' } },
  'sheet-side': { label: 'Longer side when finished, mm', range: between(MIN_SIDE_MM, MAX_SIDE_MM) },
  'sheet-paper': { label: 'Paper', options: { a4: 'A4', letter: 'Letter', '': 'one large page' } },
  'sheet-fitting': { label: 'Pieces that fit one page', value: true },
  'sheet-material': { label: 'Material', options: { '': 'card or paper', metal: 'sheet metal' } },
  'sheet-tabs': { label: 'Tabs to glue', value: true },
  'sheet-tab-depth': { label: 'Tab depth, mm', range: between(1, 50) },
  'sheet-thickness': { label: 'Thickness, mm', range: between(0.05, 20) },
  'sheet-radius': { label: 'Inner radius, mm', range: between(0, 100), optional: true, placeholder: 'as the thickness' },
  'sheet-k': { label: 'K-factor (neutral line)', range: between(0.1, 0.9) },
  'sheet-kerf': { label: 'Kerf of a laser or saw, mm', range: between(0, 10) },
  'sheet-faces': { label: 'Flat faces at most', range: between(4, 100_000), optional: true, placeholder: 'as many as it has' },
  'sheet-cut': { label: 'Cut between pieces', placeholder: SHEET_WORDS.pairs, wrong: faultOfPairs },
  'sheet-join': { label: 'Fold between pieces', placeholder: SHEET_WORDS.pairs, wrong: faultOfPairs },
};
/** @typedef {keyof typeof FIELDS} FieldName */
/** What was chosen last, on earlier visits too. */
const lastOptions = {
  'sheet-paper': /^en-(US|CA)/.test(navigator.language) ? 'letter' : 'a4', 'sheet-fitting': true, 'sheet-material': '', 'sheet-tabs': true, 'sheet-tab-depth': '6',
  'sheet-thickness': '1', 'sheet-radius': '', 'sheet-k': '0.44', 'sheet-kerf': '0', ...kept('sheets', {}),
};
/** What was chosen last for the model whose sheets were shown last. @type {{ model: string, choice: Partial<Record<FieldName, string | boolean>> }} */
let lastModel = kept('sheets of the model', { model: '', choice: {} });
/** Fields whose choice belongs to the model. @type {readonly FieldName[]} */
const OF_MODEL = ['sheet-unit', 'sheet-side', 'sheet-faces', 'sheet-cut', 'sheet-join'];
/** Length of a piece below which it can hardly be held, folded and glued, in millimetres. */
const MIN_HANDY_PIECE_MM = 10;
/** Number of joints above which a model takes more than an evening. */
const MAX_EASY_JOINTS = 100;
/** Blank margin of the pages of a format, in millimetres, as the library leaves it. */
const PAGE_MARGIN_MM = 10;
/** Maximum number of pages that are printed without a question. */
const MAX_EXPECTED_PAGES = 12;

/**
 * A surface that can be cut into sheets.
 * @typedef {object} SheetSource
 * @property {string} stem file name without ending
 * @property {string} model what the size, cuts and folds are kept with
 * @property {number} length longer side, in the input's unit
 * @property {'y' | 'z'} up the axis that points upwards
 * @property {string} [note] note that says what the sheets lack
 * @property {LengthUnit | 'none' | 'unknown'} unit unit of the input; `none` for an example, which has any size
 * @property {(options: CutOptions, onProgress: (progress: TaskProgress) => void) => Promise<Drawing>} cut computes the pattern
 * @property {() => Promise<number | undefined>} metalThickness thickness of a solid of sheet metal, in the input's unit
 * @property {boolean} isMesh whether it is a whole mesh, whose own faces may be flat
 * @property {() => void} stop cancels the pattern that is being computed
 * @property {number} lambda of the surface
 * @property {() => void} cancelSolve cancels the solve of another λ
 * @property {boolean} isFitted whether less detail makes simpler pieces
 * @property {() => Promise<unknown>} solved resolves when the next solve has ended
 * @property {() => void} again offers the sheets of what was solved then
 */

/** Opens the dialog. @param {Api} api @param {SheetSource} source */
export function offerSheets(api, { stem, model, note = '', length, unit, up, cut, metalThickness, isMesh, stop, lambda, cancelSolve, isFitted, solved, again: offerAgain }) {
  const suggested = suggestedSide(length, unit);
  const fields = fieldsOf(FIELDS);
  // A size that is not the true one goes by no unit.
  const choice = { ...lastOptions, 'sheet-unit': suggested === trueSide(length, unit) ? unit : 'none', 'sheet-side': suggested, ...(lastModel.model === model && lastModel.choice) };
  for (const [name, value] of Object.entries(choice)) fields.set(/** @type {FieldName} */ (name), value);
  fields.show(unit !== 'none', 'sheet-unit');
  const [detail, pageDetail] = [fields.control('sheet-detail'), element('lambda', HTMLInputElement)];
  Object.assign(detail, { type: 'range', min: pageDetail.min, max: pageDetail.max, step: pageDetail.step, value: String(Math.log10(lambda)) });
  const side = () => fields.number('sheet-side');
  const paper = () => /** @type {'a4' | 'letter' | ''} */ (fields.text('sheet-paper'));
  const isMetal = () => fields.text('sheet-material') !== '';
  const metalNote = make('p', 'muted small');
  /** Thickness of a solid of sheet metal. @type {number | undefined} */
  let thickness;
  const byNumber = make('details', 'more', make('summary', 'small', SHEET_WORDS.byNumber), ...fields.nodes('sheet-cut', 'sheet-join'));
  const edgeNote = make('p', 'small');
  edgeNote.role = 'status';
  const undo = makeButton('plain', () => history.step(), SHEET_WORDS.undo);
  const edges = Object.assign(make('div', 'edges', make('div', 'several', edgeNote, undo), byNumber), { hidden: true });
  /** The edge that was clicked, until it is drawn, and what is said when that is done. @type {[clicked: ReturnType<typeof edgeAt>, words: string]} */
  let [clicked, edgeWords] = [null, SHEET_WORDS.edges];
  /** The edge under the pointer, over the drawing. */
  const [mark, markPath] = ['svg', 'path'].map((name) => document.createElementNS('http://www.w3.org/2000/svg', name));
  mark.append(markPath);
  /** Number of pieces of the last drawing. */
  let pieces = Infinity;
  /** @returns {CutOptions} */
  const cutOptions = () => ({
    ...(fields.text('sheet-cut').trim() && { cut: parsePairs(fields.text('sheet-cut')) ?? [] }),
    ...(fields.text('sheet-join').trim() && { join: parsePairs(fields.text('sheet-join')) ?? [] }),
    ...(fields.text('sheet-faces') !== '' && { faces: fields.number('sheet-faces') }),
    ...(!isMetal() && fields.isChecked('sheet-fitting') && { stock: paper() || undefined }),
    side: side(),
    kerf: fields.number('sheet-kerf'),
    ...(isMetal()
      ? { thickness: fields.number('sheet-thickness'), innerRadius: fields.text('sheet-radius') === '' ? undefined : fields.number('sheet-radius'), kFactor: fields.number('sheet-k') }
      : { tabs: fields.isChecked('sheet-tabs') ? fields.number('sheet-tab-depth') : undefined }),
  });
  const keepOptions = () => {
    const values = /** @param {readonly string[]} names */ (names) => fields.values(...(/** @type {readonly FieldName[]} */ (names)));
    keep('sheets', Object.assign(lastOptions, values(Object.keys(lastOptions))));
    keep('sheets of the model', lastModel = { model, choice: values(OF_MODEL) });
  };
  const showFields = () => {
    fields.show(!isMetal(), 'sheet-tabs');
    fields.show(fields.text('sheet-faces') === '', 'sheet-detail');
    fields.show(!isMetal() && fields.isChecked('sheet-tabs'), 'sheet-tab-depth');
    fields.show(isMetal() && thickness === undefined, 'sheet-thickness', 'sheet-radius');
    fields.show(isMetal(), 'sheet-k');
    metalNote.hidden = !isMetal();
    metalNote.textContent = thickness === undefined ? SHEET_WORDS.upperSide : SHEET_WORDS.blank(number((thickness * side()) / length));
  };
  const preview = make('div', 'preview');
  /** @type {History<Record<string, string | boolean>>} */
  const history = new History(preview, (values) => {
    for (const [name, value] of Object.entries(values)) fields.set(/** @type {FieldName} */ (name), value);
    void draw();
  });
  const status = Object.assign(make('p', 'said'), { role: 'status' });
  const waitingElement = Object.assign(make('div', 'waiting over-picture'), { id: 'cutting' });
  /** Whether the surface is being solved with another detail: then what there is is offered again. */
  let isSolving = false;
  const waiting = waitingPanel(waitingElement, () => {
    if (isSolving) return cancelSolve();
    leave('it was cancelled');
    status.textContent = SAVE_WORDS.cancelled;
    again.hidden = false;
    again.focus();
  });
  const again = Object.assign(makeButton('', () => draw(), SHEET_WORDS.cut), { hidden: true });
  const fit = Object.assign(makeButton('', () => {
    fields.set('sheet-side', fit.value);
    fields.control('sheet-side').dispatchEvent(new Event('input', { bubbles: true }));
  }, ''), { hidden: true });
  const about = make('div', '');
  const warning = Object.assign(make('p', 'guess small'), { hidden: true });
  /** @type {Promise<Drawing>} */
  let drawing = new Promise(() => {});
  /** Ends without a drawing: writers of files then report the reason. @param {string} reason */
  const leave = (reason) => {
    clearTimeout(inputTimer);
    stop();
    waiting.end();
    drawing = Promise.reject(new Error(reason));
    drawing.catch(() => {});
    preview.setAttribute('aria-busy', 'false');
    offer.renew();
  };
  /** Withdraws the drawing, which is of other values than those of the fields: it is not saved any more. */
  const withdraw = () => {
    drawing = new Promise(() => {});
    preview.setAttribute('aria-busy', 'true');
    offer.renew();
  };

  /** Takes away what is said of the last drawing. */
  const clear = () => {
    element('save-title', HTMLElement).textContent = SHEET_WORDS.title;
    warning.hidden = fit.hidden = true;
    about.replaceChildren();
  };
  /** The sides of each sheet, the shorter one first. @param {Drawing} finished */
  const sidesOf = ({ sheets }) => sheets.map(({ bounds: [[left, bottom], [right, top]] }) => [right - left, top - bottom].sort((a, b) => a - b));
  /** Whether each sheet is on one page of the paper. @param {Drawing} finished */
  const isOnPages = (finished) => sidesOf(finished).every((sides) => sides.every((side, k) => side <= PAPERS[paper() || 'a4'][k] - 2 * PAGE_MARGIN_MM + 1e-6));
  /** Shows the size of the finished surface and the number of pages. @param {Drawing} finished */
  const showSize = (finished) => {
    const { summary } = finished;
    const smallest = Math.min(...sidesOf(finished).map(([, longer]) => longer));
    const stock = paper();
    const pages = stock === '' ? 1 : summary[stock];
    element('save-title', HTMLElement).textContent = SHEET_WORDS.headline(number(side(), 4), pages, summary.seams, finished.sheets.length > 1 ? number(smallest, 2) : undefined);
    legend.textContent = SHEET_WORDS.legend(summary);
    // Tabs stay as deep as they are.
    const beside = cutOptions().tabs ? 2 * fields.number('sheet-tab-depth') : 0;
    const room = stock === '' ? [] : PAPERS[stock].map((length) => length - 2 * PAGE_MARGIN_MM - beside);
    const shares = sidesOf(finished).flatMap((sides) => sides.map((length, k) => room[k] / (length - beside)));
    const fitting = Math.floor(side() * Math.min(...shares));
    fit.hidden = !(pages > finished.sheets.length && fitting >= MIN_SIDE_MM && fitting < side());
    [fit.value, fit.textContent] = [String(fitting), SHEET_WORDS.fit(number(fitting, 4))];
    const warnings = [...faultsInWords(finished), ...(pages > MAX_EXPECTED_PAGES ? [SHEET_WORDS.manyPages(pages)] : []), ...(smallest < MIN_HANDY_PIECE_MM ? [SHEET_WORDS.small(number(smallest, 2))] : summary.seams > MAX_EASY_JOINTS ? [SHEET_WORDS.long(summary.seams)] : [])];
    warning.hidden = warnings.length === 0;
    warning.textContent = warnings.join(' ');
  };

  const draw = async () => {
    // The dialog may be closed by then.
    if (!options.isConnected) return;
    if (isSolving) return keepOptions();
    showFields();
    if (fields.check()) {
      // The fault stands at its field, and nothing is drawn any more.
      leave('');
      status.textContent = '';
      return clear();
    }
    keepOptions();
    history.note(fields.values(.../** @type {FieldName[]} */ (Object.keys(lastOptions)), ...OF_MODEL));
    status.textContent = '';
    again.hidden = true;
    preview.setAttribute('aria-busy', 'true');
    waiting.begin('cutting');
    const requested = (drawing = cut({ ...cutOptions(), assembly: true }, waiting.tell));
    let failed = false;
    offer.renew();
    try {
      // Its failure is reported below.
      requested.catch(() => {});
      thickness = await metalThickness();
      showFields();
      const image = await drawingImage(api, await requested, preview, zoom);
      if (requested !== drawing) return;
      const finished = await requested;
      if (finished.summary.simplified && fields.text('sheet-faces') === '') {
        fields.set('sheet-faces', finished.summary.simplified.faces);
        return void draw();
      }
      showSize(finished);
      // Only flat faces can be cut apart anywhere: nothing of them is stretched.
      const isExact = finished.summary.simplified !== undefined || (isMesh && finished.summary.strain === 0);
      edges.hidden = !isExact || finished.summary.folds + finished.summary.seams === 0;
      fields.show(isExact && !isMetal() && paper() !== '', 'sheet-fitting');
      pieces = Math.max(...finished.sheets.flatMap((sheet) => sheet.patches)) + 1;
      /** @param {MouseEvent} event */
      const edgeUnder = ({ offsetX, offsetY }) => (edges.hidden ? null : edgeAt(finished, [(offsetX / image.clientWidth) * finished.width, (1 - offsetY / image.clientHeight) * finished.height]));
      image.addEventListener('click', (event) => {
        if (!edges.hidden) toggleEdge(edgeUnder(event));
      });
      image.addEventListener('pointermove', (event) => markEdge(finished, edgeUnder(event)));
      image.addEventListener('pointerleave', () => markEdge(finished, null));
      mark.setAttribute('viewBox', `0 0 ${finished.width} ${finished.height}`);
      mark.style.setProperty('--aspect', String(finished.width / finished.height));
      markPath.removeAttribute('d');
      preview.replaceChildren(image, mark);
      edgeNote.textContent = clicked ? SHEET_WORDS.toggled(clicked.pair, clicked.isFold) : edgeWords;
      undo.hidden = clicked === null;
      [clicked, edgeWords] = [null, SHEET_WORDS.edges];
      // What is enlarged is seen from its middle on.
      preview.scrollTo((preview.scrollWidth - preview.clientWidth) / 2, (preview.scrollHeight - preview.clientHeight) / 2);
      status.textContent = countsInWords(finished, isExact && cutOptions().stock !== undefined && isOnPages(finished));
      about.replaceChildren(figures(sheetFigures(finished)), make('ol', 'small', ...buildSteps(finished).map((step) => make('li', '', step))));
    } catch (error) {
      if (requested !== drawing) return;
      const reason = plainMessage(error);
      const isOverlapping = /“join” as folds/.test(reason);
      if (clicked && isOverlapping) {
        [edgeWords, clicked] = [SHEET_WORDS.unfoldable(clicked.pair), null];
        return history.step();
      }
      clicked = null;
      preview.replaceChildren();
      clear();
      const [, ...pair] = /patches (\d+) and (\d+) have no edge/.exec(reason)?.map(Number) ?? [];
      status.textContent = pair.length > 0 || isOverlapping ? '' : hasCode(error, 'CURVED_FOLD') ? SHEET_WORDS.curvedFold : SHEET_WORDS.uncut(reason);
      if (isOverlapping) {
        [edges.hidden, byNumber.open] = [false, true];
        fields.blame('sheet-join', SHEET_WORDS.unfoldableAll);
      }
      for (const name of /** @type {const} */ (['sheet-cut', 'sheet-join'])) {
        if (!parsePairs(fields.text(name))?.some((one) => String(one) === String(pair))) continue;
        [edges.hidden, byNumber.open] = [false, true];
        fields.blame(name, SHEET_WORDS.noEdgeBetween(pair, pieces));
      }
      failed = true;
    }
    // The reason stands beside the preview.
    if (failed) return leave('');
    preview.setAttribute('aria-busy', 'false');
    waiting.end();
  };
  /** Marks an edge of the drawing, and says what a click does to it. @param {Drawing} finished @param {ReturnType<typeof edgeAt>} edge */
  const markEdge = ({ height }, edge) => {
    const path = edge?.lines.map((line) => `M${line.map(([x, y]) => `${x} ${height - y}`).join('L')}`).join('') ?? '';
    if (path === (markPath.getAttribute('d') ?? '')) return;
    markPath.setAttribute('d', path);
    mark.classList.toggle('letters', edge?.isFold === false);
    edgeNote.textContent = edge ? SHEET_WORDS.edge(edge.pair, edge.isFold) : SHEET_WORDS.edges;
  };
  /** Cuts a fold, or folds a cut; again, it is as before. @param {ReturnType<typeof edgeAt>} edge */
  const toggleEdge = (edge) => {
    if (!edge) return void (edgeNote.textContent = SHEET_WORDS.noEdge);
    clicked = edge;
    const [own, other] = edge.isFold ? /** @type {const} */ (['sheet-cut', 'sheet-join']) : /** @type {const} */ (['sheet-join', 'sheet-cut']);
    const isUndone = (parsePairs(fields.text(other)) ?? []).some((pair) => String(pair) === String(edge.pair));
    const name = isUndone ? other : own;
    fields.set(name, togglePair(fields.text(name), edge.pair));
    void draw();
  };
  detail.addEventListener('change', async () => {
    withdraw();
    isSolving = true;
    waiting.begin('solving');
    const end = solved();
    pageDetail.value = detail.value;
    for (const event of ['input', 'change']) pageDetail.dispatchEvent(new Event(event));
    await end;
    // The dialog may be closed by then.
    if (options.isConnected) offerAgain();
  });
  let [inputTimer, zoom] = [0, 1];
  const legend = make('p', 'muted small');
  const enlarge = makeButton('', () => {
    zoom = zoom === 1 ? 3 : 1;
    preview.style.setProperty('--zoom', String(zoom));
    enlarge.setAttribute('aria-pressed', String(zoom > 1));
    void draw();
  }, SHEET_WORDS.enlarge);
  const options = make('div', 'sheets-options',
    status,
    warning,
    legend,
    edges,
    enlarge,
    fit,
    ...(note ? [make('p', 'small', note)] : []),
    again,
    ...(isFitted ? fields.nodes('sheet-detail') : []),
    ...fields.nodes('sheet-faces'),
    ...fields.nodes('sheet-unit', 'sheet-side', 'sheet-paper', 'sheet-fitting', 'sheet-material', 'sheet-tabs', 'sheet-tab-depth'),
    metalNote,
    ...fields.nodes('sheet-thickness', 'sheet-radius', 'sheet-k', 'sheet-kerf'),
    make('details', 'more', make('summary', '', SHEET_WORDS.figures), about));
  options.addEventListener('input', ({ target }) => {
    clearTimeout(inputTimer);
    if (target === detail) return;
    if (target === fields.control('sheet-unit')) {
      const side = trueSide(length, fields.text('sheet-unit'));
      fields.set('sheet-side', Number.isNaN(side) ? suggested : side);
    }
    if (target === fields.control('sheet-side')) fields.set('sheet-unit', 'none');
    withdraw();
    inputTimer = window.setTimeout(() => void draw(), SETTLING_MS);
  });

  const offer = offerToSave(api, {
    title: SHEET_WORDS.title,
    stem: `${stem}-sheets`,
    ready: () => drawing,
    // A pattern that is still being computed would delay the next analysis.
    closed: () => {
      stop();
      // What was chosen last is kept, though it was not drawn yet.
      if (!fields.check()) keepOptions();
    },
    extra: [make('div', 'sheets', preview, waitingElement, options)],
    formats: [
      { value: 'pdf', name: 'PDF', words: SHEET_WORDS.pdf, type: 'application/pdf',
        write: async (worker) => worker.writePdf(await drawing, { stock: paper() || undefined, title: stem }) },
      { value: 'svg', name: 'SVG', words: SHEET_WORDS.svg, type: 'image/svg+xml', write: async (worker) => worker.writeSvg(await drawing, { title: stem }) },
      { value: 'dxf', name: 'DXF', words: SHEET_WORDS.dxf, type: 'image/vnd.dxf', write: async (worker) => worker.writeDxf(await drawing) },
      { value: 'png', name: 'PNG', words: SHEET_WORDS.png, type: 'image/png', write: async () => builtPicture(await drawing, up) },
      { value: 'glb', name: 'GLB', words: SHEET_WORDS.glb, type: 'model/gltf-binary', write: async () => assemblyOf(await drawing).model },
    ],
  });
  void draw();
}
