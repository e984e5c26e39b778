/** What the photo's side of the page is about, without its elements: a photo, the outline of the page in it, what is known. */
import { Events } from '../events.js';
import { Flattening } from './flatten.js';
import { gutterOf } from './gutter.js';
import { rescaled } from './grey.js';
import { flatPlace, lineBetween } from './lines.js';
import { EDGE_NAMES, EDGES, Outline } from './outline.js';
import { settle, traced } from './snap.js';

/** @import {Api} from '../api.js' */
/** @import {Flat, Line, Options, Traces, Wish} from './flatten.js' */
/** @import {Ends} from './lines.js' */
/** @import {PagePhoto} from './photo.js' */
/** @import {Edge, Point, Which} from './outline.js' */

/**
 * @typedef {object} PageEvents
 * @property {PagePhoto} photo another one
 * @property {{ outline: Outline, traces: Traces, moving: boolean }} outline
 * @property {boolean} working whether a newer flat page is to come
 * @property {Flat & { moving: boolean }} flat of the reduced photo; `moving`: something is being dragged
 * @property {null} unfound there is no outline yet: corners have to be put onto the page first
 * @property {null} lines of text: others are drawn, or found
 * @property {unknown} problem why there is none
 */
/** @typedef {{ ends: Ends, points: Line }} DrawnLine */
/** @typedef {{ outline: Outline, drawn: DrawnLine[], moved: ReadonlySet<number>, chosen: number }} Snapshot */
/** @typedef {Snapshot & { quarters: number, traces: Traces, text: Line[][] }} PageState what was done to a photo's outline, without its pixels */

/** Lines of text that are shorter than this share of the photo are none. */
const SHORT = 0.02;
/** How far a corner may be put beyond the photo's border, as a share of its diagonal: less than the package takes. */
const MAX_OUTSIDE_SHARE = 0.045;
/** Share of an edge's length that shows contrast, below which the edge is called weak. */
const MIN_SEEN_SHARE = 0.5;

/** @extends {Events<PageEvents>} */
export class PageSession extends Events {
  /** @type {PagePhoto | null} */
  photo = null;
  /** @type {Outline} */
  outline = Outline.within({ width: 1, height: 1 });
  /** Which of several pages that were found is made flat. */
  chosen = 0;
  /** The corners that were put where they are by hand. @type {ReadonlySet<number>} */
  moved = new Set();
  /** Names of edges that the photo hardly shows. @type {string[]} */
  weak = [];
  /** Whether edges are drawn to what the photo shows. */
  snapping = true;
  /** Whether lines of text are looked for. */
  finding = true;
  /** Lines of text that are drawn. @type {DrawnLine[]} */
  drawn = [];
  /** Those that were found. @type {Line[]} */
  found = [];
  /** Whether the page was found by these, or against them. */
  agreed = true;
  /** @type {Options} */
  options = {};

  /** Quarter turns by which the flat page is turned clockwise. */
  quarters = 0;

  #flattening;
  /** The newest flat page. @type {Flat | null} */
  #made = null;
  /** @type {Wish | null} */
  #newest = null;
  /** What the outline was before each change. @type {Snapshot[]} */
  #past = [];
  /** Whether the change under way is remembered already. */
  #dragging = false;

  /** @param {Api} api */
  constructor(api) {
    super();
    this.worker = new api.DevelopableWorker();
    this.#flattening = new Flattening(this.worker);
  }

  /** Whether no page was found, and no corner was put onto it yet. */
  get unfound() {
    return this.photo?.outlines.verdict === 'notFound' && this.moved.size === 0;
  }

  get changed() {
    return this.#past.length > 0;
  }

  /** Names of the corners that are outside the photo. */
  get outside() {
    const { photo, outline } = this;
    if (!photo) return [];
    const names = ['upper left', 'upper right', 'lower right', 'lower left'];
    return names.filter((_, i) => {
      const { x, y } = outline.corners[i];
      return x < -0.5 || y < -0.5 || x > photo.width - 0.5 || y > photo.height - 0.5;
    });
  }

