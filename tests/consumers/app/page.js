import { solve } from './solve.js';
import { solveHere } from './solve-here.js';

globalThis.outcome = (async () => ({ worker: await solve(), here: await solveHere() }))();
