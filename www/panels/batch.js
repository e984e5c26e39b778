/** Several scans that are cleaned in one go: a ZIP of their surfaces, with a table of their reports. */
import { element } from '../dom.js';
import { plainMessage } from '../error-messages.js';
import { readInput } from '../height-file.js';
import { BATCH_WORDS, FORMAT_WORDS } from '../messages.js';
import { heightsOf, spacingOf } from '../session.js';
import { zipOf } from '../zip.js';
import { csvOf, figuresOf } from './report.js';
import { offerToSave } from './save-dialog.js';

/** @import {Surface} from '../../pkg/types.js' */
/** @import {Format} from './save-dialog.js' */

/** Offers the surfaces of scans, solved with the settings of the one that is shown. @param {Session} session @param {readonly File[]} files */
export async function offerBatch({ api, settings }, files) {
  const { IMAGE_FILES } = await import('../../pkg/schema/image-files.js');
  /** The scans that are solved, by their files: further formats write them again. @type {Map<File, { name: string, surface: Surface }>} */
  const solved = new Map();
  /** Why the others are left out. @type {string[]} */
  let problems = [];
  /** @param {File} file @param {PackageWorker} worker @param {AbortSignal} signal */
  const solve = async (file, worker, signal) => {
    const input = await readInput(api, file, signal);
    if (input.depths === 'certain') throw new Error(BATCH_WORDS.depths);
    const { coarsening, ...options } = settings;
    // Files of several folders may have one name.
    const name = [...solved.values()].some((one) => one.name === input.name) ? `${input.name}-${solved.size + 1}` : input.name;
    solved.set(file, { name, surface: await worker.fit(heightsOf(input), { ...options, ...spacingOf(input, Math.max(coarsening, input.stored?.coarsening ?? 1)) }) });
  };
  /** @param {string} value @param {string} words @param {(worker: PackageWorker, surface: Surface) => Promise<Uint8Array>} write @returns {Format} */
  const format = (value, words, write) => ({
    value: `${value}.zip`, name: value.toUpperCase(), words, type: 'application/zip', note: () => BATCH_WORDS.without(problems),
    write: async (worker, signal) => {
      problems = [];
      for (const [i, file] of files.entries()) {
        element('save-size', HTMLElement).textContent = BATCH_WORDS.solving(i + 1, files.length, file.name);
        await (solved.has(file) || solve(file, worker, signal).catch((error) => {
          signal.throwIfAborted();
          problems.push(`“${file.name}”: ${plainMessage(error)}`);
        }));
      }
      if (solved.size === 0) throw new Error(problems.join('; '));
      const surfaces = await Promise.all([...solved.values()].map(async ({ name, surface }) => [`${name}-developable.${value}`, await write(worker, surface)]));
      const reports = [...solved.values()].map(({ name, surface }) => ({ file: name, ...Object.fromEntries(figuresOf(surface.report)) }));
      const columns = [...new Set(reports.flatMap((report) => Object.keys(report)))];
      const table = csvOf([columns, ...reports.map((report) => columns.map((column) => report[/** @type {'file'} */ (column)] ?? ''))]);
      return zipOf({ ...Object.fromEntries(surfaces), 'reports.csv': table });
    },
  });
  offerToSave(api, {
    title: BATCH_WORDS.title(files.length), stem: 'scans',
    formats: [
      ...Object.entries(IMAGE_FILES).map(([name, { about }]) => format(name, `heights as ${about}`, (worker, surface) => worker.writeImage(surface, { format: /** @type {import('../../pkg/schema/image-files.js').ImageFile} */ (name) }))),
      format('obj', FORMAT_WORDS.obj, (worker, surface) => worker.writeObj(surface)),
      format('stl', FORMAT_WORDS.stl, (worker, surface) => worker.writeStl(surface)),
      format('ply', FORMAT_WORDS.ply, (worker, surface) => worker.writePly(surface)),
    ],
  });
}
