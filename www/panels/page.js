/** From a photo of a page alone to the flat page: opened or an example, its outline, what is known, what comes of it. */
import { choosesFile, element, elements } from '../dom.js';
import { examplePhoto } from '../page/example.js';
import { openPhoto, photoOf } from '../page/photo.js';
import { PageSession } from '../page/session.js';
import { hideNotice, showFailure } from './notice.js';
import { pageKnownPanel } from './page-known.js';
import { pagePhotoPanel } from './page-photo.js';
import { pageResultPanel } from './page-result.js';

/** @import {Api} from '../api.js' */
/** @import {ExampleName} from '../page/example.js' */
/** @import {PagePhoto} from '../page/photo.js' */
/** @import {DewarpedPage} from '../page/flatten.js' */

/**
 * @param {Api} api
 * @param {(flat: DewarpedPage, name: string) => void} goOn with the page as a surface
 */
export function pagePanel(api, goOn) {
  /** Made with the first photo, for most visitors come for something else. @type {PageSession | null} */
  let session = null;
  const examples = elements('input[name="page-example"]', HTMLInputElement);
  let opened = 0;

  const begun = () => {
    if (session) return session;
    const made = (session = new PageSession(api));
    pagePhotoPanel(made);
    pageKnownPanel(made);
    pageResultPanel(api, made, goOn);
    return made;
  };

  /**
   * @param {string} doing
   * @param {(session: PageSession) => Promise<PagePhoto>} load
   * @param {number} [pages]
   */
  const show = async (doing, load, pages) => {
    const turn = ++opened;
    const to = begun();
    try {
      const photo = await load(to);
      if (turn !== opened) return;
      hideNotice();
      to.show(photo, pages);
    } catch (error) {
      if (turn === opened) showFailure(doing, error);
    }
  };

  /** @param {File} file */
  const open = async (file) => {
    await show(`“${file.name}” could not be opened`, async ({ worker }) => {
      const photo = await openPhoto(worker, file);
      for (const radio of examples) radio.checked = false;
      return photo;
    }, 1);
  };
  const openExample = async () => {
    const name = /** @type {ExampleName} */ (examples.find((radio) => radio.checked)?.value ?? 'curled');
    const { image, film35, pages } = examplePhoto(name);
    await show('The example could not be made', () => photoOf({ width: image.width, height: image.height, data: image.data, film35 }, name), pages);
  };
  for (const radio of examples) radio.addEventListener('change', openExample);
  choosesFile(element('page-open', HTMLButtonElement), element('page-file', HTMLInputElement), open);
  return {
    open,
    /** Something to see, where nothing was opened yet. */
    begin() {
      if (opened === 0) void openExample();
    },
  };
}
