/** What a result of heights is saved as: a 3D file, sheets to cut out. */
import { percent, shortLambda } from '../format.js';
import { MESH_FIT_WORDS } from '../messages.js';
import { longerSide, cutSheets, lengthUnitOf, modelOf } from '../pattern.js';
import { offerSurface } from '../solid.js';
import { latticePositions } from '../surface/lattice.js';
import { offerSheets } from './sheets.js';

/** Offers the result as a file: images have the pixels of the input, meshes the vertices of the lattice. @param {Session} session */
export async function offerFile(session) {
  // The page itself has to start where the package is missing, to say so.
  const { IMAGE_FILES } = await import('../../pkg/schema/image-files.js');
  const imageFiles = /** @type {[import('../../pkg/schema/image-files.js').ImageFile, { type: string, about: string }][]} */ (Object.entries(IMAGE_FILES));
  const { api, result } = session;
  if (!result) return;
  const { surface, image } = result;
  offerSurface(api, {
    stem: fileStem(result), surface, positions: latticePositions(surface), unit: result.input.unit, onBase: true,
    mesh: async (worker) => worker.readMesh(new File([/** @type {Uint8Array<ArrayBuffer>} */ (await worker.writePly({ ...surface, frame: undefined, colors: undefined, uvs: undefined }))], 'surface.ply')),
    further: imageFiles.map(([format, { type, about }]) => ({
      value: format, name: format.toUpperCase(), words: `heights as ${about}`, type, write: (worker) => worker.writeImage({ ...image, georeference: surface.georeference }, { format }),
    })),
  });
}

/** Offers the result as sheets. @param {Session} session @param {Analyses} analyses @param {() => void} again offers those of the next result */
export function offerResultSheets(session, analyses, again) {
  const { result } = session;
  if (!result) return;
  const hidden = result.input.lattice?.hidden;
  offerSheets(session.api, {
    stem: fileStem(result),
    model: modelOf(result.input),
    note: hidden ? MESH_FIT_WORDS.hidden(percent(hidden)) : '',
    length: longerSide(result),
    up: 'z',
    unit: lengthUnitOf(result.input),
    cut: (options, tell) => cutSheets(analyses, result, options, tell),
    metalThickness: async () => undefined,
    isMesh: false,
    stop: () => analyses.stop(),
    lambda: result.surface.report.lambda,
    cancelSolve: () => session.cancel(),
    isFitted: true,
    solved: () => session.next('result', 'unsolved'),
    again,
  });
}

/** Name of the saved file without its ending. @param {Result} result */
function fileStem({ input, surface }) {
  const cancelled = surface.report.stopReason === 'cancelled' ? '-cancelled' : '';
  return `${input.name}-developable-${shortLambda(surface.report.lambda)}${cancelled}`;
}
