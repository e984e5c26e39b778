/** What is under the finger, enlarged, beside it. */

/** Its size and how much it enlarges what is seen of the photo. */
const [SIZE, ENLARGED] = [128, 4];

/** @typedef {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }} Pixels */

export class Magnifier {
  #source = document.createElement('canvas');

  /** @param {HTMLElement} box over the whole photo, of which its parent may show a part */
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
   * @param {Pixels} photo
   * @param {readonly [number, number]} place
   * @param {readonly (readonly (readonly [number, number])[])[]} lines to be drawn over it
   */
  show(photo, [x, y], lines) {
    const { canvas, box } = this;
    const perPixel = photo.width / box.clientWidth;
    // In pixels of the photo, at least a few of them.
    const side = Math.max(12, Math.round((SIZE / ENLARGED) * perPixel));
    const [left, top] = [Math.round(x - side / 2), Math.round(y - side / 2)];
    const ratio = window.devicePixelRatio;
    canvas.width = canvas.height = Math.round(SIZE * ratio);
    canvas.hidden = false;
    // On the side where the finger is not.
    const [whole, shown] = [box, box.parentElement ?? box].map((one) => one.getBoundingClientRect());
    canvas.classList.toggle('right', whole.left + (x / photo.width) * whole.width < shown.left + shown.width / 2);
    const context = canvas.getContext('2d');
    if (!context) return;
    this.#source.width = this.#source.height = side;
    this.#source.getContext('2d')?.putImageData(part(photo, left, top, side), 0, 0);
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

/**
 * A square of a photo, transparent beyond its rim.
 * @param {Pixels} photo
 * @param {number} left
 * @param {number} top
 * @param {number} side
 */
function part({ width, height, data }, left, top, side) {
  const image = new ImageData(side, side);
  for (let row = 0; row < side; row++) {
    const y = top + row;
    const [from, to] = [Math.max(0, left), Math.min(width, left + side)];
    if (y < 0 || y >= height || from >= to) continue;
    image.data.set(data.subarray(4 * (y * width + from), 4 * (y * width + to)), 4 * (row * side + from - left));
  }
  return image;
}
