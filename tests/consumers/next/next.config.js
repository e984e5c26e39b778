import { fileURLToPath } from 'node:url';

/** The app is a folder within another project here, which is all that this says. */
const root = fileURLToPath(new URL('..', import.meta.url));
export default { turbopack: { root }, outputFileTracingRoot: root };
