/** Typed look-up of the page's elements, and small helpers for the DOM. */

/**
 * The element with an id.
 * @template {Element} T
 * @param {string} id
 * @param {new () => T} type
 * @returns {T}
 * @throws if there is none of this type, since the markup and the modules then disagree
 */
export function element(id, type) {
  const found = document.getElementById(id);
  if (!(found instanceof type)) throw new Error(`#${id} is not a ${type.name}`);
  return found;
}

/** All elements of one type that match a selector. @template {Element} T @param {string} selector @param {new () => T} type @returns {T[]} */
export function elements(selector, type) {
  /** @param {Element} found @returns {found is T} */
  const typed = (found) => found instanceof type;
  return [...document.querySelectorAll(selector)].filter(typed);
}

/** Closes the dialogs: they are about what was open before. */
export const closeDialogs = () => elements('dialog[open]', HTMLDialogElement).forEach((dialog) => dialog.close());

/**
 * Makes a button open a file dialog.
 * @param {HTMLButtonElement} button
 * @param {HTMLInputElement} input
 * @param {(files: File[]) => unknown} onFiles called with at least one file
 */
export function onFilesChosen(button, input, onFiles) {
  button.addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    const files = [...input.files ?? []];
    // The field is emptied, so that choosing the same file again counts as a change.
    input.value = '';
    if (files.length > 0) onFiles(files);
  });
}

/** Throttles a function to one call per animation frame. @param {() => void} draw @returns {() => void} */
export function oncePerFrame(draw) {
  let scheduled = false;
  return () => {
    if (scheduled) return;
    scheduled = true;
    requestAnimationFrame(() => {
      scheduled = false;
      draw();
    });
  };
}

/** Time after the last of several changes before what follows from them is done, in milliseconds. */
export const SETTLING_MS = 400;
/** Time for which a button says that something was copied, in milliseconds. */
const COPIED_NOTE_MS = 4000;

/** Copies a text, and says so on a button for a while. @param {HTMLButtonElement} button @param {string} text @param {string} [words] */
export async function copyText(button, text, words = 'Copied') {
  await navigator.clipboard.writeText(text);
  const label = (button.dataset.label ??= button.textContent ?? '');
  button.textContent = words;
  setTimeout(() => (button.textContent = label), COPIED_NOTE_MS);
}

/** Keeps the resolution of a canvas at that of the device. @param {HTMLCanvasElement} canvas @param {() => void} onResize called after every change, which clears the canvas */
export function matchDevicePixels(canvas, onResize) {
  const fit = () => {
    const ratio = window.devicePixelRatio;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width === width && canvas.height === height) return;
    canvas.width = width;
    canvas.height = height;
    onResize();
  };
  new ResizeObserver(fit).observe(canvas);
  // Zooming the page and moving it to another screen change the pixel ratio without changing the element's size.
  window.addEventListener('resize', fit);
}

/**
 * Creates an element.
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {string} className
 * @param {...(Node | string)} children
 * @returns {HTMLElementTagNameMap[T]}
 */
export function make(tag, className, ...children) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  made.append(...children);
  return made;
}

/** Creates a button. @param {string} className @param {() => unknown} act called when it is clicked @param {...(Node | string)} children */
export function makeButton(className, act, ...children) {
  const made = make('button', className, ...children);
  made.type = 'button';
  made.addEventListener('click', () => void act());
  return made;
}

/** Downloads a file. @param {Uint8Array<ArrayBuffer> | Blob | string} content @param {string} type @param {string} name */
export function download(content, type, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  // By then the browser has started the download.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
