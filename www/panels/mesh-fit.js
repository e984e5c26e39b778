/** A mesh solved whole: before and after in space, what is known of it, and its files. */
import { download, element, elements, make } from '../dom.js';
import { percent } from '../format.js';
import { unitOf } from '../pattern.js';
import { plainly } from '../error-messages.js';
import { FORMAT_WORDS, WHOLE_WORDS } from '../messages.js';
import { MeshView } from '../surface/mesh-view.js';
import { PictureView } from '../surface/picture.js';
import { work } from '../surface/work.js';
import { Zoom } from '../surface/zoom.js';
import { gaussian, patches, readingAt, rulings, shaded, sheet, wholeInWords } from '../views/mesh-fit.js';
import { longestSide } from '../mesh-fit.js';
import { offerToSave } from './save-dialog.js';
import { offerSheets } from './sheets.js';
import { waitingPanel } from './waiting.js';

/** @import {Mesh} from '../api.js' */
/** @import {Session} from '../session.js' */
/** @import {MeshSurface, Whole} from '../mesh-fit.js' */
/** @import {WholeShown} from '../views/mesh-fit.js' */

/** Milliseconds for a vertex, until that was measured. */
const EACH = 0.1;
/** Share of a mesh behind what is seen of it, from which on it is better solved whole. */
const MUCH = 0.1;
/** Where the viewer looks at first: no side is seen straight. */
const OBLIQUE = /** @type {const} */ ([-0.5, -0.45, -0.75]);
/** @type {Record<string, (whole: Whole, mesh: Mesh, surface: MeshSurface) => Promise<WholeShown>>} */
const VIEWS = { shaded, gaussian, rulings, patches, sheet };

