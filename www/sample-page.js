/** A picture of a page of text, which is printed on the surfaces of examples. */

/** Longer side of the page, in pixels. */
const PAGE_SIDE_PIXELS = 1400;

/** Text of the page, which is repeated until the page is full. */
const PAGE_TEXT = 'What bends like paper can be laid flat again without a stretch or a tear. '
  + 'Seen from above, lines that were printed straight become curves, and what slants away becomes narrow. '
  + 'From the heights it follows how far each point is from its neighbours along the sheet, and so where it was before the sheet was bent. ';

/**
 * Draws the page.
 * @param {number} wide width, in any unit
 * @param {number} high height, in the same unit
 * @returns {ImageData}
 */
export function samplePage(wide, high) {
  const scale = (PAGE_SIDE_PIXELS - 1) / Math.max(wide, high);
  const [width, height] = [Math.ceil(wide * scale) + 1, Math.ceil(high * scale) + 1];
  // An offscreen canvas also exists in workers.
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  if (!context) return new ImageData(width, height);
  context.fillStyle = '#fbfaf5';
  context.fillRect(0, 0, width, height);
  const [margin, line] = [width * 0.08, width * 0.034];
  context.fillStyle = '#22618f';
  context.font = `700 ${line * 1.7}px serif`;
  context.fillText('On laying paper flat', margin, margin + line * 1.4);
  context.fillStyle = '#23282d';
  context.font = `${line * 0.78}px serif`;
  const words = PAGE_TEXT.repeat(12).split(' ');
  const foot = height - margin - 4 * line;
  for (let y = margin + 3.6 * line; y < foot; y += line) {
    let text = '';
    while (words.length > 0 && context.measureText(`${text} ${words[0]}`).width < width - 2 * margin) text += ` ${words.shift()}`;
    context.fillText(text.trim(), margin, y);
    context.fillRect(margin, y + 0.25 * line, width - 2 * margin, 2);
  }
  const square = (width - 2 * margin) / 24;
  for (let i = 0; i < 24; i++) context.fillRect(margin + i * square, height - margin - (i % 2 === 0 ? 2 : 1) * square, square, square);
  context.lineWidth = 3;
  context.strokeStyle = '#22618f';
  context.strokeRect(margin / 2, margin / 2, width - margin, height - margin);
  return context.getImageData(0, 0, width, height);
}
