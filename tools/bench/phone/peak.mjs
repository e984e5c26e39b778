/** Imported by a program that is measured: leaves in a file what it has cost. */
import { writeFileSync } from 'node:fs';

// Workers share the process and end before it.
process.on('exit', () => {
  const { maxRSS, userCPUTime, systemCPUTime } = process.resourceUsage();
  const cost = { bytes: 1024 * maxRSS, processor: (userCPUTime + systemCPUTime) / 1e6 };
  writeFileSync(String(process.env.PEAK_FILE), JSON.stringify(cost));
});
