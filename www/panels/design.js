/** Pins and curves of a design, dragged in space; the surface follows. */
import { changed, constraintsOf, designInput, handlesOf, pinAt, STARTS } from '../design.js';
import { element, elements } from '../dom.js';
import { number } from '../format.js';

/** @import {Design, Handle, Pin} from '../design.js' */
/** @import {Session} from '../session.js' */
/** @typedef {ReturnType<typeof import('./space.js').spacePanel>} SpacePanel */

/** In sides of the square, for each press of an arrow key. */
const KEY_STEP = 0.02;
/** Seen from closer to straight above than this, heights cannot be dragged: pins go sideways. */
const STEEP = 0.2;
/** The highest and the lowest that a pin goes. */
const REACH = 1;
/** Pins of a new curve. */
const PINS = 4;

/**
 * @param {Session} session
 * @param {SpacePanel} space
 */
export function designPanel(session, space) {
  const tools = element('design-tools', HTMLElement);
  const layer = element('handles', HTMLElement);
  const clamped = element('clamped', HTMLInputElement);
  const undo = element('design-undo', HTMLButtonElement);
  const away = element('take-away', HTMLButtonElement);
  const adds = { pin: element('add-pin', HTMLButtonElement), curve: element('add-curve', HTMLButtonElement) };
  /** What was before each change, oldest first. @type {Design[]} */
  let past = [];
  /** @type {{ handle: Handle, knob: HTMLButtonElement }[]} */
  let knobs = [];
  /** The pin that was touched last. @type {Handle | null} */
  let touched = null;
  /** What the next drag over the surface makes. @type {'pin' | 'curve' | null} */
  let adding = null;

  const drawn = () => session.input?.drawn;

  /** @param {Design} design @param {boolean} [done] */
  const put = (design, done = true) => {
    session.reshape({ drawn: design, data: constraintsOf(design) });
    if (done) session.settle();
  };
  const remember = () => {
    const design = drawn();
    if (design) past.push(design);
    undo.disabled = past.length === 0;
  };
  /** @param {Design} design */
  const renew = (design) => {
    remember();
    put(design);
  };

  for (const button of elements('button[data-start]', HTMLButtonElement)) {
    button.addEventListener('click', () => renew(STARTS[button.dataset.start ?? 'flat']));
  }
  clamped.addEventListener('change', () => {
    const design = drawn();
    if (design) renew({ ...design, clamped: clamped.checked });
  });
  const back = () => {
    const before = past.pop();
    undo.disabled = past.length === 0;
    if (before) put(before);
  };
  undo.addEventListener('click', back);
  document.addEventListener('keydown', (event) => {
    const typing = event.target instanceof HTMLInputElement && event.target.type === 'text';
    if (tools.hidden || typing || event.key !== 'z' || !(event.ctrlKey || event.metaKey)) return;
    event.preventDefault();
    back();
  });

  /** @param {typeof adding} what */
  const add = (what) => {
    adding = what;
    for (const [name, button] of Object.entries(adds)) button.setAttribute('aria-pressed', String(name === what));
  };
  for (const name of /** @type {const} */ (['pin', 'curve'])) {
    // By mouse the next drag says where; by keyboard it goes to the middle.
    adds[name].addEventListener('click', ({ detail }) => {
      if (detail > 0) return add(adding === name ? null : name);
      const middle = { x: 0.5, y: 0.5, z: space.heightAt(0.5, 0.5) };
      place(name, name === 'pin' ? [middle] : line({ ...middle, x: 0.1 }, { ...middle, x: 0.9 }));
    });
  }
  /** @param {'pin' | 'curve'} what @param {Pin[]} pins */
  const place = (what, pins) => {
    const design = drawn();
    add(null);
    if (!design) return;
    renew(what === 'pin' ? { ...design, pins: [...design.pins, ...pins] } : { ...design, curves: [...design.curves, pins] });
    const last = knobs.findLast(({ handle }) => (handle.curve === null) === (what === 'pin'));
    last?.knob.focus();
  };
  /** Between two places on the surface. @param {Pin} from @param {Pin} to */
  const line = (from, to) => Array.from({ length: PINS }, (_, i) => {
    const t = i / (PINS - 1);
    const [x, y] = [from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)];
    return { x, y, z: space.heightAt(x, y) };
  });
  /** @type {Pin | null} */
  let from = null;
  /** @type {Pin | null} */
  let to = null;
  space.takes({
    begin: (x, y) => {
      if (!adding || tools.hidden) return false;
      from = to = space.placeAt(x, y);
      return true;
    },
    move: (x, y) => (to = space.placeAt(x, y) ?? to),
    end: () => {
      if (adding && from && to) place(adding, adding === 'pin' ? [to] : line(from, to));
      else add(null);
    },
  });

  /** @param {Handle | null} handle */
  const touch = (handle) => {
    touched = handle;
    away.disabled = handle === null;
  };
  /** @param {Handle} handle */
  const takeAway = (handle) => {
    const design = drawn();
    if (!design) return;
    renew(changed(design, handle, null));
    knobs[0]?.knob.focus();
  };
  away.addEventListener('click', () => {
    if (touched) takeAway(touched);
  });

  /** @param {Handle} handle @param {number} number */
  const knobOf = (handle, number) => {
    const knob = document.createElement('button');
    knob.type = 'button';
    knob.className = 'knob';
    if (handle.curve !== null) knob.dataset.curve = '';
    knob.setAttribute('role', 'slider');
    knob.setAttribute('aria-orientation', 'vertical');
    knob.setAttribute('aria-label', handle.curve === null ? `Pin ${number}` : `Pin ${handle.index + 1} of curve ${handle.curve + 1}`);
    knob.setAttribute('aria-valuemin', String(-REACH));
    knob.setAttribute('aria-valuemax', String(REACH));
    /** @param {Partial<Pin>} change @param {boolean} done */
    const move = (change, done) => {
      const design = drawn();
      if (design) put(changed(design, handle, change), done);
    };
    const own = () => {
      const design = drawn();
      return design ? pinAt(design, handle) : null;
    };
    knob.addEventListener('focus', () => touch(handle));
    /** @type {{ x: number, y: number, pin: Pin } | null} */
    let held = null;
    knob.addEventListener('pointerdown', (event) => {
      const pin = own();
      if (event.button !== 0 || !pin) return;
      knob.setPointerCapture(event.pointerId);
      // Not every browser focuses what is pressed.
      touch(handle);
      remember();
      held = { x: event.clientX, y: event.clientY, pin };
    });
    knob.addEventListener('pointermove', (event) => {
      if (!held) return;
      const [across, up] = [event.clientX - held.x, held.y - event.clientY];
      move(space.dragged(held.pin, across, up, event.shiftKey || space.tip() < STEEP), false);
    });
    const drop = () => {
      if (held) session.settle();
      held = null;
    };
    knob.addEventListener('pointerup', drop);
    knob.addEventListener('pointercancel', drop);
    knob.addEventListener('keydown', (event) => {
      const pin = own();
      const design = drawn();
      if (!pin || !design) return;
      if (event.key === 'Delete' || event.key === 'Backspace') {
        event.preventDefault();
        takeAway(handle);
        return;
      }
      const step = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] }[event.key];
      if (!step) return;
      event.preventDefault();
      if (!event.repeat) remember();
      const [across, up] = step.map((by) => by * KEY_STEP);
      move(event.shiftKey || across !== 0 ? within({ x: pin.x + across, y: pin.y + (event.shiftKey ? up : 0) }) : { z: pin.z + up }, !event.repeat);
    });
    knob.addEventListener('keyup', () => session.settle());
    return { handle, knob };
  };

  const follow = () => {
    const design = drawn();
    layer.hidden = !design || !space.there();
    if (!design || layer.hidden) return;
    for (const { handle, knob } of knobs) {
      const pin = pinAt(design, handle);
      if (!pin) continue;
      const [x, y] = space.seenAt(pin);
      Object.assign(knob.style, { left: `${x}px`, top: `${y}px` });
      knob.setAttribute('aria-valuenow', pin.z.toFixed(2));
      knob.setAttribute('aria-valuetext', `height ${number(100 * pin.z, 2)} % of a side`);
    }
  };
  space.onDraw(follow);

  session.on('input', ({ drawn: design, kind }) => {
    tools.hidden = !design || kind !== undefined;
    if (!design) {
      past = [];
      undo.disabled = true;
      add(null);
      layer.replaceChildren();
      knobs = [];
      layer.hidden = true;
      return;
    }
    clamped.checked = design.clamped;
    const handles = handlesOf(design);
    const same = handles.length === knobs.length && handles.every(({ curve, index }, i) => curve === knobs[i].handle.curve && index === knobs[i].handle.index);
    if (!same) {
      knobs = handles.map((handle, i) => knobOf(handle, i + 1));
      layer.replaceChildren(...knobs.map(({ knob }) => knob));
      touch(null);
    }
    follow();
  });
}

/** @param {{ x: number, y: number }} place */
function within({ x, y }) {
  return { x: Math.min(1, Math.max(0, x)), y: Math.min(1, Math.max(0, y)) };
}
