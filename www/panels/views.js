/** Input and result side by side under one light. */
import { element } from '../dom.js';
import { number, shortest } from '../format.js';
import { inputNormals, resultNormals } from '../surface/known.js';
import { Light } from '../surface/light.js';
import { SurfaceView } from '../surface/view.js';

/** @import {Session} from '../session.js' */

/** @param {Session} session */
export function viewsPanel(session) {
  const light = new Light();
  const before = new SurfaceView(element('input-canvas', HTMLCanvasElement), light);
  const after = new SurfaceView(element('result-canvas', HTMLCanvasElement), light);
  const views = element('views', HTMLElement);
  const figure = element('result-view', HTMLElement);
  const inputCaption = element('input-caption', HTMLElement);
  const caption = element('result-caption', HTMLElement);
  const mark = element('result-mark', HTMLElement);
  const empty = element('result-empty', HTMLElement);

  session.on('input', (input) => {
    const { name, width, height } = input;
    before.show(inputNormals(input));
    views.style.setProperty('--aspect', String(width / height));
    inputCaption.textContent = `${name}, ${number(width, 6)} × ${number(height, 6)}`;
  });
  session.on('cleared', () => {
    after.show(null);
    caption.textContent = '';
    mark.hidden = true;
    empty.hidden = false;
  });
  session.on('result', (result) => {
    after.show(resultNormals(result));
    caption.textContent = `λ = ${shortest(result.settings.lambda)}`;
    mark.textContent = result.surface.report.stopReason === 'cancelled' ? 'cancelled' : '';
    mark.hidden = !mark.textContent;
    empty.hidden = true;
  });
  session.on('phase', (phase) => {
    figure.setAttribute('aria-busy', String(phase === 'running'));
    empty.textContent = phase === 'running' ? 'Solving…' : 'Not solved yet';
  });
}
