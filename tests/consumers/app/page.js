import { solve, solveHere } from './solve.js';

globalThis.outcome = (async () => ({ worker: await solve(), here: await solveHere() }))();
