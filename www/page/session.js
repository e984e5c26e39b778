/** The state of “Flatten a photo of a page” without its elements: a photo, the outline of the page in it, and the options. */
import { Events } from '../events.js';
import { flattenReducedPhoto, rescaleLine, tracedEdges } from './flatten.js';
import { firstKnown, optionsOf } from './known.js';
import { findGutter } from './gutter.js';
import { EDGE_NAMES, EDGES, Outline } from './outline.js';

/** @import {Line, Traces, FlattenRequest} from './flatten.js' */
/** @import {Known} from './known.js' */
/** @import {Edge, NodeIndex} from './outline.js' */

/**
 * @typedef {object} PageEvents
 * @property {PagePhoto} photo another photo is shown
 * @property {{ outline: Outline, moving: boolean }} outline the outline has changed; `moving`: something is being dragged
 * @property {number} progress share of the present flattening that is done; 0 when one begins
 * @property {boolean} working whether a flat page is being computed, or another photo is being opened
 * @property {{ flat: DewarpedPage, moving: boolean }} flat a new flat page of the reduced photo; `moving`: something is being dragged
 * @property {null} unfound no page was detected, and not all corners were put onto it by hand yet
 * @property {null} changed the outline, what is known of the page or its turn has changed
 * @property {null} lines the traced edges or the detected lines of text have changed
 * @property {unknown} problem error that prevents a flat page
 */
/** @typedef {{ outline: Outline, movedCorners: ReadonlySet<number>, pageIndex: number, quarters: number, known?: Known, traces: Traces | null }} PageState the outline of the page in a photo, without its pixels; what a browser has kept of it is data without methods. `traces`: null as long as the page is not found */

/** Maximum distance of a corner outside the photo, in diagonals of the photo: less than what the package accepts. */
const MAX_CORNER_OUTSIDE_DIAGONALS = 0.045;

/** @extends {Events<PageEvents>} */
export class PageSession extends Events {
  /** @type {PagePhoto | null} */
  photo = null;
  /** @type {Outline} */
  outline = Outline.inside({ width: 1, height: 1 });
  /** Index of the detected page that is flattened. */
  pageIndex = 0;
  /** Indices of the corners that were moved by hand. @type {ReadonlySet<number>} */
  movedCorners = new Set();
  /** The edges as they are known: traced in the photo, detected, or through the nodes that were set by hand. @type {Traces} */
  traces = [[], [], [], []];
  /** Detected lines of text. @type {Line[]} */
  foundLines = [];
  /** What is known of the page. @type {Known} */
  known = firstKnown();

  /** Whether the outline may differ from the detected one. */
  isOutlineChanged = false;

  /** Number of clockwise quarter turns of the flat page. */
  quarters = 0;

  #isFlattening = false;
  /** Whether another photo is being opened. */
  isOpening = false;
  /** The newest flat page. @type {DewarpedPage | null} */
  #flat = null;
  /** The newest request; null if no page is to be flattened. @type {FlattenRequest | null} */
  #latestRequest = null;

  /** @param {Api} api */
  constructor(api) {
    super();
    this.worker = new api.DevelopableWorker();
  }

  /** Number of corners that have to be put onto the page by hand, since it was not detected. */
  get unplacedCorners() {
    return this.photo?.outlines.verdict === 'notFound' ? 4 - this.movedCorners.size : 0;
  }

  /** Names of the edges that the photo hardly shows: those that could not be traced. */
  get weakEdges() {
    return EDGES.filter((edge) => this.traces[edge].some((line) => line.length === 2)).map((edge) => EDGE_NAMES[edge]);
  }

  /** Names of the corners outside the photo. */
  get outsideCorners() {
    const { photo, outline } = this;
    if (!photo) return [];
    const names = ['upper left', 'upper right', 'lower right', 'lower left'];
    return names.filter((_, i) => {
      const { x, y } = outline.corners[i];
      return x < -0.5 || y < -0.5 || x > photo.width - 0.5 || y > photo.height - 0.5;
    });
  }

