/** Elements below the views: colour bars, figures, tables and sentences. */
import { make } from '../dom.js';
import { toCss, divergingColour } from '../surface/colours.js';

/** @import {Scale} from '../surface/colours.js' */

/**
 * A colour bar with its ticks.
 * @param {string} title with the unit
 * @param {Scale} scale
 */
export function colourBar(title, scale) {
  const bar = make('div', 'bar');
  const stops = Array.from({ length: 21 }, (_, i) => toCss(divergingColour(i / 10 - 1)));
  bar.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
  const ticks = make('div', 'ticks');
  for (const { value, label } of scale.ticks) {
    const tick = make('span', '', label);
    tick.style.left = `${50 * (1 + scale.place(value))}%`;
    ticks.append(tick);
  }
  return make('figure', 'scale', make('figcaption', '', title), bar, ticks);
}

/**
 * A list of figures with their names.
 * @param {readonly (readonly [name: string, value: string])[]} figures
 */
export function figures(figures) {
  return make('dl', 'figures', ...figures.map(([name, value]) =>
    make('div', '', make('dt', '', name), make('dd', '', value))));
}

/**
 * A table.
 * @param {string} caption
 * @param {readonly string[]} head
 * @param {readonly (readonly (string | Node)[])[]} rows the first cell is the row's name
 */
export function table(caption, head, rows) {
  const made = make('table', 'small');
  made.createCaption().textContent = caption;
  const top = made.createTHead().insertRow();
  for (const text of head) {
    const cell = make('th', '', text);
    cell.scope = 'col';
    top.append(cell);
  }
  const body = made.createTBody();
  for (const [name, ...cells] of rows) {
    const row = body.insertRow();
    const header = make('th', '', name);
    header.scope = 'row';
    row.append(header);
    for (const cell of cells) row.insertCell().append(cell);
  }
  return made;
}

/** An entry of a legend: a colour and its meaning. @param {string} colour @param {string} words */
export function key(colour, words) {
  const made = make('span', 'key', words);
  made.style.setProperty('--colour', colour);
  return made;
}

/** A sentence above the figures. @param {string} words */
export function statement(words) {
  return make('p', 'said', words);
}
