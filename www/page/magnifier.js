/** A magnifier: enlarges the part of the photo under the finger, and shows it beside the finger. */

/** Enlargement of the photo as it is displayed. */
const MAGNIFICATION = 4;

/** @typedef {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }} Pixels */

export class Magnifier {
  #source = document.createElement('canvas');

  /** @param {HTMLElement} box element that covers the whole photo; its parent may show only a part of it */
  constructor(box) {
    this.box = box;
    this.canvas = document.createElement('canvas');
    this.canvas.className = 'magnifier';
    this.canvas.setAttribute('aria-hidden', 'true');
    this.canvas.hidden = true;
    box.parentElement?.append(this.canvas);
  }

  hide() {
    this.canvas.hidden = true;
  }

  /**
   * Shows the surroundings of a place of the photo.
   * @param {Pixels} photo
   * @param {readonly [number, number]} place in pixels of the photo
   * @param {readonly (readonly (readonly [number, number])[])[]} lines drawn over it
   */
  show(photo, [x, y], lines) {
    const { canvas, box } = this;
    const perPixel = photo.width / box.clientWidth;
    // The shown square in pixels of the photo, at least 12.
    canvas.hidden = false;
    const side = Math.max(12, Math.round((canvas.clientWidth / MAGNIFICATION) * perPixel));
    const [left, top] = [Math.round(x - side / 2), Math.round(y - side / 2)];
    const ratio = window.devicePixelRatio;
    canvas.width = canvas.height = Math.round(canvas.clientWidth * ratio);
    // The magnifier is on the side of the frame opposite to the finger.
    const [whole, shown] = [box, box.parentElement ?? box].map((one) => one.getBoundingClientRect());
    canvas.classList.toggle('right', whole.left + (x / photo.width) * whole.width < shown.left + shown.width / 2);
    const context = canvas.getContext('2d');
    if (!context) return;
    this.#source.width = this.#source.height = side;
    // Outside of the photo it stays transparent.
    this.#source.getContext('2d')?.putImageData(new ImageData(photo.data, photo.width), -left, -top);
    context.imageSmoothingEnabled = canvas.width / side < 6;
    context.drawImage(this.#source, 0, 0, canvas.width, canvas.height);
    const scale = canvas.width / side;
    const style = getComputedStyle(canvas);
    /** @param {string} name @param {number} width */
    const stroke = (name, width) => {
      context.strokeStyle = style.getPropertyValue(name).trim();
      context.lineWidth = width * ratio;
      context.stroke();
    };
    for (const line of lines) {
      context.beginPath();
      for (const [u, v] of line) context.lineTo((u + 0.5 - left) * scale, (v + 0.5 - top) * scale);
      stroke('--line-under', 3);
      stroke('--line-over', 1.5);
    }
    const [cx, cy] = [(x + 0.5 - left) * scale, (y + 0.5 - top) * scale];
    context.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(cx + 5 * ratio * dx, cy + 5 * ratio * dy);
      context.lineTo(cx + 18 * ratio * dx, cy + 18 * ratio * dy);
    }
    stroke('--line-under', 3);
    stroke('--line-cross', 1.5);
  }
}
