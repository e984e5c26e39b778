/** Text recognition: by the browser where it can, else by Tesseract, which is loaded when it is asked for. */

/** @typedef {{ text: string, box: readonly [number, number, number, number] }} TextLine a line of text; `box`: left, top, width and height in pixels */

/**
 * The lines of text in a picture.
 * @param {ImageData} image
 * @param {boolean} isWanted whether Tesseract is loaded where the browser recognises no text
 * @returns {Promise<TextLine[]>}
 */
export async function linesIn(image, isWanted) {
  const found = globalThis.TextDetector
    ? (await new globalThis.TextDetector().detect(image).catch(() => [])).map(({ rawValue, boundingBox }) => ({ text: rawValue, rect: boundingBox }))
    : isWanted ? await tesseractLines(image) : [];
  return found.flatMap(({ text, rect: { left, top, right, bottom } }) => {
    const [x, y, end, foot] = [Math.max(0, left), Math.max(0, top), Math.min(image.width, right), Math.min(image.height, bottom)];
    return text.trim() && x < end && y < foot ? [{ text: text.trim(), box: /** @type {const} */ ([x, y, end - x, foot - y]) }] : [];
  });
}

/**
 * Lines of English text by Tesseract, in a worker of its own, which ends with them.
 * @param {ImageData} image
 * @returns {Promise<{ text: string, rect: { left: number, top: number, right: number, bottom: number } }[]>}
 */
async function tesseractLines(image) {
  const { OCRClient } = await import(new URL('../vendor/text-client.js', import.meta.url).href);
  const [wasmBinary, packed] = await Promise.all([new URL('../vendor/text-core.wasm', import.meta.url), new URL('../vendor/text-english.bin', import.meta.url)].map((url) => fetch(url)));
  const model = new Response(packed.body?.pipeThrough(new DecompressionStream('gzip')));
  const client = new OCRClient({ workerURL: new URL('../vendor/text-worker.js', import.meta.url).href, wasmBinary: await wasmBinary.arrayBuffer() });
  try {
    await client.loadModel(await model.arrayBuffer());
    await client.loadImage(image);
    return await client.getTextBoxes('line');
  } finally {
    await client.destroy();
  }
}
