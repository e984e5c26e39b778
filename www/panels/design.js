/** Pins and curves of a design, which are dragged in space; the surface is solved meanwhile. */
import { constraintsOf, designInput, handlesOf, pinAt, START_DESIGNS, withPin } from '../design.js';
import { element, elements } from '../dom.js';
import { number } from '../format.js';
import { clampToUnit } from '../surface/relief.js';

/** @import {Design, Handle, Pin} from '../design.js' */
/** @import {Session} from '../session.js' */
/** @typedef {ReturnType<typeof import('./space.js').spacePanel>} SpacePanel */

/** Distance that an arrow key moves a pin, in sides of the square. */
const KEY_STEP_SIDES = 0.02;
/** Minimum tilt of the camera at which a drag changes a pin's height, in radians from straight above; below it a drag moves the pin sideways. */
const MIN_HEIGHT_DRAG_TILT = 0.2;
/** Maximum absolute height of a pin that is reported to screen readers, in sides of the square. */
const MAX_REPORTED_HEIGHT_SIDES = 1;
/** Number of pins of a new curve. */
const NEW_CURVE_PINS = 4;

/**
 * @param {Session} session
 * @param {SpacePanel} space
 */
export function designPanel(session, space) {
  const tools = element('design-tools', HTMLElement);
  const layer = element('handles', HTMLElement);
  const clamped = element('clamped', HTMLInputElement);
  const undo = element('design-undo', HTMLButtonElement);
  const removeButton = element('take-away', HTMLButtonElement);
  const addButtons = { pin: element('add-pin', HTMLButtonElement), curve: element('add-curve', HTMLButtonElement) };
  /** Designs before each change, the newest last. @type {Design[]} */
  let undoStack = [];
  /** @type {{ handle: Handle, knob: HTMLButtonElement }[]} */
  let knobs = [];
  /** The pin that was focused last. @type {Handle | null} */
  let selected = null;
  /** Element that the next drag over the surface adds to the design. @type {'pin' | 'curve' | null} */
  let adding = null;

  const presentDesign = () => session.input?.designShape;

  /** Makes a design the input. @param {Design} design @param {boolean} [done] false while a pin is dragged */
  const setDesign = (design, done = true) => {
    session.previewInput({ designShape: design, data: constraintsOf(design) });
    if (done) session.runPending();
  };
  const saveUndo = () => {
    const design = presentDesign();
    if (design) undoStack.push(design);
    undo.disabled = undoStack.length === 0;
  };
  /** Makes a design the input, with undo. @param {Design} design */
  const changeDesign = (design) => {
    saveUndo();
    setDesign(design);
  };

  for (const button of elements('button[data-start]', HTMLButtonElement)) {
    button.addEventListener('click', () => changeDesign(START_DESIGNS[button.dataset.start ?? 'flat']));
  }
  clamped.addEventListener('change', () => {
    const design = presentDesign();
    if (design) changeDesign({ ...design, clamped: clamped.checked });
  });
  const undoLast = () => {
    const before = undoStack.pop();
    undo.disabled = undoStack.length === 0;
    if (before) setDesign(before);
  };
  undo.addEventListener('click', undoLast);
  document.addEventListener('keydown', (event) => {
    const typing = event.target instanceof HTMLInputElement && event.target.type === 'text';
    if (tools.hidden || typing || event.key !== 'z' || !(event.ctrlKey || event.metaKey)) return;
    event.preventDefault();
    undoLast();
  });

  /** Sets what the next drag adds. @param {typeof adding} what */
  const setAdding = (what) => {
    adding = what;
    for (const [name, button] of Object.entries(addButtons)) button.setAttribute('aria-pressed', String(name === what));
  };
  for (const name of /** @type {const} */ (['pin', 'curve'])) {
    // After a click by mouse the next drag gives the position; by keyboard the middle is taken.
    addButtons[name].addEventListener('click', ({ detail }) => {
      if (detail > 0) return setAdding(adding === name ? null : name);
      const middle = { x: 0.5, y: 0.5, z: space.heightAt(0.5, 0.5) };
      addPins(name, name === 'pin' ? [middle] : curvePins({ ...middle, x: 0.1 }, { ...middle, x: 0.9 }));
    });
  }
  /** Adds a pin or a curve, and focuses its last pin. @param {'pin' | 'curve'} what @param {Pin[]} pins */
  const addPins = (what, pins) => {
    const design = presentDesign();
    setAdding(null);
    if (!design) return;
    changeDesign(what === 'pin' ? { ...design, pins: [...design.pins, ...pins] } : { ...design, curves: [...design.curves, pins] });
    const last = knobs.findLast(({ handle }) => (handle.curve === null) === (what === 'pin'));
    last?.knob.focus();
  };
  /** Pins on the surface between two others. @param {Pin} from @param {Pin} to */
  const curvePins = (from, to) => Array.from({ length: NEW_CURVE_PINS }, (_, i) => {
    const t = i / (NEW_CURVE_PINS - 1);
    const [x, y] = [from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)];
    return { x, y, z: space.heightAt(x, y) };
  });
  /** Start of a drag over the surface. @type {Pin | null} */
  let from = null;
  /** End of a drag over the surface. @type {Pin | null} */
  let to = null;
  space.addDragHandler({
    begin: (x, y) => {
      if (!adding || tools.hidden) return false;
      from = to = space.placeAt(x, y);
      return true;
    },
    move: (x, y) => (to = space.placeAt(x, y) ?? to),
    end: () => {
      if (adding && from && to) addPins(adding, adding === 'pin' ? [to] : curvePins(from, to));
      else setAdding(null);
    },
  });

  /** @param {Handle | null} handle */
  const selectPin = (handle) => {
    selected = handle;
    removeButton.disabled = handle === null;
  };
  /** @param {Handle} handle */
  const removePin = (handle) => {
    const design = presentDesign();
    if (!design) return;
    changeDesign(withPin(design, handle, null));
    knobs[0]?.knob.focus();
  };
  removeButton.addEventListener('click', () => {
    if (selected) removePin(selected);
  });

  /** The button by which a pin is dragged. @param {Handle} handle @param {number} number */
  const makeKnob = (handle, number) => {
    const knob = document.createElement('button');
    knob.type = 'button';
    knob.className = 'knob';
    if (handle.curve !== null) knob.dataset.curve = '';
    knob.setAttribute('role', 'slider');
    knob.setAttribute('aria-orientation', 'vertical');
    knob.setAttribute('aria-label', handle.curve === null ? `Pin ${number}` : `Pin ${handle.index + 1} of curve ${handle.curve + 1}`);
    knob.setAttribute('aria-valuemin', String(-MAX_REPORTED_HEIGHT_SIDES));
    knob.setAttribute('aria-valuemax', String(MAX_REPORTED_HEIGHT_SIDES));
    /** @param {Partial<Pin>} change @param {boolean} done */
    const move = (change, done) => {
      const design = presentDesign();
      if (design) setDesign(withPin(design, handle, change), done);
    };
    const presentPin = () => {
      const design = presentDesign();
      return design ? pinAt(design, handle) : null;
    };
    knob.addEventListener('focus', () => selectPin(handle));
    /** Start of the present drag, in pixels of the page. @type {{ x: number, y: number, pin: Pin } | null} */
    let dragStart = null;
    knob.addEventListener('pointerdown', (event) => {
      const pin = presentPin();
      if (event.button !== 0 || !pin) return;
      knob.setPointerCapture(event.pointerId);
      // Not every browser focuses a button when it is pressed.
      selectPin(handle);
      saveUndo();
      dragStart = { x: event.clientX, y: event.clientY, pin };
    });
    knob.addEventListener('pointermove', (event) => {
      if (!dragStart) return;
      const [across, up] = [event.clientX - dragStart.x, dragStart.y - event.clientY];
      move(space.movePin(dragStart.pin, across, up, event.shiftKey || space.cameraTilt() < MIN_HEIGHT_DRAG_TILT), false);
    });
    const endDrag = () => {
      if (dragStart) session.runPending();
      dragStart = null;
    };
    knob.addEventListener('pointerup', endDrag);
    knob.addEventListener('pointercancel', endDrag);
    knob.addEventListener('keydown', (event) => {
      const pin = presentPin();
      const design = presentDesign();
      if (!pin || !design) return;
      if (event.key === 'Delete' || event.key === 'Backspace') {
        event.preventDefault();
        removePin(handle);
        return;
      }
      const step = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] }[event.key];
      if (!step) return;
      event.preventDefault();
      if (!event.repeat) saveUndo();
      const [across, up] = step.map((by) => by * KEY_STEP_SIDES);
      move(event.shiftKey || across !== 0 ? clampToSquare({ x: pin.x + across, y: pin.y + (event.shiftKey ? up : 0) }) : { z: pin.z + up }, !event.repeat);
    });
    knob.addEventListener('keyup', () => session.runPending());
    return { handle, knob };
  };

  const positionKnobs = () => {
    const design = presentDesign();
    layer.hidden = !design || !space.isShown();
    if (!design || layer.hidden) return;
    for (const { handle, knob } of knobs) {
      const pin = pinAt(design, handle);
      if (!pin) continue;
      const [x, y] = space.screenPosition(pin);
      Object.assign(knob.style, { left: `${x}px`, top: `${y}px` });
      knob.setAttribute('aria-valuenow', pin.z.toFixed(2));
      knob.setAttribute('aria-valuetext', `height ${number(100 * pin.z, 2)} % of a side`);
    }
  };
  space.onDraw(positionKnobs);

  session.on('input', ({ designShape: design, kind }) => {
    tools.hidden = !design || kind !== undefined;
    if (!design) {
      undoStack = [];
      undo.disabled = true;
      setAdding(null);
      layer.replaceChildren();
      knobs = [];
      layer.hidden = true;
      return;
    }
    clamped.checked = design.clamped;
    const handles = handlesOf(design);
    const same = handles.length === knobs.length && handles.every(({ curve, index }, i) => curve === knobs[i].handle.curve && index === knobs[i].handle.index);
    if (!same) {
      knobs = handles.map((handle, i) => makeKnob(handle, i + 1));
      layer.replaceChildren(...knobs.map(({ knob }) => knob));
      selectPin(null);
    }
    positionKnobs();
  });
}

/** The nearest point of the unit square. @param {{ x: number, y: number }} place */
function clampToSquare({ x, y }) {
  return { x: clampToUnit(x), y: clampToUnit(y) };
}
