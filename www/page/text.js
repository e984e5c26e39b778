/** Text recognition by Tesseract, which is loaded when it is asked for. */

/** @typedef {{ text: string, box: readonly [number, number, number, number] }} TextLine a line of text; `box`: left, top, width and height in pixels */

/** The lines of English text in a picture, found in a worker of its own, which ends with them. @param {ImageData} image @returns {Promise<TextLine[]>} */
export async function linesIn(image) {
  const { OCRClient } = await import(new URL('../vendor/text-client.js', import.meta.url).href);
  const [wasmBinary, packed] = await Promise.all([new URL('../vendor/text-core.wasm', import.meta.url), new URL('../vendor/text-english.bin', import.meta.url)].map((url) => fetch(url)));
  const model = new Response(packed.body?.pipeThrough(new DecompressionStream('gzip')));
  const client = new OCRClient({ workerURL: new URL('../vendor/text-worker.js', import.meta.url).href, wasmBinary: await wasmBinary.arrayBuffer() });
  try {
    await client.loadModel(await model.arrayBuffer());
    await client.loadImage(image);
    /** @type {{ text: string, rect: { left: number, top: number, right: number, bottom: number } }[]} */
    const found = await client.getTextBoxes('line');
    return found.filter(({ text }) => text.trim()).map(({ text, rect: { left, top, right, bottom } }) => ({ text: text.trim(), box: [left, top, right - left, bottom - top] }));
  } finally {
    await client.destroy();
  }
}
