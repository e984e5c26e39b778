/** Typed look-up of the page's elements. */

/**
 * The element with this id; the markup and the modules must agree, so its absence is a mistake.
 * @template {Element} T
 * @param {string} id
 * @param {new () => T} type
 * @returns {T}
 */
export function element(id, type) {
  const found = document.getElementById(id);
  if (!(found instanceof type)) throw new Error(`#${id} is not a ${type.name}`);
  return found;
}

/**
 * All elements of one type that match.
 * @template {Element} T
 * @param {string} selector
 * @param {new () => T} type
 * @returns {T[]}
 */
export function elements(selector, type) {
  /** @param {Element} found @returns {found is T} */
  const typed = (found) => found instanceof type;
  return [...document.querySelectorAll(selector)].filter(typed);
}

/**
 * Lets a button open the file dialog.
 * @param {HTMLButtonElement} button
 * @param {HTMLInputElement} input
 * @param {(file: File) => unknown} take
 */
export function choosesFile(button, input, take) {
  choosesFiles(button, input, ([file]) => take(file));
}

/**
 * The same for several at once.
 * @param {HTMLButtonElement} button
 * @param {HTMLInputElement} input
 * @param {(files: File[]) => unknown} take at least one
 */
export function choosesFiles(button, input, take) {
  button.addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    const files = [...input.files ?? []];
    // So that choosing the same file again, perhaps mended, is a change.
    input.value = '';
    if (files.length > 0) take(files);
  });
}

/**
 * At most one call per frame, however often it is asked for.
 * @param {() => void} draw
 * @returns {() => void}
 */
export function eachFrame(draw) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      draw();
    });
  };
}

/** Lets the browser draw and listen before more is done. */
export function breath() {
  return new Promise((resolve) => setTimeout(resolve));
}

/**
 * Sizes the canvas' pixels to the device's, and calls back whenever they change.
 * @param {HTMLCanvasElement} canvas
 * @param {() => void} changed
 */
export function followDevicePixels(canvas, changed) {
  const fit = () => {
    const ratio = window.devicePixelRatio;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width === width && canvas.height === height) return;
    canvas.width = width;
    canvas.height = height;
    changed();
  };
  new ResizeObserver(fit).observe(canvas);
  // Zooming and moving to another screen change the ratio without changing the box.
  window.addEventListener('resize', fit);
}

/**
 * A new element.
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

/**
 * Hands a file to the browser's downloads.
 * @param {Uint8Array<ArrayBuffer> | Blob | string} content
 * @param {string} type
 * @param {string} name
 */
export function download(content, type, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  // Once the browser has taken hold of it.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