  /**
   * Shows another photo.
   * @param {PagePhoto} photo
   * @param {number} [pages] number of pages in the photo
   * @param {PageState | null} [state] earlier state of the photo, which is restored
   */
  show(photo, pages = 1, state = null) {
    [this.photo, this.isOpening] = [photo, false];
    [this.foundLines, this.#flat, this.pageIndex, this.quarters, this.known] = [[], null, 0, 0, firstKnown()];
    this.#resetOutline(photo, pages);
    if (state) this.#setState(state);
    this.emit('photo', photo);
    this.#update();
  }

  /** Restores an earlier state of the photo. @param {PageState} state */
  restore(state) {
    this.#setState(state);
    this.#update();
  }

  /** @param {PageState} state */
  #setState({ outline, movedCorners, pageIndex, quarters, known = firstKnown() }) {
    Object.assign(this, { outline: Outline.copyOf(outline), movedCorners, pageIndex, quarters, known, isOutlineChanged: movedCorners.size > 0 });
  }

  /** Announces that another photo is being opened, so that the flat page is no longer the one that is wanted; or that none was opened after all. @param {boolean} isOpening */
  setOpening(isOpening) {
    this.isOpening = isOpening;
    this.emit('working', isOpening || (this.#isFlattening && this.#latestRequest !== null));
  }

  /** Goes back to the detected outline, or to that of another detected page. @param {number} [page] its index @param {number} [pages] number of pages within it */
  reset(page = this.pageIndex, pages = this.outline.pages) {
    if (!this.photo) return;
    this.pageIndex = page;
    this.#resetOutline(this.photo, pages);
    this.#update();
  }

  /** Takes the whole photo for the page, as of a flatbed scan. */
  takeWhole() {
    if (this.photo) this.restore({ ...this.state(), outline: Outline.inside(this.photo, 0), movedCorners: new Set(EDGES) });
  }

  /** Sets the outline to the detected or the default one. @param {PagePhoto} photo @param {number} pages */
  #resetOutline(photo, pages) {
    const found = photo.outlines.verdict === 'notFound' ? undefined : photo.outlines.pages[this.pageIndex];
    this.outline = found ? Outline.fromDetected(found) : Outline.inside(photo);
    [this.movedCorners, this.isOutlineChanged] = [new Set(), false];
    this.traces = this.#outlineTraces();
    if (pages === 2) this.#splitAtGutter();
  }

  /** The state to restore when the photo is shown again. @returns {PageState} */
  state() {
    const { outline, movedCorners, pageIndex, quarters, known } = this;
    return { outline: Outline.copyOf(outline), movedCorners, pageIndex, quarters, known, traces: this.unplacedCorners > 0 ? null : this.#outlineTraces() };
  }

  /** Divides the page into two at its gutter. */
  addGutter() {
    if (!this.photo) return;
    this.#splitAtGutter();
    this.#update();
  }

  #splitAtGutter() {
    const [[upper], [lower]] = this.traces;
    this.outline = this.outline.withGutter(findGutter([upper, lower]));
  }

  /** Joins two pages into one. */
  removeGutter() {
    this.outline = this.outline.withoutGutter();
    this.#update();
  }

  /** Turns the flat page clockwise by a quarter turn. */
  turn() {
    this.quarters = (this.quarters + 1) % 4;
    this.emit('changed', null);
    if (this.#flat) this.emit('flat', { flat: this.#flat, moving: false });
  }

  /** The options of flattening. */
  get options() {
    return optionsOf(this.known);
  }

  /** Sets what is known of the page. @param {Known} known */
  setKnown(known) {
    this.known = known;
    this.#update();
  }

  /** Moves a node. @param {NodeIndex} index @param {readonly [number, number]} to @param {boolean} ended whether the drag has ended */
  move(index, [x, y], ended) {
    const { photo, outline } = this;
    const node = outline.nodeOf(index);
    if (!photo || !node) return;
    const outside = MAX_CORNER_OUTSIDE_DIAGONALS * Math.hypot(photo.width, photo.height);
    const within = (/** @type {number} */ at, /** @type {number} */ side) => Math.min(Math.max(at, -outside), side + outside);
    outline.move(index, [within(x, photo.width), within(y, photo.height)]);
    const corner = outline.corners.indexOf(node);
    if (corner >= 0) this.movedCorners = new Set([...this.movedCorners, corner]);
    this.isOutlineChanged = true;
    this.#update(!ended);
  }

  /** Adds a node to an edge. @param {Edge} edge @param {[number, number]} place @param {boolean} [pulled] whether the new node is being dragged already */
  add(edge, place, pulled = false) {
    const [line, ...others] = this.traces[edge];
    const index = this.outline.add(edge, place, others.length === 0 ? line : []);
    this.isOutlineChanged = true;
    this.#update(pulled);
    return index;
  }

  /** Removes a node. @param {NodeIndex} index */
  remove(index) {
    this.outline.remove(index);
    this.isOutlineChanged = true;
    this.#update();
  }

  /** The request to flatten the photo; null without a photo. @param {boolean} [moving] whether something is being dragged @returns {FlattenRequest | null} */
  request(moving = false) {
    const { photo, options, movedCorners } = this;
    return photo && { photo, traces: this.#outlineTraces(), options, isDetected: movedCorners.size === 0, moving };
  }

  /** Shows a flat page and its detected lines of text. @param {DewarpedPage} flat @param {FlattenRequest} request */
  #showFlat(flat, { photo, traces, moving }) {
    this.#flat = flat;
    // While something is dragged, no lines are detected and the earlier ones stay.
    if (!moving) {
      this.traces = tracedEdges(flat, traces, photo.scale);
      this.foundLines = flat.lines.flat().map((line) => rescaleLine(line, 1 / photo.scale));
    }
    this.emit('flat', { flat, moving });
  }

  /** Announces the changed outline and requests a new flat page. @param {boolean} [moving] whether something is being dragged */
  #update(moving = false) {
    const request = this.request(moving);
    if (!request) return;
    this.#latestRequest = this.unplacedCorners > 0 ? null : request;
    this.traces = request.traces;
    this.emit('outline', { outline: this.outline, moving });
    if (!moving) this.emit('changed', null);
    if (!this.#latestRequest) {
      [this.foundLines, this.#flat] = [[], null];
      this.emit('unfound', null);
      this.emit('lines', null);
      this.emit('working', this.isOpening);
      return;
    }
    this.emit('working', true);
    // While something is dragged, each flattening is short.
    if (!moving) this.emit('progress', 0);
    if (!this.#isFlattening) void this.#flattenNewest();
  }

  /** Flattens the newest request until there is no newer one; those in between are left out. */
  async #flattenNewest() {
    this.#isFlattening = true;
    for (let done = null; this.#latestRequest && this.#latestRequest !== done;) {
      const request = (done = this.#latestRequest);
      const isNewest = () => request === this.#latestRequest;
      try {
        const flat = await flattenReducedPhoto(this.worker, request, (fraction) => this.emit('progress', fraction));
        // While nothing is dragged, only the flat page of the newest outline and options is shown.
        if (request.photo !== this.photo || !this.#latestRequest || !(isNewest() || request.moving)) continue;
        this.#showFlat(flat, request);
      } catch (error) {
        if (!isNewest()) continue;
        [this.foundLines, this.#flat] = [[], null];
        this.emit('problem', error);
      }
      this.emit('lines', null);
      if (isNewest()) this.emit('working', this.isOpening);
    }
    this.#isFlattening = false;
  }

  /** The lines of the outline, before they are traced. @returns {Traces} */
  #outlineTraces() {
    return /** @type {Traces} */ (EDGES.map((edge) => this.outline.lines(edge)));
  }
}
