/** Directions of the arrow keys, and the zoom of the mouse wheel, for all views. */

/** Zoom per pixel and per line that the wheel scrolls, as a logarithm. */
const WHEEL_ZOOM_PER_PIXEL = 0.0015;
const WHEEL_ZOOM_PER_LINE = 0.05;

/** Direction of each arrow key: x to the right, y up. @type {Record<string, readonly [x: number, y: number]>} */
export const ARROW_DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** The factor by which a turn of the wheel enlarges a picture. @param {WheelEvent} event */
export function wheelZoomFactor({ deltaY, deltaMode }) {
  return Math.exp(-deltaY * (deltaMode === WheelEvent.DOM_DELTA_LINE ? WHEEL_ZOOM_PER_LINE : WHEEL_ZOOM_PER_PIXEL));
}
