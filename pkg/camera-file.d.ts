import type { PhotoCamera } from './types.js';

/**
 * The camera that a program for capturing or calibrating has written: JSON (with `fx, fy, cx, cy`, or `fl_x, fl_y` and
 * `camera_angle_x` as in `transforms.json`, a field of view, a matrix, or as OpenSfM writes it), YAML and XML of ROS, OpenCV and Metashape, COLMAP's
 * `cameras.txt` and `cameras.bin`, INI of ROS and ZED, CSV, four numbers, or a matrix of 3 × 3 by rows or by columns, 3 × 4 or
 * 4 × 4; with sizes, lens distortion and pose where they are there. A field of view is in degrees or radians. Of several cameras it is the first one that fits
 * `images`. Where it does not say which images its numbers are for, it is that of `images` whose middle the axis is nearest to; if
 * it is near none, that is an error, as is a lens that `k1` to `k3`, `p1` and `p2` do not describe. A file without a camera throws with
 * code `FORMAT`.
 */
export function parseCamera(file: string | Uint8Array | ArrayBuffer, images?: readonly { width: number; height: number }[]): PhotoCamera;
