/** Imported by a program that is measured: leaves the most memory that it had, in kB, in a file. */
import { writeFileSync } from 'node:fs';

// Workers share the process and end before it.
process.on('exit', () => writeFileSync(String(process.env.PEAK_FILE), String(process.resourceUsage().maxRSS)));
