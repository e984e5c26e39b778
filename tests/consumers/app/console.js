import { solve } from './solve.js';
import { solveHere } from './solve-here.js';

console.log(JSON.stringify({ worker: await solve(), here: await solveHere() }));
