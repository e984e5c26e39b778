/** Depth cameras: a known plane comes back from its depths; directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { refuses, run, silent, temporaryFolder } from './support/command.mjs';
import { error } from './support/error.mjs';

after(() => developable.dispose());
await Promise.all([direct.init(), direct.load('files', 'meshes')]);

const [width, height] = [64, 48];
const camera = { fx: 90, fy: 110, cx: 30, cy: 25 };

/** x to the right, y up, z backwards, on the ray of a pixel, 1 ahead. @param {number} i */
const ray = (i) => [((i % width) - 30) / 90, (25 - Math.floor(i / width)) / 110, -1];
/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b */
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** A plane at a slant: no flip or turn leaves it as it is. */
const normal = [0.36, 0.48, 0.8];
const away = -3;
const depths = Float64Array.from({ length: width * height }, (_, i) => away / dot(normal, ray(i)));
const image = { width, height, data: depths };

/** @param {ArrayLike<number>} positions */
function checkPlane(positions, tolerance = 1e-6) {
  assert.ok(positions.length > 3000);
  for (let i = 0; i < positions.length; i += 3) {
    const point = [positions[i], positions[i + 1], positions[i + 2]];
    assert.ok(Math.abs(dot(normal, point) - away) < tolerance, point.join());
  }
}

test('units, rays, masks and values without depth', () => {
  const mesh = direct.backProject(image, camera);
  const millimetres = depths.map((v) => 1000 * v);
  // What images are scaled by otherwise does not count.
  const scaled = direct.backProject({ ...image, data: millimetres, heightScale: 7, pixelSize: 3 }, { ...camera, depthScale: 0.001 });
  const rays = depths.map((v, i) => v * Math.hypot(...ray(i)));
  for (const other of [scaled, direct.backProject({ ...image, data: rays }, { ...camera, depth: 'ray' })]) {
    assert.ok(other.positions.every((v, i) => Math.abs(v - mesh.positions[i]) < 1e-12));
  }
  const mask = new Uint8Array(width * height).fill(1);
  mask[10 * width + 10] = 0;
  const holed = depths.slice();
  holed[20 * width + 10] = NaN;
  holed[20 * width + 20] = 0;
  holed[20 * width + 30] = 65535;
  const { triangles } = direct.backProject({ ...image, data: holed, mask, noData: 65535 }, camera);
  assert.equal(triangles.length, mesh.triangles.length - 4 * 4 * 3);
});

test('what is wrong with a camera is said', async () => {
  /** @param {any} changed */
  const changed = (changed) => () => direct.backProject(image, { ...camera, ...changed });
  assert.throws(changed({ fx: 0 }), error('OPTION', /`fx` is 0/));
  assert.throws(changed({ fy: 'long' }), error('OPTION', /`fy`/));
  assert.throws(changed({ cx: NaN }), error('OPTION', /`cx`/));
  assert.throws(changed({ cy: undefined }), error('OPTION', /fx, fy, cx and cy/));
  assert.throws(changed({ depthScale: -1 }), error('OPTION', /`depthScale`/));
  assert.throws(changed({ depth: 'radial' }), error('OPTION', /planar or ray/));
  assert.throws(changed({ k1: NaN }), error('OPTION', /`k1`/));
  assert.throws(changed({ k4: 0.1 }), error('OPTION', /k4/));
  assert.throws(() => direct.backProject(/** @type {any} */ ({}), camera), error('INPUT', /width/));
  assert.throws(() => direct.backProject({ ...image, data: [1, 2] }, camera), error('SHAPE', /depth image/));
  const none = { ...image, data: new Float64Array(width * height) };
  await assert.rejects(developable.backProject(none, camera), error('UNSUPPORTED', /no three neighbouring/));
  const surface = direct.sampleMesh(direct.backProject(image, camera), { view: 'best-fit', resolution: 60 });
  const square = { width: 10, height: 10, data: new Uint8ClampedArray(400) };
  assert.throws(() => direct.paint(surface, square), error('UNSUPPORTED', /10 × 10/));
  assert.throws(() => direct.paint(surface, square, { camera: { ...camera, width, height }, extent: [0, 0, 1, 1] }), error('OPTION', /extent/));
});

