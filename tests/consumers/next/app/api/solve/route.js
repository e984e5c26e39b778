import { solve, solveHere } from '../../../../app/solve.js';

export const dynamic = 'force-dynamic';

export async function GET() {
  return Response.json({ worker: await solve(), here: await solveHere() });
}
