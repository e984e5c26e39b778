import { solve } from '../../../../app/solve.js';
import { solveHere } from '../../../../app/solve-here.js';

export const dynamic = 'force-dynamic';

export async function GET() {
  return Response.json({ worker: await solve(), here: await solveHere() });
}
