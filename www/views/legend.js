/** Elements below the views: colour bars, figures and sentences. */
import { make } from '../dom.js';
import { toCss, divergingColour } from '../surface/colours.js';

/** @import {Scale} from '../surface/colours.js' */
/** @typedef {{ title: string, scale: Scale }} Colours what colours mean: a title with the unit, and the scale */

/** Colours of a colour bar, evenly spaced. */
const STOPS = Array.from({ length: 21 }, (_, i) => toCss(divergingColour(i / 10 - 1)));

/** A colour bar with its ticks. @param {Colours} colours */
export function colourBar({ title, scale }) {
  const bar = make('div', 'bar');
  bar.style.background = `linear-gradient(to right, ${STOPS.join(', ')})`;
  const ticks = make('div', 'ticks');
  for (const { value, label } of scale.ticks) {
    const tick = make('span', '', label);
    tick.style.left = `${50 * (1 + scale.place(value))}%`;
    ticks.append(tick);
  }
  return make('figure', 'scale', make('figcaption', '', title), bar, ticks);
}

/** A list of figures with their names. @param {readonly (readonly [name: string, value: string])[]} figures */
export function figures(figures) {
  return make('dl', 'figures', ...figures.map(([name, value]) =>
    make('div', '', make('dt', '', name), make('dd', '', value))));
}

/** An entry of a legend: a colour and its meaning. @param {string} colour @param {string} words */
export function key(colour, words) {
  const made = make('span', 'key', words);
  made.style.setProperty('--colour', colour);
  return made;
}

/** A picture as it is saved: on the ground of the page, with a colour bar below. @param {HTMLCanvasElement} drawn @param {Colours} [colours] */
export function pictureWithColours(drawn, colours) {
  const line = Math.round(drawn.width / 60);
  const picture = new OffscreenCanvas(drawn.width, drawn.height + (colours ? 6 * line : 0));
  const context = picture.getContext('2d');
  if (!context) throw new Error('this browser draws no pictures');
  const style = getComputedStyle(drawn.parentElement ?? document.body);
  context.fillStyle = style.backgroundColor;
  context.fillRect(0, 0, picture.width, picture.height);
  context.drawImage(drawn, 0, 0);
  if (!colours) return picture;
  const [left, top, width] = [0.1 * drawn.width, drawn.height + 2 * line, 0.8 * drawn.width];
  const gradient = context.createLinearGradient(left, 0, left + width, 0);
  STOPS.forEach((colour, i) => gradient.addColorStop(i / (STOPS.length - 1), colour));
  context.fillStyle = gradient;
  context.fillRect(left, top, width, line);
  Object.assign(context, { fillStyle: style.color, font: `${line}px ${style.fontFamily}` });
  context.fillText(colours.title, left, top - line / 2);
  context.textAlign = 'center';
  for (const { value, label } of colours.scale.ticks) context.fillText(label, left + (width * (1 + colours.scale.place(value))) / 2, top + 2.5 * line);
  return picture;
}
