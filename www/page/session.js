/** The state of “Flatten a photo of a page” without its elements: a photo, the outline of the page in it, and the options. */
import { Events } from '../events.js';
import { PageFlattener } from './flatten.js';
import { findGutter } from './gutter.js';
import { rescalePixel } from './grey.js';
import { flatPixelAt, textLineBetween } from './text-lines.js';
import { EDGE_NAMES, EDGES, Outline } from './outline.js';
import { snapOutline, traceEdge } from './edge-snapping.js';

/** @import {Api} from '../api.js' */
/** @typedef {import('../../pkg/types.js').DewarpedPage} DewarpedPage */
/** @import {Line, Options, Traces, FlattenRequest} from './flatten.js' */
/** @import {Ends} from './text-lines.js' */
/** @import {PagePhoto} from './photo.js' */
/** @import {Edge, Point, NodeIndex} from './outline.js' */

/**
 * @typedef {object} PageEvents
 * @property {PagePhoto} photo another photo is shown
 * @property {{ outline: Outline, traces: Traces, moving: boolean }} outline the outline has changed; `moving`: something is being dragged
 * @property {boolean} working whether a flat page is being computed, or another photo is being opened
 * @property {{ flat: DewarpedPage, moving: boolean }} flat a new flat page of the reduced photo; `moving`: something is being dragged
 * @property {null} unfound no page was detected: the user has to put the corners onto it first
 * @property {null} lines the drawn or the detected lines of text have changed
 * @property {unknown} problem error that prevents a flat page
 */
/** @typedef {{ ends: Ends, points: Line }} DrawnLine */
/** @typedef {{ outline: Outline, drawnLines: DrawnLine[], movedCorners: ReadonlySet<number>, pageIndex: number }} Snapshot */
/** @typedef {Snapshot & { quarters: number, traces: Traces, textLines: Line[][] }} PageState the outline and lines of a photo, without its pixels; what a browser has kept of it is data without methods */

/** Minimum length of a line of text, in widths of the photo; shorter ones are discarded. */
const MIN_TEXT_LINE_WIDTHS = 0.02;
/** Maximum distance of a corner outside the photo, in diagonals of the photo: less than what the package accepts. */
const MAX_CORNER_OUTSIDE_DIAGONALS = 0.045;
/** Minimum share of an edge's length with a visible gradient; below it the edge is called weak. */
const MIN_VISIBLE_SHARE = 0.5;

/** @extends {Events<PageEvents>} */
export class PageSession extends Events {
  /** @type {PagePhoto | null} */
  photo = null;
  /** @type {Outline} */
  outline = Outline.defaultFor({ width: 1, height: 1 });
  /** Index of the detected page that is flattened. */
  pageIndex = 0;
  /** Indices of the corners that were moved by hand. @type {ReadonlySet<number>} */
  movedCorners = new Set();
  /** Names of the edges that the photo hardly shows. @type {string[]} */
  weakEdges = [];
  /** Whether edges snap to the gradients of the photo. */
  snapsToEdges = true;
  /** Whether lines of text are detected. */
  findsTextLines = true;
  /** Lines of text drawn by hand. @type {DrawnLine[]} */
  drawnLines = [];
  /** Detected lines of text. @type {Line[]} */
  foundLines = [];
  /** @type {Options} */
  options = {};

  /** Number of clockwise quarter turns of the flat page. */
  quarters = 0;

  #flattening;
  /** The newest flat page. @type {DewarpedPage | null} */
  #flat = null;
  /** @type {FlattenRequest | null} */
  #latestRequest = null;
  /** Snapshots from before each change, for undo. @type {Snapshot[]} */
  #history = [];
  /** Whether a drag is under way, whose snapshot was saved already. */
  #dragging = false;

  /** @param {Api} api */
  constructor(api) {
    super();
    this.worker = new api.DevelopableWorker();
    this.#flattening = new PageFlattener(this.worker);
  }

  /** Whether no page was detected and no corner was moved by hand yet. */
  get isPageMissing() {
    return this.photo?.outlines.verdict === 'notFound' && this.movedCorners.size === 0;
  }

