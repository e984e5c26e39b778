/** What the page shows, as the part of its address after the #: to be shared, gone back to, and reloaded. */
import { shortest } from './format.js';
import { ENERGIES, VIEWS } from './messages.js';

/** @import {Energy} from './api.js' */
/** @import {Settings} from './session.js' */

/**
 * @typedef {object} State
 * @property {string} [card] of the gallery
 * @property {{ name: string, size: number, noise: number }} [example]
 * @property {number} [file] by its number among those that are kept
 * @property {{ pixelSize?: number, heightScale?: number, zeros?: boolean, hexagonal?: boolean }} [stored] how it is understood
 * @property {Partial<Settings>} settings that are not the defaults
 * @property {boolean} [whole] a mesh is solved whole
 * @property {boolean} [photo] a photo of a page is made flat
 * @property {boolean} [unkept] the file was too large to be kept, or the browser keeps nothing
 * @property {string} [view]
 */

/** @type {readonly (keyof Settings)[]} */
const NUMBERS = ['gap', 'coarsening', 'reweighting', 'occlusionThreshold'];

/**
 * @param {State} state
 * @param {Readonly<Settings>} defaults
 * @returns {string} with its #
 */
export function addressOf({ card, example, file, stored, settings, whole, photo, unkept, view }, defaults) {
  const words = new URLSearchParams();
  if (example) {
    words.set('example', example.name);
    words.set('size', String(example.size));
    words.set('noise', String(example.noise));
  }
  if (file !== undefined) words.set('file', String(file));
  for (const [name, value] of Object.entries(stored ?? {})) words.set(name, String(Number(value)));
  for (const [name, value] of Object.entries(settings)) {
    if (value === undefined || value === defaults[/** @type {keyof Settings} */ (name)]) continue;
    words.set(name, typeof value === 'number' && name === 'lambda' ? shortest(value) : String(value));
  }
  if (unkept) words.set('unkept', '1');
  if (photo) words.set('photo', '1');
  if (whole) words.set('whole', '1');
  if (view && view !== 'shaded') words.set('view', view);
  return `#${[...(card ? [card] : []), ...(words.size > 0 ? [words] : [])].join('&')}`;
}

/**
 * Takes what it understands, and leaves the rest.
 * @param {string} hash
 * @returns {State}
 */
export function stateOf(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, ''));
  /** @param {string} name */
  const positive = (name) => {
    const value = Number(words.get(name) ?? NaN);
    return value > 0 && Number.isFinite(value) ? value : undefined;
  };
  /** @type {Partial<Settings>} */
  const settings = {};
  const lambda = words.get('lambda') === 'auto' ? 'auto' : positive('lambda');
  if (lambda !== undefined) settings.lambda = lambda;
  for (const name of NUMBERS) {
    const value = positive(name);
    if (value !== undefined) Object.assign(settings, { [name]: value });
  }
  const energy = words.get('energy') ?? '';
  if (Object.hasOwn(ENERGIES, energy)) settings.energy = /** @type {Energy} */ (energy);
  if (words.get('schedule') === 'paper') settings.schedule = 'paper';
  const view = words.get('view') ?? undefined;
  const name = words.get('example');
  const [card] = [...words.entries()].find(([, value]) => value === '') ?? [];
  const flags = ['zeros', 'hexagonal'].filter((flag) => words.has(flag)).map((flag) => [flag, words.get(flag) === '1']);
  const scales = ['pixelSize', 'heightScale'].filter((scale) => Number(words.get(scale))).map((scale) => [scale, Number(words.get(scale))]);
  return {
    card,
    example: name ? { name, size: positive('size') ?? 400, noise: Math.max(0, Number(words.get('noise') ?? 0.02)) || 0 } : undefined,
    file: positive('file'),
    stored: flags.length + scales.length > 0 ? Object.fromEntries([...flags, ...scales]) : undefined,
    settings,
    whole: words.get('whole') === '1' || undefined,
    photo: words.get('photo') === '1' || undefined,
    unkept: words.get('unkept') === '1' || undefined,
    view: view && Object.hasOwn(VIEWS, view) ? view : undefined,
  };
}
