/**
 * Error codes. Those of the Rust crate (`Error::code`):
 * - `EMPTY`: heights or a picture have no values;
 * - `SHAPE`: an array is not as long as rows and columns say;
 * - `NOT_FINITE`: a number is infinite or NaN where none may be;
 * - `NO_INTERIOR`: no vertex has heights all around it;
 * - `OVERFLOW`, `UNDERFLOW`: heights or lengths are too large or too small for double precision;
 * - `TOO_LARGE`: there are more heights or pixels than can be held;
 * - `TOPOLOGY`: a mesh that is no surface with two sides, as a Möbius strip;
 * - `UNDERDETERMINED`: a part of the surface that its constraints and confidences do not hold in place;
 * - `EDGES`: traced edges that cannot be those of a page;
 * - `NO_PAGE`: no page was found in a photo, so that its edges have to be given;
 * - `CURVED_FOLD`: a fold along which sheet metal cannot be bent, since it is curved;
 * - `NOT_FLAT`: a part of a surface that no cut lays flat within the limits of a pattern;
 * - `OPTION`: an option is unknown, of the wrong type or out of range;
 * - `FORMAT`: a file is damaged, or of another format;
 * - `UNSUPPORTED`: a file or a request is valid, but not supported;
 * - `OUT_OF_MEMORY`.
 *
 * Those of the JS side:
 * - `INPUT`: an argument is not of the documented shape;
 * - `NOT_INITIALIZED`: a direct function was called before `init` was done;
 * - `INIT`: the wasm could not be loaded (may be tried again);
 * - `DISPOSED`: the solver or worker was used after its disposal, or disposed while it worked;
 * - `REPLACED`: a newer `fit` of the same open solver took the place of this one;
 * - `TRAP`: the wasm crashed, which is a bug to report; direct functions stay unusable, workers are replaced;
 * - `WORKER`: the worker could not be started or died.
 */
export type ErrorCode =
  | 'EMPTY' | 'SHAPE' | 'NOT_FINITE' | 'NO_INTERIOR' | 'UNDERDETERMINED' | 'TOPOLOGY' | 'OPTION' | 'OVERFLOW' | 'UNDERFLOW'
  | 'TOO_LARGE' | 'OUT_OF_MEMORY' | 'EDGES' | 'NO_PAGE' | 'CURVED_FOLD' | 'NOT_FLAT'
  | 'FORMAT' | 'UNSUPPORTED'
  | 'INPUT' | 'NOT_INITIALIZED' | 'INIT' | 'DISPOSED' | 'REPLACED' | 'TRAP' | 'WORKER';

/** Error that every function of the package throws or rejects with, besides the reason of an abort signal and what a callback throws. */
export class DevelopableError extends Error {
  /** Name of the class of errors. */
  readonly name: 'DevelopableError';
  /** Code of the error, stable, for programs. The message is for people. */
  readonly code: ErrorCode;
  /** Makes an error of the package. */
  constructor(code: ErrorCode, message: string, options?: { cause?: unknown });
}

/** Returns the message of anything that was thrown. */
export function messageOf(thrown: unknown): string;
