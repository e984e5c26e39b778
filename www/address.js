/** Encoding of the page's state in the fragment of its address (after the #), for links, the history and reloads. */
import { shortLambda } from './format.js';
import { ENERGIES, VIEW_WORDS } from './messages.js';
import { noDataOf } from './import-interpretation.js';

/**
 * @typedef {object} State
 * @property {string} [card] id of a card of the gallery
 * @property {{ name: string, size: number, noise: number }} [example]
 * @property {number} [file] id of the file in the storage of recent files
 * @property {import('./linked-file.js').LinkedFile} [linked] file that a link holds
 * @property {{ pixelSize?: number, heightScale?: number, noData?: NoData }} [stored] interpretation of the file
 * @property {Partial<Settings>} settings settings that differ from the defaults
 * @property {boolean} [whole] whether a whole mesh is fitted
 * @property {boolean} [photo] whether a photo of a page is made flat
 * @property {boolean} [unkept] whether the file could not be stored
 * @property {string} [view]
 */

/** Settings that are positive numbers. @type {readonly (keyof Settings)[]} */
const NUMERIC_SETTINGS = ['gap', 'coarsening', 'occlusionThreshold'];

/** Encodes a state as a fragment. @param {State} state @param {Readonly<Settings>} defaults @returns {string} fragment with its # */
export function addressOf({ card, example, file, linked, stored, settings, whole, photo, unkept, view }, defaults) {
  const parameters = new URLSearchParams();
  for (const [name, value] of Object.entries({ example: example?.name, size: example?.size, noise: example?.noise, file, ...stored })) if (value !== undefined) parameters.set(name, String(value));
  for (const [name, value] of Object.entries(settings)) {
    if (value === undefined || value === defaults[/** @type {keyof Settings} */ (name)]) continue;
    parameters.set(name, typeof value === 'number' && name === 'lambda' ? shortLambda(value) : String(value));
  }
  for (const [name, value] of Object.entries(linked ?? {})) parameters.set(name, value);
  for (const [name, flag] of Object.entries({ unkept, photo, whole })) if (flag) parameters.set(name, '1');
  if (view && view !== 'shaded') parameters.set('view', view);
  return `#${[...(card ? [card] : []), ...(parameters.size > 0 ? [parameters] : [])].join('&')}`;
}

/** Whether a fragment leads to the first screen. @param {string} hash */
export const isStart = (hash) => hash.length <= 1;

/** Decodes a fragment; unknown or invalid parts are ignored. @param {string} hash @returns {State} */
export function stateOf(hash) {
  const parameters = new URLSearchParams(hash.replace(/^#/, ''));
  /** @param {string} name */
  const positive = (name) => {
    const value = Number(parameters.get(name) ?? NaN);
    return value > 0 && Number.isFinite(value) ? value : undefined;
  };
  /** @type {Partial<Settings>} */
  const settings = {};
  const lambda = parameters.get('lambda') === 'auto' ? 'auto' : positive('lambda');
  if (lambda !== undefined) settings.lambda = lambda;
  for (const name of NUMERIC_SETTINGS) {
    const value = positive(name);
    if (value !== undefined) Object.assign(settings, { [name]: value });
  }
  const energy = parameters.get('energy') ?? '';
  if (Object.hasOwn(ENERGIES, energy)) settings.energy = /** @type {Energy} */ (energy);
  const view = parameters.get('view') ?? undefined;
  const name = parameters.get('example');
  const [card] = [...parameters.entries()].find(([, value]) => value === '') ?? [];
  const scales = ['pixelSize', 'heightScale'].map((scale) => [scale, Number(parameters.get(scale))]).filter(([, value]) => value);
  const stored = { ...Object.fromEntries(scales), noData: noDataOf(parameters.get('noData') ?? '') };
  const [whole, photo, unkept] = ['whole', 'photo', 'unkept'].map((flag) => parameters.get(flag) === '1' || undefined);
  return {
    card,
    example: name ? { name, size: positive('size') ?? 400, noise: Math.max(0, Number(parameters.get('noise') ?? 0.02)) || 0 } : undefined,
    file: positive('file'),
    linked: parameters.has('data') ? { name: parameters.get('name') ?? 'file', data: parameters.get('data') ?? '' } : undefined,
    stored: Object.values(stored).some((value) => value !== undefined) ? stored : undefined,
    settings,
    whole,
    photo,
    unkept,
    view: view && Object.hasOwn(VIEW_WORDS, view) ? view : undefined,
  };
}
