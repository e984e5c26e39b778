/** Every comparison there is, by the name that chooses it. */
import { accuracy } from './comparisons/accuracy.mjs';
import { conic } from './comparisons/conic.mjs';
import { dewarping } from './comparisons/dewarping.mjs';
import { flattening } from './comparisons/flattening.mjs';
import { gaps } from './comparisons/gaps.mjs';
import { meshes } from './comparisons/meshes.mjs';
import { memory } from './comparisons/memory.mjs';
import { nativeAndWasm } from './comparisons/native-and-wasm.mjs';
import { phone } from './comparisons/phone.mjs';
import { phoneCommand } from './comparisons/phone-command.mjs';
import { photoAlone } from './comparisons/photo-alone.mjs';
import { restarts } from './comparisons/restarts.mjs';
import { schedules } from './comparisons/schedules.mjs';
import { sizes } from './comparisons/sizes.mjs';
import { verdicts } from './comparisons/verdicts.mjs';

/** @type {Record<string, (bench: import('./bench.mjs').Bench) => Promise<import('./text.mjs').Table>>} */
export const tables = {
  schedules,
  conic,
  'native-and-wasm': nativeAndWasm,
  sizes,
  memory,
  meshes,
  gaps,
  accuracy,
  restarts,
  dewarping,
  flattening,
  phone,
  'photo-alone': photoAlone,
  'phone-command': phoneCommand,
  verdicts,
};
