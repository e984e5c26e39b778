/** Line plots on a canvas: a frame with ticks, linear across and logarithmic up. */
import { number } from './format.js';

/** @typedef {{ left: number, top: number, width: number, height: number }} Box */

/**
 * @typedef {object} Curve
 * @property {string} colour
 * @property {string} label
 * @property {readonly (readonly [number, number])[]} points a value of NaN interrupts the line
 */

/**
 * @typedef {object} Axes
 * @property {Box} box
 * @property {number} xMax the x-axis begins at 0
 * @property {[number, number]} yRange both above 0
 * @property {string} title
 * @property {string} xLabel
 * @property {{ ink: string, muted: string, line: string }} palette
 */

/** Minimum distance of the tick labels on the x-axis, in CSS pixels. */
const MIN_X_TICK_DISTANCE_PX = 64;
/** Minimum distance of the tick labels on the y-axis, in CSS pixels. */
const MIN_Y_TICK_DISTANCE_PX = 22;

/** Functions from values to positions on the canvas. @param {Axes} axes */
export function scales({ box, xMax, yRange: [low, high] }) {
  const [from, to] = [Math.log(low), Math.log(high)];
  return {
    /** @param {number} x */
    x: (x) => box.left + (x / xMax) * box.width,
    /** @param {number} y */
    y: (y) => box.top + box.height * (1 - (Math.log(y) - from) / (to - from)),
  };
}

/**
 * Draws axes with ticks, labels and a title.
 * @param {CanvasRenderingContext2D} context
 * @param {Axes} axes
 */
export function drawAxes(context, axes) {
  const { box, xMax, yRange, title, xLabel, palette } = axes;
  const { x, y } = scales(axes);
  const bottom = box.top + box.height;
  context.lineWidth = 1;
  context.strokeStyle = palette.line;
  context.fillStyle = palette.muted;
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  for (const tick of powersOfTen(yRange, box.height / MIN_Y_TICK_DISTANCE_PX)) {
    const at = Math.round(y(tick)) + 0.5;
    drawLine(context, box.left, at, box.left + box.width, at);
    context.fillText(number(tick), box.left - 6, at);
  }
  context.textAlign = 'center';
  context.textBaseline = 'top';
  for (const tick of linearTicks(xMax, box.width / MIN_X_TICK_DISTANCE_PX)) {
    const at = Math.round(x(tick)) + 0.5;
    drawLine(context, at, box.top, at, bottom);
    context.fillText(number(tick), at, bottom + 5);
  }
  context.textAlign = 'right';
  context.fillText(xLabel, box.left + box.width, bottom + 20);
  context.fillStyle = palette.ink;
  context.textAlign = 'left';
  context.textBaseline = 'bottom';
  context.fillText(title, box.left, box.top - 5);
}

/**
 * Draws a curve, with a dot at its last point.
 * @param {CanvasRenderingContext2D} context
 * @param {Axes} axes
 * @param {Curve} curve
 */
export function drawCurve(context, axes, { colour, points }) {
  const { box, yRange } = axes;
  const { x, y } = scales(axes);
  context.save();
  context.beginPath();
  context.rect(box.left, box.top - 2, box.width + 4, box.height + 4);
  context.clip();
  context.beginPath();
  let drawing = false;
  for (const [at, value] of points) {
    // Values below the range may be negative; clamping keeps their logarithm finite.
    const [px, py] = [x(at), y(Math.max(value, yRange[0] / 100))];
    if (drawing) context.lineTo(px, py);
    else context.moveTo(px, py);
    drawing = !Number.isNaN(value);
  }
  context.strokeStyle = colour;
  context.lineWidth = 2;
  context.lineJoin = 'round';
  context.stroke();
  const last = points.at(-1);
  if (last && !Number.isNaN(last[1])) {
    context.beginPath();
    context.arc(x(last[0]), y(Math.max(last[1], yRange[0] / 100)), 3, 0, 2 * Math.PI);
    context.fillStyle = colour;
    context.fill();
  }
  context.restore();
}

/**
 * Draws the legend of a curve, right-aligned in the line of the title.
 * @param {CanvasRenderingContext2D} context
 * @param {Axes} axes
 * @param {Curve} curve
 */
export function drawLegend(context, { box, palette }, { label, colour }) {
  const right = box.left + box.width;
  context.textAlign = 'right';
  context.textBaseline = 'bottom';
  context.fillStyle = palette.muted;
  context.fillText(label, right, box.top - 5);
  context.fillStyle = colour;
  context.fillRect(right - context.measureText(label).width - 18, box.top - 12, 12, 3);
}

/**
 * Draws a dashed horizontal line at a value, with a label.
 * @param {CanvasRenderingContext2D} context
 * @param {Axes} axes
 * @param {number} value
 * @param {string} label
 */
export function drawLevel(context, axes, value, label) {
  const { box, palette } = axes;
  const at = Math.round(scales(axes).y(value)) + 0.5;
  context.save();
  context.setLineDash([4, 4]);
  context.strokeStyle = palette.muted;
  drawLine(context, box.left, at, box.left + box.width, at);
  context.restore();
  context.fillStyle = palette.muted;
  context.textAlign = 'left';
  context.textBaseline = 'top';
  context.fillText(label, box.left + 5, at + 3);
}

/**
 * Draws a straight line.
 * @param {CanvasRenderingContext2D} context
 * @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1
 */
function drawLine(context, x0, y0, x1, y1) {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

/**
 * Ticks of a linear axis: multiples of a round step from 0 on.
 * @param {number} max end of the axis
 * @param {number} maxCount approximate maximum number of ticks
 */
export function linearTicks(max, maxCount) {
  const minStep = max / Math.max(1, maxCount);
  const power = 10 ** Math.floor(Math.log10(minStep));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= minStep) ?? minStep;
  const ticks = [];
  for (let k = 0; k * step <= max * (1 + 1e-9); k++) ticks.push(k * step);
  return ticks;
}

/**
 * The powers of ten on a logarithmic axis.
 * @param {readonly [number, number]} range
 * @param {number} maxCount approximate maximum number of ticks
 */
export function powersOfTen([low, high], maxCount) {
  const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
  const step = Math.max(1, Math.ceil((last - first + 1) / maxCount));
  return Array.from({ length: Math.max(0, Math.floor((last - first) / step) + 1) }, (_, i) => 10 ** (first + i * step));
}
