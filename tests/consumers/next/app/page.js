'use client';

import { useEffect } from 'react';
import { solve } from '../../app/solve.js';
import { solveHere } from '../../app/solve-here.js';

export default function Page() {
  useEffect(() => {
    globalThis.outcome = (async () => ({ worker: await solve(), here: await solveHere() }))();
  }, []);
  return <p>developable</p>;
}
