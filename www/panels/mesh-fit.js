/** The fit of a whole mesh: mesh and result in space, views of the result, and files to save. */
import { download, element, elements, make } from '../dom.js';
import { percent } from '../format.js';
import { lengthUnitOf } from '../pattern.js';
import { plainMessage } from '../error-messages.js';
import { MESH_FIT_WORDS, TASK_WORDS } from '../messages.js';
import { OBLIQUE_VIEWS, SceneView } from '../surface/scene.js';
import { PictureView } from '../surface/picture-view.js';
import { gaussian, patches, readingAt, rulings, shaded, sheet, meshFitSummary } from '../views/mesh-fit.js';
import { longestSide } from '../mesh-fit.js';
import { surfaceFormats } from '../solid.js';
import { aboutView } from '../views/legend.js';
import { dividerOver } from './divider.js';
import { offerToSave } from './save-dialog.js';
import { offerSheets } from './sheets.js';
import { waitingPanel } from './waiting.js';

/** @import {Mesh} from '../api.js' */
/** @import {Session} from '../session.js' */
/** @import {MeshSurface, MeshFit} from '../mesh-fit.js' */
/** @import {MeshViewContent} from '../views/mesh-fit.js' */
/** @import {TaskProgress} from './waiting.js' */

/** Kinds of files whose programs take y for the axis that points upwards; those of the others take z. */
const Y_UP_KINDS = ['OBJ', 'GLB', 'GLTF'];
/** Functions that prepare the views, by their names. @type {Record<string, (meshFit: MeshFit, mesh: Mesh, surface: MeshSurface, tell: (progress: TaskProgress) => void) => Promise<MeshViewContent>>} */
const VIEWS = { shaded, gaussian, rulings, patches, sheet };

