/** The report as a table, each line with a word on what it means. */
import { download, element } from '../dom.js';
import { count, number, percentAtMost, seconds } from '../format.js';
import { accuracyOf } from '../surface/known.js';
import { ENERGIES, STOP_REASONS, lambdaFound } from '../messages.js';
import { REPORT_WORDS } from '../report-words.js';

/** @import {Report} from '../api.js' */
/** @import {Result, Session} from '../session.js' */

/** @typedef {{ name: string, value: string, meaning: string, told: boolean }} Line */
/** @typedef {{ title: string, lines: Line[] }} Group */

/** @param {Session} session */
export function reportPanel(session) {
  const table = element('report-table', HTMLTableElement);
  const empty = element('report-empty', HTMLElement);
  element('report-save', HTMLButtonElement).addEventListener('click', () => {
    const { result } = session;
    if (result) download(`${JSON.stringify(result.surface.report, null, 2)}\n`, 'application/json', `${result.input.name}-report.json`);
  });
  session.on('result', (result) => {
    const { report } = result.surface;
    const groups = [certificate(report), domain(report), work(report), accuracy(result)];
    table.replaceChildren(...groups.filter((group) => group.lines.length > 0).map(rowGroup));
    table.hidden = element('report-save', HTMLElement).hidden = false;
    empty.hidden = true;
  });
  session.on('cleared', () => {
    table.hidden = element('report-save', HTMLElement).hidden = true;
    empty.hidden = false;
  });
}

/** @param {Report} report @returns {Group} */
function certificate(report) {
  return {
    title: 'Certificate',
    lines: [
      line('Gap', percentAtMost(report.gap), report.gap === undefined ? REPORT_WORDS.noGap : REPORT_WORDS.gap),
      line('Objective', number(report.objective, 5), REPORT_WORDS.objective),
      line('Fidelity', number(report.fidelity, 4), REPORT_WORDS.fidelity),
      line('Nuclear norms', number(report.nuclearNorm, 4), REPORT_WORDS.nuclearNorm, report.energy === 'nuclear'),
      line('Bending', number(report.nuclearNorm, 4), ENERGIES[report.energy], report.energy !== 'nuclear'),
      line('Dual bound', number(report.dualBound, 5), REPORT_WORDS.dualBound),
      line('Stopped by', STOP_REASONS[report.stopReason], ''),
    ],
  };
}

/** @param {Report} report @returns {Group} */
function domain(report) {
  return {
    title: 'Vertices',
    lines: [
      line('Interior', count(report.interior), REPORT_WORDS.interior),
      line('Boundary', count(report.boundary), REPORT_WORDS.boundary),
      line('Omitted', count(report.omitted), REPORT_WORDS.omitted),
      line('Torn', count(report.occluded), REPORT_WORDS.torn, report.occluded > 0),
      line('Held', count(report.constrained), REPORT_WORDS.held, report.constrained > 0),
      line('Free', count(report.free), REPORT_WORDS.free, report.free > 0),
      line('Parts', count(report.components), REPORT_WORDS.parts, report.components > 1),
    ],
  };
}

/** @param {Report} report @returns {Group} */
function work(report) {
  const { setup, zStep, hStep, certificate: check, total } = report.seconds;
  return {
    title: 'Work',
    lines: [
      line('λ', number(report.lambda), REPORT_WORDS.lambda),
      line('Noise, σ', number(report.lambdaChoice?.sigma ?? 0), lambdaFound(report), report.lambdaChoice?.sigma !== undefined),
      line('Reweighted', count(report.reweighting), REPORT_WORDS.reweighted, report.reweighting > 0),
      line('Creases', count(report.huber?.creases ?? 0), REPORT_WORDS.creases(report.huber?.creasePasses ?? 0), report.huber !== undefined),
      line('Lattices', count(report.levels.length), REPORT_WORDS.lattices(report.levels.map(({ interior }) => interior))),
      line('Iterations', count(report.iterations), REPORT_WORDS.iterations(report.levels.at(-1)?.iterations ?? 0)),
      line('CG iterations', count(report.cgIterations), REPORT_WORDS.cgIterations),
      line('ρ', number(report.rho), REPORT_WORDS.rho),
      line('Scale', number(report.scale, 4), REPORT_WORDS.scale),
      line('Time', seconds(total), REPORT_WORDS.time(seconds(setup), seconds(zStep), seconds(hStep), seconds(check))),
    ],
  };
}

/**
 * Against the known truth, for examples.
 * @param {Result} result
 * @returns {Group}
 */
function accuracy(result) {
  const known = accuracyOf(result);
  if (!known) return { title: '', lines: [] };
  const { heights, normals } = known;
  return {
    title: 'Error against the true surface, input → result',
    lines: [
      line('Heights', `${number(heights.before)} → ${number(heights.after)}`, REPORT_WORDS.heights),
      line('Normals', `${number(normals.before)}° → ${number(normals.after)}°`, REPORT_WORDS.normals),
    ],
  };
}

/** @param {string} name @param {string} value @param {string} meaning @param {boolean} [told] whether it says something @returns {Line} */
function line(name, value, meaning, told = true) {
  return { name, value, meaning, told };
}

/** @param {Group} group */
function rowGroup({ title, lines }) {
  const body = document.createElement('tbody');
  const head = body.insertRow();
  head.className = 'group';
  const heading = document.createElement('th');
  heading.colSpan = 3;
  heading.scope = 'rowgroup';
  heading.textContent = title;
  head.append(heading);
  for (const { name, value, meaning } of lines.filter(({ told }) => told)) {
    const row = body.insertRow();
    const header = document.createElement('th');
    header.scope = 'row';
    header.textContent = name;
    row.append(header);
    const figure = row.insertCell();
    figure.textContent = value;
    if (meaning) row.insertCell().textContent = meaning;
    // A value in words needs the room of its missing explanation.
    else figure.colSpan = 2;
  }
  return body;
}
