/** Puts the page together. */
import { Analyses } from './analyses.js';
import { connect } from './api.js';
import { element } from './dom.js';
import { kindByName } from './file-kinds.js';
import { analysisPanel } from './panels/analysis.js';
import { besidePanel } from './panels/beside.js';
import { curvePanel } from './panels/curve.js';
import { designPanel } from './panels/design.js';
import { watchDrops } from './panels/drop.js';
import { editPanel } from './panels/edit.js';
import { galleryPanel } from './panels/gallery.js';
import { headline } from './panels/headline.js';
import { keepPanel } from './panels/address-sync.js';
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
import { wholePanel } from './panels/mesh-fit.js';
import { Session } from './session.js';
import { Whole } from './mesh-fit.js';
import { complaint } from './messages.js';

async function start() {
  const session = new Session(await connect());
  const started = session.start();
  const analyses = new Analyses(session.api);
  const whole = new Whole(session.api);
  const { show, space } = viewsPanel(session);
  designPanel(session, space);
  editPanel(session, space);
  const { adopt } = settingsPanel(session, whole);
  const strip = stripPanel(session, adopt);
  openingPanel(session);
  const solvedWhole = wholePanel(session, whole);
  besidePanel(session);
  runPanel(session);
  curvePanel(session);
  reportPanel(session);
  const views = analysisPanel(session, analyses, show);
  headline(session, analyses);
  savePanel(session, analyses, views.choose, solvedWhole);
  const { openNamed, openFiles, understand, takeMesh } = sourcePanel(session, views, (files) => void keep.remember(files), (photo) => {
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
    takeMesh({ name, kind: 'photo' }, async () => mesh, 'The page could not be taken as a surface');
  }, openHeights, (file) => void keep.rememberPhoto(file));
  const mode = modePanel((entered) => {
    if (entered === 'photo') page.begin();
    keep.entered();
  });
  const gallery = galleryPanel(session, { adopt, choose: views.choose, strip: strip.show, enter: () => mode.enter('heights') });
  element('notice-close', HTMLButtonElement).addEventListener('click', hideNotice);
  watchDrops((files) => {
    if (mode.now === 'photo' && (files.length === 1 || files.every((file) => kindByName(file) === 'picture'))) return void page.openAll(files);
    // What comes together is no photo alone.
    openHeights(files);
  });
  const keep = keepPanel(session, {
    adopt, choose: views.choose, openExample: openNamed, openFiles, openRecent: openHeights, understand, gallery, mode, openPhoto: page.open,
    beginPhoto: page.begin, whole, solvedWhole,
  });
  await started;
  await keep.begin();
}

start().catch((error) => {
  element('page', HTMLElement).dataset.phase = 'failed';
  element('verdict', HTMLElement).textContent = 'The page could not start.';
  showNotice(complaint('The solver could not be started', error));
});
