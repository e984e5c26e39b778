/** What the command takes for a phone's photo of 12 megapixels. */
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { init, load, writeImage, writePhoto } from '../../../pkg/direct.js';
import { command } from '../../../tests/js/support/command.mjs';
import { Problem } from '../../util/problem.mjs';
import { run } from '../../util/process.mjs';
import { depthCamera, finer, outline, poses, project, seenFrom, view } from '../phone/camera.mjs';
import { upright } from '../phone/pages.mjs';
import { jpeg, prints } from '../phone/print.mjs';
import { photograph, sensed } from '../phone/sensor.mjs';
import { digits, seconds } from '../text.mjs';

const camera = finer(depthCamera, 15.75);
const hook = pathToFileURL(fileURLToPath(new URL('../phone/peak.mjs', import.meta.url))).href;
/** Seconds, and bytes. */
const target = { seconds: 3, bytes: 500e6 };

/** @param {{ quick: boolean }} bench */
export async function phoneCommand({ quick }) {
  await init();
  await load('files', 'images', 'meshes', 'unroll');
  const folder = await mkdtemp(join(tmpdir(), 'developable-command-'));
  try {
    const { edges, crop } = await capture(folder);
    const depth = ['dewarp', 'depth.tif', '--intrinsics', 'camera.json', '--texture', 'photo.jpg', '-o', 'page.png'];
    /** @type {[string, string[]][]} */
    const tasks = [
      ['depths and photo', depth],
      ['cropped', [...depth, '--crop', crop]],
      ['cropped, with the warp map', [...depth, '--crop', crop, '--map', 'map.npy']],
      ['cropped, λ medium', [...depth, '--crop', crop, '--lambda', 'medium']],
      ['photo and edges', ['dewarp', 'photo.jpg', '--edges', edges, '--focal-length', String(camera.fx), '--page', 'a4', '-o', 'page.png']],
    ];
    const rows = [];
    for (const [name, args] of tasks) {
      /** @type {Awaited<ReturnType<typeof measured>>[]} */
      const tries = [];
      for (let k = 0; k < (quick ? 1 : 3); k += 1) tries.push(await measured(folder, args));
      const least = (/** @type {'seconds' | 'processor' | 'bytes'} */ key) => Math.min(...tries.map((one) => one[key]));
      const [time, bytes] = [least('seconds'), least('bytes')];
      const missed = [time > target.seconds ? 'time' : '', bytes > target.bytes ? 'memory' : ''].filter(Boolean);
      rows.push([name, seconds(time), seconds(least('processor')), `${digits(bytes / 1e6)} MB`, missed.join(', ') || 'none']);
      console.log(`  ${rows[rows.length - 1].join(', ')}`);
    }
    return {
      title: "The command with a phone's photo",
      text: `A photo of ${camera.width} × ${camera.height} pixels (JPEG) of an A4 page, depths of ${depthCamera.width} × ${depthCamera.height} (TIFF), `
        + 'and `developable dewarp` in Node from its start to its end: the fastest and the smallest of three runs, with the time that its threads were at work, which other programs on the machine do not add to, and all of its resident memory. '
        + 'Targets: 3 s and 500 MB.',
      columns: ['what', 'time', 'of the processor', 'memory', 'missed'],
      rows,
    };
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

/**
 * Writes what a phone gives.
 * @param {string} folder
 */
async function capture(folder) {
  const pose = poses[0];
  const { sheet } = await prints();
  const photo = photograph(view(upright, pose, camera), sheet.fine, upright);
  await writeFile(join(folder, 'photo.jpg'), await jpeg(writePhoto(photo), photo));
  const { width, height, data } = sensed(upright, pose, depthCamera, 1);
  const metres = data.map((depth) => (depth === 0 ? NaN : depth / 1000));
  await writeFile(join(folder, 'depth.tif'), writeImage({ width, height, data: metres }, { format: 'tiff' }));
  await writeFile(join(folder, 'camera.json'), JSON.stringify(camera));
  const space = seenFrom(upright, pose);
  const edge = (/** @type {number} */ v) =>
    Array.from({ length: 40 }, (_, i) => project(camera, space((i / 39) * upright.width, v)));
  await writeFile(join(folder, 'edges.json'), JSON.stringify({ top: edge(0), bottom: edge(upright.height) }));
  return { edges: 'edges.json', crop: outline(upright, pose, camera).flat().map((x) => x.toFixed(1)).join(',') };
}

/**
 * @param {string} folder
 * @param {string[]} args
 */
async function measured(folder, args) {
  const peak = join(folder, 'peak');
  const start = performance.now();
  const env = { ...process.env, PEAK_FILE: peak };
  const { ok, failure, output } = await run(process.execPath, ['--import', hook, command, ...args], { cwd: folder, env });
  const time = (performance.now() - start) / 1000;
  if (!ok) throw new Problem(`developable ${args.join(' ')} failed (${failure}): ${output}`);
  /** @type {{ bytes: number, processor: number }} */
  const cost = JSON.parse(await readFile(peak, 'utf8'));
  return { seconds: time, ...cost };
}
