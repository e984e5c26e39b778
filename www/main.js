/** Puts the page together. */
import { connect } from './api.js';
import { element } from './dom.js';
import { analysisPanel } from './panels/analysis.js';
import { besidePanel } from './panels/beside.js';
import { curvePanel } from './panels/curve.js';
import { designPanel } from './panels/design.js';
import { watchDrops } from './panels/drop.js';
import { editPanel } from './panels/edit.js';
import { headline } from './panels/headline.js';
import { modePanel } from './panels/mode.js';
import { hideNotice, showNotice } from './panels/notice.js';
import { pagePanel } from './panels/page.js';
import { reportPanel } from './panels/report.js';
import { runPanel } from './panels/run.js';
import { savePanel } from './panels/save.js';
import { settingsPanel } from './panels/settings.js';
import { sourcePanel } from './panels/source.js';
import { viewsPanel } from './panels/views.js';
import { Session } from './session.js';
import { complaint } from './words.js';

async function start() {
  const session = new Session(await connect());
  headline(session);
  const { show, space } = viewsPanel(session);
  designPanel(session, space);
  editPanel(session, space);
  settingsPanel(session);
  besidePanel(session);
  runPanel(session);
  curvePanel(session);
  reportPanel(session);
  savePanel(session);
  const { choose } = analysisPanel(session, show);
  const { openExample, openFiles, takeMesh } = sourcePanel(session, choose);
  const page = pagePanel(session.api, ({ mesh }, name) => {
    mode.enter('heights');
    takeMesh({ name, kind: 'photo' }, async () => mesh, 'The page could not be taken as a surface');
  });
  const mode = modePanel((entered) => {
    if (entered === 'photo') page.begin();
  });
  element('notice-close', HTMLButtonElement).addEventListener('click', hideNotice);
  watchDrops((files) => {
    if (mode.now === 'photo' && files.length === 1) return void page.open(files[0]);
    // What comes together is no photo alone.
    mode.enter('heights');
    void openFiles(files);
  });
  // Something to see at once.
  await openExample();
}

start().catch((error) => {
  element('page', HTMLElement).dataset.phase = 'failed';
  element('verdict', HTMLElement).textContent = 'The page could not start.';
  showNotice(complaint('The solver could not be started', error));
});
