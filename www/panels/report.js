/** The report as a table, with an explanation of each row. */
import { copyText, download, element, make } from '../dom.js';
import { count, number, percentAtMost, seconds } from '../format.js';
import { ENERGIES, REPRODUCE_WORDS, STOP_REASONS, lambdaChoiceInWords } from '../messages.js';
import { asCode, asCommand, CITATION } from '../reproduce.js';
import { showError, showNotice } from './notice.js';

/** @typedef {[name: string, value: string, meaning: string]} Row */
/** @typedef {Pick<Progress, 'level' | 'iteration' | 'elapsed' | 'gap'>} Moment of a run, as its progress tells */

/** @param {Session} session @param {Analyses} analyses */
export function reportPanel(session, analyses) {
  const acts = element('report-acts', HTMLElement);
  const table = element('report-table', HTMLTableElement);
  const empty = element('report-empty', HTMLElement);
  /** The moments of the present run. @type {Moment[]} */
  let moments = [];
  session.on('start', () => (moments = []));
  session.on('progress', ({ level, iteration, elapsed, gap }) => void moments.push({ level, iteration, elapsed, gap }));
  /** @param {string} id @param {(result: Result) => unknown} act */
  const on = (id, act) => element(id, HTMLButtonElement).addEventListener('click', () => {
    if (session.result) act(session.result);
  });
  /** @param {string} ending @param {string} type @param {(report: object) => string} textOf */
  const onSave = (ending, type, textOf) => async (/** @type {Result} */ result) => {
    try {
      download(textOf(await reportFile(analyses, result, moments)), type, `${result.input.name}-report.${ending}`);
    } catch (error) {
      showError('The report could not be saved', error);
    }
  };
  on('report-save', onSave('json', 'application/json', (report) => `${JSON.stringify(report, null, 2)}\n`));
  on('report-csv', onSave('csv', 'text/csv', (report) => csvOf([['quantity', 'value'], ...figuresOf(report)])));
  const offers = [copyButton('copy-command'), copyButton('copy-code')];
  copyButton('copy-citation')(CITATION);
  const uncopied = element('report-uncopied', HTMLElement);
  /** @param {boolean} isThere */
  const showReport = (isThere) => {
    table.hidden = acts.hidden = uncopied.hidden = !isThere;
    empty.hidden = isThere;
  };
  session.on('result', (result) => {
    table.replaceChildren(...groupsOf(result).map(rowGroup));
    const texts = [asCommand(result), asCode(result)];
    texts.forEach((text, i) => offers[i](text));
    uncopied.textContent = texts.map((text, i) => (text === null ? REPRODUCE_WORDS[i] : '')).join(' ').trim();
    showReport(true);
  });
  session.on('cleared', () => showReport(false));
}

/** A button that copies a text. @param {string} id @returns {(text: string | null) => void} offers a text, or none */
function copyButton(id) {
  const button = element(id, HTMLButtonElement);
  let offered = '';
  button.addEventListener('click', () => copyText(button, offered).catch(() => showNotice(offered, 'note')));
  return (text) => {
    offered = text ?? '';
    button.disabled = text === null;
  };
}

/** A table as CSV. @param {readonly (readonly string[])[]} rows */
export const csvOf = (rows) => rows.map((cells) => `${cells.map((text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text)).join(',')}\r\n`).join('');

/** The figures of a report by their paths, such as `huber.creases`, without its lists. @param {object} report @returns {[string, string][]} */
export function figuresOf(report) {
  return Object.entries(report).flatMap(([name, value]) => {
    if (Array.isArray(value) || value === undefined || value === null) return [];
    return typeof value === 'object' ? figuresOf(value).map(([path, figure]) => /** @type {[string, string]} */ ([`${name}.${path}`, figure])) : [[name, String(value)]];
  });
}

