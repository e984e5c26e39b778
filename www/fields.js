/** Forms that are built from tables of their fields: labels, units, ranges and hints. What is wrong in a field is said beneath it. And choices of one among few. */
import { element, make } from './dom.js';
import { numberIn } from './format.js';

/**
 * @typedef {object} Range numbers that a field takes
 * @property {(value: number) => boolean} takes
 * @property {string} must what a number has to be, for messages
 * @property {boolean} [isWide] whether its numbers are written with an exponent
 *
 * @typedef {object} Field
 * @property {string} label with the unit
 * @property {string | boolean} [value] the initial one
 * @property {Record<string, string>} [options] of a menu: words by value
 * @property {Range} [range] of a number
 * @property {boolean} [optional] whether it may be empty
 * @property {(text: string) => string} [wrong] what is wrong with another text; empty if nothing is
 * @property {string} [placeholder]
 * @property {string} [hint]
 * @property {string} [describedBy] ids of other elements that describe it
 * @property {string} [controls] id of the control that a check box shows
 */

/** @param {number} least @param {number} most @param {string} [words] @returns {Range} */
export const between = (least, most, words = `from ${least} to ${most}`) => ({ takes: (value) => value >= least && value <= most, must: `a number ${words}` });
/** @param {number} limit @param {string} [words] @returns {Range} */
export const above = (limit, words = `above ${limit}`) => ({ takes: (value) => value > limit && value < Infinity, must: `a number ${words}` });

/** Returns the error message for the text of a field; empty if it is valid. @param {Field} field @param {string} text */
function faultOf({ range, optional, wrong }, text) {
  if (wrong) return wrong(text);
  if (!range || (optional && text.trim() === '')) return '';
  return range.takes(numberIn(text)) ? '' : `This must be ${range.must}.`;
}

/**
 * Builds the fields of a table.
 * @template {string} N
 * @param {Readonly<Record<N, Field>>} table by the ids of their controls
 * @param {(name: N) => void} [onChange] called when a field was changed to something that it takes
 */
export function fieldsOf(table, onChange = () => {}) {
  /** @param {N} name */
  const create = (name) => {
    const field = /** @type {Field} */ (table[name]);
    const { label, value = '', options, placeholder = '', hint, describedBy = '', controls } = field;
    const isCheck = typeof value === 'boolean';
    const control = options ? make('select', '', ...Object.entries(options).map(([option, words]) => new Option(words, option))) : make('input', '');
    // Keypads of phones for decimals have neither a minus nor an exponent.
    Object.assign(control, { id: name, ...(isCheck ? { type: 'checkbox', checked: value } : { value }), ...(!options && !isCheck && { type: 'text', inputMode: field.range && !field.range.isWide && !field.range.takes(-1) ? 'decimal' : 'text', placeholder, spellcheck: false, autocomplete: 'off' }) });
    const fault = make('span', 'wrong small');
    Object.assign(fault, { id: `${name}-wrong`, ariaLive: 'polite' });
    const about = make('span', 'muted small', hint ?? '');
    about.id = `${name}-hint`;
    if (!isCheck) control.setAttribute('aria-describedby', `${fault.id} ${about.id} ${describedBy}`.trim());
    if (controls) control.setAttribute('aria-controls', controls);
    const node = isCheck ? make('label', 'check', control, ` ${label}`) : make('div', 'field', Object.assign(make('label', '', label), { htmlFor: name }), control, fault, about);
    /** Says what is wrong. @param {string} [words] empty if nothing is */
    const check = (words = node.hidden || !(control instanceof HTMLInputElement) || isCheck ? '' : faultOf(field, control.value)) => {
      fault.textContent = words;
      if (words) control.setAttribute('aria-invalid', 'true');
      else control.removeAttribute('aria-invalid');
      return words;
    };
    control.addEventListener('change', () => {
      if (!check()) onChange(name);
    });
    // What was wrong goes while it is mended: later, a button beneath would move away from under the pointer.
    control.addEventListener('input', () => void (fault.textContent && check()));
    return { node, control, check, about, fault };
  };
  const names = /** @type {N[]} */ (Object.keys(table));
  const fields = /** @type {Record<N, ReturnType<typeof create>>} */ (Object.fromEntries(names.map((name) => [name, create(name)])));
  return {
    /** The elements of fields. @param {...N} wanted all unless said otherwise */
    nodes: (...wanted) => (wanted.length > 0 ? wanted : names).map((name) => fields[name].node),
    /** @param {N} name */
    control: (name) => fields[name].control,
    /** @param {N} name */
    text: (name) => fields[name].control.value,
    /** @param {N} name */
    number: (name) => numberIn(fields[name].control.value),
    /** @param {N} name */
    isChecked: (name) => /** @type {HTMLInputElement} */ (fields[name].control).checked,
    /** @param {N} name @param {string | number | boolean} value */
    set: (name, value) => {
      const { control, check } = fields[name];
      if (typeof value === 'boolean') /** @type {HTMLInputElement} */ (control).checked = value;
      else control.value = String(value);
      check();
    },
    /** What was chosen or typed. @param {...N} wanted */
    values: (...wanted) => Object.fromEntries(wanted.map((name) => {
      const { type, checked, value } = /** @type {HTMLInputElement} */ (fields[name].control);
      return [name, type === 'checkbox' ? checked : value];
    })),
    /** Says what else is wrong in a field, until it is changed. @param {N} name @param {string} words */
    blame: (name, words) => void fields[name].check(words),
    /** @param {N} name @param {string} words */
    hint: (name, words) => void (fields[name].about.textContent = words),
    /** Shows or hides fields. @param {boolean} isShown @param {...N} wanted */
    show: (isShown, ...wanted) => {
      for (const name of wanted) fields[name].node.hidden = !isShown;
    },
    /** Says at each field what is wrong in it. @returns {string} the first fault with the label of its field; empty if there is none */
    check: () => names.map((name) => [fields[name].check(), table[name].label]).filter(([fault]) => fault).map(([fault, label]) => `“${label}”: ${fault}`)[0] ?? '',
  };
}

/**
 * Builds a choice of one among few, the first at first.
 * @param {string} name of the radio buttons
 * @param {Readonly<Record<string, string>>} options words by value
 * @param {(value: string) => void} onChange called when the user has chosen
 */
export function choiceOf(name, options, onChange) {
  const radios = Object.keys(options).map((value, i) => Object.assign(make('input', ''), { type: 'radio', name, value, checked: i === 0 }));
  const labels = radios.map((radio) => make('label', '', radio, make('span', '', options[radio.value])));
  const box = element(`${name}-choice`, HTMLElement);
  box.append(...labels);
  for (const radio of radios) radio.addEventListener('change', () => onChange(radio.value));
  return {
    box,
    /** The value that is chosen; empty if none is. */
    get value() {
      return radios.find(({ checked }) => checked)?.value ?? '';
    },
    /** Chooses a value, or none. @param {string} value */
    set: (value) => radios.forEach((radio) => (radio.checked = radio.value === value)),
    /** Shows some of the options. @param {(value: string) => boolean} isOffered */
    offer: (isOffered) => radios.forEach(({ value }, i) => (labels[i].hidden = !isOffered(value))),
  };
}
