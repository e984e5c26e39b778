/** The photo of a page with its outline, whose points are dragged, and the lines of text that were found. */
import { element, matchDevicePixels, makeButton } from '../dom.js';
import { number } from '../format.js';
import { assumedInWords } from '../messages.js';
import { PAGE_WORDS } from '../page/messages.js';
import { Handles } from '../page/handles.js';
import { EDGES } from '../page/outline.js';
import { canvasFromImage } from '../surface/layer.js';

/** @import {Edge, NodeIndex} from '../page/outline.js' */
/** @import {Line} from '../page/handles.js' */

/** @param {PageSession} session @param {import('../history.js').History<any>} history */
export function pagePhotoPanel(session, history) {
  const box = element('page-photo', HTMLElement);
  const canvas = element('page-canvas', HTMLCanvasElement);
  const caption = element('page-caption', HTMLElement);
  const more = element('point-add', HTMLButtonElement);
  const fewer = element('point-remove', HTMLButtonElement);
  const undo = element('page-undo', HTMLButtonElement);
  const suggest = element('suggest', HTMLButtonElement);
  const several = element('several', HTMLElement);
  const assumed = element('page-assumed', HTMLElement);
  /** The node of the outline that each handle moves. @type {NodeIndex[]} */
  let nodes = [];
  /** Index of the handle that had the focus last. */
  let chosen = -1;

  const handles = new Handles(box, {
    move: (handle, to, ended) => session.move(nodes[handle], to, ended),
    pull: (edge, place) => handleOf(session.add(/** @type {Edge} */ (edge), place, true)),
    remove: (handle) => remove(handle),
    choose: (handle) => {
      chosen = handle;
      updateButtons();
    },
  });
  /** @param {NodeIndex} which */
  const handleOf = ({ edge, node }) => nodes.findIndex((one) => one.edge === edge && one.node === node);
  const isBendChosen = () => nodes[chosen] !== undefined && !session.outline.nodeOf(nodes[chosen])?.corner;
  const updateButtons = () => {
    // `aria-disabled` in the place of `disabled`, so that the button keeps the focus.
    fewer.setAttribute('aria-disabled', String(!isBendChosen()));
    more.setAttribute('aria-disabled', String(session.photo === null));
    undo.setAttribute('aria-disabled', String(!history.canUndo));
    suggest.hidden = !session.isOutlineChanged;
  };
  /** @param {number} handle */
  const remove = (handle) => {
    if (session.outline.nodeOf(nodes[handle])?.corner !== false) return;
    session.remove(nodes[handle]);
    handles.focus(handle - 1);
  };

  more.addEventListener('click', () => {
    if (!session.photo) return;
    const edge = nodes[chosen]?.edge ?? 0;
    handles.focus(handleOf(session.add(edge, longestSegmentMiddle(session, edge))));
  });
  fewer.addEventListener('click', () => isBendChosen() && remove(chosen));
  element('page-turn', HTMLButtonElement).addEventListener('click', () => session.turn());
  suggest.addEventListener('click', () => session.reset());
  undo.addEventListener('click', () => history.step());

  const paint = () => {
    const context = canvas.getContext('2d');
    if (!context || !session.photo) return;
    context.imageSmoothingQuality = 'high';
    context.drawImage(canvasFromImage(session.photo.reduced), 0, 0, canvas.width, canvas.height);
  };
  matchDevicePixels(canvas, paint);

  session.on('photo', (photo) => {
    chosen = -1;
    handles.setPhoto(photo);
    box.hidden = false;
    const { verdict, pages } = photo.outlines;
    const isNone = verdict === 'notFound';
    several.hidden = !isNone && (verdict !== 'several' || pages.length < 2);
    several.replaceChildren(...(isNone ? [makeButton('', () => session.takeWhole(), PAGE_WORDS.takeWhole)] : [PAGE_WORDS.several, ...pages.map((_, i) => makeButton('', () => session.reset(i, 1), PAGE_WORDS.choosePage(i + 1)))]));
    element('page-empty', HTMLElement).hidden = true;
    assumed.textContent = assumedInWords(photo.assumptions);
    assumed.hidden = assumed.textContent === '';
    caption.textContent = `${photo.name}, ${number(photo.width, 6)} × ${number(photo.height, 6)}`;
    canvas.setAttribute('aria-label', `The photo ${photo.name}`);
    paint();
  });
  const redraw = () => {
    const { outline } = session;
    /** @type {Line[]} */
    const found = session.foundLines.map((points) => ({ kind: 'text', points }));
    const gutter = outline.gutter();
    /** @type {Line[]} */
    const gutters = gutter ? [{ kind: 'side', points: gutter.map(({ x, y }) => /** @type {[number, number]} */ ([x, y])) }] : [];
    /** @type {Line[]} */
    const edges = session.traces.flatMap((spans, edge) => spans.map((points) => ({ kind: /** @type {const} */ ('edge'), points, pullId: edge })));
    handles.draw({
      handles: nodes.map((which) => {
        const { x, y, corner } = outline.nodeOf(which);
        return { x, y, name: outline.name(which), kind: /** @type {'corner' | 'bend'} */ (corner ? 'corner' : 'bend') };
      }),
      lines: [...found, ...gutters, ...edges],
    });
    updateButtons();
  };
  session.on('lines', redraw);
  session.on('changed', updateButtons);
  session.on('outline', ({ outline, moving }) => {
    nodes = EDGES.flatMap((edge) => outline.edges[edge].flatMap((_, node, { length }) =>
      (edge > 1 && (node === 0 || node === length - 1) ? [] : [{ edge, node }])));
    // The visible part does not change during a drag.
    if (!moving) handles.showWithin(outline.corners.map(({ x, y }) => [x, y]));
    redraw();
  });
  updateButtons();
}

/** The middle of the longest segment between two neighbouring nodes of an edge. @param {PageSession} session @param {Edge} edge @returns {[number, number]} */
function longestSegmentMiddle({ outline }, edge) {
  const nodes = outline.edges[edge];
  const lengths = nodes.slice(1).map((node, i) => Math.hypot(node.x - nodes[i].x, node.y - nodes[i].y));
  const i = lengths.indexOf(Math.max(...lengths));
  return [(nodes[i].x + nodes[i + 1].x) / 2, (nodes[i].y + nodes[i + 1].y) / 2];
}
