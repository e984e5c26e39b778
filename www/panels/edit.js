/** Brush and lasso on the surface: remove heights, lower their confidence, or make them constraints; and undo. */
import { element } from '../dom.js';
import { applyEdit, pixelsAlong, pixelsInside, undoEdit } from '../height-edits.js';

/** @import {Session} from '../session.js' */
/** @import {Effect, Place, UndoStep} from '../height-edits.js' */
/** @typedef {ReturnType<typeof import('./space.js').spacePanel>} SpacePanel */

/** Values of the menu that edit heights. @type {readonly string[]} */
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
  /** The newest last. @type {UndoStep[]} */
  let undoSteps = [];
  /** The present stroke. @type {Place[]} */
  let stroke = [];

  const effect = () => (EFFECTS.includes(drag.value) ? /** @type {Effect} */ (drag.value) : null);
  const isLasso = () => shape.value === 'lasso' || effect() === 'crop';
  const updateControls = () => {
    options.hidden = effect() === null && undoSteps.length === 0;
    shape.disabled = effect() === 'crop';
    size.disabled = isLasso();
    undo.disabled = undoSteps.length === 0;
  };

  /** Converts a place of the surface to pixels of the input. @param {{ x: number, y: number } | null} place @returns {Place | null} */
  const pixelAt = (place) => {
    const { input } = session;
    return place && input ? [0.5 + place.x * (input.width - 1), 0.5 + (1 - place.y) * (input.height - 1)] : null;
  };
  /** @param {number} x @param {number} y in CSS pixels */
  const extendStroke = (x, y) => {
    const { input } = session;
    const place = space.placeAt(x, y);
    const pixel = pixelAt(place);
    if (!place || !pixel || !input) return;
    stroke.push(pixel);
    space.showTrail(stroke.map(([px, py]) => ({ x: (px - 0.5) / (input.width - 1), y: 1 - (py - 0.5) / (input.height - 1) })), isLasso());
  };
  const apply = () => {
    const { input } = session;
    const chosen = effect();
    const line = stroke;
    stroke = [];
    space.showTrail([], false);
    if (!input || !chosen || line.length === 0) return;
    const radius = (size.valueAsNumber / 100) * Math.max(input.width, input.height);
    const pixels = isLasso() ? pixelsInside(input, line, chosen === 'crop') : pixelsAlong(input, line, radius);
    if (pixels.length === 0) return;
    const { change, undo: step } = applyEdit(input, pixels, chosen, space.heightSampler());
    if (change.data && !change.data.some(Number.isFinite)) {
      session.fail('This could not be taken out', new Error('nothing else would be left'));
      return;
    }
    undoSteps.push(step);
    updateControls();
    void session.updateInput({ ...change, isEdited: true });
  };

  space.addDragHandler({
    begin: (x, y) => {
      const { input } = session;
      if (effect() === null || !input || input.design || input.lattice) return false;
      stroke = [];
      extendStroke(x, y);
      return true;
    },
    move: extendStroke,
    end: apply,
  });
  // The keyboard edits at the middle of the canvas.
  space.canvas.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter' || effect() === null || isLasso()) return;
    extendStroke(space.canvas.clientWidth / 2, space.canvas.clientHeight / 2);
    apply();
  });

  drag.addEventListener('change', updateControls);
  shape.addEventListener('change', updateControls);
  const undoLast = () => {
    const step = undoSteps.pop();
    updateControls();
    if (step && session.input) void session.updateInput({ ...undoEdit(session.input, step), isEdited: undoSteps.length > 0 });
  };
  undo.addEventListener('click', undoLast);
  document.addEventListener('keydown', (event) => {
    const typing = event.target instanceof HTMLInputElement && event.target.type === 'text';
    if (typing || undoSteps.length === 0 || event.key !== 'z' || !(event.ctrlKey || event.metaKey)) return;
    event.preventDefault();
    undoLast();
  });
  // Edits of another input cannot be undone.
  session.on('cleared', () => {
    undoSteps = [];
    updateControls();
  });
  session.on('input', ({ design, lattice }) => {
    for (const option of drag.options) option.disabled = EFFECTS.includes(option.value) && (design === true || lattice !== undefined);
    if (drag.selectedOptions[0]?.disabled) drag.value = 'turn';
    updateControls();
  });
}