test('the command takes depths with --intrinsics', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'depth.npy'), direct.writeImage({ width, height, data: depths.map((v) => 1000 * v) }));
  await writeFile(join(folder, 'rays.npy'), direct.writeImage({ width, height, data: depths.map((v, i) => v * Math.hypot(...ray(i))) }));
  const grey = { width: 2 * width, height: 2 * height, data: new Uint8Array(16 * width * height).fill(128) };
  const photo = Buffer.from(direct.writePhoto(grey, { format: 'jpeg' }));
  await writeFile(join(folder, 'photo.jpg'), photo);
  await writeFile(join(folder, 'part.jpg'), await readFile(new URL('../data/grey.jpg', import.meta.url)));
  const { fx, fy, cx, cy } = camera;
  await writeFile(join(folder, 'phone.json'), JSON.stringify({ fx: 2 * fx, fy: 2 * fy, cx: 2 * cx + 0.5, cy: 2 * cy + 0.5, w: 2 * width, h: 2 * height }));
  const numbers = '--intrinsics 90,110,30,25';
  for (const [args, output] of [
    [`depth.npy ${numbers},0.001`, 'a.ply'],
    [`depth.npy ${numbers},0.001 --view best-fit`, 'b.ply'],
    [`rays.npy ${numbers} --ray --spacing 0.05`, 'c.obj'],
    [`rays.npy ${numbers} --ray --texture photo.jpg`, 'd.glb'],
    // Numbers that are about the photo, and a camera of its own.
    [`rays.npy --intrinsics phone.json --ray --texture photo.jpg`, 'e.glb'],
    [`rays.npy ${numbers} --ray --texture photo.jpg --photo-camera phone.json`, 'f.glb'],
  ]) {
    assert.deepEqual(await run(folder, `fit ${args} --lambda big -o ${output}`), silent, args);
    checkPlane(direct.readMesh(await readFile(join(folder, output))).positions, 1e-5);
  }
  assert.ok((await readFile(join(folder, 'd.glb'))).indexOf(photo) > 0);
  await refuses(folder, [
    [`fit depth.npy --intrinsics 90,110,30 -o x.ply`, /--intrinsics.*fx,fy,cx,cy/],
    [`fit depth.npy --intrinsics 90,110,30,b -o x.ply`, /--intrinsics/],
    [`fit depth.npy --intrinsics 0,110,30,25 -o x.ply`, /--fx|fx/],
    [`fit depth.npy --ray -o x.ply`, /--ray/],
    [`fit depth.npy ${numbers} --texture part.jpg -o x.ply`, /16 × 16 pixels.*another part/, 3],
    [`fit depth.npy ${numbers} --photo-camera phone.json -o x.ply`, /--texture/],
    [`fit depth.npy ${numbers} --texture photo.jpg -o x.stl`, /--texture.*\.glb/],
    [`fit depth.npy ${numbers} --texture missing.jpg -o x.glb`, /missing\.jpg/, 3],
    [`fit depth.npy ${numbers} --height-scale 2 -o x.ply`, /--height-scale/],
    [`fit a.ply ${numbers} -o x.ply`, /--intrinsics/],
    [`fit depth.npy ${numbers} --resolution 9 --spacing 1 -o x.ply`, /--spacing/],
  ]);
});

