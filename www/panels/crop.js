/** Crop of a photo: a polygon whose corners are dragged, and clicks on the photo. */
import { element } from '../dom.js';
import { Handles } from '../page/handles.js';

/** @typedef {[x: number, y: number]} Place in pixels of the photo */

/** Initial corners of the polygon, as shares of the photo's sides. @type {Place[]} */
const INITIAL_CORNERS = [[0.15, 0.15], [0.85, 0.15], [0.85, 0.85], [0.15, 0.85]];

/**
 * @param {object} callbacks
 * @param {() => void} callbacks.onChange called when the polygon has changed
 * @param {(place: Place) => void} callbacks.onClick called when the photo is clicked
 */
export function cropPanel({ onChange, onClick }) {
  const over = element('photo-over', HTMLElement);
  const toggle = element('crop', HTMLButtonElement);
  /** @type {ImageData | null} */
  let photo = null;
  /** @type {Place[]} */
  let polygon = [];

  const handles = new Handles(over, {
    move: (corner, [x, y], ended) => {
      if (!photo) return;
      polygon[corner] = [Math.min(Math.max(x, -0.5), photo.width - 0.5), Math.min(Math.max(y, -0.5), photo.height - 0.5)];
      draw();
      if (ended) onChange();
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
      onChange();
    },
  });
  const draw = () => {
    toggle.setAttribute('aria-pressed', String(polygon.length > 0));
    handles.draw({
      handles: polygon.map(([x, y], i) => ({ x, y, name: `Corner ${i + 1} of the crop`, kind: 'corner' })),
      lines: polygon.map((place, i) => ({ points: [place, polygon[(i + 1) % polygon.length]], kind: 'edge', pullId: i })),
    });
  };
  const clear = () => {
    polygon = [];
    draw();
  };

  toggle.addEventListener('click', () => {
    if (!photo) return;
    const { width, height } = photo;
    polygon = polygon.length > 0 ? [] : INITIAL_CORNERS.map(([x, y]) => [x * (width - 1), y * (height - 1)]);
    draw();
    onChange();
  });
  over.addEventListener('click', (event) => {
    // A drag of a handle ends with a click, too, which is ignored.
    if (!photo || !(event.target instanceof Element) || event.target.closest('.handle, svg')) return;
    onClick(handles.photoPosition(event));
  });

  return {
    /** Shows the crop of a photo; null hides it. @param {ImageData | null} image */
    show(image) {
      over.hidden = image === null;
      if (!image || image === photo) return;
      photo = image;
      handles.setPhoto(image);
      clear();
    },
    clear,
    /** Corners of the polygon, if there is one. @returns {Place[] | undefined} */
    get polygon() {
      return polygon.length > 0 ? polygon.map(([x, y]) => /** @type {Place} */ ([x, y])) : undefined;
    },
  };
}
