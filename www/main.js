/** Entry point of the page: creates the session and its panels, and connects them. */
import { Analyses } from './analyses.js';
import { connect } from './api.js';
import { element } from './dom.js';
import { isScene, isSolved } from './early.js';
import { filesPanel } from './panels/files.js';
import { galleryPanel } from './panels/gallery.js';
import { watchDrops, watchIncoming } from './panels/incoming.js';
import { headlinePanel } from './panels/headline.js';
import { homePanel } from './panels/home.js';
import { addressSyncPanel } from './panels/address-sync.js';
import { modePanel } from './panels/mode.js';
import { hideNotice, showNotice } from './panels/notice.js';
import { pagePanel } from './panels/page.js';
import { reportPanel } from './panels/report.js';
import { runPanel } from './panels/run.js';
import { settingsPanel } from './panels/settings.js';
import { sourcePanel } from './panels/source.js';
import { stripPanel } from './panels/strip.js';
import { PROGRESS_DELAY_MS, waitingPanel } from './panels/waiting.js';
import { heightsPanel } from './panels/heights.js';
import { meshFitPanel } from './panels/mesh-fit.js';
import { unfoldParts } from './kept.js';
import { Session } from './session.js';
import { MeshFit } from './mesh-fit.js';
import { loadThree } from './surface/scene.js';
import { errorMessage } from './messages.js';

async function start() {
  unfoldParts();
  // What draws the first scene is fetched beside the solver. The scene reports the error of an import that failed.
  if (isScene) loadThree().catch(() => {});
  const session = new Session(await connect());
  // The doors, and what is behind the other two, need no solver.
  const started = isSolved ? session.start() : undefined;
  const analyses = new Analyses(session.api.DevelopableWorker);
  const meshFit = new MeshFit(session.api);
  const { stage, heights } = heightsPanel(session, analyses);
  const { adopt } = settingsPanel(session, meshFit);
  const strip = stripPanel(session, adopt);
  const opening = waitingPanel(element('opening', HTMLElement), () => session.cancelOpening(), PROGRESS_DELAY_MS);
  session.on('opening', (task) => (task ? opening.begin(task) : opening.end()));
  const meshFitView = meshFitPanel(session, meshFit, stage, heights);
  runPanel(session, meshFit, stage);
  reportPanel(session, analyses);
  headlinePanel(session, analyses, stage, heights);
  const source = sourcePanel(session, adopt, stage.choose, (files) => void addressSync.rememberFiles(files), meshFitView.begin, (file) => void files.openColour(file));
  const page = pagePanel(session, (photos, shown) => void addressSync.rememberPhotos(photos, shown), (states, shown) => void addressSync.rememberOutlines(states, shown));
  const mode = modePanel(session);
  const files = filesPanel(session, mode, source, page);
  const gallery = galleryPanel(session, { adopt, choose: stage.choose, strip: strip.show, enter: () => mode.show('heights'), expectsInput: () => addressSync.expectsInput });
  element('notice-close', HTMLButtonElement).addEventListener('click', hideNotice);
  watchDrops((dropped) => void files.open(dropped));
  homePanel((chosen, door) => void files.open(chosen, door === 'page' || undefined), {
    page: () => void files.openIn('photo', page.showExample),
    scan: () => {
      mode.show('heights');
      void source.openExample('roof', { size: 400, noise: 0.02 });
    },
  });
  const addressSync = addressSyncPanel(session, {
    adopt, stage, openExample: source.openExample, openFiles: source.openFiles, reinterpretFile: source.reinterpretFile, gallery, mode,
    openHeights: (stored) => void files.open(stored), openPhotos: page.openStored, hasPhoto: page.hasPhoto, beginPhoto: page.begin, showExamplePhoto: page.showExample, meshFit, meshFitView,
  });
  await started;
  await addressSync.begin();
  watchIncoming((incoming) => void files.open(incoming));
}

start().catch((error) => {
  element('page', HTMLElement).dataset.phase = 'failed';
  element('verdict', HTMLElement).textContent = 'The page could not start.';
  showNotice(errorMessage('The solver could not be started', error));
});
