/** The gallery: cards with pictures. A card opens an input with settings and a view, and tells its story. */
import { element, make, makeButton } from '../dom.js';
import { CARDS } from '../gallery/cards.js';

/**
 * @param {Session} session
 * @param {object} page
 * @param {(settings: Settings) => void} page.adopt
 * @param {(view: string) => void} page.choose shows a view
 * @param {(wanted: boolean) => void} page.strip shows or hides the results with five λ
 * @param {() => void} page.enter shows the part of the page for heights
 * @param {() => boolean} page.expectsInput whether the next input has the settings of an address
 */
export function galleryPanel(session, { adopt, choose, strip, enter, expectsInput }) {
  const dialog = element('gallery', HTMLDialogElement);
  const list = element('gallery-cards', HTMLElement);
  const story = element('story', HTMLElement);
  const turns = element('story-turn', HTMLSelectElement);
  /** The card that is open. @type {Card | null} */
  let present = null;
  /** Name of the card's input; another input closes the card. */
  let inputName = '';

  const open = () => {
    if (list.childElementCount === 0) list.append(...CARDS.map((card) => cardButton(card, () => show(card))));
    dialog.showModal();
  };
  element('gallery-open', HTMLButtonElement).addEventListener('click', open);
  element('story-all', HTMLButtonElement).addEventListener('click', open);
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close();
  });
  /** @param {number} step */
  const go = (step) => {
    if (present) void show(CARDS[(CARDS.indexOf(present) + step + CARDS.length) % CARDS.length]);
  };
  element('story-before', HTMLButtonElement).addEventListener('click', () => go(-1));
  element('story-next', HTMLButtonElement).addEventListener('click', () => go(1));

  turns.addEventListener('change', () => present && void show(present, session.settings));
  const showStory = () => {
    story.hidden = present === null;
    if (!present) return;
    element('story-title', HTMLElement).textContent = `${present.title}${present.figure ? ` (${present.figure} of the paper)` : ''}.`;
    element('story-words', HTMLElement).textContent = present.words;
    element('story-look', HTMLElement).textContent = present.look;
    element('story-turns', HTMLElement).hidden = !present.turns;
  };

  /** The input of a card. @param {Card} card @param {number} turn angle by which it is turned, in degrees */
  const inputOf = async ({ example, input, size }, turn) => {
    if (input) return input(size, turn);
    if (!example) throw new Error('it has neither');
    return session.example(example.name, { size, noise: example.noise });
  };

  /** @param {Card} card @param {Partial<Settings>} [settings] default: the card's own @param {string} [view] */
  const show = async (card, settings = card.settings, view = card.view) => {
    dialog.close();
    enter();
    if (card !== present) turns.replaceChildren(...(card.turns ?? []).map((angle) => new Option(`${angle}°`, String(angle))));
    const opened = await session.open('The gallery’s input could not be made', () => inputOf(card, Number(turns.value)), 'making');
    if (!opened) return;
    present = card;
    inputName = session.input?.name ?? '';
    showStory();
    adopt({ ...session.defaults, ...settings });
    choose(view);
    if (card.fromAbove) element('from-above', HTMLButtonElement).click();
    strip(card.opens === 'strip');
    element('drawer', HTMLElement).hidden = card.opens !== 'drawer';
    element('report-open', HTMLButtonElement).setAttribute('aria-expanded', String(card.opens === 'drawer'));
    await session.run();
  };

  session.on('input', (input) => {
    if (present && input.name === inputName && input.kind === undefined) return;
    if (present) {
      strip(false);
      // Settings that make the card's point are not meant for another input.
      if (!expectsInput()) adopt(session.defaults);
    }
    present = null;
    showStory();
  });

  return {
    /** The card with an id. @param {string} id */
    find: (id) => CARDS.find((card) => card.id === id),
    show,
    get present() {
      return present;
    },
  };
}

/** The button of a card, with its picture. @param {Card} card @param {() => unknown} onChosen */
function cardButton({ id, title, words, figure }, onChosen) {
  const picture = Object.assign(make('img', ''), { loading: 'lazy', src: new URL(`../gallery/pictures/${id}.webp`, import.meta.url).href, alt: '' });
  return makeButton('card', onChosen, picture, make('strong', '', title), make('span', 'small', words), ...(figure ? [make('span', 'muted small', `${figure} of the paper`)] : []));
}