/** @param {Session} session @param {MeshFit} meshFit */
export function meshFitPanel(session, meshFit) {
  const side = element('heights-side', HTMLElement);
  const stage = element('whole', HTMLElement);
  const canvas = element('whole-canvas', HTMLCanvasElement);
  const missing = element('whole-missing', HTMLElement);
  const verdict = element('whole-verdict', HTMLElement);
  const detail = element('whole-detail', HTMLElement);
  const about = element('whole-about', HTMLElement);
  const hint = element('whole-hint', HTMLElement);
  const again = element('whole-again', HTMLButtonElement);
  const reading = element('whole-reading', HTMLElement);
  const ways = elements('input[name="mesh-way"]', HTMLInputElement);
  const radios = elements('input[name="whole-view"]', HTMLInputElement);
  const [file, sheets] = ['file', 'sheets'].map((name) => element(`whole-${name}`, HTMLButtonElement));
  const report = element('whole-report', HTMLButtonElement);
  const picture = new PictureView(element('whole-picture', HTMLCanvasElement));
  /** @type {Promise<SceneView | null> | null} */
  let viewer = null;
  const divider = dividerOver('whole-divider', ['input', 'result'], async (share) => (await viewer)?.divide(share));
  /** Number of the newest update; answers to older ones are discarded. */
  let newestUpdate = 0;
  /** The mesh that the input was sampled from, if it has triangles. @type {Mesh | null} */
  let inputMesh = null;
  /** The mesh that the viewer has been turned to. @type {Mesh | null} */
  let viewedMesh = null;
  /** Whether the mesh is solved whole without being asked for: if that fails, it is shown from one side. */
  let isFirstSolve = false;
  /** Reads the view's value at a place of the surface. @type {MeshViewContent['read']} */
  let readValue;

  const waiting = waitingPanel(element('whole-waiting', HTMLElement), () => {
    newestUpdate++;
    meshFit.stop();
    waiting.end();
    const wasSolving = !meshFit.surface;
    const isRestored = meshFit.restore();
    again.hidden = false;
    again.toggleAttribute('data-solves', wasSolving);
    if (!isRestored) say('Cancelled.', '');
    else if (wasSolving) detail.textContent = MESH_FIT_WORDS.kept;
    else about.replaceChildren(make('p', 'muted', 'Cancelled.'));
    stage.setAttribute('aria-busy', 'false');
    again.focus();
  });
  /** @param {string} sentence @param {string} details */
  const say = (sentence, details) => {
    verdict.textContent = sentence;
    detail.textContent = details;
  };

  /** @param {MeshViewContent} shown */
  const display = async (shown) => {
    const { before, after, lines, flat: laid, read } = shown;
    readValue = read;
    about.replaceChildren(...aboutView(shown));
    picture.show(laid ?? null);
    reading.textContent = '';
    viewer ??= SceneView.create(canvas, { isFaceted: true }).catch(() => null);
    const view = await viewer;
    missing.hidden = view !== null || laid !== undefined;
    canvas.hidden = view === null || laid !== undefined;
    const isDivided = after !== undefined && !canvas.hidden;
    divider.show(isDivided);
    for (const badge of stage.querySelectorAll('.badge')) badge.toggleAttribute('hidden', !isDivided);
    if (laid || !view) return;
    view.show(before, after, lines);
    view.divide(after ? divider.share : 1);
  };

  const update = async () => {
    const turn = ++newestUpdate;
    const { mesh, surface } = meshFit;
    if (!mesh || !surface) return;
    const name = radios.find(({ checked }) => checked)?.value ?? 'shaded';
    stage.setAttribute('aria-busy', 'true');
    again.hidden = true;
    if (name !== 'shaded') waiting.begin(TASK_WORDS.view);
    try {
      const shown = await VIEWS[name](meshFit, mesh, surface, waiting.tell);
      if (turn !== newestUpdate) return;
      waiting.end();
      await display(shown);
    } catch (error) {
      if (turn !== newestUpdate) return;
      waiting.end();
      session.fail('This view could not be worked out', error);
    } finally {
      if (turn === newestUpdate) stage.setAttribute('aria-busy', 'false');
    }
  };

  /** @param {boolean} ready */
  const enable = (ready) => {
    for (const button of [file, sheets, report]) button.disabled = !ready;
    for (const radio of radios) radio.disabled = !ready;
  };

  /** The axis of the mesh that points upwards. */
  const upAxis = () => (Y_UP_KINDS.includes(session.input?.kind ?? '') ? 'y' : 'z');
  /** Shows the whole mesh and fits it. */
  const solve = () => {
    if (!inputMesh) return;
    isFirstSolve = false;
    session.setAutoRun(false);
    side.dataset.whole = '';
    stage.hidden = false;
    for (const radio of ways) radio.checked = radio.value === 'whole';
    void meshFit.solve(inputMesh, session.settings.lambda);
  };
  /** Returns to the input that was sampled from the mesh. */
  const leave = () => {
    if (stage.hidden) return;
    newestUpdate++;
    meshFit.leave();
    session.setAutoRun(true);
    waiting.end();
    stage.hidden = true;
    delete side.dataset.whole;
    for (const radio of ways) radio.checked = radio.value === 'seen';
  };
  /** Returns to one side of the mesh, and solves it if that has not been done. */
  const showOneSide = () => {
    if (stage.hidden) return;
    leave();
    if (!session.result) void session.run();
  };
  /** @param {string} view */
  const choose = (view) => {
    for (const radio of radios) radio.checked = radio.value === view;
    if (!radios.some(({ checked }) => checked)) radios[0].checked = true;
  };
  /** Shows a view of the whole mesh, and fits it if that has not been done. @param {string} view */
  const enter = (view) => {
    choose(view);
    if (meshFit.mesh === null || meshFit.mesh !== inputMesh) solve();
    else if (meshFit.surface) void update();
  };
  session.on('settings', ({ lambda }) => {
    if (meshFit.mesh && lambda !== meshFit.lambda) solve();
  });

  meshFit.on('start', (mesh) => {
    newestUpdate++;
    say(MESH_FIT_WORDS.solving, '');
    enable(false);
    again.hidden = true;
    stage.setAttribute('aria-busy', 'true');
    waiting.begin(TASK_WORDS.solving);
    void display({ before: mesh }).then(async () => {
      // A further solve of the same mesh keeps the view.
      const view = await viewer;
      if (viewedMesh === mesh || !view) return;
      const { up, direction } = OBLIQUE_VIEWS[upAxis()];
      view.setUp(up);
      view.look(direction);
      view.turnOnce();
      viewedMesh = mesh;
    });
  });
  meshFit.on('progress', ({ iteration }) => {
    detail.textContent = MESH_FIT_WORDS.iterations(iteration);
  });
  meshFit.on('result', (surface) => {
    if (!meshFit.mesh) return;
    waiting.end();
    say(MESH_FIT_WORDS.solved, meshFitSummary(meshFit.mesh, surface));
    enable(true);
    void update();
  });
  meshFit.on('failure', (error) => {
    waiting.end();
    stage.setAttribute('aria-busy', 'false');
    const words = plainMessage(error instanceof Error ? error.message : String(error));
    say(MESH_FIT_WORDS.unsolved, `${words[0].toUpperCase()}${words.slice(1)}.`);
    if (!isFirstSolve) return;
    showOneSide();
    hint.textContent = `${MESH_FIT_WORDS.unsolved} ${detail.textContent}`;
  });

  report.addEventListener('click', () => {
    if (meshFit.surface) download(`${JSON.stringify(meshFit.surface.report, null, 2)}\n`, 'application/json', `${stem()}-report.json`);
  });
  for (const radio of radios) radio.addEventListener('change', () => void update());
  again.addEventListener('click', () => (meshFit.surface && !again.hasAttribute('data-solves') ? void update() : solve()));
  for (const radio of ways) radio.addEventListener('change', () => (radio.value === 'whole' ? enter('shaded') : showOneSide()));
  /** Newest position of the pointer; the value there is read once per frame. @type {{ offsetX: number, offsetY: number } | null} */
  let pointer = null;
  let frame = 0;
  const updateReading = async () => {
    frame = 0;
    const view = await viewer;
    const { mesh, surface } = meshFit;
    const place = pointer && view?.pick(pointer);
    reading.textContent = place && mesh && surface ? readingAt(mesh, surface, place, readValue?.(place)) : '';
  };
  /** @param {PointerEvent} event */
  const onPointer = ({ type, buttons, offsetX, offsetY }) => {
    // No value is shown while the mesh is turned.
    pointer = type === 'pointermove' && buttons === 0 ? { offsetX, offsetY } : null;
    frame ||= requestAnimationFrame(() => void updateReading());
  };
  canvas.addEventListener('pointermove', onPointer);
  canvas.addEventListener('pointerleave', onPointer);
  picture.canvas.addEventListener('pointermove', (event) => (reading.textContent = picture.read(event)));
  picture.canvas.addEventListener('pointerleave', () => (reading.textContent = ''));

  const stem = () => `${session.input?.name ?? 'mesh'}-developable`;
  file.addEventListener('click', () => {
    const { surface } = meshFit;
    if (!surface) return;
    const solid = surfaceFormats({ surface, length: longestSide(surface), unit: surface.unit, onBase: false, mesh: async () => surface });
    const offer = offerToSave(session.api, {
      title: '3D file',
      stem: stem(),
      unit: surface.unit,
      extra: [solid.fields],
      formats: solid.formats,
    });
    solid.onChange(offer.renew);
  });
  sheets.addEventListener('click', () => {
    const { surface } = meshFit;
    if (!surface) return;
    const longest = longestSide(surface);
    offerSheets(session.api, {
      stem: stem(),
      length: longest,
      up: upAxis(),
      unit: lengthUnitOf({ ...session.input, kind: 'mesh', unit: surface.unit ?? undefined }),
      cut: ({ side: length, ...options }, tell) => meshFit.pattern(surface, { scale: length / longest, ...options }, tell),
      svg: (drawing) => meshFit.svg(drawing),
      metalThickness: async () => (await meshFit.recognized(meshFit.mesh ?? surface)).thickness,
      canFoldElsewhere: ({ summary }) => summary.strain === 0,
      stop: () => meshFit.stop(),
    });
  });

  session.on('input', ({ sampling, lattice }) => {
    const mesh = sampling?.mesh ?? null;
    if (mesh !== inputMesh && !stage.hidden) leave();
    inputMesh = mesh && mesh.triangles.length > 0 ? mesh : null;
    element('mesh-ways', HTMLElement).hidden = inputMesh === null;
    hint.textContent = '';
    if (inputMesh && lattice?.hidden) hint.textContent = MESH_FIT_WORDS.hidden(percent(lattice.hidden));
  });

  return {
    /** Name of the view; undefined unless a whole mesh is shown. */
    get view() {
      return meshFit.mesh ? radios.find(({ checked }) => checked)?.value : undefined;
    },
    /** Sentence that says how much of the mesh is hidden from the chosen side; empty if that is little. */
    get hiddenInWords() {
      return hint.textContent ?? '';
    },
    enter,
    leave: showOneSide,
    /**
     * Solves a mesh that was opened: its heights from one side, or the whole of it if much is hidden from there or it has no noise
     * and no texture, which is flattened from one side.
     */
    begin() {
      const { hidden, noNoise } = session.input?.lattice ?? {};
      if (!inputMesh || !(hidden || (noNoise && !inputMesh.textures?.length))) return void session.run();
      enter('shaded');
      isFirstSolve = true;
    },
  };
}
