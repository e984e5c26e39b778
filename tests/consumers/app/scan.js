/** A curved page with some noise on it. */
export function scan() {
  const [width, height] = [48, 40];
  const data = Float64Array.from({ length: width * height }, (_, i) =>
    8 * Math.sin((i % width) / 12) + 0.1 * Math.sin(12.9898 * i));
  return { width, height, data };
}
