/** The report as a table, each line with a word on what it means. */
import { download, element } from '../dom.js';
import { count, number, percentAtMost, seconds } from '../format.js';
import { accuracyOf } from '../surface/known.js';
import { ENERGIES, STOP_REASONS, lambdaFound } from '../messages.js';

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
      line('Gap', percentAtMost(report.gap), report.gap === undefined ? 'The objective is a rounding error: no share of it says anything.' : 'At most this share of the objective is above the optimum.'),
      line('Objective', number(report.objective, 5), 'The energy of the result: the sum of the next two.'),
      line('Fidelity', number(report.fidelity, 4), 'λ times the squared distances from the input.'),
      line('Nuclear norms', number(report.nuclearNorm, 4), 'Bending and creasing; what makes it developable.', report.energy === 'nuclear'),
      line('Bending', number(report.nuclearNorm, 4), ENERGIES[report.energy], report.energy !== 'nuclear'),
      line('Dual bound', number(report.dualBound, 5), 'No surface has less energy than this.'),
      line('Stopped by', STOP_REASONS[report.stopReason], ''),
    ],
  };
}

/** @param {Report} report @returns {Group} */
function domain(report) {
  return {
    title: 'Vertices',
    lines: [
      line('Interior', count(report.interior), 'With all six neighbours: curvature is measured here.'),
      line('Boundary', count(report.boundary), 'Neighbours of interior ones.'),
      line('Omitted', count(report.omitted), 'Left out of the solve, restored from what is nearest.'),
      line('Torn', count(report.occluded), 'No curvature is measured here.', report.occluded > 0),
      line('Held', count(report.constrained), 'Their heights are given for good.', report.constrained > 0),
      line('Free', count(report.free), 'Neither held nor drawn towards the input.', report.free > 0),
      line('Parts', count(report.components), 'Not connected; each was solved for itself.', report.components > 1),
    ],
  };
}

/** @param {Report} report @returns {Group} */
function work(report) {
  const { setup, zStep, hStep, certificate: check, total } = report.seconds;
  return {
    title: 'Work',
    lines: [
      line('λ', number(report.lambda), 'Weight of the fidelity, in the unit square.'),
      line('Noise, σ', number(report.lambdaChoice?.sigma ?? 0), lambdaFound(report), report.lambdaChoice?.sigma !== undefined),
      line('Reweighted', count(report.reweighting), 'Passes after the first; the certificate is the last one’s.', report.reweighting > 0),
      line('Creases', count(report.huber?.creases ?? 0), `Vertices on them; ${count(report.huber?.creasePasses ?? 0)} passes after the first, and the certificate is the last one’s.`, report.huber !== undefined),
      line('Lattices', count(report.levels.length), `From coarse to fine, with ${report.levels.map(({ interior }) => count(interior)).join(', ')} interior vertices.`),
      line('Iterations', count(report.iterations), `Of ADMM; ${count(report.levels.at(-1)?.iterations ?? 0)} of them on the finest lattice.`),
      line('CG iterations', count(report.cgIterations), 'Conjugate gradients, within its z-steps.'),
      line('ρ', number(report.rho), 'The last penalty; adapted as it goes.'),
      line('Scale', number(report.scale, 4), 'From the input’s units to the unit square.'),
      line('Time', seconds(total), `Set-up ${seconds(setup)}, z-steps ${seconds(zStep)}, H-steps ${seconds(hStep)}, certificate ${seconds(check)}.`),
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
      line('Heights', `${number(heights.before)} → ${number(heights.after)}`, 'Root mean square, in the example’s units.'),
      line('Normals', `${number(normals.before)}° → ${number(normals.after)}°`, 'Mean angle between the normals.'),
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