  /** Whether there is a change to undo. */
  get canUndo() {
    return this.#history.length > 0;
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
    this.photo = photo;
    [this.drawnLines, this.foundLines, this.#flat, this.#history] = [[], [], null, []];
    [this.pageIndex, this.#dragging, this.quarters] = [0, false, 0];
    this.#resetOutline(photo, pages);
    if (state) {
      const { outline, drawnLines, movedCorners, pageIndex, quarters } = state;
      Object.assign(this, { outline: Outline.copyOf(outline), drawnLines: [...drawnLines], movedCorners, pageIndex, quarters });
    }
    this.emit('photo', photo);
    this.#update();
  }

  /** Announces that another photo is being opened: the flat page shown is no longer the one that is wanted. */
  beginOpening() {
    this.emit('working', true);
  }

  /** Announces that no other photo was opened after all. */
  endOpening() {
    this.emit('working', false);
  }

  /** Selects another detected page. @param {number} page its index */
  choosePage(page) {
    if (!this.photo?.outlines.pages[page]) return;
    this.#saveSnapshot();
    this.pageIndex = page;
    this.#resetOutline(this.photo, 1);
    this.#update();
  }

  /** Discards all changes to outline and lines. */
  reset() {
    if (!this.photo) return;
    this.#history = [];
    this.drawnLines = [];
    this.#resetOutline(this.photo, this.outline.pages);
    this.#update();
  }

  /** Sets the outline to the detected or the default one. @param {PagePhoto} photo @param {number} pages */
  #resetOutline(photo, pages) {
    const found = photo.outlines.verdict === 'notFound' ? undefined : photo.outlines.pages[this.pageIndex];
    this.outline = found ? Outline.fromDetected(found) : Outline.defaultFor(photo);
    this.movedCorners = new Set();
    if (pages === 2) this.#splitAtGutter(photo);
  }

  /** Saves a snapshot for undo. */
  #saveSnapshot() {
    this.#dragging = false;
    const { outline, drawnLines, movedCorners, pageIndex } = this;
    this.#history.push({ outline: outline.copy(), drawnLines: [...drawnLines], movedCorners, pageIndex });
  }

  /** The state to restore when the photo is shown again; null without an outline. @returns {PageState | null} */
  state() {
    const { outline, drawnLines, movedCorners, pageIndex, quarters } = this;
    const request = this.isPageMissing ? null : this.request();
    return request && { outline: outline.copy(), drawnLines: [...drawnLines], movedCorners, pageIndex, quarters, traces: request.traces, textLines: request.textLines };
  }

  /** Undoes the last change of outline or lines. */
  undo() {
    const before = this.#history.pop();
    if (!before) return;
    Object.assign(this, before);
    this.#dragging = false;
    this.#update();
  }

  /** Divides the page into two at its gutter. */
  addGutter() {
    if (!this.photo) return;
    this.#saveSnapshot();
    this.#splitAtGutter(this.photo);
    this.#update();
  }

