/** Entry point of the page: creates the session and its panels, and connects them. */
import { Analyses } from './analyses.js';
import { connect } from './api.js';
import { element } from './dom.js';
import { kindByName } from './file-kinds.js';
import { analysisPanel } from './panels/analysis.js';
import { inputImagesPanel } from './panels/input-images.js';
import { curvePanel } from './panels/curve.js';
import { designPanel } from './panels/design.js';
import { watchDrops } from './panels/drop.js';
import { editPanel } from './panels/edit.js';
import { galleryPanel } from './panels/gallery.js';
import { headlinePanel } from './panels/headline.js';
import { addressSyncPanel } from './panels/address-sync.js';
import { modePanel } from './panels/mode.js';
import { hideNotice, showNotice } from './panels/notice.js';
import { openingPanel } from './panels/opening.js';
import { pagePanel } from './panels/page.js';
import { reportPanel } from './panels/report.js';
import { runPanel } from './panels/run.js';
import { savePanel } from './panels/save.js';
import { settingsPanel } from './panels/settings.js';
import { sourcePanel } from './panels/source.js';
import { stripPanel } from './panels/strip.js';
import { viewsPanel } from './panels/views.js';
import { meshFitPanel } from './panels/mesh-fit.js';
import { Session } from './session.js';
import { MeshFit } from './mesh-fit.js';
import { errorMessage } from './messages.js';

async function start() {
  const session = new Session(await connect());
  const started = session.start();
  const analyses = new Analyses(session.api);
  const meshFit = new MeshFit(session.api);
  const { show, space } = viewsPanel(session);
  designPanel(session, space);
  editPanel(session, space);
  const { adopt } = settingsPanel(session, meshFit);
  const strip = stripPanel(session, adopt);
  openingPanel(session);
  const meshFitView = meshFitPanel(session, meshFit);
  inputImagesPanel(session);
  runPanel(session);
  curvePanel(session);
  reportPanel(session);
  const views = analysisPanel(session, analyses, show);
  headlinePanel(session, analyses);
  savePanel(session, analyses, views.choose, meshFitView);
  const { openExample, openFiles, reinterpretFile, openLoadedMesh } = sourcePanel(session, views, (files) => void addressSync.rememberFiles(files), (photo) => {
    mode.show('photo');
    void page.open(photo);
  });
  /** @param {File[]} files */
  const openHeights = (files) => {
    mode.enter('heights');
    void openFiles(files);
  };
  const page = pagePanel(session.api, ({ mesh }, name) => {
    mode.enter('heights');
    openLoadedMesh({ name, kind: 'photo' }, async () => mesh, 'The page could not be taken as a surface');
  }, openHeights, (file) => void addressSync.rememberPhoto(file));
  const mode = modePanel((entered) => {
    if (entered === 'photo') page.begin();
    addressSync.onModeChange();
  });
  const gallery = galleryPanel(session, { adopt, choose: views.choose, strip: strip.show, enter: () => mode.enter('heights') });
  element('notice-close', HTMLButtonElement).addEventListener('click', hideNotice);
  watchDrops((files) => {
    if (mode.now === 'photo' && (files.length === 1 || files.every((file) => kindByName(file) === 'picture'))) return void page.openAll(files);
    // Several files of other kinds are heights or a mesh with the files that belong to them.
    openHeights(files);
  });
  const addressSync = addressSyncPanel(session, {
    adopt, choose: views.choose, openExample, openFiles, openRecent: openHeights, reinterpretFile, gallery, mode, openPhoto: page.open,
    beginPhoto: page.begin, meshFit, meshFitView,
  });
  await started;
  await addressSync.begin();
}

start().catch((error) => {
  element('page', HTMLElement).dataset.phase = 'failed';
  element('verdict', HTMLElement).textContent = 'The page could not start.';
  showNotice(errorMessage('The solver could not be started', error));
});
