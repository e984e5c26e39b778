/** Heights and their result on the stage: the surfaces in space, previews of the result, and the views of it. */
import { closeDialogs } from '../dom.js';
import { number, shortLambda } from '../format.js';
import { heightAt, heightfieldBox, reliefMesh, reliefOf } from '../surface/relief.js';
import { latticeField } from '../surface/layer.js';
import { curvature } from '../views/curvature.js';
import { patchesOfHeights } from '../views/patches.js';
import { hasColours, photo } from '../views/photo.js';
import { flat } from '../views/pieces.js';
import { rulings } from '../views/rulings.js';
import { stagePanel } from './stage.js';

/** @import {Relief} from '../surface/relief.js' */
/** @import {Look} from '../surface/scene.js' */
/** @import {View} from './stage.js' */

/** Steel, seen at an angle. @type {Look} */
const STEEL_LOOK = { up: [0, 0, 1], direction: [0.375, 0.687, -0.622], isMetal: true, isSeenFromAbove: true };

/** Creates the stage, which shows heights at first. @param {Session} session @param {Analyses} analyses */
export function heightsPanel(session, analyses) {
  /** Input and result. @type {[Relief | null, Relief | null]} */
  const reliefs = [null, null];
  let box = /** @type {ReturnType<Subject['box']>} */ (null);
  let caption = '';
  /** @type {ReturnType<Subject['mark']>} */
  let mark = '';

  /** @param {(result: Result, tell: Tell) => ReturnType<View>} prepare @returns {View} */
  const ofResult = (prepare) => (tell) => prepare(/** @type {Result} */ (session.result), tell);
  /** @param {'gaussian' | 'kappa2'} what */
  const curvatureView = (what) => ofResult(async (result) => curvature(what, result.input.unit, await analyses.curvatures(result), (analysis) => latticeField(analysis, analysis[what])));
  /** @type {Subject} */
  const heights = {
    isWhole: false,
    name: () => session.input?.name ?? 'view',
    caption: () => (session.input ? `${session.input.name}, ${number(session.input.width, 6)} × ${number(session.input.height, 6)}` : ''),
    look: () => STEEL_LOOK,
    box: () => box,
    surface: (side, isFast) => {
      const relief = reliefs[side];
      return relief && reliefMesh(relief, isFast);
    },
    isSolved: () => session.result !== null,
    isDivided: () => reliefs[1] !== null,
    resultCaption: () => caption,
    mark: () => mark,
    views: {
      gaussian: curvatureView('gaussian'),
      kappa2: curvatureView('kappa2'),
      rulings: ofResult(async (result) => rulings((await analyses.rulings(result)).lines, result.input.unit)),
      patches: ofResult(async (result) => patchesOfHeights(result.input, await analyses.patches(result))),
      photo: ofResult(async ({ input }) => photo(input)),
      sheet: ofResult((result, tell) => flat(session.api, analyses, result, tell)),
    },
    offers: (view) => view !== 'photo' || (session.input !== null && hasColours(session.input)),
    read: ({ after, point: [x, y] }, value) => {
      const relief = reliefs[after ? 1 : 0];
      const height = relief ? heightAt(relief, x, y) : NaN;
      return Number.isNaN(height) ? '' : [`height ${number(height)} ${session.input?.unit ?? 'units'}`, value].filter(Boolean).join(' · ');
    },
    stop: () => analyses.stop(),
    run: () => void session.run(),
    cancel: () => session.cancel(),
    saveFile: async () => (await import('./save.js')).offerFile(session),
    cutSheets: async () => (await import('./save.js')).offerResultSheets(session, analyses, () => void heights.cutSheets()),
  };
  const stage = stagePanel(heights);

  /** @param {Input} input @param {{ width: number, height: number, data: ArrayLike<number> }} image @param {number} lambda @param {typeof mark} newMark */
  const showSurface = (input, image, lambda, newMark) => {
    caption = `λ = ${shortLambda(lambda)}`;
    mark = newMark;
    reliefs[1] = reliefOf(input, image, 1);
    stage.renew(heights, [1]);
  };
  /** @param {Result | null} result */
  const showResult = (result) => {
    if (result) return showSurface(result.input, result.image, result.surface.report.lambda, result.surface.report.stopReason === 'cancelled' ? 'cancelled' : '');
    mark = '';
    reliefs[1] = null;
    stage.renew(heights, [1]);
  };
  session.on('input', (input) => {
    reliefs[0] = reliefOf(input, input, input.heightScale);
    box = heightfieldBox(input);
    stage.renew(heights);
  });
  session.on('cleared', () => {
    closeDialogs();
    showResult(null);
    stage.begin(heights);
    stage.update(heights);
  });
  session.on('preview', ({ input, image, lambda }) => showSurface(input, image, lambda, 'preview'));
  session.on('result', (result) => {
    showResult(result);
    stage.update(heights);
  });
  // The last result replaces the previews.
  session.on('unsolved', () => showResult(session.result));
  return { stage, heights };
}
