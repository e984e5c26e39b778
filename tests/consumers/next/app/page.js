'use client';

import { useEffect } from 'react';
import { solve, solveHere } from '../../app/solve.js';

export default function Page() {
  useEffect(() => {
    globalThis.outcome = (async () => ({ worker: await solve(), here: await solveHere() }))();
  }, []);
  return <p>developable</p>;
}
