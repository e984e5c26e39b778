/** The promise API: a solve in a worker, and work that takes other wasm files. The worker is left: a process has to end all the same. */
import { fit, read, unroll, writeImage } from 'developable';
import { scan } from './scan.js';

export async function solve() {
  const surface = await fit(scan(), { lambda: 'medium' });
  const { data } = await read(await writeImage(surface.image, { format: 'png' }));
  const { report } = await unroll(surface);
  return {
    gap: surface.report.gap,
    finite: surface.image.data.every(Number.isFinite),
    read: data.length === surface.image.data.length,
    // It is curved, so that it has more area than its outline.
    unrolled: report.area > 46 * 38 && report.area < 2 * 48 * 40,
  };
}
