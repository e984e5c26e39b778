/** The photo with the outline of the page on it, to be dragged. */
import { element, followDevicePixels } from '../dom.js';
import { number } from '../format.js';
import { Handles } from '../page/handles.js';
import { canvasOf } from '../views/dewarped.js';

/** @import {PageSession} from '../page/session.js' */
/** @import {Which} from '../page/outline.js' */
/** @import {Line} from '../page/handles.js' */

/** @param {PageSession} session */
export function pagePhotoPanel(session) {
  const box = element('page-photo', HTMLElement);
  const canvas = element('page-canvas', HTMLCanvasElement);
  const caption = element('page-caption', HTMLElement);
  const more = element('point-add', HTMLButtonElement);
  const fewer = element('point-remove', HTMLButtonElement);
  const snap = element('snap', HTMLInputElement);
  /** Which node each handle is. @type {Which[]} */
  let nodes = [];
  /** The handle that had the focus last. */
  let chosen = -1;

  const handles = new Handles(box, {
    move: (handle, to, { key, ended }) => session.move(nodes[handle], to, { held: key, ended }),
    pull: (edge, place) => handleOf(session.add(/** @type {0 | 1} */ (edge), place)),
    remove: (handle) => remove(handle),
    choose: (handle) => {
      chosen = handle;
      tell();
    },
  });
  /** @param {Which} which */
  const handleOf = ({ edge, node }) => nodes.findIndex((one) => one.edge === edge && one.node === node);
  const bend = () => nodes[chosen] !== undefined && !session.outline.at(nodes[chosen])?.corner;
  const tell = () => {
    // Only said to be disabled, so that the keyboard's focus is not lost.
    fewer.setAttribute('aria-disabled', String(!bend()));
    more.setAttribute('aria-disabled', String(session.photo === null));
  };
  /** @param {number} handle */
  const remove = (handle) => {
    if (session.outline.at(nodes[handle])?.corner !== false) return;
    session.remove(nodes[handle]);
    handles.focus(handle - 1);
  };

  more.addEventListener('click', () => {
    if (!session.photo) return;
    const edge = nodes[chosen]?.edge ?? 0;
    handles.focus(handleOf(session.add(edge, widest(session, edge))));
  });
  fewer.addEventListener('click', () => remove(chosen));
  snap.addEventListener('change', () => session.snap(snap.checked));
  element('suggest', HTMLButtonElement).addEventListener('click', () => session.suggest());

  const paint = () => {
    const context = canvas.getContext('2d');
    if (!context || !session.photo) return;
    context.imageSmoothingQuality = 'high';
    context.drawImage(canvasOf(session.photo.small), 0, 0, canvas.width, canvas.height);
  };
  followDevicePixels(canvas, paint);

  session.on('photo', (photo) => {
    chosen = -1;
    handles.on(photo);
    box.hidden = false;
    element('page-empty', HTMLElement).hidden = true;
    caption.textContent = `${photo.name}, ${number(photo.width, 6)} × ${number(photo.height, 6)}`;
    canvas.setAttribute('aria-label', `The photo ${photo.name}`);
    paint();
  });
  session.on('outline', ({ outline, traces }) => {
    nodes = outline.edges.flatMap((list, edge) => list.map((_, node) => ({ edge: /** @type {0 | 1} */ (edge), node })));
    /** @type {Line[]} */
    const sides = outline.sides().map(([p, q]) => ({ kind: 'side', points: [[p.x, p.y], [q.x, q.y]] }));
    /** @type {Line[]} */
    const edges = traces.lines.flatMap((spans, edge) => spans.map((points) => ({ kind: /** @type {const} */ ('edge'), points, pulls: edge })));
    handles.draw({
      handles: nodes.map((which) => {
        const { x, y, corner, held } = outline.at(which);
        return { x, y, name: outline.name(which), kind: corner ? 'corner' : 'bend', held };
      }),
      lines: [...sides, ...edges],
    });
    tell();
  });
  tell();
}

/**
 * The middle of an edge's longest part without a point.
 * @param {PageSession} session
 * @param {0 | 1} edge
 * @returns {[number, number]}
 */
function widest({ outline }, edge) {
  const nodes = outline.edges[edge];
  const gaps = nodes.slice(1).map((node, i) => Math.hypot(node.x - nodes[i].x, node.y - nodes[i].y));
  const i = gaps.indexOf(Math.max(...gaps));
  return [(nodes[i].x + nodes[i + 1].x) / 2, (nodes[i].y + nodes[i + 1].y) / 2];
}