  /**
   * @param {PagePhoto} photo
   * @param {number} [pages] that it shows
   * @param {PageState | null} [state] what was done to it before
   */
  show(photo, pages = 1, state = null) {
    this.photo = photo;
    [this.drawn, this.found, this.#made, this.#past] = [[], [], null, []];
    [this.chosen, this.#dragging, this.quarters] = [0, false, 0];
    this.#begin(photo, pages);
    if (state) {
      const { outline, drawn, moved, chosen, quarters } = state;
      Object.assign(this, { outline: outline.copy(), drawn: [...drawn], moved, chosen, quarters });
    }
    this.emit('photo', photo);
    this.#changed();
  }

  /** Another of the pages that were found. @param {number} page */
  choose(page) {
    if (!this.photo?.outlines.pages[page]) return;
    this.#remember();
    this.chosen = page;
    this.#begin(this.photo, 1);
    this.#changed();
  }

  /** An outline to start from, again. */
  suggest() {
    if (!this.photo) return;
    this.#past = [];
    this.drawn = [];
    this.#begin(this.photo, this.outline.pages);
    this.#changed();
  }

  /** @param {PagePhoto} photo @param {number} pages */
  #begin(photo, pages) {
    const found = photo.outlines.verdict === 'notFound' ? undefined : photo.outlines.pages[this.chosen];
    this.outline = found ? Outline.from(found) : Outline.within(photo);
    this.moved = new Set();
    if (pages === 2) this.#divide(photo);
  }

  #remember() {
    this.#dragging = false;
    const { outline, drawn, moved, chosen } = this;
    this.#past.push({ outline: outline.copy(), drawn: [...drawn], moved, chosen });
  }

  /** What was done to the photo's outline, if it has one. @returns {PageState | null} */
  state() {
    const { outline, drawn, moved, chosen, quarters } = this;
    const wish = this.unfound ? null : this.wish();
    return wish && { outline: outline.copy(), drawn: [...drawn], moved, chosen, quarters, traces: wish.traces, text: wish.text };
  }

  /** Takes the last change of outline or lines back. */
  undo() {
    const before = this.#past.pop();
    if (!before) return;
    Object.assign(this, before);
    this.#dragging = false;
    this.#changed();
  }

  divide() {
    if (!this.photo) return;
    this.#remember();
    this.#divide(this.photo);
    this.#changed();
  }

