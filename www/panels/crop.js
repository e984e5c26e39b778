/** Which part of a photo is wanted: what lies within a polygon whose corners are dragged, or where it was clicked. */
import { element } from '../dom.js';
import { Handles } from '../page/handles.js';

/** @typedef {[x: number, y: number]} Place */

/** Where the polygon's corners are for a start, as shares of the photo. @type {Place[]} */
const BEGIN = [[0.15, 0.15], [0.85, 0.15], [0.85, 0.85], [0.15, 0.85]];

/**
 * @param {object} doings
 * @param {() => void} doings.changed the polygon is another
 * @param {(place: Place) => void} doings.click the photo was clicked there
 */
export function cropPanel({ changed, click }) {
  const over = element('photo-over', HTMLElement);
  const toggle = element('crop', HTMLButtonElement);
  /** @type {ImageData | null} */
  let photo = null;
  /** @type {Place[]} */
  let polygon = [];

  const handles = new Handles(over, {
    move: (corner, [x, y], { ended }) => {
      if (!photo) return;
      polygon[corner] = [Math.min(Math.max(x, -0.5), photo.width - 0.5), Math.min(Math.max(y, -0.5), photo.height - 0.5)];
      draw();
      if (ended) changed();
    },
    pull: (side, place) => {
      polygon.splice(side + 1, 0, place);
      draw();
      return side + 1;
    },
    remove: (corner) => {
      if (polygon.length <= 3) return;
      polygon.splice(corner, 1);
      draw();
      handles.focus(corner % polygon.length);
      changed();
    },
  });
  const draw = () => {
    toggle.setAttribute('aria-pressed', String(polygon.length > 0));
    handles.draw({
      handles: polygon.map(([x, y], i) => ({ x, y, name: `Corner ${i + 1} of the crop`, kind: 'corner' })),
      lines: polygon.map((place, i) => ({ points: [place, polygon[(i + 1) % polygon.length]], kind: 'edge', pulls: i })),
    });
  };
  const forget = () => {
    polygon = [];
    draw();
  };

  toggle.addEventListener('click', () => {
    if (!photo) return;
    const { width, height } = photo;
    polygon = polygon.length > 0 ? [] : BEGIN.map(([x, y]) => [x * (width - 1), y * (height - 1)]);
    draw();
    changed();
  });
  over.addEventListener('click', (event) => {
    // Not at the end of a drag.
    if (!photo || !(event.target instanceof Element) || event.target.closest('.handle, svg')) return;
    click(handles.place(event));
  });

  return {
    /** @param {ImageData | null} shown */
    show(shown) {
      over.hidden = shown === null;
      if (!shown || shown === photo) return;
      photo = shown;
      handles.on(shown);
      forget();
    },
    forget,
    /** Corners, where there are any. @returns {Place[] | undefined} */
    get polygon() {
      return polygon.length > 0 ? polygon.map(([x, y]) => /** @type {Place} */ ([x, y])) : undefined;
    },
  };
}