  /** @param {PagePhoto} photo */
  #splitAtGutter({ grey }) {
    this.outline = this.outline.withGutter(findGutter(this.outline, this.snapsToEdges ? grey : null));
    if (this.snapsToEdges) snapOutline(grey, this.outline);
  }

  /** Joins two pages into one. */
  removeGutter() {
    this.#saveSnapshot();
    this.outline = this.outline.withoutGutter();
    this.#snapAndUpdate();
  }

  /** Turns the flat page clockwise by a quarter turn. */
  turn() {
    this.quarters = (this.quarters + 1) % 4;
    if (this.#flat) this.emit('flat', { flat: this.#flat, moving: false });
  }

  /** Sets whether edges snap to the gradients of the photo. @param {boolean} snapping */
  setSnapsToEdges(snapping) {
    this.snapsToEdges = snapping;
    this.#snapAndUpdate();
  }

  /** Sets the options of flattening. @param {Options} options */
  setOptions(options) {
    this.options = options;
    this.#update();
  }

  /**
   * Moves a node.
   * @param {NodeIndex} index
   * @param {readonly [number, number]} to
   * @param {{ pinned: boolean, ended: boolean }} how `pinned`: snapping leaves the node there; `ended`: the drag has ended
   */
  move(index, [x, y], { pinned, ended }) {
    const { photo, outline } = this;
    const node = outline.nodeOf(index);
    if (!photo || !node) return;
    if (!this.#dragging) this.#saveSnapshot();
    this.#dragging = !ended;
    const outside = MAX_CORNER_OUTSIDE_DIAGONALS * Math.hypot(photo.width, photo.height);
    const within = (/** @type {number} */ at, /** @type {number} */ side) => Math.min(Math.max(at, -outside), side + outside);
    outline.move(index, [within(x, photo.width), within(y, photo.height)]);
    node.pinned = pinned || !this.snapsToEdges;
    const corner = outline.corners.indexOf(node);
    if (corner >= 0) this.movedCorners = new Set([...this.movedCorners, corner]);
    if (ended && this.snapsToEdges && !node.pinned) snapOutline(photo.grey, outline);
    this.#update(!ended);
  }

  /** Sets whether lines of text are detected. @param {boolean} finding */
  setFindsTextLines(finding) {
    this.findsTextLines = finding;
    this.#update();
  }

  /**
   * Draws a line of text, or changes a drawn one.
   * @param {Ends} ends
   * @param {{ line?: number, ended: boolean }} how `line`: its index, a new line by default; `ended`: the drag has ended
   * @returns the index of the line
   */
  drawLine(ends, { line = this.drawnLines.length, ended }) {
    if (!this.photo) return line;
    if (!this.#dragging) this.#saveSnapshot();
    this.#dragging = !ended;
    const { photo: { grey, width, height }, snapsToEdges } = this;
    const within = ends.map(([x, y]) => [Math.min(Math.max(x, 0), width - 1), Math.min(Math.max(y, 0), height - 1)]);
    const [from, to] = /** @type {Ends} */ (within);
    this.drawnLines[line] = { ends: [from, to], points: textLineBetween(grey, [from, to], this.#flat, snapsToEdges && ended) };
    if (ended && Math.hypot(to[0] - from[0], to[1] - from[1]) < MIN_TEXT_LINE_WIDTHS * width) this.drawnLines.splice(line, 1);
    this.emit('lines', null);
    if (ended) this.#update();
    return line;
  }

  /** Removes a drawn line of text. @param {number} line its index */
  removeLine(line) {
    this.#saveSnapshot();
    this.drawnLines.splice(line, 1);
    this.emit('lines', null);
    this.#update();
  }

  /** The index of the page that a line of text is on. @param {Ends} ends */
  #pageOfLine([from, to]) {
    const { pages } = this.outline;
    const flat = this.#flat;
    const middle = /** @type {Point} */ ([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2]);
    const place = flat && this.photo && flatPixelAt(flat, middle, this.photo.grey.scale);
    if (pages === 1 || !place) return 0;
    return Math.min(pages - 1, Math.floor((place[0] / flat.width) * pages));
  }

  /**
   * Adds a node to an edge.
   * @param {Edge} edge
   * @param {[number, number]} place
   * @param {boolean} [pulled] whether the new node is being dragged already
   */
  add(edge, place, pulled = false) {
    this.#saveSnapshot();
    this.#dragging = pulled;
    const index = this.outline.add(edge, place);
    this.#update();
    return index;
  }

  /** Removes a node. @param {NodeIndex} index */
  remove(index) {
    this.#saveSnapshot();
    this.outline.remove(index);
    this.#update();
  }

  /** The request to flatten the photo; null without a photo. @param {boolean} [moving] whether something is being dragged @returns {FlattenRequest | null} */
  request(moving = false) {
    const { photo, options, findsTextLines, drawnLines } = this;
    if (!photo) return null;
    /** @type {Line[][]} */
    const textLines = Array.from({ length: this.outline.pages }, () => []);
    for (const { ends, points } of drawnLines) {
      if (Math.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]) >= MIN_TEXT_LINE_WIDTHS * photo.width) textLines[this.#pageOfLine(ends)].push(points);
    }
    return { photo, traces: this.#traces(photo), textLines, options: { ...options, findLines: findsTextLines }, moving };
  }

  /** Shows a flat page and its detected lines of text. @param {DewarpedPage} flat @param {FlattenRequest} request */
  #showFlat(flat, { photo, moving }) {
    this.#flat = flat;
    // While something is dragged, no lines are detected and the earlier ones stay.
    if (!moving) {
      const toPhoto = (/** @type {number} */ at) => rescalePixel(at, 1 / photo.grey.scale);
      this.foundLines = flat.lines.flat().map((line) => line.map(([x, y]) => [toPhoto(x), toPhoto(y)]));
    }
    this.emit('flat', { flat, moving });
  }

  /** Snaps the outline if that is on, and updates the flat page. */
  #snapAndUpdate() {
    if (this.photo && this.snapsToEdges) snapOutline(this.photo.grey, this.outline);
    this.#update();
  }

  /** Announces the changed outline and requests a new flat page. @param {boolean} [moving] whether something is being dragged */
  #update(moving = false) {
    const request = this.request(moving);
    if (!request) return;
    this.#latestRequest = request;
    this.emit('outline', { outline: this.outline, traces: request.traces, moving });
    if (this.isPageMissing) {
      [this.foundLines, this.#flat] = [[], null];
      this.emit('unfound', null);
      this.emit('lines', null);
      this.emit('working', false);
      return;
    }
    this.emit('working', true);
    void this.#flattening.preview(request, (done) => {
      if (done.request.photo !== this.photo || this.isPageMissing) return;
      // While nothing is dragged, only the flat page of the newest outline and options is shown.
      if (done.request !== this.#latestRequest && !done.request.moving) return;
      if ('flat' in done) this.#showFlat(done.flat, done.request);
      else {
        [this.foundLines, this.#flat] = [[], null];
        this.emit('problem', done.error);
      }
      this.emit('lines', null);
      if (done.request === this.#latestRequest) this.emit('working', false);
    });
  }

  /**
   * The points of each edge: the detected edge, else the traced one, else the nodes themselves.
   * @param {PagePhoto} photo
   * @returns {Traces}
   */
  #traces({ grey }) {
    const { outline } = this;
    this.weakEdges = [];
    // Without a detected page the edges are not traced.
    if (this.isPageMissing) return /** @type {Traces} */ (EDGES.map((edge) => outline.spans(edge).map((nodes) => nodes.map(({ x, y }) => /** @type {Point} */ ([x, y])))));
    return /** @type {Traces} */ (EDGES.map((edge) => {
      const traces = outline.spans(edge).map((nodes) => ({ nodes, ...traceEdge(grey, nodes) }));
      if (traces.some(({ visibleShare }) => visibleShare < MIN_VISIBLE_SHARE)) this.weakEdges.push(EDGE_NAMES[edge]);
      const found = outline.detectedEdges[edge];
      if (found) return [found];
      return traces.map(({ nodes, points, visibleShare }) => (this.snapsToEdges && visibleShare >= MIN_VISIBLE_SHARE ? points : nodes.map(({ x, y }) => /** @type {Point} */ ([x, y]))));
    }));
  }
}
