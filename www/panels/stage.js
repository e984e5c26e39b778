/**
 * The stage: input and result in space on both sides of a divider, or a flat picture in their place; the choice of a view, what is
 * said of it, and what to do with the result. Heights and whole meshes are subjects that it shows in the same way.
 */
import { download, element, elements, make, makeButton, oncePerFrame } from '../dom.js';
import { choiceOf } from '../fields.js';
import { SAVE_WORDS, VIEW_LABELS, VIEW_WORDS } from '../messages.js';
import { PictureView } from '../surface/picture-view.js';
import { SceneView } from '../surface/scene.js';
import { colourBar, pictureWithColours } from '../views/legend.js';
import { dividerOver } from './divider.js';
import { showError } from './notice.js';
import { waitingPanel } from './waiting.js';

/** @import {Layer} from '../surface/layer.js' */
/** @import {Box, Look, Place, Surface} from '../surface/scene.js' */

/**
 * @typedef {object} Subject what the stage shows
 * @property {boolean} isWhole whether it is a whole mesh
 * @property {() => string} name of the input
 * @property {() => string} caption of the input
 * @property {() => Look} look how its surfaces look, and from where
 * @property {() => Box | null} box that its surfaces fill; null without an input
 * @property {(side: 0 | 1, isFast: boolean) => Surface | null} surface of the input or the result
 * @property {() => boolean} isSolved whether there is a result
 * @property {() => boolean} isDivided whether there is anything to show beside the input
 * @property {() => string} resultCaption caption of the result
 * @property {() => '' | 'preview' | 'cancelled'} mark how the result falls short: views say nothing about a preview
 * @property {Record<string, View | undefined>} views prepare the views
 * @property {(view: string) => boolean} offers whether a view can be chosen
 * @property {(place: Place, value?: string) => string} read what is under the pointer, with the view's value there
 * @property {() => void} stop cancels the view that is being prepared
 * @property {() => void} run solves the input
 * @property {() => void} cancel cancels the solve
 * @property {() => Promise<void>} saveFile offers the result as a 3D file
 * @property {() => Promise<void>} cutSheets offers the result as sheets
 */
/** @typedef {(tell: Tell) => Promise<ViewContent>} View */
/** @typedef {ReturnType<typeof stagePanel>} Stage */

/** Pixels of a saved picture per pixel of the screen. */
const SAVED_RATIO = 2;

