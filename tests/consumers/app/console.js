import { solve, solveHere } from './solve.js';

console.log(JSON.stringify({ worker: await solve(), here: await solveHere() }));
