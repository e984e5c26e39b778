import type { PhotoCamera } from './types.js';

/**
 * The camera that a program for capturing or calibrating has written as a text: `fx, fy, cx, cy` in JSON; a matrix by rows
 * or by columns, in JSON (`K`, `intrinsic_matrix`, `camera_matrix`) or as a CSV of three rows; `fl_x, fl_y` as in
 * `transforms.json`; with sizes, lens distortion and pose where they are there. Where it does not say which images its
 * numbers are for, it is that of `images` whose middle the axis is nearest to; if it is near none, that is an error.
 */
export function parseCamera(text: string, images?: readonly { width: number; height: number }[]): PhotoCamera;