test('cameras from the files of other programs', () => {
  const numbers = { fx: 1400, fy: 1410, cx: 960, cy: 720 };
  const images = [{ width: 256, height: 192 }, { width: 1920, height: 1440 }];
  const sized = { ...numbers, width: 1920, height: 1440 };
  /** The image that they are for follows from the middle. @type {[string, object][]} */
  const known = [
    ['1400,0,960\n0,1410,720\n0,0,1\n', sized],
    ['1400 0 960\r\n0 1410 720\r\n0 0 1', sized],
    [JSON.stringify([[1400, 0, 960], [0, 1410, 720], [0, 0, 1]]), sized],
    [JSON.stringify({ intrinsics: [1400, 0, 0, 0, 1410, 0, 960, 720, 1] }), sized],
    [JSON.stringify({ camera: numbers }), sized],
    [JSON.stringify({ fl_x: 1400, fl_y: 1410, cx: 960, cy: 720, w: 1920, h: 1440, k1: 0.1 }), { ...sized, k1: 0.1 }],
    [JSON.stringify({ camera_matrix: { data: [1400, 0, 960, 0, 1410, 720, 0, 0, 1] }, distortion_coefficients: { data: [0.1, 0, 0, 0, 0.02] } }),
      { ...sized, k1: 0.1, k2: 0, p1: 0, p2: 0, k3: 0.02 }],
  ];
  for (const [text, expected] of known) {
    assert.deepEqual(developable.parseCamera(text, images), expected, text);
    assert.deepEqual(developable.parseCamera(`\uFEFF${text}`, images), expected, 'after a byte order mark');
  }
  assert.deepEqual(direct.parseCamera(known[0][0]), numbers, 'of no image that is known');
  for (const [text, message] of /** @type {[string, RegExp][]} */ ([
    ['', /no camera/], ['{', /no camera/], ['[]', /no camera/], ['{"camera":null}', /no camera/], ['1,2,3', /no camera/],
    ['1400,0,9600\n0,1410,720\n0,0,1', /far from the middle of 256 × 192 and of 1920 × 1440/],
  ])) {
    assert.throws(() => developable.parseCamera(text, images), (/** @type {any} */ error) =>
      error instanceof developable.DevelopableError && error.code === (/no camera/.test(error.message) ? 'FORMAT' : 'INPUT') && message.test(error.message), text);
  }
});

