/**
 * The colour of steel under one light, as a table from normals to colours.
 *
 * A polished surface shows its surroundings by reflection, so its tone depends on the angle
 * between the mirrored view and the light only. The surroundings are a studio: a bright window
 * where the light is, a room that darkens away from it, a faint panel behind. Reflection doubles
 * every turn of the normal, which is why the paper shows developability this way.
 */
import { EMPTY_ENTRY, TABLE_SIDE } from './raster.js';

/** Number of entries of the table of tones. */
const TONE_TABLE_SIZE = 2048;
const toneTable = tabulateTones();

/**
 * Brightness of the studio, 0 to 1, at an angle to the light given by its cosine.
 * @param {number} cosine
 */
function studioBrightness(cosine) {
  const room = ((1 + cosine) / 2) ** 2;
  const window = Math.exp((cosine - 1) / 0.13);
  const panel = Math.exp(-(((cosine + 0.5) / 0.22) ** 2));
  return 0.12 + 0.46 * room + 0.42 * window + 0.2 * panel;
}

/** The colour of steel in GLSL: the brightness of the studio, tinted. */
export const STUDIO_GLSL = `
vec3 steel(float cosine) {
  float room = (1.0 + cosine) * (1.0 + cosine) / 4.0;
  float panel = (cosine + 0.5) / 0.22;
  float tone = 0.12 + 0.46 * room + 0.42 * exp((cosine - 1.0) / 0.13) + 0.2 * exp(-panel * panel);
  float tint = 0.1 * (1.0 - tone);
  return clamp(tone * vec3(1.0 - tint, 1.0, 1.0 + 1.3 * tint), 0.0, 1.0);
}`;

/** The colour of steel at evenly spaced cosines from −1 to 1, as pixels of a canvas. */
function tabulateTones() {
  const bytes = new Uint8ClampedArray(4 * TONE_TABLE_SIZE);
  for (let i = 0; i < TONE_TABLE_SIZE; i++) {
    const tone = studioBrightness((2 * i) / (TONE_TABLE_SIZE - 1) - 1);
    // Dark tones are bluish, bright ones white.
    const tint = 0.1 * (1 - tone);
    bytes.set([255 * tone * (1 - tint), 255 * tone, 255 * tone * (1 + 1.3 * tint), 255], 4 * i);
  }
  return new Uint32Array(bytes.buffer);
}

/**
 * Fills `table` with the colour of every normal under a light.
 * @param {Uint32Array} table `NOTHING + 1` entries
 * @param {readonly [number, number, number]} light unit vector towards the light
 */
export function fillSteelTable(table, [lx, ly, lz]) {
  const step = 2 / (TABLE_SIDE - 1);
  for (let j = 0, i = 0; j < TABLE_SIDE; j++) {
    const ny = j * step - 1;
    for (let k = 0; k < TABLE_SIDE; k++, i++) {
      const nx = k * step - 1;
      const nz = Math.sqrt(Math.max(0, 1 - nx * nx - ny * ny));
      // The dot product of the light with the view (0, 0, 1) mirrored at the normal.
      const cosine = 2 * nz * (nx * lx + ny * ly) + (2 * nz * nz - 1) * lz;
      const tone = Math.round((Math.min(1, Math.max(-1, cosine)) + 1) * 0.5 * (TONE_TABLE_SIZE - 1));
      table[i] = toneTable[tone];
    }
  }
  table[EMPTY_ENTRY] = 0;
}
