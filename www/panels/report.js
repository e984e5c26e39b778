/** The report as a table, with an explanation of each row. */
import { download, element } from '../dom.js';
import { count, number, percentAtMost, seconds } from '../format.js';
import { accuracyOf } from '../surface/derived-data.js';
import { ENERGIES, REPRODUCE_WORDS, STOP_REASONS, lambdaChoiceInWords } from '../messages.js';
import { REPORT_WORDS } from '../report-words.js';
import { asCode, asCommand } from '../reproduce.js';
import { showError, showNotice } from './notice.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Report} from '../api.js' */
/** @import {Result, Session} from '../session.js' */

/** @typedef {{ name: string, value: string, meaning: string, isShown: boolean }} Row */
/** @typedef {{ title: string, rows: Row[] }} Group */

/** @typedef {Pick<import('../api.js').Progress, 'level' | 'iteration' | 'elapsed' | 'gap'>} Moment of a run, as its progress tells */

/** Time for which a button says that it has copied, in milliseconds. */
const COPIED_MS = 3000;

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
  on('report-save', async (result) => {
    try {
      download(`${JSON.stringify(await reportFile(analyses, result, moments), null, 2)}\n`, 'application/json', `${result.input.name}-report.json`);
    } catch (error) {
      showError('The report could not be saved', error);
    }
  });
  on('report-csv', (result) => {
    const rows = groupsOf(result).flatMap(({ title, rows: all }) => all.filter(({ isShown }) => isShown).map(({ name, value }) => [title, name, value]));
    download([['group', 'quantity', 'value'], ...rows].map((cells) => `${cells.map(csvCell).join(',')}\r\n`).join(''), 'text/csv', `${result.input.name}-report.csv`);
  });
  const offers = [
    copyButton('copy-command', REPRODUCE_WORDS.noCommand),
    copyButton('copy-code', REPRODUCE_WORDS.noCode),
  ];
  session.on('result', (result) => {
    table.replaceChildren(...groupsOf(result).map(rowGroup));
    [asCommand, asCode].forEach((textOf, i) => offers[i](textOf(result)));
    table.hidden = acts.hidden = false;
    empty.hidden = true;
  });
  session.on('cleared', () => {
    table.hidden = acts.hidden = true;
    empty.hidden = false;
  });
}

/**
 * A button that copies a text.
 * @param {string} id
 * @param {string} words why there may be no text
 * @returns {(text: string | null) => void} offers a text, or none
 */
function copyButton(id, words) {
  const button = element(id, HTMLButtonElement);
  const label = button.textContent;
  let [offered, timer] = ['', 0];
  button.addEventListener('click', async () => {
    try {
      await navigator.clipboard.writeText(offered);
      button.textContent = 'Copied';
      clearTimeout(timer);
      timer = window.setTimeout(() => (button.textContent = label), COPIED_MS);
    } catch {
      showNotice(offered, 'note');
    }
  });
  return (text) => {
    offered = text ?? '';
    button.disabled = text === null;
    button.title = text === null ? words : '';
  };
}

/** @param {string} text */
const csvCell = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** All that the page shows about a result. @param {Analyses} analyses @param {Result} result @param {readonly Moment[]} convergence */
async function reportFile(analyses, result, convergence) {
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
    errors: { heights: accuracyOf(result) ?? undefined },
    convergence,
  };
}

/** The groups of the report that have rows. @param {Result} result */
function groupsOf(result) {
  const { report } = result.surface;
  return [certificate(report), domain(report), work(report), accuracy(result)].filter((group) => group.rows.length > 0);
}

/** @param {Report} report @returns {Group} */
function certificate(report) {
  return {
    title: 'Certificate',
    rows: [
      row('Gap', percentAtMost(report.gap), report.gap === undefined ? REPORT_WORDS.noGap : REPORT_WORDS.gap),
      row('Objective', number(report.objective, 5), REPORT_WORDS.objective),
      row('Fidelity', number(report.fidelity, 4), REPORT_WORDS.fidelity),
      row('Nuclear norms', number(report.nuclearNorm, 4), REPORT_WORDS.nuclearNorm, report.energy === 'nuclear'),
      row('Bending', number(report.nuclearNorm, 4), ENERGIES[report.energy], report.energy !== 'nuclear'),
      row('Dual bound', number(report.dualBound, 5), REPORT_WORDS.dualBound),
      row('Stopped by', STOP_REASONS[report.stopReason], ''),
    ],
  };
}

/** @param {Report} report @returns {Group} */
function domain(report) {
  return {
    title: 'Vertices',
    rows: [
      row('Interior', count(report.interior), REPORT_WORDS.interior),
      row('Boundary', count(report.boundary), REPORT_WORDS.boundary),
      row('Omitted', count(report.omitted), REPORT_WORDS.omitted),
      row('Torn', count(report.occluded), REPORT_WORDS.torn, report.occluded > 0),
      row('Held', count(report.constrained), REPORT_WORDS.held, report.constrained > 0),
      row('Free', count(report.free), REPORT_WORDS.free, report.free > 0),
      row('Parts', count(report.components), REPORT_WORDS.parts, report.components > 1),
    ],
  };
}

/** @param {Report} report @returns {Group} */
function work(report) {
  return {
    title: 'Work',
    rows: [
      row('λ', number(report.lambda), REPORT_WORDS.lambda),
      row('Noise, σ', number(report.lambdaChoice?.sigma ?? 0), lambdaChoiceInWords(report), report.lambdaChoice?.sigma !== undefined),
      row('Creases', count(report.huber?.creases ?? 0), REPORT_WORDS.creases(report.huber?.creasePasses ?? 0), report.huber !== undefined),
      row('Iterations', count(report.iterations), REPORT_WORDS.iterations(report.levels.at(-1)?.iterations ?? 0)),
      row('Time', seconds(report.seconds.total), ''),
    ],
  };
}

/**
 * Errors against the true surface, which is known for examples.
 * @param {Result} result
 * @returns {Group}
 */
function accuracy(result) {
  const errors = accuracyOf(result);
  if (!errors) return { title: '', rows: [] };
  return {
    title: 'Error against the true surface, input → result',
    rows: [row('Heights', `${number(errors.before)} → ${number(errors.after)}`, REPORT_WORDS.heights)],
  };
}

/** @param {string} name @param {string} value @param {string} meaning @param {boolean} [isShown] @returns {Row} */
function row(name, value, meaning, isShown = true) {
  return { name, value, meaning, isShown };
}

/** @param {Group} group */
function rowGroup({ title, rows }) {
  const body = document.createElement('tbody');
  const head = body.insertRow();
  head.className = 'group';
  const heading = document.createElement('th');
  heading.colSpan = 3;
  heading.scope = 'rowgroup';
  heading.textContent = title;
  head.append(heading);
  for (const { name, value, meaning } of rows.filter(({ isShown }) => isShown)) {
    const line = body.insertRow();
    const header = document.createElement('th');
    header.scope = 'row';
    header.textContent = name;
    line.append(header);
    const figure = line.insertCell();
    figure.textContent = value;
    if (meaning) line.insertCell().textContent = meaning;
    // A value without an explanation takes its cell, too.
    else figure.colSpan = 2;
  }
  return body;
}
