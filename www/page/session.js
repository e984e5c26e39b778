/** What the photo's side of the page is about, without its elements: a photo, the outline of the page in it, what is known. */
import { Events } from '../events.js';
import { suggested } from './detect.js';
import { Flattening } from './flatten.js';
import { gutterOf } from './gutter.js';
import { Outline } from './outline.js';
import { settle, traced } from './snap.js';

/** @import {Api} from '../api.js' */
/** @import {DewarpedPage, Options, Traces, Wish} from './flatten.js' */
/** @import {PagePhoto} from './photo.js' */
/** @import {Which} from './outline.js' */

/**
 * @typedef {object} PageEvents
 * @property {PagePhoto} photo another one
 * @property {{ outline: Outline, traces: Traces }} outline
 * @property {boolean} working whether a newer flat page is to come
 * @property {DewarpedPage} flat of the reduced photo
 * @property {unknown} problem why there is none
 */

/** @extends {Events<PageEvents>} */
export class PageSession extends Events {
  /** @type {PagePhoto | null} */
  photo = null;
  /** @type {Outline} */
  outline = Outline.within({ width: 1, height: 1 });
  /** Whether edges are drawn to what the photo shows. */
  snapping = true;
  /** @type {Options} */
  options = {};

  #flattening;
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
    this.outline = suggested(photo.grey) ?? Outline.within(photo);
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
    this.#changed();
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
    const { photo, options } = this;
    return photo && { photo, traces: this.#traces(photo), options };
  }

  /** @param {Wish} wish */
  whole(wish) {
    return this.#flattening.whole(wish);
  }

  #settled() {
    if (this.photo && this.snapping) settle(this.photo.grey, this.outline);
    this.#changed();
  }

  #changed() {
    const wish = this.wish();
    if (!wish) return;
    this.emit('outline', { outline: this.outline, traces: wish.traces });
    this.emit('working', true);
    this.#newest = wish;
    void this.#flattening.preview(wish, (done) => {
      if (done.wish.photo !== this.photo) return;
      if ('flat' in done) this.emit('flat', done.flat);
      else this.emit('problem', done.error);
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
