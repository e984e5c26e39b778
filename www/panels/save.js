/** What to do with the result, one click each: a 3D file, sheets to cut out, a flat photo. */
import { element } from '../dom.js';
import { shortest } from '../format.js';
import { FORMAT_WORDS } from '../messages.js';
import { longerSide, piecesOf, unitOf } from '../pattern.js';
import { resultImage } from '../surface/known.js';
import { offerToSave } from './save-dialog.js';
import { offerSheets } from './sheets.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Api} from '../api.js' */
/** @import {Result, Session} from '../session.js' */
/** @import {Cutter} from './sheets.js' */

/**
 * @param {Session} session
 * @param {Analyses} analyses
 * @param {(view: string) => void} choose a view of the result
 * @param {{ hiddenInWords: string }} whole what is not seen of a mesh
 */
export function savePanel(session, analyses, choose, whole) {
  const ends = ['file', 'sheets', 'photo'].map((name) => element(`end-${name}`, HTMLButtonElement));
  const [file, sheets, photo] = ends;
  file.addEventListener('click', () => {
    if (session.result) offerFile(session.api, session.result);
  });
  sheets.addEventListener('click', () => {
    const { result } = session;
    if (result) offerSheets(session.api, { ...cutterOf(result, analyses), note: whole.hiddenInWords });
  });
  photo.addEventListener('click', () => {
    choose('dewarped');
    element('views', HTMLElement).scrollIntoView({ block: 'nearest' });
  });
  /** @param {boolean} ready */
  const enable = (ready) => {
    for (const end of ends) end.disabled = !ready;
  };
  session.on('result', () => enable(true));
  session.on('cleared', () => enable(false));
}

/**
 * Images at the input's pixels, meshes on the lattice.
 * @param {Api} api
 * @param {Result} result
 */
function offerFile(api, result) {
  const { surface } = result;
  const image = () => resultImage(result);
  offerToSave(api, {
    title: '3D file',
    stem: fileStem(result),
    size: surface.heights.length,
    formats: [
      { value: 'obj', name: 'OBJ', words: FORMAT_WORDS.obj, type: 'model/obj', write: (worker) => worker.writeObj(surface) },
      { value: 'stl', name: 'STL', words: FORMAT_WORDS.stl, type: 'model/stl', write: (worker) => worker.writeStl(surface) },
      { value: 'glb', name: 'GLB', words: FORMAT_WORDS.glb, type: 'model/gltf-binary', write: (worker) => worker.writeGlb(surface) },
      { value: 'ply', name: 'PLY', words: FORMAT_WORDS.ply, type: 'model/ply', write: (worker) => worker.writePly(surface) },
      { value: 'png', name: 'PNG', words: FORMAT_WORDS.png16, type: 'image/png', write: (worker) => worker.writePng(image()) },
      { value: 'tiff', name: 'TIFF', words: FORMAT_WORDS.floats, type: 'image/tiff', write: (worker) => worker.writeTiff(image()) },
      { value: 'exr', name: 'EXR', words: FORMAT_WORDS.floats, type: 'image/x-exr', write: (worker) => worker.writeExr(image()) },
      { value: 'npy', name: 'NPY', words: FORMAT_WORDS.npy, type: 'application/octet-stream', write: (worker) => worker.writeNpy(image()) },
    ],
  });
}

/** @param {Result} result @param {Analyses} analyses @returns {Cutter} */
function cutterOf(result, analyses) {
  return {
    stem: fileStem(result),
    size: result.surface.heights.length,
    length: longerSide(result),
    unit: unitOf(result.input),
    cut: (options) => piecesOf(analyses, result, options),
    svg: (drawing) => analyses.svg(drawing),
    stop: () => analyses.stop(),
  };
}

/** @param {Result} result */
function fileStem({ input, surface }) {
  const lambda = input.design ? '' : `-${shortest(surface.report.lambda)}`;
  const cancelled = surface.report.stopReason === 'cancelled' ? '-cancelled' : '';
  return `${input.name}-developable${lambda}${cancelled}`;
}