/** @param {Subject} first */
export function stagePanel(first) {
  const side = element('heights-side', HTMLElement);
  const stage = element('stage', HTMLElement);
  const canvas = element('space-canvas', HTMLCanvasElement);
  const flat = new PictureView(element('result-picture', HTMLCanvasElement));
  const reading = element('reading', HTMLElement);
  const panel = element('analysis', HTMLElement);
  const about = element('about-view', HTMLElement);
  const description = element('view-says', HTMLElement);
  const save = element('view-save', HTMLButtonElement);
  const report = element('whole-report', HTMLElement);
  const mark = element('result-mark', HTMLElement);
  const picture = element('picture', HTMLElement);
  const ends = ['file', 'sheets'].map((name) => element(`end-${name}`, HTMLButtonElement));
  let subject = first;
  /** Null until it is created with the first input, and without WebGL. @type {SceneView | null} */
  let view = null;
  let isCreated = false;
  /** Whether the scene could not be created. */
  let isMissing = false;
  /** Whether the input turns slowly at first. */
  let turnsAtFirst = false;
  /** @type {Partial<ViewContent>} */
  let shown = {};
  /** The surfaces of the subject. @type {(Surface | null)[]} */
  const plain = [null, null];
  /** What is drawn on each side: a surface of the subject, and what the view makes of it. @type {({ from: Surface | null, by: Layer['surface'] } | undefined)[]} */
  let drawn = [];
  /** Number of the newest update; answers to older ones are discarded. */
  let newestUpdate = 0;
  /** The verdict and its details, by the subject that they are about. @type {Map<Subject, [string, string]>} */
  const said = new Map();

  const divider = dividerOver('divider', ['input', 'result'], (share) => view?.divide(share));
  const choice = choiceOf('view', VIEW_LABELS, () => restart());
  const chosen = () => choice.value;
  /** The choices of views that a model seldom needs: they are folded beside it. */
  const researchViews = elements(['gaussian', 'kappa2', 'rulings'].map((value) => `#view-choice label:has([value=${value}])`).join(), HTMLLabelElement);

  /** Whether the scene was asked for from above before it was there. */
  let startsFromAbove = false;
  /** Creates the scene with the first input, and shows in it what there is by then. */
  const createView = async () => {
    isCreated = true;
    view = await SceneView.create(canvas).catch(() => null);
    isMissing = view === null;
    showFirst();
  };
  /** Shows the subject from its first direction. */
  const showFirst = () => {
    view?.setLook(subject.look());
    renew();
    if (!view) return;
    if (startsFromAbove) view.lookDown();
    else {
      view.look();
      if (turnsAtFirst) view.turnOnce();
    }
    startsFromAbove = false;
  };
  /** Shows the surfaces, or the picture in their place, and what can be done with them. */
  const arrange = () => {
    element('input-caption', HTMLElement).textContent = subject.caption();
    element('result-caption', HTMLElement).textContent = subject.resultCaption();
    mark.textContent = subject.mark();
    mark.hidden = !mark.textContent;
    report.hidden = !subject.isWhole || !subject.isSolved();
    element('quarter-turn', HTMLButtonElement).hidden = !subject.isWhole;
    const isFlat = shown.flat !== undefined;
    element('space-missing', HTMLElement).hidden = !isMissing || isFlat;
    canvas.hidden = isMissing || isFlat;
    element('picture-hint', HTMLElement).hidden = !isFlat;
    for (const tools of elements('#space-hint, .space-tools', HTMLElement)) tools.hidden = isFlat;
    const isDivided = subject.isDivided() && !isFlat;
    divider.show(isDivided && !isMissing);
    element('space-before', HTMLElement).hidden = isFlat;
    element('space-after', HTMLElement).hidden = !isDivided;
    save.disabled = !subject.isSolved() || (view === null && !isFlat);
    for (const button of ends) button.disabled = !subject.isSolved();
    choice.offer(subject.offers);
  };
  /** The view's layer on a side; where the result is the input, what is found in it is shown there. @param {0 | 1} at */
  const layerOn = (at) => {
    if (at === 1 && subject.mark() === 'preview') return undefined;
    return subject.isDivided() ? shown.layers?.[at] : at === 0 ? shown.layers?.[1] ?? shown.layers?.[0] : undefined;
  };
  /** Draws what the view lays over the surfaces, or shows in their place. */
  const updateLayers = () => {
    for (const at of /** @type {const} */ ([0, 1])) {
      const layer = layerOn(at);
      const [from, by] = [plain[at], layer?.surface];
      if (drawn[at]?.from !== from || drawn[at]?.by !== by) {
        drawn[at] = { from, by };
        view?.setSurface(at, from && by ? by(from) : from);
      }
      view?.setLines(at, layer?.lines ?? []);
    }
    view?.divide(divider.share);
    arrange();
  };
  /** Draws surfaces of the subject anew; the view's direction stays. @param {readonly (0 | 1)[]} [sides] both, and their box, unless said otherwise */
  const renew = (sides) => {
    const box = subject.box();
    if (!isCreated && box) void createView();
    if (view && box) {
      if (!sides) {
        view.setBox(box);
        drawn = [];
      }
      for (const at of sides ?? /** @type {const} */ ([0, 1])) plain[at] = subject.surface(at, view.isFast);
    }
    updateLayers();
    if (!subject.offers(chosen())) choose('shaded');
  };

  /** Whether a whole mesh is being solved, and a view prepared. */
  const busy = { isSolving: false, isPreparing: false };
  /** @param {Partial<typeof busy>} change */
  const setBusy = (change) => {
    Object.assign(busy, change);
    stage.dataset.busy = String(busy.isSolving || busy.isPreparing);
    // Not on the stage: what is said in its live regions would wait.
    for (const one of [picture, panel]) one.ariaBusy = stage.dataset.busy;
  };
  /** @param {Partial<ViewContent>} content */
  const display = (content) => {
    shown = content;
    flat.show(content.flat ?? null);
    reading.textContent = '';
    about.replaceChildren(...(content.said ? [make('p', 'said', content.said)] : []), ...(content.colours ? [colourBar(content.colours)] : []), ...(content.about ?? []));
    panel.dataset.view = chosen();
    panel.hidden = about.childElementCount === 0;
    updateLayers();
  };
  const update = async () => {
    const turn = ++newestUpdate;
    const name = chosen();
    const prepare = subject.views[name];
    waiting.end();
    display(prepare && !subject.isSolved() && name !== 'shaded' ? { about: [make('p', 'muted', 'Appears when a run has ended.')] } : {});
    description.textContent = subject.isSolved() && (name !== 'shaded' || subject.isDivided()) ? VIEW_WORDS[name] : '';
    const isPreparing = prepare !== undefined && subject.isSolved();
    setBusy({ isPreparing });
    if (!isPreparing) return;
    description.textContent = '';
    waiting.begin('view');
    try {
      const content = await prepare(waiting.tell);
      if (turn !== newestUpdate) return;
      display(content);
      description.textContent = name !== 'shaded' || subject.isDivided() ? VIEW_WORDS[name] : '';
    } catch (error) {
      if (turn !== newestUpdate) return;
      showError('This view could not be worked out', error);
    }
    waiting.end();
    setBusy({ isPreparing: false });
  };
  const waiting = waitingPanel(element('waiting', HTMLElement), () => {
    newestUpdate++;
    subject.stop();
    waiting.end();
    setBusy({ isPreparing: false });
    const again = makeButton('', update, 'Try again');
    display({ about: [make('p', 'muted', 'Cancelled.'), again] });
    again.focus();
  });
  /** Cancels the view of the last result, and prepares the present one. */
  const restart = () => {
    subject.stop();
    void update();
  };
  /** Shows a view. @param {string} name */
  const choose = (name) => {
    choice.set(subject.offers(name) ? name : 'shaded');
    restart();
  };

  /** Newest place of the pointer. */
  let pointer = { offsetX: 0, offsetY: 0 };
  const readSoon = oncePerFrame(() => {
    const place = view?.pick(pointer);
    reading.textContent = place ? subject.read(place, layerOn(place.after ? 1 : 0)?.read?.(place)) : '';
  });
  canvas.addEventListener('pointermove', ({ offsetX, offsetY, buttons }) => {
    pointer = { offsetX, offsetY };
    // No value is shown while the surface is turned.
    if (buttons === 0) readSoon();
  });
  flat.canvas.addEventListener('pointermove', (event) => (reading.textContent = flat.read(event)));
  for (const one of [canvas, flat.canvas]) one.addEventListener('pointerleave', () => (reading.textContent = ''));

  element('from-above', HTMLButtonElement).addEventListener('click', () => (view ? view.lookDown() : (startsFromAbove = true)));
  element('at-an-angle', HTMLButtonElement).addEventListener('click', () => {
    startsFromAbove = false;
    view?.look();
  });
  save.addEventListener('click', async () => {
    const isFlat = shown.flat !== undefined;
    if (!isFlat) view?.draw(SAVED_RATIO * devicePixelRatio);
    const coloured = pictureWithColours(isFlat ? flat.canvas : canvas, shown.colours);
    view?.drawSoon();
    download(await coloured.convertToBlob({ type: 'image/png' }), 'image/png', `${subject.name()}-view.png`);
  });
  // The dialogs are fetched when they are opened first.
  for (const [i, offer] of /** @type {const} */ (['saveFile', 'cutSheets']).entries()) ends[i].addEventListener('click', () => subject[offer]().catch((error) => showError(SAVE_WORDS.noDialog, error)));

  const showSaid = () => {
    const [verdict, detail] = said.get(subject) ?? ['', ''];
    element('verdict', HTMLElement).textContent = verdict;
    element('verdict-detail', HTMLElement).textContent = detail;
  };
  arrange();

  return {
    get subject() {
      return subject;
    },
    /** Name of the view. */
    get view() {
      return chosen();
    },
    /** Shows a subject in the place of another one. @param {Subject} next */
    enter(next) {
      if (next === subject) return;
      subject.stop();
      subject = next;
      side.toggleAttribute('data-whole', next.isWhole);
      (next.isWhole ? element('view-others', HTMLElement) : choice.box).append(...researchViews);
      turnsAtFirst = false;
      shown = {};
      // A model is cut out, a scan is saved.
      const [main, other] = next.isWhole ? ends.toReversed() : ends;
      for (const button of ends) button.classList.toggle('primary', button === main);
      main.after(other);
      showFirst();
      showSaid();
      void update();
    },
    /** Draws surfaces of a subject anew, if it is the one that is shown. @param {Subject} of @param {readonly (0 | 1)[]} [sides] */
    renew: (of, sides) => {
      if (of === subject) renew(sides);
    },
    /** Shows a new input of a subject from its first direction. @param {Subject} of @param {boolean} [turns] whether it turns there slowly */
    begin: (of, turns = false) => {
      if (of !== subject) return;
      turnsAtFirst = turns;
      showFirst();
    },
    /** Prepares the view of a subject's result, or of none. @param {Subject} of */
    update: (of) => {
      if (of === subject) restart();
    },
    /** Says what has become of a subject. @param {Subject} of @param {string} verdict @param {string} [detail] */
    say: (of, verdict, detail = '') => {
      said.set(of, [verdict, detail]);
      if (of === subject) showSaid();
    },
    choose,
    /** Tells whether a whole mesh is being solved. @param {boolean} solves */
    setSolving: (solves) => setBusy({ isSolving: solves }),
  };
}
