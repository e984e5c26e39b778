import { solveHere } from '../app/solve-here.js';

solveHere().then((here) => postMessage({ here }));
