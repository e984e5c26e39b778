/** Captures of bent pages by a phone, at random: pages, poses, noise, and crops that are set with and without care. */
import { depthCamera, outline, project, seenFrom } from './camera.mjs';
import { A4, SPREAD, crumpled, profile } from './pages.mjs';
import { sensed, uniform } from './sensor.mjs';

/**
 * @typedef {import('./camera.mjs').Camera} Camera
 * @typedef {import('./pages.mjs').Page} Page
 * @typedef {[number, number]} Place
 * @typedef {() => number} Chance uniform from 0 to 1
 * @typedef {object} Capture
 * @property {Page} page
 * @property {import('./camera.mjs').Pose} pose
 * @property {string} crop how the crop was set
 * @property {Place[]} corners of the crop, in pixels of the photo
 * @property {ReturnType<typeof sensed>} depths
 */

const degree = Math.PI / 180;

/** A page rolled onto a cone, whose rulings are not parallel. @param {number} apex distance from the page, in metres @param {number} half the cone's half angle @returns {Page} */
function cone(apex, half) {
  const [width, height] = A4;
  return {
    name: 'cone', width, height,
    point(u, v) {
      const [x, y] = [u - width / 2, apex + height - v];
      const [r, turn] = [Math.hypot(x, y), Math.atan2(x, y) / Math.sin(half)];
      return [r * Math.sin(half) * Math.sin(turn), r * Math.cos(half), r * Math.sin(half) * Math.cos(turn)];
    },
  };
}

/** @type {Record<string, (chance: Chance) => Page>} */
const kinds = {
  flat: (chance) => {
    const most = 0.02 * chance();
    return profile('flat', A4, 0, (p) => most * Math.sin((3 * p) / A4[0]));
  },
  curled: (chance) => {
    const [most, waves, phase] = [0.3 + 0.7 * chance(), 2 + 2.5 * chance(), 2 * Math.PI * chance()];
    const direction = (chance() < 0.5 ? 0 : 90) + 30 * (chance() - 0.5);
    return profile('curled', A4, direction * degree, (p) => most * Math.sin((waves * p) / A4[0] + phase));
  },
  folded: (chance) => {
    const [a, b, c] = [chance, chance, chance].map((next) => 1.2 * (next() - 0.5));
    const third = chance() < 0.5 ? A4[1] / 6 : 0;
    return profile('folded', A4, (86 + 8 * chance()) * degree, (p) => (p < -third ? a : p < third ? b : c));
  },
  spread: (chance) => {
    const [left, right, reach] = [0.5 + 0.5 * chance(), 0.5 + 0.5 * chance(), 0.02 + 0.02 * chance()];
    return profile('spread', SPREAD, 0, (p) => (p < 0 ? 0.1 - left * Math.exp(p / reach) : right * Math.exp(-p / reach) - 0.1));
  },
  cone: (chance) => cone(0.25 + 0.35 * chance(), 0.45 + 0.35 * chance()),
  crumpled: (chance) => crumpled(0.1 + 0.3 * chance(), [0.2 + 0.25 * chance(), 0.25 + 0.25 * chance()]),
};

/** How a crop is set, by what people do: along the outline, by four corners, and beside the page. @type {Record<string, (chance: Chance, outline: Place[], corners: Place[]) => Place[]>} */
const crops = {
  outline: (_, around) => around,
  'outline, roughly': (chance, around) => around.map(([x, y]) => [x + 12 * (chance() - 0.5), y + 12 * (chance() - 0.5)]),
  corners: (_, __, corners) => corners,
  'corners within': (chance, _, corners) => scaled(corners, 0.85 + 0.1 * chance()),
  'corners beside': (chance, _, corners) => scaled(corners, 1.03 + 0.1 * chance()),
};

/** Away from their middle, by a factor. @param {Place[]} corners @param {number} factor @returns {Place[]} */
function scaled(corners, factor) {
  const [x, y] = [0, 1].map((k) => corners.reduce((sum, corner) => sum + corner[k] / corners.length, 0));
  return corners.map((corner) => [x + factor * (corner[0] - x), y + factor * (corner[1] - y)]);
}

/**
 * The same capture for a number each time.
 * @param {number} number
 * @param {Camera} photoCamera
 * @param {boolean} [isLidar] whether the noise is that of a phone's LiDAR, and the crop roughly along the outline
 * @returns {Capture}
 */
export function capture(number, photoCamera, isLidar = false) {
  const chance = uniform(Math.imul(number + 1, 2654435761));
  // The first numbers of neighbouring seeds are alike.
  for (let k = 0; k < 20; k += 1) chance();
  /** @template T @param {readonly T[]} of @returns {T} */
  const one = (of) => of[Math.floor(of.length * chance())];
  const names = Object.keys(kinds);
  const page = kinds[names[number % names.length]](chance);
  const pose = {
    distance: 0.38 + 0.25 * chance(), tilt: 30 * chance(), yaw: 40 * (chance() - 0.5), roll: 20 * (chance() - 0.5),
    behind: one(/** @type {const} */ (['wall', 'table'])),
  };
  const some = [one([0.5, 1, 2, 3, 4]), one([0.7, 1, 1.5, 2, 3])];
  const any = one(Object.keys(crops));
  const [noise, smooth] = isLidar ? [2 + 3 * chance(), 2 + 2 * chance()] : some;
  const crop = isLidar ? 'outline, roughly' : any;
  const space = seenFrom(page, pose);
  const { width, height } = page;
  const corners = [[0, 0], [width, 0], [width, height], [0, height]].map(([u, v]) => project(photoCamera, space(u, v)));
  return {
    page, pose, crop,
    corners: crops[crop](chance, outline(page, pose, photoCamera), corners),
    depths: sensed(page, pose, depthCamera, noise, number, smooth),
  };
}
