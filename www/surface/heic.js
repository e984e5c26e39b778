/** Photos as iPhones write them: read by the browser where it can, else by libheif, which is loaded with the first of them. */

/** How the camera was held, as Exif data have it before its value: big and little endian. */
const ORIENTATION = /\x01\x12\0\x03\0{3}\x01\0|\x12\x01\x03\0\x01\0{3}/;
/** Most bytes of Exif data that a JPEG file holds. */
const MAX_EXIF_BYTES = 65_525;

/** A JPEG file of a photo in HEIC, with what is known of its camera. @param {File} file @returns {Promise<Blob>} */
export async function jpegOfHeic(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  const picture = await createImageBitmap(file).catch(() => decode(bytes));
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  const context = canvas.getContext('2d');
  if (!context) throw new Error('the browser gives no canvas of that size');
  if (picture instanceof ImageData) context.putImageData(picture, 0, 0);
  else context.drawImage(picture, 0, 0);
  const jpeg = await canvas.convertToBlob({ type: 'image/jpeg', quality: 1 });
  const exif = exifOf(bytes);
  const head = new Uint8Array([0xff, 0xe1, (exif.length + 2) >> 8, (exif.length + 2) & 255]);
  return exif.length > 0 ? new Blob([jpeg.slice(0, 2), head, exif, jpeg.slice(2)]) : jpeg;
}

/** @param {Uint8Array} bytes */
async function decode(bytes) {
  const [{ default: libheif }, wasm] = await Promise.all([
    import(new URL('../vendor/heif-client.js', import.meta.url).href), fetch(new URL('../vendor/heif-decoder.wasm', import.meta.url)),
  ]);
  const pictures = new (libheif({ wasmBinary: await wasm.arrayBuffer() }).HeifDecoder)().decode(bytes);
  const picture = pictures.find((/** @type {any} */ one) => one.is_primary()) ?? pictures[0];
  if (!picture) throw new Error('it is not HEIC, or damaged');
  const pixels = new ImageData(picture.get_width(), picture.get_height());
  if (await new Promise((resolve) => picture.display(pixels, resolve))) return pixels;
  throw new Error('it is damaged');
}

/** The Exif data of a photo that is upright now; none are empty. @param {Uint8Array<ArrayBuffer>} bytes */
function exifOf(bytes) {
  const text = new TextDecoder('latin1').decode(bytes);
  const start = text.search(/Exif\0\0(?:MM\0\*|II\*\0)/);
  if (start < 0) return new Uint8Array();
  const exif = bytes.slice(start, start + MAX_EXIF_BYTES);
  const held = ORIENTATION.exec(text.slice(start));
  if (held) exif[held.index + held[0].length] = 1;
  return exif;
}