/** @param {Session} session @param {Whole} whole */
export function wholePanel(session, whole) {
  const side = element('heights-side', HTMLElement);
  const stage = element('whole', HTMLElement);
  const canvas = element('whole-canvas', HTMLCanvasElement);
  const missing = element('whole-missing', HTMLElement);
  const divider = element('whole-divider', HTMLInputElement);
  const divided = element('whole-divided', HTMLElement);
  const verdict = element('whole-verdict', HTMLElement);
  const detail = element('whole-detail', HTMLElement);
  const about = element('whole-about', HTMLElement);
  const hint = element('whole-hint', HTMLElement);
  const again = element('whole-again', HTMLButtonElement);
  const reading = element('whole-reading', HTMLElement);
  const ways = elements('input[name="mesh-way"]', HTMLInputElement);
  const radios = elements('input[name="whole-view"]', HTMLInputElement);
  const [file, sheets, flat] = ['file', 'sheets', 'flat'].map((name) => element(`whole-${name}`, HTMLButtonElement));
  const report = element('whole-report', HTMLButtonElement);
  const picture = new PictureView(element('whole-picture', HTMLCanvasElement), new Zoom());
  /** @type {Promise<MeshView | null> | null} */
  let viewer = null;
  /** Counts what was asked for, to tell the newest. */
  let asked = 0;
  /** The mesh that the input is seen of. @type {Mesh | null} */
  let present = null;
  /** The one that was turned. @type {Mesh | null} */
  let looked = null;
  /** What is told of a place. @type {WholeShown['read']} */
  let read;

  const waiting = waitingPanel(element('whole-waiting', HTMLElement), () => {
    asked++;
    whole.stop();
    waiting.end();
    const solving = !whole.surface;
    const kept = whole.restore();
    again.hidden = false;
    again.toggleAttribute('data-solves', solving);
    if (!kept) say('Cancelled.', '');
    else if (solving) detail.textContent = WHOLE_WORDS.kept;
    else about.replaceChildren(make('p', 'muted', 'Cancelled.'));
    stage.setAttribute('aria-busy', 'false');
    again.focus();
  });
  /** @param {Mesh} mesh @param {string} words @param {string} kind */
  const slow = (mesh, words, kind) => ({ words, kind, size: mesh.positions.length / 3, each: EACH });
  /** @param {string} words @param {string} more */
  const say = (words, more) => {
    verdict.textContent = words;
    detail.textContent = more;
  };

  /** @param {WholeShown} shown */
  const put = async ({ before, after, lines, flat: laid, read: told, about: nodes }) => {
    read = told;
    about.replaceChildren(...nodes);
    picture.show(laid ?? null);
    reading.textContent = '';
    viewer ??= MeshView.on(canvas, () => {}, { flatShading: true }).catch(() => null);
    const view = await viewer;
    missing.hidden = view !== null || laid !== undefined;
    canvas.hidden = view === null || laid !== undefined;
    divided.hidden = !after || canvas.hidden;
    for (const badge of stage.querySelectorAll('.badge')) badge.toggleAttribute('hidden', divided.hidden);
    if (laid || !view) return;
    view.show(before, after, lines);
    view.divide(after ? divider.valueAsNumber : 1);
  };

  const update = async () => {
    const turn = ++asked;
    const { mesh, surface } = whole;
    if (!mesh || !surface) return;
    const name = radios.find(({ checked }) => checked)?.value ?? 'shaded';
    const doing = slow(mesh, 'Preparing this view', `whole ${name}`);
    stage.setAttribute('aria-busy', 'true');
    again.hidden = true;
    if (name !== 'shaded') waiting.begin(doing);
    try {
      const shown = await VIEWS[name](whole, mesh, surface);
      if (turn !== asked) return;
      waiting.end(name === 'shaded' ? undefined : doing);
      await put(shown);
    } catch (error) {
      if (turn !== asked) return;
      waiting.end();
      session.fail('This view could not be worked out', error);
    } finally {
      if (turn === asked) stage.setAttribute('aria-busy', 'false');
    }
  };

  /** @param {boolean} ready */
  const enable = (ready) => {
    for (const end of [file, sheets, flat, report]) end.disabled = !ready;
    for (const radio of radios) radio.disabled = !ready;
  };

  const solve = () => {
    if (!present) return;
    session.watch(false);
    side.dataset.whole = '';
    stage.hidden = false;
    for (const radio of ways) radio.checked = radio.value === 'whole';
    void whole.solve(present, session.settings.lambda);
  };
  const leave = () => {
    if (stage.hidden) return;
    asked++;
    whole.leave();
    session.watch(true);
    waiting.end();
    stage.hidden = true;
    delete side.dataset.whole;
    for (const radio of ways) radio.checked = radio.value === 'seen';
  };
  /** @param {string} view */
  const choose = (view) => {
    for (const radio of radios) radio.checked = radio.value === view;
    if (!radios.some(({ checked }) => checked)) radios[0].checked = true;
  };
  /** @param {string} view */
  const enter = (view) => {
    choose(view);
    if (whole.mesh === null || whole.mesh !== present) solve();
    else if (whole.surface) void update();
  };
  session.on('settings', ({ lambda }) => {
    if (whole.mesh && lambda !== whole.lambda) solve();
  });

  whole.on('start', (mesh) => {
    asked++;
    say(WHOLE_WORDS.solving, '');
    enable(false);
    again.hidden = true;
    stage.setAttribute('aria-busy', 'true');
    waiting.begin(slow(mesh, 'Solving', 'whole'));
    void put({ before: mesh, about: [] }).then(async () => {
      // Solved once more, it stays as it was turned.
      if (looked !== mesh) (await viewer)?.look(OBLIQUE);
      looked = mesh;
    });
  });
  whole.on('progress', ({ iteration }) => {
    detail.textContent = WHOLE_WORDS.iterations(iteration);
  });
  whole.on('result', (surface) => {
    if (!whole.mesh) return;
    waiting.end(slow(whole.mesh, '', 'whole'));
    say(WHOLE_WORDS.solved, wholeInWords(whole.mesh, surface));
    enable(true);
    void update();
  });
  whole.on('failure', (error) => {
    waiting.end();
    stage.setAttribute('aria-busy', 'false');
    const words = plainly(error instanceof Error ? error.message : String(error));
    say(WHOLE_WORDS.unsolved, `${words[0].toUpperCase()}${words.slice(1)}.`);
  });

  report.addEventListener('click', () => {
    if (whole.surface) download(`${JSON.stringify(whole.surface.report, null, 2)}\n`, 'application/json', `${stem()}-report.json`);
  });
  divider.addEventListener('input', async () => (await viewer)?.divide(divider.valueAsNumber));
  for (const radio of radios) radio.addEventListener('change', () => void update());
  again.addEventListener('click', () => (whole.surface && !again.hasAttribute('data-solves') ? void update() : solve()));
  for (const radio of ways) radio.addEventListener('change', () => (radio.value === 'whole' ? enter('shaded') : leave()));
  /** The newest place of the pointer, which is looked at once in a frame. @type {{ offsetX: number, offsetY: number } | null} */
  let pointed = null;
  let frame = 0;
  const point = async () => {
    frame = 0;
    const view = await viewer;
    const { mesh, surface } = whole;
    const place = pointed && view?.under(pointed);
    reading.textContent = place && mesh && surface ? readingAt(mesh, surface, place, read?.(place)) : '';
  };
  /** @param {PointerEvent} event */
  const pointAt = ({ type, buttons, offsetX, offsetY }) => {
    // While it is turned, there is nothing to be read.
    pointed = type === 'pointermove' && buttons === 0 ? { offsetX, offsetY } : null;
    frame ||= requestAnimationFrame(() => void point());
  };
  canvas.addEventListener('pointermove', pointAt);
  canvas.addEventListener('pointerleave', pointAt);
  picture.canvas.addEventListener('pointermove', (event) => (reading.textContent = picture.read(event)));
  picture.canvas.addEventListener('pointerleave', () => (reading.textContent = ''));

  const stem = () => `${session.input?.name ?? 'mesh'}-developable`;
  file.addEventListener('click', () => {
    const { surface } = whole;
    if (!surface) return;
    offerToSave(session.api, {
      title: '3D file',
      stem: stem(),
      size: surface.positions.length / 3,
      formats: [
        { value: 'obj', name: 'OBJ', words: FORMAT_WORDS.obj, type: 'model/obj', write: (worker) => worker.writeObj(surface) },
        { value: 'stl', name: 'STL', words: FORMAT_WORDS.stl, type: 'model/stl', write: (worker) => worker.writeStl(surface) },
        { value: 'glb', name: 'GLB', words: FORMAT_WORDS.glb, type: 'model/gltf-binary', write: (worker) => worker.writeGlb(surface) },
        { value: 'ply', name: 'PLY', words: FORMAT_WORDS.ply, type: 'model/ply', write: (worker) => worker.writePly(surface) },
      ],
    });
  });
  flat.addEventListener('click', () => {
    const { surface } = whole;
    if (!surface) return;
    offerToSave(session.api, {
      title: 'Laid flat',
      stem: `${stem()}-flat`,
      size: surface.positions.length / 3,
      formats: [{
        value: 'obj', name: 'OBJ', words: FORMAT_WORDS.flatMesh, type: 'model/obj',
        write: async (worker) => {
          const { places, triangles } = await whole.unrolled(surface);
          const positions = Float64Array.from({ length: (places.length / 2) * 3 }, (_, i) => (i % 3 === 2 ? 0 : places[2 * Math.floor(i / 3) + (i % 3)]));
          return worker.writeObj({ positions, triangles });
        },
      }],
      closed: () => whole.stop(),
    });
  });
  sheets.addEventListener('click', () => {
    const { surface } = whole;
    if (!surface) return;
    const longest = longestSide(surface);
    offerSheets(session.api, {
      stem: stem(),
      size: surface.positions.length / 3,
      length: longest,
      unit: unitOf({ ...session.input, kind: 'mesh', unit: surface.unit ?? undefined }),
      cut: ({ side: length, ...options }) => whole.pattern(surface, { scale: length / longest, ...options }),
      svg: (drawing) => whole.svg(drawing),
      stop: () => whole.stop(),
    });
  });

  session.on('input', async ({ seen, lattice }) => {
    const mesh = seen?.mesh ?? null;
    if (mesh !== present && !stage.hidden) leave();
    present = mesh && mesh.triangles.length > 0 ? mesh : null;
    element('mesh-ways', HTMLElement).hidden = present === null;
    hint.textContent = '';
    if (!mesh || !present || !lattice?.frame) return;
    const { rows, cols, spacing, origin = [0, 0], heights, frame } = lattice;
    const { positions, triangles } = mesh;
    const hidden = await work('hiddenShare', { positions, triangles }, { rows, cols, spacing, origin, heights, frame });
    if (session.input?.lattice !== lattice || hidden < MUCH) return;
    hint.textContent = WHOLE_WORDS.hidden(percent(hidden));
  });

  return {
    /** What is shown of it, if it is shown. */
    get view() {
      return whole.mesh ? radios.find(({ checked }) => checked)?.value : undefined;
    },
    /** How much of the mesh is not seen from the chosen side; empty where that is little. */
    get hiddenInWords() {
      return hint.textContent ?? '';
    },
    enter,
    leave,
  };
}
