/**
 * The colour of each normal under one light, as a texture over the unit disk (a "matcap").
 *
 * Steel shows its surroundings by reflection, so its tone depends on the angle between the mirrored view and the light only. The
 * surroundings are a studio: a bright window where the light is, a room that darkens away from it, a faint panel behind.
 * Reflection doubles every turn of the normal, which is why the paper shows developability this way. Paper is matt.
 */

/** Side of the texture. */
export const MATCAP_SIDE_TEXELS = 128;
/** Radius of the disk on which a renderer looks up a normal, in half sides of the texture. */
const DISK_RADIUS = 0.99;
/** Place of the light above the unit disk that stands for the directions towards the viewer, y up. */
const LIGHT = { x: -0.38, y: 0.42 };
/** Colour of paper in full light. */
const PAPER_COLOUR = [244, 246, 248];

/** Brightness of the studio, 0 to 1, at an angle to the light given by its cosine. @param {number} cosine */
function studioBrightness(cosine) {
  const room = ((1 + cosine) / 2) ** 2;
  const window = Math.exp((cosine - 1) / 0.13);
  const panel = Math.exp(-(((cosine + 0.5) / 0.22) ** 2));
  return 0.22 + 0.4 * room + 0.38 * window + 0.16 * panel;
}

/**
 * The unit vector towards the light along the axes of the view. It turns twice as far as the camera is tilted, so that a level
 * surface mirrors the same from every side.
 * @param {number} tilt in radians, from straight above
 * @returns {[number, number, number]}
 */
export function lightFrom(tilt) {
  const z = Math.sqrt(1 - LIGHT.x ** 2 - LIGHT.y ** 2);
  const [c, s] = [Math.cos(2 * tilt), Math.sin(2 * tilt)];
  return [LIGHT.x, c * LIGHT.y + s * z, c * z - s * LIGHT.y];
}

/**
 * Fills a texture with the colour of every normal under a light, the lowest row first.
 * @param {Uint8Array} texels RGBA
 * @param {readonly [number, number, number]} light unit vector towards the light
 * @param {{ isMetal: boolean, isPale: boolean }} look `isPale`: for surfaces with colours of their own, which nearly keep these
 */
export function fillMatcap(texels, [lx, ly, lz], { isMetal, isPale }) {
  const step = 2 / (MATCAP_SIDE_TEXELS - 1) / DISK_RADIUS;
  const [r, g, b] = isMetal || isPale ? [255, 255, 255] : PAPER_COLOUR;
  for (let j = 0, i = 0; j < MATCAP_SIDE_TEXELS; j++) {
    for (let k = 0; k < MATCAP_SIDE_TEXELS; k++, i += 4) {
      const [x, y] = [k * step - 1 / DISK_RADIUS, j * step - 1 / DISK_RADIUS];
      const outside = Math.max(1, Math.sqrt(x * x + y * y));
      const [nx, ny] = [x / outside, y / outside];
      const nz = Math.sqrt(Math.max(0, 1 - nx * nx - ny * ny));
      const facing = nx * lx + ny * ly + nz * lz;
      // The cosine between the light and the view (0, 0, 1) mirrored at the normal, or the normal itself.
      const tone = isMetal ? studioBrightness(2 * nz * facing - lz) : 0.4 + 0.3 * (1 + facing);
      const shown = isPale ? 0.45 + 0.55 * tone : tone;
      // Dark tones of steel are bluish, bright ones white.
      const tint = isMetal && !isPale ? 0.1 * (1 - tone) : 0;
      texels[i] = Math.min(255, r * shown * (1 - tint));
      texels[i + 1] = Math.min(255, g * shown);
      texels[i + 2] = Math.min(255, b * shown * (1 + 1.3 * tint));
      texels[i + 3] = 255;
    }
  }
}
