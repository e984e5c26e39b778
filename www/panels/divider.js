/** The divider between input and result over a picture, moved by pointer or keyboard. */
import { element } from '../dom.js';
import { KEY_MOVE_SHARE } from '../surface/zoom.js';

/** Time of its movement over the picture, in milliseconds. */
const GLIDE_MS = 1600;

/**
 * @param {string} id
 * @param {[string, string]} names of what is left and right of the divider
 * @param {(share: number) => void} onMove gets the share of the picture left of the divider
 * @param {number} [share] initial share
 */
export function dividerOver(id, [left, right], onMove, share = 0.5) {
  const divider = element(id, HTMLElement);
  /** @param {number} to */
  const move = (to) => {
    share = Math.min(1, Math.max(0, to));
    divider.style.left = `${100 * share}%`;
    divider.style.setProperty('--share', String(share));
    divider.ariaValueNow = String(Math.round(100 * share));
    divider.setAttribute('aria-valuetext', `${left} on ${divider.ariaValueNow} % of the picture, ${right} on the rest`);
    onMove(share);
  };
  divider.addEventListener('pointerdown', (event) => {
    if (event.button === 0) divider.setPointerCapture(event.pointerId);
  });
  divider.addEventListener('pointermove', (event) => {
    if (!divider.hasPointerCapture(event.pointerId)) return;
    const frame = /** @type {HTMLElement} */ (divider.parentElement).getBoundingClientRect();
    move((event.clientX - frame.left) / frame.width);
  });
  divider.addEventListener('keydown', (event) => {
    const to = { ArrowLeft: share - KEY_MOVE_SHARE, ArrowDown: share - KEY_MOVE_SHARE, ArrowRight: share + KEY_MOVE_SHARE, ArrowUp: share + KEY_MOVE_SHARE, Home: 0, End: 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    move(to);
  });
  move(share);
  return {
    /** Moves over the picture to its left rim until somebody moves it; not where less motion is preferred. */
    glide: () => {
      if (matchMedia('(prefers-reduced-motion: reduce)').matches) return;
      const start = performance.now();
      let last = share;
      const step = () => {
        // Somebody has moved it.
        if (share !== last) return;
        const left = Math.max(0, 1 - (performance.now() - start) / GLIDE_MS);
        // Slowly at first, and at the end.
        move(last = (1 - Math.cos(Math.PI * left)) / 2);
        if (left > 0) requestAnimationFrame(step);
      };
      step();
    },
    get share() {
      return share;
    },
    /** @param {boolean} shown */
    show: (shown) => (divider.hidden = !shown),
  };
}
