/** Shows one part of the page: the first screen, heights and meshes, or photos of pages. */
import { element } from '../dom.js';

/** @typedef {'home' | 'heights' | 'photo'} Mode */

/** The guide to each job. */
const GUIDES = { home: './guide/docs/page.html', photo: './guide/docs/dewarp.html', model: './guide/docs/meshes.html', scan: './guide/docs/scans.html' };

/** @param {Session} session */
export function modePanel(session) {
  const sides = { home: element('home', HTMLElement), heights: element('heights-side', HTMLElement), photo: element('page-side', HTMLElement) };
  /** @type {Mode} */
  let now = 'heights';
  /** Which job the page is set up for. */
  const showJob = () => {
    const job = now === 'heights' ? (session.input?.sampling ? 'model' : 'scan') : now;
    document.body.dataset.job = job;
    element('guide', HTMLAnchorElement).href = GUIDES[job];
  };
  session.on('input', showJob);
  /** Shows a part of the page. @param {Mode} mode */
  const show = (mode) => {
    // From far down the doors to the top of what is behind one.
    if (mode !== now) window.scrollTo(0, 0);
    const hadFocus = sides[now].contains(document.activeElement);
    now = mode;
    for (const [name, side] of Object.entries(sides)) side.hidden = name !== mode;
    if (hadFocus) sides[now].focus({ preventScroll: true });
    showJob();
  };
  return {
    show,
    get now() {
      return now;
    },
  };
}
