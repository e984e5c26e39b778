/** Whole meshes on the stage: the mesh and its fit in space, the views of it, and what it is saved as. */
import { closeDialogs, download, element } from '../dom.js';
import { choiceOf } from '../fields.js';
import { capitalised, percent, shortLambda } from '../format.js';
import { lengthUnitOf, modelOf } from '../pattern.js';
import { plainMessage } from '../error-messages.js';
import { MESH_FIT_WORDS } from '../messages.js';
import { boxOf, sidesOf, standsRather } from '../surface/triangles.js';
import { PAPER_LOOKS } from '../surface/scene.js';
import { meshField } from '../surface/layer.js';
import { curvature } from '../views/curvature.js';
import { figures } from '../views/legend.js';
import { readingAt, meshFacts, meshFitSummary } from '../views/mesh-fit.js';
import { patchesOfMesh } from '../views/patches.js';
import { photoOfMesh } from '../views/photo.js';
import { rulings } from '../views/rulings.js';
import { sheetOfMesh } from '../views/sheet.js';

/** @import {View} from './stage.js' */

/** Kinds of files whose programs take y for the axis that points upwards; those of the others take z. */
const Y_UP_KINDS = ['OBJ', 'GLB', 'GLTF'];

/** @param {Session} session @param {MeshFit} meshFit @param {Stage} stage @param {Subject} heights */
export function meshFitPanel(session, meshFit, stage, heights) {
  const hint = element('whole-hint', HTMLElement);
  const report = element('whole-report', HTMLButtonElement);
  /** The mesh that the input was sampled from, if it has triangles. @type {Mesh | null} */
  let inputMesh = null;
  /** The mesh that was turned to. @type {Mesh | null} */
  let viewedMesh = null;
  /** Whether the mesh is solved whole without being asked for: if that fails, it is shown from one side. */
  let isFirstSolve = false;

  /** Whether another axis points upwards than in other files of the kind. */
  let isTurned = false;
  /** The axis of the mesh that points upwards. */
  const upAxis = () => (Y_UP_KINDS.includes(session.input?.kind ?? '') !== isTurned ? 'y' : 'z');
  const stem = () => `${session.input?.name ?? 'mesh'}-developable`;
  /** @param {(surface: MeshSurface, mesh: Mesh, tell: Tell) => ReturnType<View>} prepare @returns {View} */
  const ofSurface = (prepare) => (tell) => prepare(/** @type {MeshSurface} */ (meshFit.surface), /** @type {Mesh} */ (meshFit.mesh), tell);
  /** The result, unless it is the input, which has no noise. */
  const fitted = () => (meshFit.surface?.report.stopReason === 'noNoise' ? null : meshFit.surface);
  /** Whether the mesh has textures or colours. */
  const isColoured = () => inputMesh?.colors !== undefined || (inputMesh?.uvs !== undefined && (inputMesh.textures ?? []).length > 0);
  /** @type {Subject['views']} */
  const views = {
    shaded: ofSurface(async (surface) => ({ about: [figures(meshFacts(surface))] })),
    gaussian: ofSurface(async (surface, mesh) => {
      // Curvature of flat faces is at their corners, and colours between these would be none of the faces'.
      if (!fitted() && (await meshFit.recognized(mesh)).kind === 'faces') return { said: MESH_FIT_WORDS.flatFaces };
      const [before, after] = await Promise.all([meshFit.curvatures(mesh), meshFit.curvatures(surface)]);
      return curvature('gaussian', mesh.unit, { before, after }, ({ gaussian }) => meshField(mesh, gaussian));
    }),
    rulings: ofSurface(async (surface, { unit }) => rulings((await meshFit.rulings(surface)).lines, unit)),
    patches: ofSurface(async (surface) => patchesOfMesh(surface, await meshFit.patches(surface))),
    photo: ofSurface((_, mesh) => photoOfMesh(mesh)),
    sheet: ofSurface(async (surface, { unit }, tell) => sheetOfMesh(unit ?? 'units', await meshFit.unrolled(surface, tell))),
  };
  /** @type {Subject} */
  const whole = {
    isWhole: true,
    name: () => session.input?.name ?? 'mesh',
    caption: () => session.input?.name ?? '',
    look: () => PAPER_LOOKS[upAxis()],
    box: () => meshFit.mesh && boxOf(meshFit.mesh.positions),
    surface: (side) => {
      const shown = side === 0 ? meshFit.mesh : fitted();
      return shown && { positions: shown.positions, triangles: shown.triangles, colors: shown.colors };
    },
    resultCaption: () => (meshFit.surface ? `λ = ${shortLambda(meshFit.surface.report.lambda)}` : ''),
    mark: () => '',
    isSolved: () => meshFit.surface !== null,
    isDivided: () => fitted() !== null,
    views,
    offers: (view) => view in views && (view !== 'photo' || isColoured()),
    read: (place, value) => (meshFit.mesh && meshFit.surface ? readingAt(meshFit.mesh, meshFit.surface, place, value) : ''),
    stop: () => {
      if (meshFit.surface) meshFit.stop();
    },
    run: () => solve(),
    cancel: () => meshFit.cancel(),
    saveFile: async () => {
      const { offerSurface } = await import('../solid.js');
      const { surface } = meshFit;
      if (surface) offerSurface(session.api, { stem: stem(), surface, positions: surface.positions, unit: surface.unit, onBase: false, mesh: async () => surface });
    },
    cutSheets: async () => {
      const { offerSheets } = await import('./sheets.js');
      const { surface } = meshFit;
      // The stage says why not.
      if (!surface) return closeDialogs();
      const longest = Math.max(...sidesOf(surface.positions));
      offerSheets(session.api, {
        stem: stem(),
        model: session.input ? modelOf(session.input) : '',
        length: longest,
        up: upAxis(),
        unit: lengthUnitOf({ ...session.input, kind: 'mesh', unit: surface.unit ?? undefined }),
        cut: ({ side: length, ...options }, tell) => meshFit.pattern(surface, { scale: length / longest, ...options }, tell),
        metalThickness: async () => (await meshFit.recognized(meshFit.mesh ?? surface)).thickness,
        isMesh: true,
        stop: () => whole.stop(),
        lambda: surface.report.lambda,
        cancelSolve: () => meshFit.cancel(),
        isFitted: fitted() !== null,
        solved: () => meshFit.next('result', 'failure', 'cancelled'),
        again: () => void whole.cutSheets(),
      });
    },
  };

  /** Shows the whole mesh and fits it. */
  const solve = () => {
    if (!inputMesh) return;
    isFirstSolve = false;
    session.setAutoRun(false);
    way.set('whole');
    void meshFit.solve(inputMesh, session.settings.lambda);
  };
  /** Returns to the input that was sampled from the mesh. */
  const leave = () => {
    meshFit.leave();
    stage.setSolving(false);
    session.setAutoRun(true);
    stage.enter(heights);
    way.set('seen');
  };
  /** Returns to one side of the mesh, and solves it if that has not been done. */
  const showOneSide = () => {
    if (stage.subject !== whole) return;
    leave();
    if (session.result?.input !== session.input) void session.run();
  };
  /** Shows a view of the whole mesh, and fits it if that has not been done. @param {string} view */
  const enter = (view) => {
    if (meshFit.mesh === null || meshFit.mesh !== inputMesh) solve();
    if (stage.subject === whole) stage.choose(view);
  };
  session.on('settings', ({ lambda }) => {
    if (meshFit.mesh && lambda !== meshFit.lambda) solve();
  });

  meshFit.on('start', (mesh) => {
    stage.enter(whole);
    stage.say(whole, MESH_FIT_WORDS.solving);
    stage.setSolving(true);
    // A further solve of the same mesh keeps the view.
    if (viewedMesh === mesh) stage.renew(whole);
    else stage.begin(whole, true);
    viewedMesh = mesh;
    stage.update(whole);
  });
  meshFit.on('result', (surface) => {
    stage.setSolving(false);
    stage.say(whole, MESH_FIT_WORDS.solved, meshFitSummary(surface));
    stage.renew(whole, [1]);
    stage.update(whole);
  });
  meshFit.on('cancelled', (isKept) => {
    stage.setSolving(false);
    stage.say(whole, isKept ? MESH_FIT_WORDS.solved : 'Cancelled.', isKept ? MESH_FIT_WORDS.kept : '');
  });
  meshFit.on('failure', (error) => {
    stage.setSolving(false);
    const reason = `${capitalised(plainMessage(error))}.`;
    stage.say(whole, MESH_FIT_WORDS.unsolved, reason);
    if (!isFirstSolve) return;
    showOneSide();
    hint.textContent = `${MESH_FIT_WORDS.unsolved} ${reason}`;
  });
  element('quarter-turn', HTMLButtonElement).addEventListener('click', () => {
    isTurned = !isTurned;
    stage.begin(whole);
  });
  report.addEventListener('click', () => {
    if (meshFit.surface) download(`${JSON.stringify(meshFit.surface.report, null, 2)}\n`, 'application/json', `${stem()}-report.json`);
  });
  const way = choiceOf('mesh-way', { seen: 'From one side', whole: 'Whole mesh' }, (chosen) => (chosen === 'whole' ? enter(stage.view) : showOneSide()));

  session.on('input', ({ sampling, lattice }) => {
    const mesh = sampling?.mesh ?? null;
    if (mesh !== inputMesh) {
      const [usual, other] = Y_UP_KINDS.includes(session.input?.kind ?? '') ? /** @type {const} */ ([1, 2]) : /** @type {const} */ ([2, 1]);
      isTurned = mesh !== null && standsRather(mesh.positions, other, usual);
      if (stage.subject === whole) leave();
    }
    inputMesh = mesh && mesh.triangles.length > 0 ? mesh : null;
    way.box.hidden = inputMesh === null;
    hint.textContent = inputMesh && lattice?.hidden ? MESH_FIT_WORDS.hidden(percent(lattice.hidden)) : '';
  });

  return {
    /** Whether a whole mesh is shown. */
    get isShown() {
      return stage.subject === whole;
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
      enter(isColoured() ? 'photo' : 'shaded');
      isFirstSolve = true;
    },
  };
}
