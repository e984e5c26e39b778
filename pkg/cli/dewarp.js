/** `developable dewarp` of a photo by heights. */
import * as developable from '../index.js';
import { dewarp as flattening } from '../schema/photo.js';
import { readCamera } from './camera.js';
import { withFileName } from './explain.js';
import { checkPlaces, readBytes, writeWhole } from './files.js';
import { mapFile, mapOptions, printed, sizeInWords } from './flat-image.js';
import { cylinderOf, flattened, reported } from './flattened.js';
import { Problem, status } from './problem.js';
import { optionsFrom } from './task.js';
import { during, percent, say, succeed } from './terminal.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {import('./inputs.js').Input} Input
 */

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function dewarp(task, signal) {
  await checkPlaces(...task.written);
  const texture = task.texture === undefined ? undefined : await readPhoto(task.texture);
  const { photoCamera } = task;
  const elsewhere = photoCamera !== undefined && texture !== undefined ? await readCamera(photoCamera, [texture]) : undefined;
  const { width = 0, height = 0, orientation } = texture ?? {};
  const seen = texture && { width, height, orientation, wanted: task.crop, camera: elsewhere };
  const { surface, options } = await flattened({ ...task, photo: seen }, signal, (input) => {
    if (task.extension === '.pdf') checkUnit(input);
    if (texture !== undefined && photoCamera === undefined) checkPlace(task.input, input);
  });
  const cylinder = cylinderOf(surface);
  const photo = texture ?? await textureOf(task.input, surface);
  const camera = elsewhere ?? (photoCamera === undefined ? undefined : await readCamera(photoCamera, [photo]));
  const { crop } = task;
  const given = { ...options, ...optionsFrom(flattening, task), ...mapOptions(task.map) };
  const flat = await during('flattening the photo', () => developable.dewarp(surface, photo, { ...given, camera, transfer: true }));
  const files = [{ path: task.output, bytes: await printed(task, flat) }, ...reported(task, { ...flat, report: { ...flat.report, ...(cylinder && { cylinder }) } })];
  if (task.map !== undefined) {
    files.push({ path: task.map, bytes: mapFile(flat, photo) });
  }
  await writeWhole(files, signal);
  succeed(task.output, sizeInWords(flat));
  if (task.camera !== undefined && crop === undefined && reachesRim(surface)) {
    say('warning: the whole depth image was flattened, with what the page lies on; --crop x,y,x,y,... with the corners of the page in the photo selects the page, and so does --mask');
  }
  if (cylinder?.verdict === 'other') {
    say('warning: the heights are not those of a cylinder: what is made flat may be wrong; without --shape cylinder any surface that unrolls is fitted');
  }
  if (crop?.length === 4 && flat.loss > MAX_UNMENTIONED_LOSS) {
    say(`warning: ${percent(flat.loss, 2)} of the page between the corners of --crop is missing: there are no depths of it`);
  }
  if (flat.verdict === 'doubtful' && flat.overreach > 0) {
    const beyond = `--crop reaches beyond the page that the photo shows, by up to ${percent(flat.overreach, 2)} of its side`;
    say(`warning: ${beyond}: the flat image may show what lies beside the page, and be bent by it; place the corners on the page`);
  }
  if (flat.verdict === 'flat') {
    say('the photo shows the page flat to begin with, and can be used as it is');
  } else if (flat.verdict === 'stretched') {
    const { distortion: { rms, above, flipped }, crossings } = flat.report;
    const reasons = [
      ...(above > 0 ? [`its sheet is stretched by ${percent(rms, 2)} on average and by more than 1 % in ${percent(above, 2)} of its area`] : []),
      ...(flipped + crossings > 0 ? ['parts of the sheet lie on others'] : []),
    ];
    say(`warning: the surface cannot be laid flat as it is: ${reasons.join(', and ')}; lengths on the flat image may be wrong`);
  }
}

/** Largest share of a page that is left out without a word: a millimetre on each side of a page of A4. */
const MAX_UNMENTIONED_LOSS = 0.015;

/** How near to the rim of an image something is to reach it, and on what share of a side, in shares of that. */
const [NEAR, LONG] = [0.03, 0.3];

/**
 * Whether what a depth camera has seen of a surface goes on to the rim of its image, as a page alone does not.
 * @param {Input} surface
 */
function reachesRim(surface) {
  const { uvs, heights } = /** @type {import('../types.js').Heightfield} */ (surface);
  if (uvs === undefined || heights === undefined) return false;
  const steps = 100;
  const sides = Array.from({ length: 4 }, () => new Uint8Array(steps + 1));
  for (let i = 0; i < heights.length; i += 1) {
    const [u, v] = [uvs[2 * i], uvs[2 * i + 1]];
    if (!Number.isFinite(heights[i]) || !(u >= 0 && u <= 1 && v >= 0 && v <= 1)) continue;
    const [across, up] = [u, v].map((share) => Math.round(steps * share));
    [u, 1 - u].forEach((far, k) => far < NEAR && (sides[k][up] = 1));
    [v, 1 - v].forEach((far, k) => far < NEAR && (sides[2 + k][across] = 1));
  }
  return sides.some((side) => side.reduce((sum, one) => sum + one, 0) > LONG * steps);
}

/**
 * Refuses what is seen of a mesh if nothing says where in the photo that is: before it is fitted.
 * @param {string} path
 * @param {import('./inputs.js').Input} input
 */
function checkPlace(path, input) {
  const { frame, camera, uvs } = /** @type {import('../types.js').Heightfield} */ (input);
  if (frame === undefined || camera !== undefined || uvs !== undefined) return;
  throw new Problem(
    status.input,
    `nothing says where in the photo the points of ${path} are: --photo-camera FILE gives the camera that took it; or take a mesh `
      + 'with texture coordinates',
  );
}

/** Says what a true size takes, where it is not known. @param {Input} input */
function checkUnit({ unit }) {
  if (unit !== undefined && unit !== null) return;
  throw new Problem(
    status.usage,
    'a .pdf has its true size, and nothing says in what unit the lengths are: --unit mm or --unit m does (and --pixel-size ' +
      'how large a pixel of heights is, in that unit)',
  );
}

/** @param {string} path */
async function readPhoto(path) {
  const bytes = await readBytes(path);
  return withFileName(path, () => developable.readPhoto(bytes));
}

/**
 * The picture that a scan has with it.
 * @param {string} input
 * @param {Input} surface
 */
async function textureOf(input, surface) {
  const { texture } = /** @type {import('../types.js').Heightfield} */ (surface);
  if (texture !== undefined) return developable.readPhoto(texture);
  throw new Problem(
    status.usage,
    `${input} has no texture of its own, or several: --texture PHOTO gives the picture that its texture coordinates are about`,
  );
}