test('cameras as ROS, OpenCV, COLMAP, nerfstudio, Metashape, ZED and others write them', () => {
  const images = [{ width: 640, height: 480 }, { width: 4000, height: 3000 }];
  const plain = { fx: 525, fy: 520, cx: 319.5, cy: 239.5, width: 640, height: 480 };
  const lens = { k1: 0.1, k2: -0.2, p1: 0.001, p2: 0.002, k3: 0 };
  const list = '525.0, 0.0, 319.5, 0.0, 520.0, 239.5, 0.0, 0.0, 1.0';
  const angle = (/** @type {number} */ side) => 2 * Math.atan(side / 2 / 700);
  const wide = { fx: 700, fy: 700, cx: 320, cy: 240, width: 640, height: 480 };
  /** @type {[string, string, object][]} */
  const known = [
    ['ROS', `image_width: 640\nimage_height: 480\ncamera_name: head\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [${list}]\n` +
      'distortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.1, -0.2, 0.001,\n     0.002, 0.0]\n' +
      'rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n', { ...plain, ...lens }],
    ['ROS 2 by `topic echo`', `height: 480\nwidth: 640\ndistortion_model: plumb_bob\nd:\n- 0.1\n- -0.2\n- 0.001\n- 0.002\n- 0.0\nk:\n- ${list.split(', ').join('\n- ')}\nr:\n- 1.0\n`,
      { ...plain, ...lens }],
    ['OpenCV, YAML', `%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 525., 0., 319.5, 0., 520., 239.5, 0., 0., 1. ]\n`, plain],
    ['OpenCV, XML', '<?xml version="1.0"?>\n<opencv_storage>\n<Camera_Matrix type_id="opencv-matrix">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n' +
      '  <data>\n    525. 0. 319.5 0. 520. 239.5 0. 0. 1.</data></Camera_Matrix>\n</opencv_storage>', plain],
    ['COLMAP', '# Camera list with one line of data per camera:\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n1 OPENCV 640 480 525 520 319.5 239.5 0.1 -0.2 0.001 0.002\n',
      { ...plain, ...lens, k3: undefined }],
    ['COLMAP, one focal length', '3 SIMPLE_RADIAL 640 480 525 319.5 239.5 0.1\n', { ...plain, fy: 525, k1: 0.1 }],
    ['nerfstudio', JSON.stringify({ camera_model: 'OPENCV', w: 640, h: 480, frames: [{ file_path: 'a.png', fl_x: 525, fl_y: 520, cx: 319.5, cy: 239.5, transform_matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]] }] }), plain],
    ['instant-ngp', JSON.stringify({ camera_angle_x: angle(640), w: 640, h: 480, frames: [] }), wide],
    ['MoGe, of images of the same proportions', JSON.stringify({ fov_x: angle(640) * 180 / Math.PI, fov_y: angle(480) * 180 / Math.PI }), wide],
    ['a field of view of the longer side', JSON.stringify({ fov: angle(640) * 180 / Math.PI }), wide],
    ['shares of the sides', JSON.stringify({ intrinsics: [[700 / 640, 0, 0.5], [0, 700 / 480, 0.5], [0, 0, 1]] }), wide],
    ['Metashape: the axis from the middle, p1 and p2 the other way round', '<?xml version="1.0" encoding="UTF-8"?>\n<calibration>\n  <projection>frame</projection>\n  <width>640</width>\n' +
      '  <height>480</height>\n  <f>520</f>\n  <cx>-0.5</cx>\n  <cy>-0.5</cy>\n  <b1>5</b1>\n  <k1>0.1</k1>\n  <k2>-0.2</k2>\n  <k3>0</k3>\n  <p1>0.002</p1>\n  <p2>0.001</p2>\n</calibration>', { ...plain, ...lens }],
    ['ZED', '[LEFT_CAM_2K]\nfx=1396\nfy=1396\ncx=1104\ncy=611\n\n[LEFT_CAM_VGA]\nfx=525\nfy=520\ncx=319.5\ncy=239.5\n\n[RIGHT_CAM_VGA]\nfx=351\nfy=351\ncx=320\ncy=240\n\n[STEREO]\nBaseline=120\n', plain],
    ['ORB-SLAM', '%YAML:1.0\n# of the left one\nCamera.fx: 525.0\nCamera.fy: 520.0\nCamera.cx: 319.5\nCamera.cy: 239.5\n', plain],
    ['Kalibr', 'cam0:\n  camera_model: pinhole\n  distortion_coeffs: [0.1, -0.2, 0.001, 0.002]\n  distortion_model: radtan\n  intrinsics: [525, 520, 319.5, 239.5]\n  resolution: [640, 480]\n', { ...plain, ...lens, k3: undefined }],
    ['Kalibr, a line for each number', 'cam0:\n  camera_model: pinhole\n  distortion_coeffs:\n  - 0.1\n  - -0.2\n  - 0.001\n  - 0.002\n  intrinsics:\n  - 525\n  - 520\n  - 319.5\n  - 239.5\n' +
      '  resolution:\n  - 640\n  - 480\n  rostopic: /cam0/image_raw\n', { ...plain, ...lens, k3: undefined }],
    ['ROS, written anew by PyYAML', `camera_matrix:\n  cols: 3\n  data:\n  - ${list.split(', ').join('\n  - ')}\n  rows: 3\ndistortion_coefficients:\n  cols: 5\n  data:\n  - 0.1\n  - -0.2\n  - 0.001\n  - 0.002\n  - 0.0\n  rows: 1\n` +
      'image_height: 480\nimage_width: 640\n', { ...plain, ...lens }],
    ['ROS, as PyYAML writes a map without lines of its own', '{camera_matrix: {cols: 3, data: [525.0, 0.0, 319.5, 0.0, 520.0, 239.5, 0.0, 0.0, 1.0],\n    rows: 3}, camera_name: narrow, distortion_coefficients: {cols: 5, data: [0.1,\n' +
      '      -0.2, 0.001, 0.002, 0.0], rows: 1}, distortion_model: plumb_bob, image_height: 480,\n  image_width: 640}\n', { ...plain, ...lens }],
    ['a map of YAML over several lines', 'camera: {fx: 525, fy: 520,\n  cx: 319.5, cy: 239.5}\n', plain],
    ['MATLAB', JSON.stringify({ IntrinsicMatrix: [[525, 0, 0], [0, 520, 0], [319.5, 239.5, 1]], RadialDistortion: [0.1, -0.2], TangentialDistortion: [0.001, 0.002] }), { ...plain, ...lens, k3: undefined }],
    ['lists of rows by PyYAML', 'camera_matrix:\n- - 525.0\n  - 0.0\n  - 319.5\n- - 0.0\n  - 520.0\n  - 239.5\n- - 0.0\n  - 0.0\n  - 1.0\ndist_coeff:\n- - 0.1\n  - -0.2\n  - 0.001\n  - 0.002\n  - 0.0\n', { ...plain, ...lens }],
    ['ROS, within other fields', `left:\n  camera_info:\n    height: 480\n    width: 640\n    K:\n    - ${list.split(', ').join('\n    - ')}\n`, plain],
    ['four numbers', '525.0 520.0 319.5 239.5\n', plain],
    ['3 × 4', '525 0 319.5 0\n0 520 239.5 0\n0 0 1 0\n', plain],
    ['KITTI', 'P0: 5.25e+02 0 3.195e+02 0 0 5.2e+02 2.395e+02 0 0 0 1 0\n', plain],
    ['ROS, INI: names and values on lines of their own', `# oST version 5.0 parameters\n\n\n[image]\n\nwidth\n640\n\nheight\n480\n\n[narrow_stereo]\n\ncamera matrix\n` +
      '525.000000 0.000000 319.500000\n0.000000 520.000000 239.500000\n0.000000 0.000000 1.000000\n\ndistortion\n0.1 -0.2 0.001 0.002 0.000000\n\nrectification\n' +
      '1.0 0.0 0.0\n0.0 1.0 0.0\n0.0 0.0 1.0\n\nprojection\n500.0 0.0 320.0 0.0\n0.0 500.0 240.0 0.0\n0.0 0.0 1.0 0.0\n', { ...plain, ...lens }],
    ['OpenCV, the left one of a pair', `%YAML:1.0\n---\ncameraMatrix1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ ${list} ]\n` +
      'distCoeffs1: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ 0.1, -0.2, 0.001, 0.002, 0. ]\ncameraMatrix2: !!opencv-matrix\n   rows: 3\n   cols: 3\n' +
      '   dt: d\n   data: [ 1., 0., 2., 0., 1., 3., 0., 0., 1. ]\n', { ...plain, ...lens }],
    ['VINS, whose lens is a group of its own', '%YAML:1.0\n---\nmodel_type: PINHOLE\nimage_width: 640\nimage_height: 480\ndistortion_parameters:\n   k1: 0.1\n   k2: -0.2\n' +
      '   p1: 0.001\n   p2: 0.002\nprojection_parameters:\n   fx: 525\n   fy: 520\n   cx: 319.5\n   cy: 239.5\n', { ...plain, ...lens, k3: undefined }],
    ['the lens in a group of its own, JSON', JSON.stringify({ intrinsics: { fx: 525, fy: 520, cx: 319.5, cy: 239.5 }, distortion: { model: 'radtan', coefficients: [0.1, -0.2, 0.001, 0.002] } }),
      { ...plain, ...lens, k3: undefined }],
    ['PhotoScan: fx, and the axis from the corner', '<calibration type="frame" class="adjusted"><resolution width="640" height="480"/><fx>525</fx><fy>520</fy><cx>319.5</cx><cy>239.5</cy>' +
      '<p1>0.002</p1><p2>0.001</p2></calibration>', { ...plain, p1: 0.001, p2: 0.002 }],
    ['3D Gaussian splatting, whose rotation is no pose', JSON.stringify([{ id: 0, width: 640, height: 480, position: [0, 0, 1], rotation: [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], fx: 700, fy: 700 }]), wide],
    ['a table with names', 'timestamp, fx, fy, cx, cy\n0.1, 525, 520, 319.5, 239.5\n0.2, 526, 520, 319.5, 239.5\n', plain],
    ['names and values in one line', 'fx=525 fy=520 cx=319.5 cy=239.5', plain],
    ['a map of YAML in one line', 'camera: {fx: 525, fy: 520, cx: 319.5, cy: 239.5, width: 640, height: 480}\n', plain],
    ['as Python prints it', "{'fx': 525.0, 'fy': 520.0, 'cx': 319.5, 'cy': 239.5}", plain],
    ['four numbers and the lens', '525 520 319.5 239.5 0.1 -0.2 0.001 0.002\n', { ...plain, ...lens, k3: undefined }],
    ['a number as text', JSON.stringify({ hfov_deg: String(angle(640) * 180 / Math.PI) }), wide],
    ['NumPy, printed', '[[525.   0.  319.5]\n [  0.  520.  239.5]\n [  0.    0.    1. ]]', plain],
    ['OpenSfM: shares of the longer side, the axis from the middle of the pixels', JSON.stringify({ 'v2 unknown 640 480 perspective 0.85': { projection_type: 'perspective', width: 640, height: 480, focal: 0.85, k1: 0.1, k2: -0.2 } }),
      { fx: 544, fy: 544, cx: 319.5, cy: 239.5, width: 640, height: 480, k1: 0.1, k2: -0.2 }],
    ['OpenSfM, upright, with five coefficients', JSON.stringify({ all: { projection_type: 'brown', width: 480, height: 640, focal_x: 0.75, focal_y: 0.8, c_x: 0.01, c_y: -0.02, k1: 0.1, k2: -0.2, p1: 0.001, p2: 0.002, k3: 0 } }),
      { fx: 480, fy: 512, cx: 245.9, cy: 306.7, width: 480, height: 640, ...lens }],
    ['a focal length in millimetres beside a field of view', JSON.stringify({ focal: 50, fov: angle(640) * 180 / Math.PI, width: 640, height: 480 }), wide],
    ['maps within a map of YAML in one line', 'cam0: {fx: 525, fy: 520, cx: 319.5, cy: 239.5, distortion: {k1: 0.1, k2: -0.2}}\n', { ...plain, k1: 0.1, k2: -0.2 }],
    ['maps of YAML two deep', 'camera:\n  model: pinhole\n  intrinsics: {fx: 525, fy: 520, cx: 319.5, cy: 239.5}\n  distortion: {model: plumb_bob, coeffs: {k1: 0.1, k2: -0.2, p1: 0.001, p2: 0.002}}\n', { ...plain, ...lens, k3: undefined }],
    ['as Python prints it, within another', "{'cam': {'fx': 525.0, 'fy': 520.0, 'cx': 319.5, 'cy': 239.5}}", plain],
    ['as Python prints it, two of them', "{'left': {'fx': 525.0, 'fy': 520.0, 'cx': 319.5, 'cy': 239.5}, 'right': {'fx': 351.0, 'fy': 351.0, 'cx': 320.0, 'cy': 240.0}}", plain],
    ['as Python prints it in lines', "{'fx': 525.0,\n 'fy': 520.0,\n 'cx': 319.5,\n 'cy': 237.0}", { ...plain, cy: 237 }],
    ['maps of a list in YAML', 'cameras:\n  - id: left\n    intrinsics: {fx: 525, fy: 520, cx: 319.5, cy: 239.5}\n  - id: right\n    intrinsics: {fx: 351, fy: 351, cx: 320, cy: 240}\n', plain],
    ['maps of a list in YAML in one line each', 'cameras:\n  - {fx: 525, fy: 520, cx: 319.5, cy: 239.5}\n  - {fx: 351, fy: 351, cx: 320, cy: 240}\n', plain],
    ['a size beside the camera', JSON.stringify({ intrinsics: { fx: 525, fy: 520, cx: 1200, cy: 1000 }, resolution: [3072, 2304] }), { fx: 525, fy: 520, cx: 1200, cy: 1000, width: 3072, height: 2304 }],
    ['the axis to the right of the image only', JSON.stringify({ fx: 525, fy: 520, cx: 319.5, width: 640, height: 480 }), { ...plain, cy: 240 }],
    ['the axis down the image only', JSON.stringify({ fx: 525, fy: 520, cy: 239.5, width: 640, height: 480 }), { ...plain, cx: 320 }],
    ['`topic echo`, with the end of its document', `d:\n- 0.1\n- -0.2\n- 0.001\n- 0.002\n- 0.0\nk:\n- ${list.split(', ').join('\n- ')}\n---\n`, { ...plain, ...lens }],
    ['the end of a document of YAML', `k:\n- ${list.split(', ').join('\n- ')}\nd:\n- 0.1\n- -0.2\n- 0.001\n- 0.002\n- 0.0\n...\n`, { ...plain, ...lens }],
    ['a model that is a device', JSON.stringify({ model: 'OmniVision OV5647', fx: 525, fy: 520, cx: 319.5, cy: 239.5 }), plain],
    ['a model that is a device with a field of view', JSON.stringify({ model: 'HFOV 60 webcam', fx: 525, fy: 520, cx: 319.5, cy: 239.5 }), plain],
  ];
  for (const [name, text, expected] of known) {
    const found = /** @type {any} */ (developable.parseCamera(text, images));
    const wanted = Object.entries(expected).filter(([, value]) => value !== undefined);
    assert.deepEqual(Object.keys(found).sort(), wanted.map(([key]) => key).sort(), name);
    for (const [key, value] of wanted) assert.ok(Math.abs(found[key] - value) < 1e-9, `${name}: ${key} is ${found[key]}`);
  }
  const chain = (/** @type {string[]} */ ...lenses) => lenses.map((lens, i) => `cam${i}:\n  camera_model: pinhole\n  distortion_coeffs: [0.1, -0.2, 0.001, 0.002]\n` +
    `  distortion_model: ${lens}\n  intrinsics: [${525 - i}, 520, 319.5, 239.5]\n  resolution: [640, 480]\n`).join('');
  for (const [text, message] of /** @type {[string, RegExp][]} */ ([
    ['1 OPENCV_FISHEYE 640 480 500 500 320 240 0.1 0 0 0', /lens.*OPENCV_FISHEYE.*undistort/],
    [JSON.stringify({ fx: 500, fy: 500, cx: 320, cy: 240, distortionPolynomial: [0.1, 0.2] }), /distortionpolynomial.*lens/],
    ['1 FULL_OPENCV 640 480 500 500 320 240 0.1 0 0 0 0 0.2 0 0', /lens.*undistort/],
    ['<calibration><projection>fisheye</projection><width>640</width><height>480</height><f>300</f><cx>-4</cx><cy>0.5</cy></calibration>', /lens \(fisheye\)/],
    [JSON.stringify({ fl_x: 500, fl_y: 500, cx: 320, cy: 240, w: 640, h: 480, is_fisheye: true }), /lens \(fisheye\)/],
    ['Camera.type: "KannalaBrandt8"\nCamera1.fx: 190\nCamera1.fy: 190\nCamera1.cx: 320\nCamera1.cy: 240\n', /lens \(KannalaBrandt8\)/],
    [JSON.stringify({ all: { projection_type: 'fisheye', width: 640, height: 480, focal: 0.85, k1: 0, k2: 0 } }), /lens \(fisheye\)/],
    [JSON.stringify({ all: { projection_type: 'dual', width: 640, height: 480, focal: 0.85, k1: 0, k2: 0, transition: 1 } }), /lens \(dual\)/],
    ...['fisheye', 'OPENCV_FISHEYE', 'FOV', 'kannala_brandt4', 'Equidistant', 'omni'].map((model) => /** @type {[string, RegExp]} */ (
      [JSON.stringify({ model, fx: 525, fy: 520, cx: 319.5, cy: 239.5 }), new RegExp(`lens \\(${model}\\)`)])),
    ['distortion_model: KB\nfx: 525\nfy: 520\ncx: 319.5\ncy: 239.5\n', /lens \(KB\)/],
    // Of a pair of cameras of the same size it is the first one.
    [chain('equidistant', 'radtan'), /lens \(equidistant\)/],
  ])) assert.throws(() => developable.parseCamera(text, images), message);
  // The lens of another camera in the file says nothing of this one.
  assert.equal(developable.parseCamera(chain('radtan', 'equidistant'), images).fx, 525);
  assert.equal(developable.parseCamera('1 RADIAL_FISHEYE 3072 2304 2500 1536 1152 0.1 0.1\n2 PINHOLE 640 480 525 520 319.5 239.5\n', images).fx, 525);
  assert.equal(developable.parseCamera('1 RADIAL_FISHEYE 3072 1728 2500 1536 864 0.1 0.1\n2 PINHOLE 640 480 525 520 319.5 239.5\n', images).fx, 525);
  // COLMAP's cameras.bin: a camera of three numbers, and one with a lens.
  const binary = new DataView(new ArrayBuffer(8 + 24 + 3 * 8 + 24 + 8 * 8));
  const write = (/** @type {number} */ at, /** @type {number} */ model, /** @type {number[]} */ [w, h, ...numbers]) => {
    binary.setInt32(at + 4, model, true);
    binary.setBigUint64(at + 8, BigInt(w), true);
    binary.setBigUint64(at + 16, BigInt(h), true);
    numbers.forEach((number, i) => binary.setFloat64(at + 24 + 8 * i, number, true));
  };
  binary.setBigUint64(0, 2n, true);
  write(8, 0, [3072, 1728, 2500, 1536, 864]);
  write(56, 4, [640, 480, 525, 520, 319.5, 239.5, 0.1, -0.2, 0.001, 0.002]);
  const { k3: _, ...four } = lens;
  assert.deepEqual(developable.parseCamera(binary.buffer, images), { ...plain, ...four });
  assert.equal(developable.parseCamera(new Uint8Array(binary.buffer), [{ width: 1536, height: 864 }]).fx, 2500);
  assert.throws(() => developable.parseCamera(new Uint8Array(binary.buffer, 0, 100), images), /no camera/);
  assert.throws(() => developable.parseCamera('{"fov_x": 60}'), /size of the images/);
  assert.throws(() => developable.parseCamera(/** @type {any} */ (5)), error('INPUT', /text.*Uint8Array.*5/));
  // Open3D writes a pose before the camera.
  const posed = { extrinsic: [0.6, 0.8, 0, 0, -0.8, 0.6, 0, 0, 0, 0, 1, 0, 0.1, 0.2, 2, 1],
    intrinsic: { height: 480, intrinsic_matrix: [525, 0, 0, 0, 520, 0, 319.5, 239.5, 1], width: 640 } };
  assert.deepEqual(developable.parseCamera(JSON.stringify(posed)), plain);
});