/** All that the page shows about a result. @param {Analyses} analyses @param {Result} result @param {readonly Moment[]} moments */
async function reportFile(analyses, result, moments) {
  const { input: { name, kind, example, width, height, pixelSize, heightScale, unit, stored, assumptions }, settings, surface } = result;
  const [{ default: { version } }, pieces, { before, after }] = await Promise.all([
    import(new URL('../pkg/package.json', import.meta.url).href, { with: { type: 'json' } }), analyses.patchCount(result), analyses.curvatures(result),
  ]);
  return {
    version,
    ...surface.report,
    input: { name, kind: kind ?? 'example', ...example, width, height, pixelSize, heightScale, unit, noData: stored?.noData, assumptions },
    settings,
    pieces: Number.isFinite(pieces.count) ? pieces.count : null,
    creases: pieces.creases,
    curvature: { input: before.summary, result: after.summary },
    errors: { heights: result.accuracy ?? undefined },
    // The worker tells its progress now and then only, so that the end is not among the moments.
    convergence: [...moments, { level: 0, iteration: surface.report.iterations, elapsed: surface.report.seconds.total, gap: surface.report.gap }],
  };
}

/** The groups of the report by their titles, without those that have no rows. @param {Result} result @returns {[string, Row[]][]} */
function groupsOf(result) {
  const { report } = result.surface;
  const errors = result.accuracy;
  const isNuclear = report.energy === 'nuclear';
  const passes = report.huber?.creasePasses ?? 0;
  /** @type {Record<string, (Row | false | undefined)[]>} */
  const groups = {
    Certificate: [
      ['Gap', percentAtMost(report.gap), report.gap === undefined ? 'The energy is almost zero, so a share of it would say nothing.' : 'No surface has an energy that is lower by more than this share.'],
      ['Objective', number(report.objective, 5), 'The energy of the result: fidelity and bending together.'],
      ['Fidelity', number(report.fidelity, 4), 'How far the result is from the input: λ times the squared distances.'],
      [isNuclear ? 'Nuclear norms' : 'Bending', number(report.nuclearNorm, 4), isNuclear ? 'How much the result bends and creases.' : ENERGIES[report.energy].about],
      ['Dual bound', number(report.dualBound, 5), 'The proof: no surface at all has a lower energy.'],
      ['Stopped by', STOP_REASONS[report.stopReason], ''],
    ],
    Vertices: [
      ['Interior', count(report.interior), 'These vertices have all six neighbours. Curvature is measured there.'],
      ['Boundary', count(report.boundary), 'These vertices lie at the border.'],
      ['Omitted', count(report.omitted), 'These vertices have too few neighbours. Their heights follow from the nearest ones.'],
      report.occluded > 0 && ['Torn', count(report.occluded), 'The surface is torn here, so its curvature is not measured.'],
      report.components > 1 && ['Parts', count(report.components), 'The surface has unconnected parts. Each was solved by itself.'],
    ],
    Work: [
      ['λ', number(report.lambda), 'The detail that is kept: a larger λ stays closer to the input.'],
      report.lambdaChoice?.sigma !== undefined && ['Noise, σ', number(report.lambdaChoice.sigma), lambdaChoiceInWords(result.surface, result.input.unit)],
      report.huber && passes > 0 && ['On creases', count(report.huber.creases), `So many vertices lie on creases, which were sharpened ${passes === 1 ? 'once' : `${count(passes)} times`}. The proof is about the last time.`],
      ['Iterations', count(report.iterations), `Steps of the solver (ADMM), ${count(report.levels.at(-1)?.iterations ?? 0)} of them on the finest lattice.`],
      ['Time', seconds(report.seconds.total), ''],
    ],
    // The true surface is known for examples.
    'Error against the true surface, input → result': [
      errors !== null && ['Heights', `${number(errors.before)} → ${number(errors.after)}`, 'Root mean square distance from the true surface, in the example’s unit.'],
    ],
  };
  return Object.entries(groups).map(([title, rows]) => /** @type {[string, Row[]]} */ ([title, rows.filter(Boolean)])).filter(([, rows]) => rows.length > 0);
}

/** @param {[string, Row[]]} group */
function rowGroup([title, rows]) {
  const head = make('th', '', title);
  Object.assign(head, { colSpan: 3, scope: 'rowgroup' });
  return make('tbody', '', make('tr', 'group', head), ...rows.map(([name, value, meaning]) => {
    const header = Object.assign(make('th', '', name), { scope: 'row' });
    // A value without an explanation takes its cell, too.
    return make('tr', '', header, Object.assign(make('td', '', value), { colSpan: meaning ? 1 : 2 }), ...(meaning ? [make('td', '', meaning)] : []));
  }));
}
