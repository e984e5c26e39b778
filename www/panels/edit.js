/** Brush and lasso on the surface: heights taken out, trusted less, or held; and the way back. */
import { element } from '../dom.js';
import { affected, brushed, enclosed, takenBack } from '../height-edits.js';

/** @import {Session} from '../session.js' */
/** @import {Effect, Past, Place} from '../height-edits.js' */
/** @typedef {ReturnType<typeof import('./space.js').spacePanel>} SpacePanel */

/** @type {readonly string[]} */
const EFFECTS = ['out', 'doubt', 'hold', 'crop'];

/**
 * @param {Session} session
 * @param {SpacePanel} space
 */
export function editPanel(session, space) {
  const drag = element('drag', HTMLSelectElement);
  const options = element('edit-options', HTMLElement);
  const shape = element('edit-shape', HTMLSelectElement);
  const size = element('edit-size', HTMLInputElement);
  const undo = element('edit-undo', HTMLButtonElement);
  /** @type {Past[]} */
  let past = [];
  /** @type {Place[]} */
  let line = [];

  const effect = () => (EFFECTS.includes(drag.value) ? /** @type {Effect} */ (drag.value) : null);
  const round = () => shape.value === 'lasso' || effect() === 'crop';
  const tell = () => {
    options.hidden = effect() === null && past.length === 0;
    shape.disabled = effect() === 'crop';
    size.disabled = round();
    undo.disabled = past.length === 0;
  };

  /** In pixels of the input. @param {{ x: number, y: number } | null} place @returns {Place | null} */
  const pixelAt = (place) => {
    const { input } = session;
    return place && input ? [0.5 + place.x * (input.width - 1), 0.5 + (1 - place.y) * (input.height - 1)] : null;
  };
  /** @param {number} x @param {number} y in the canvas' pixels */
  const add = (x, y) => {
    const { input } = session;
    const place = space.placeAt(x, y);
    const pixel = pixelAt(place);
    if (!place || !pixel || !input) return;
    line.push(pixel);
    space.trail(line.map(([px, py]) => ({ x: (px - 0.5) / (input.width - 1), y: 1 - (py - 0.5) / (input.height - 1) })), round());
  };
  const apply = () => {
    const { input } = session;
    const what = effect();
    const drawn = line;
    line = [];
    space.trail([], false);
    if (!input || !what || drawn.length === 0) return;
    const radius = (size.valueAsNumber / 100) * Math.max(input.width, input.height);
    const pixels = round() ? enclosed(input, drawn, what === 'crop') : brushed(input, drawn, radius);
    if (pixels.length === 0) return;
    const { change, past: before } = affected(input, pixels, what, space.seenHeight());
    if (change.data && !change.data.some(Number.isFinite)) {
      session.fail('This could not be taken out', new Error('nothing else would be left'));
      return;
    }
    past.push(before);
    tell();
    void session.amend(change);
  };

  space.takes({
    begin: (x, y) => {
      const { input } = session;
      if (effect() === null || !input || input.design || input.lattice) return false;
      line = [];
      add(x, y);
      return true;
    },
    move: add,
    end: apply,
  });
  // By keyboard: at the middle of what is seen.
  space.canvas.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter' || effect() === null || round()) return;
    add(space.canvas.width / 2, space.canvas.height / 2);
    apply();
  });

  drag.addEventListener('change', tell);
  shape.addEventListener('change', tell);
  const back = () => {
    const before = past.pop();
    tell();
    if (before && session.input) void session.amend(takenBack(session.input, before));
  };
  undo.addEventListener('click', back);
  document.addEventListener('keydown', (event) => {
    const typing = event.target instanceof HTMLInputElement && event.target.type === 'text';
    if (typing || past.length === 0 || event.key !== 'z' || !(event.ctrlKey || event.metaKey)) return;
    event.preventDefault();
    back();
  });
  // What was drawn on another input is of no use.
  session.on('cleared', () => {
    past = [];
    tell();
  });
  session.on('input', ({ design, lattice }) => {
    for (const option of drag.options) option.disabled = EFFECTS.includes(option.value) && (design === true || lattice !== undefined);
    if (drag.selectedOptions[0]?.disabled) drag.value = 'turn';
    tell();
  });
}
