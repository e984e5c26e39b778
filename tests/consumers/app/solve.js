/** What every tool has to bring to run: a solve, and work that takes others of the package's wasm files. */
import { dispose, fit, read, unroll, writePng } from 'developable';
import * as direct from 'developable/direct';

/** A curved page with some noise on it. */
function scan() {
  const [width, height] = [48, 40];
  const data = Float64Array.from({ length: width * height }, (_, i) =>
    8 * Math.sin((i % width) / 12) + 0.1 * Math.sin(12.9898 * i));
  return { width, height, data };
}

/** In a worker. */
export async function solve() {
  const surface = await fit(scan(), { lambda: 'medium' });
  const { data } = await read(await writePng(surface.image));
  const { report } = await unroll(surface);
  dispose();
  return {
    gap: surface.report.gap,
    finite: surface.image.data.every(Number.isFinite),
    read: data.length === surface.image.data.length,
    // It is curved, so that it has more area than its outline.
    unrolled: report.area > 46 * 38 && report.area < 2 * 48 * 40,
  };
}

/** Where it is called. */
export async function solveHere() {
  await direct.init();
  const { image, report } = direct.fit(scan(), { lambda: 'medium' });
  return { gap: report.gap, finite: image.data.every(Number.isFinite) };
}
