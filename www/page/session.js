/** What the photo's side of the page is about, without its elements: a photo, the outline of the page in it, what is known. */
import { Events } from '../events.js';
import { Flattening } from './flatten.js';
import { gutterOf } from './gutter.js';
import { rescaled } from './grey.js';
import { flatPlace, lineBetween } from './lines.js';
import { Outline } from './outline.js';
import { settle, traced } from './snap.js';

/** @import {Api} from '../api.js' */
/** @import {DewarpedPage, Line, Options, Traces, Wish} from './flatten.js' */
/** @import {Ends} from './lines.js' */
/** @import {PagePhoto} from './photo.js' */
/** @import {Point, Which} from './outline.js' */

/**
 * @typedef {object} PageEvents
 * @property {PagePhoto} photo another one
 * @property {{ outline: Outline, traces: Traces }} outline
 * @property {boolean} working whether a newer flat page is to come
 * @property {DewarpedPage} flat of the reduced photo
 * @property {null} lines of text: others are drawn, or found
 * @property {unknown} problem why there is none
 */

/** Lines of text that are shorter than this share of the photo are none. */
const SHORT = 0.02;

/** @extends {Events<PageEvents>} */
export class PageSession extends Events {
  /** @type {PagePhoto | null} */
  photo = null;
  /** @type {Outline} */
  outline = Outline.within({ width: 1, height: 1 });
  /** Whether edges are drawn to what the photo shows. */
  snapping = true;
  /** Whether lines of text are looked for. */
  finding = true;
  /** Lines of text that are drawn. @type {{ ends: Ends, points: Line }[]} */
  drawn = [];
  /** Those that were found. @type {Line[]} */
  found = [];
  /** Whether the page was found by these, or against them. */
  agreed = true;
  /** @type {Options} */
  options = {};

  #flattening;
  /** The newest flat page. @type {DewarpedPage | null} */
  #flat = null;
  /** @type {Wish | null} */
  #newest = null;

  /** @param {Api} api */
  constructor(api) {
    super();
    this.worker = new api.DevelopableWorker();
    this.#flattening = new Flattening(this.worker);
  }

  /**
   * @param {PagePhoto} photo
   * @param {number} [pages] that it shows
   */
  show(photo, pages = 1) {
    this.photo = photo;
    [this.drawn, this.found, this.#flat] = [[], [], null];
    this.#begin(photo, pages);
    this.emit('photo', photo);
    this.#changed();
  }

  /** An outline to start from, again. */
  suggest() {
    if (!this.photo) return;
    this.#begin(this.photo, this.outline.pages);
    this.#changed();
  }

  /** @param {PagePhoto} photo @param {number} pages */
  #begin(photo, pages) {
    this.outline = photo.outline ? Outline.of(photo.outline) : Outline.within(photo);
    if (pages === 2) this.#divide(photo);
  }

  divide() {
    if (!this.photo) return;
    this.#divide(this.photo);
    this.#changed();
  }

  /** @param {PagePhoto} photo */
  #divide({ grey }) {
    this.outline = this.outline.divided(gutterOf(this.outline, this.snapping ? grey : null));
    if (this.snapping) settle(grey, this.outline);
  }

  join() {
    this.outline = this.outline.joined();
    this.#settled();
  }

  turn() {
    const { pages } = this.outline;
    this.outline = this.outline.turned();
    if (pages === 2) this.divide();
    else this.#settled();
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
    outline.move(which, [Math.min(Math.max(x, -0.5), photo.width - 0.5), Math.min(Math.max(y, -0.5), photo.height - 0.5)]);
    node.held = held || !this.snapping;
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
    const { photo: { grey, width, height }, snapping } = this;
    const within = ends.map(([x, y]) => [Math.min(Math.max(x, 0), width - 1), Math.min(Math.max(y, 0), height - 1)]);
    const [from, to] = /** @type {Ends} */ (within);
    this.drawn[line] = { ends: [from, to], points: lineBetween(grey, [from, to], this.#flat, snapping && ended) };
    if (ended && Math.hypot(to[0] - from[0], to[1] - from[1]) < SHORT * width) this.drawn.splice(line, 1);
    this.emit('lines', null);
    if (ended) this.#changed();
    return line;
  }

  /** @param {number} line */
  removeLine(line) {
    this.drawn.splice(line, 1);
    this.emit('lines', null);
    this.#changed();
  }

  /** The page that a line of text is on. @param {Ends} ends */
  #leaf([from, to]) {
    const { pages, sideways } = this.outline;
    const flat = this.#flat;
    const middle = /** @type {Point} */ ([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2]);
    const place = flat && this.photo && flatPlace(flat, middle, this.photo.grey.scale);
    if (pages === 1 || !place) return 0;
    const share = sideways ? place[1] / flat.height : place[0] / flat.width;
    return Math.min(pages - 1, Math.floor(share * pages));
  }

  /**
   * @param {0 | 1} edge
   * @param {[number, number]} place
   */
  add(edge, place) {
    const which = this.outline.add(edge, place);
    this.#changed();
    return which;
  }

  /** @param {Which} which */
  remove(which) {
    this.outline.remove(which);
    this.#changed();
  }

  /** The wish for the whole photo made flat. @returns {Wish | null} */
  wish() {
    const { photo, options, finding, drawn } = this;
    if (!photo) return null;
    /** @type {Line[][]} */
    const text = Array.from({ length: this.outline.pages }, () => []);
    for (const { ends, points } of drawn) {
      if (Math.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]) >= SHORT * photo.width) text[this.#leaf(ends)].push(points);
    }
    return { photo, traces: this.#traces(photo), text, options: { ...options, findLines: finding } };
  }

  /** @param {DewarpedPage} flat @param {Wish} wish */
  #show(flat, { photo, options: { findLines } }) {
    this.#flat = flat;
    // While something is dragged, the lines stay as they were.
    if (findLines || !this.finding) {
      const back = (/** @type {number} */ at) => rescaled(at, 1 / photo.grey.scale);
      this.found = flat.lines.flat().map((line) => line.map(([x, y]) => [back(x), back(y)]));
      this.agreed = flat.report.linesUsed === flat.report.linesFound;
    }
    this.emit('flat', flat);
  }

  #settled() {
    if (this.photo && this.snapping) settle(this.photo.grey, this.outline);
    this.#changed();
  }

  /** @param {boolean} [moving] whether this goes on: then lines of text are not looked for, which takes longer */
  #changed(moving = false) {
    const wish = this.wish();
    if (!wish) return;
    if (moving) wish.options.findLines = false;
    this.emit('outline', { outline: this.outline, traces: wish.traces });
    this.emit('working', true);
    this.#newest = wish;
    void this.#flattening.preview(wish, (done) => {
      if (done.wish.photo !== this.photo) return;
      if ('flat' in done) this.#show(done.flat, done.wish);
      else {
        [this.found, this.#flat] = [[], null];
        this.emit('problem', done.error);
      }
      this.emit('lines', null);
      if (done.wish === this.#newest) this.emit('working', false);
    });
  }

  /**
   * The points of the edges: those that the photo shows, or else the nodes as they are.
   * @param {PagePhoto} photo
   * @returns {Traces}
   */
  #traces({ grey }) {
    const { outline } = this;
    const lines = /** @type {Traces['lines']} */ (/** @type {const} */ ([0, 1]).map((edge) => outline.spans(edge).map((nodes) => {
      const trace = this.snapping ? traced(grey, nodes) : null;
      return trace && trace.seen >= 0.5 ? trace.points : nodes.map(({ x, y }) => [x, y]);
    })));
    return { sideways: outline.sideways, lines };
  }
}