  /** @param {PagePhoto} photo */
  #divide({ grey }) {
    this.outline = this.outline.divided(gutterOf(this.outline, this.snapping ? grey : null));
    if (this.snapping) settle(grey, this.outline);
  }

  join() {
    this.#remember();
    this.outline = this.outline.joined();
    this.#settled();
  }

  /** Turns the flat page clockwise by a quarter. */
  turn() {
    this.quarters = (this.quarters + 1) % 4;
    if (this.#made) this.emit('flat', { ...this.#made, moving: false });
  }

  /** @param {boolean} snapping */
  snap(snapping) {
    this.snapping = snapping;
    this.#settled();
  }

  /** @param {Options} options */
  know(options) {
    this.options = options;
    this.#changed();
  }

  /**
   * A node was moved, or is being moved.
   * @param {Which} which
   * @param {readonly [number, number]} to
   * @param {{ held: boolean, ended: boolean }} how `held`: whether it is to stay there
   */
  move(which, [x, y], { held, ended }) {
    const { photo, outline } = this;
    const node = outline.at(which);
    if (!photo || !node) return;
    if (!this.#dragging) this.#remember();
    this.#dragging = !ended;
    const outside = MAX_OUTSIDE_SHARE * Math.hypot(photo.width, photo.height);
    const within = (/** @type {number} */ at, /** @type {number} */ side) => Math.min(Math.max(at, -outside), side + outside);
    outline.move(which, [within(x, photo.width), within(y, photo.height)]);
    node.held = held || !this.snapping;
    const corner = outline.corners.indexOf(node);
    if (corner >= 0) this.moved = new Set([...this.moved, corner]);
    if (ended && this.snapping && !node.held) settle(photo.grey, outline);
    this.#changed(!ended);
  }

  /** @param {boolean} finding */
  find(finding) {
    this.finding = finding;
    this.#changed();
  }

  /**
   * A line of text, drawn from one place to another; the newest if it has no number yet.
   * @param {Ends} ends
   * @param {{ line?: number, ended: boolean }} how
   */
  drawLine(ends, { line = this.drawn.length, ended }) {
    if (!this.photo) return line;
    if (!this.#dragging) this.#remember();
    this.#dragging = !ended;
    const { photo: { grey, width, height }, snapping } = this;
    const within = ends.map(([x, y]) => [Math.min(Math.max(x, 0), width - 1), Math.min(Math.max(y, 0), height - 1)]);
    const [from, to] = /** @type {Ends} */ (within);
    this.drawn[line] = { ends: [from, to], points: lineBetween(grey, [from, to], this.#made?.flat ?? null, snapping && ended) };
    if (ended && Math.hypot(to[0] - from[0], to[1] - from[1]) < SHORT * width) this.drawn.splice(line, 1);
    this.emit('lines', null);
    if (ended) this.#changed();
    return line;
  }

  /** @param {number} line */
  removeLine(line) {
    this.#remember();
    this.drawn.splice(line, 1);
    this.emit('lines', null);
    this.#changed();
  }

  /** The page that a line of text is on. @param {Ends} ends */
  #leaf([from, to]) {
    const { pages } = this.outline;
    const flat = this.#made?.flat;
    const middle = /** @type {Point} */ ([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2]);
    const place = flat && this.photo && flatPlace(flat, middle, this.photo.grey.scale);
    if (pages === 1 || !place) return 0;
    return Math.min(pages - 1, Math.floor((place[0] / flat.width) * pages));
  }

  /**
   * @param {Edge} edge
   * @param {[number, number]} place
   * @param {boolean} [pulled] whether the new point is being dragged already
   */
  add(edge, place, pulled = false) {
    this.#remember();
    this.#dragging = pulled;
    const which = this.outline.add(edge, place);
    this.#changed();
    return which;
  }

  /** @param {Which} which */
  remove(which) {
    this.#remember();
    this.outline.remove(which);
    this.#changed();
  }

  /** The wish for the whole photo made flat. @returns {Wish | null} */
  wish(moving = false) {
    const { photo, options, finding, drawn } = this;
    if (!photo) return null;
    /** @type {Line[][]} */
    const text = Array.from({ length: this.outline.pages }, () => []);
    for (const { ends, points } of drawn) {
      if (Math.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]) >= SHORT * photo.width) text[this.#leaf(ends)].push(points);
    }
    return { photo, traces: this.#traces(photo), text, options: { ...options, findLines: finding }, moving };
  }

  /** @param {Flat} made @param {Wish} wish */
  #show({ flat, assumed }, { photo, moving }) {
    this.#made = { flat, assumed };
    // While something is dragged, the lines stay as they were.
    if (!moving) {
      const back = (/** @type {number} */ at) => rescaled(at, 1 / photo.grey.scale);
      this.found = flat.lines.flat().map((line) => line.map(([x, y]) => [back(x), back(y)]));
      this.agreed = flat.report.linesUsed === flat.report.linesFound;
    }
    this.emit('flat', { flat, assumed, moving });
  }

  #settled() {
    if (this.photo && this.snapping) settle(this.photo.grey, this.outline);
    this.#changed();
  }

  /** @param {boolean} [moving] whether this goes on */
  #changed(moving = false) {
    const wish = this.wish(moving);
    if (!wish) return;
    this.#newest = wish;
    this.emit('outline', { outline: this.outline, traces: wish.traces, moving });
    if (this.unfound) {
      [this.found, this.#made] = [[], null];
      this.emit('unfound', null);
      this.emit('lines', null);
      this.emit('working', false);
      return;
    }
    this.emit('working', true);
    void this.#flattening.preview(wish, (done) => {
      if (done.wish.photo !== this.photo || this.unfound) return;
      if ('flat' in done) this.#show(done, done.wish);
      else {
        [this.found, this.#made] = [[], null];
        this.emit('problem', done.error);
      }
      this.emit('lines', null);
      if (done.wish === this.#newest) this.emit('working', false);
    });
  }

  /**
   * The points of the edges: those that were found or that the photo shows, or else the nodes as they are.
   * @param {PagePhoto} photo
   * @returns {Traces}
   */
  #traces({ grey }) {
    const { outline } = this;
    this.weak = [];
    // Edges of a page that was not found follow nothing.
    if (this.unfound) return /** @type {Traces} */ (EDGES.map((edge) => outline.spans(edge).map((nodes) => nodes.map(({ x, y }) => /** @type {Point} */ ([x, y])))));
    return /** @type {Traces} */ (EDGES.map((edge) => {
      const traces = outline.spans(edge).map((nodes) => ({ nodes, ...traced(grey, nodes) }));
      if (traces.some(({ seen }) => seen < MIN_SEEN_SHARE)) this.weak.push(EDGE_NAMES[edge]);
      const found = outline.found[edge];
      if (found) return [found];
      return traces.map(({ nodes, points, seen }) => (this.snapping && seen >= MIN_SEEN_SHARE ? points : nodes.map(({ x, y }) => /** @type {Point} */ ([x, y]))));
    }));
  }
}
