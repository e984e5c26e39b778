/** The direct API: a solve where it is called. */
import * as direct from 'developable/direct';
import { scan } from './scan.js';

export async function solveHere() {
  await direct.init();
  const { image, report } = direct.fit(scan(), { lambda: 'medium' });
  return { gap: report.gap, finite: image.data.every(Number.isFinite) };
}
