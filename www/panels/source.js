/** Source of the heights: an example, or files with their scale and interpretation. */
import { element, make } from '../dom.js';
import { above, fieldsOf } from '../fields.js';
import { readInput } from '../height-file.js';
import { hasColours } from '../views/photo.js';
import { noDataOf, reinterpret, spanInWords } from '../import-interpretation.js';
import { fileRoles } from '../file-routing.js';
import { isMesh, isMeshFormat, kindByName } from '../file-kinds.js';
import { assumedInWords, DEPTH_WORDS, FILE_WORDS } from '../messages.js';
import { cameraPanel } from './camera.js';
import { meshPanel } from './mesh.js';
import { showNotice } from './notice.js';

const EXAMPLE_FIELDS = {
  example: { label: 'Example', options: { roof: 'Roof', page: 'Page', house: 'House', oloid: 'Oloid', cone: 'Cone', cylinder: 'Cylinder' } },
  size: { label: 'Size', options: { 100: '100 pixels', 200: '200 pixels', 400: '400 pixels', 700: '700 pixels', 1000: '1000 pixels' }, value: '400' },
  noise: { label: 'Noise', options: { 0: 'none', 0.005: '0.5 %', 0.01: '1 %', 0.02: '2 %', 0.05: '5 %', 0.1: '10 %' }, value: '0.02' },
};
const FILE_FIELDS = {
  'pixel-size': { label: 'Pixel size', range: above(0), describedBy: 'scale-hint scale-span' },
  'height-scale': { label: 'Height scale', range: { takes: (/** @type {number} */ scale) => Math.abs(scale) > 0, must: 'a number other than 0' }, describedBy: 'scale-hint scale-span' },
  'no-data': {
    label: 'Number that means no data, or “none”', placeholder: 'automatic',
    wrong: (/** @type {string} */ text) => (text.trim() === '' || noDataOf(text) !== undefined ? '' : 'This must be a number, “none”, or empty.'),
  },
};

/**
 * @param {Session} session
 * @param {(settings: Settings) => void} adopt
 * @param {(view: string) => void} choose shows a view of the result
 * @param {(files: readonly File[]) => void} onOpened called when files have become the input
 * @param {() => void} solveMesh solves the mesh that was opened
 * @param {(file: File) => unknown} openColour opens a file that is no heights, but a picture in colour
 */
export function sourcePanel(session, adopt, choose, onOpened, solveMesh, openColour) {
  const examples = fieldsOf(EXAMPLE_FIELDS, () => void openChosenExample());
  element('example-field', HTMLElement).append(...examples.nodes('example'));
  const exampleOptions = element('example-options', HTMLElement);
  exampleOptions.append(...examples.nodes('size', 'noise'));
  const fileOptions = element('file-options', HTMLElement);
  const fileName = element('file-name', HTMLElement);
  const fields = fieldsOf(FILE_FIELDS, (name) => {
    if (name === 'no-data') void reinterpretFile({ noData: noDataOf(fields.text('no-data')) });
    else if (!fields.check()) void reinterpretFile({ pixelSize: fields.number('pixel-size'), heightScale: fields.number('height-scale'), guesses: '' });
  });
  const span = element('scale-span', HTMLElement);
  const guesses = element('guessed', HTMLElement);
  const array = make('select', '');
  const arrayField = make('label', 'field', 'Array', array);
  element('scale-fields', HTMLElement).append(arrayField, make('div', 'pair', ...fields.nodes('pixel-size', 'height-scale')));
  element('no-data-field', HTMLElement).append(...fields.nodes('no-data'));
  const mesh = meshPanel(session);
  const camera = cameraPanel(session, mesh.openLoaded);
  /** Reads the open file again, with another value that is no data. @type {(noData?: NoData) => Promise<boolean>} */
  let openAgain = () => Promise.resolve(false);

  /** Opens the chosen example and solves it. */
  const openChosenExample = async () => {
    const options = { size: examples.number('size'), noise: examples.number('noise') };
    const opened = await session.open('The example could not be made', () => session.example(/** @type {ExampleName} */ (examples.text('example')), options), 'making');
    if (opened) await session.run();
  };

  /**
   * Opens a file and solves it. Depths are not solved yet if their camera's file is opened together with them.
   * @param {File} chosen
   * @param {NonNullable<Parameters<typeof readInput>[3]>} [reading] the array to open, for a file with several, and what is no data
   * @param {File} [photo] that belongs to it
   * @param {boolean} [hasCamera] whether the camera's file is opened together with it
   */
  const openFile = async (chosen, reading, photo, hasCamera = false) => {
    const kind = kindByName(chosen);
    const unread = `“${chosen.name}” could not be read`;
    // Where a name does not tell what a file is, the contents do.
    const format = kind === 'camera' || kind === null ? await session.whileOpening(unread, 'reading', () => session.api.formatOf(chosen)) : undefined;
    if (format === null) return false;
    if (isMesh(chosen.name) || isMeshFormat(format)) return openMesh(chosen, [], format);
    if (kind === 'camera') {
      // Numbers may be a camera of the depths that are open, or heights.
      const isCamera = session.input?.kind ? await camera.readCamera(chosen, format === 'text') : undefined;
      if (isCamera !== undefined) return isCamera;
      if (format === undefined) {
        showNotice(FILE_WORDS.noHeights(chosen.name));
        return false;
      }
    }
    let isColourPicture = false;
    const opened = await session.open(unread, async (signal) => {
      try {
        return await readInput(session.api, chosen, signal, reading, photo);
      } catch (error) {
        isColourPicture = reading === undefined && error instanceof Error && /colour/.test(error.message);
        throw error;
      }
    }, 'reading');
    if (isColourPicture) {
      void openColour(chosen);
      return false;
    }
    if (!opened || !session.input) return false;
    openAgain = (noData) => openFile(chosen, { ...reading, noData }, photo, hasCamera);
    const { depths, stored } = session.input;
    const { coarsening = 1 } = stored ?? {};
    if (coarsening !== session.settings.coarsening) adopt({ ...session.settings, coarsening });
    const areDepths = depths === 'certain';
    if (depths) camera.show();
    if ((depths && hasCamera) || (areDepths && !(await camera.backProject(true)))) return true;
    void session.run();
    if (areDepths) choose(hasColours(session.input) ? 'photo' : 'shaded');
    return true;
  };

  /** @param {File} file @param {readonly File[]} [referencedFiles] @param {string} [format] where the name does not tell it */
  const openMesh = async (file, referencedFiles, format) => {
    const opened = await mesh.openFile(file, referencedFiles, format);
    if (opened) solveMesh();
    return opened;
  };

  /** Opens files that belong together, or one file. @param {readonly File[]} files */
  const openFiles = async (files) => {
    const before = session.input;
    const isOpened = await openTogether(files);
    // The file of a camera alone leaves the input as it was.
    if (isOpened && session.input !== before && session.input?.kind) onOpened(files);
    return isOpened;
  };

  /** @param {readonly File[]} files @returns {Promise<boolean>} */
  const openTogether = async (files) => {
    if (files.length === 1) return openFile(files[0]);
    const { mesh: meshFile, depths, camera: cameraFile, photo } = await fileRoles(files);
    if (meshFile) return openMesh(meshFile, files.filter((file) => file !== meshFile));
    if (!depths) return false;
    if (!(await openFile(depths, undefined, photo, cameraFile !== undefined))) return false;
    if (!cameraFile) return true;
    camera.show();
    if (!(await camera.readCamera(cameraFile)) || !(await camera.backProject())) return true;
    void session.run();
    choose(photo ? 'photo' : 'shaded');
    return true;
  };

  /** Changes the interpretation of the open file, which is read again where other values are no data. @param {Parameters<typeof reinterpret>[1]} change */
  const reinterpretFile = async (change) => {
    const { stored } = session.input ?? {};
    if (stored && 'noData' in change && change.noData !== stored.noData) {
      const { pixelSize: side, heightScale: step } = stored;
      if (!(await openAgain(change.noData))) return;
      return reinterpretFile({ pixelSize: side, heightScale: step, ...change });
    }
    const { input } = session;
    if (!input) return;
    try {
      session.updateInput(reinterpret(input, change));
    } catch (error) {
      session.fail('It could not be taken so', error);
    }
  };

  /** Scales the relief of the heights. @param {number} factor of height per width */
  const scaleRelief = (factor) => {
    const stored = session.input?.stored;
    if (!stored) return;
    // For integer levels the height scale is unknown, for other values the pixel size.
    const { levels, heightScale: step, pixelSize: side } = stored;
    reinterpretFile(levels ? { heightScale: step * factor } : { pixelSize: side / factor });
  };

  element('flatter', HTMLButtonElement).addEventListener('click', () => scaleRelief(0.5));
  element('steeper', HTMLButtonElement).addEventListener('click', () => scaleRelief(2));
  array.addEventListener('change', () => {
    const several = session.input?.array;
    if (several) void openFile(several.file, { array: array.value });
  });

  session.on('input', (input) => {
    const isFile = input.kind !== undefined;
    element('example-field', HTMLElement).hidden = exampleOptions.hidden = input.example === undefined;
    const isBackProjected = input.depthSource !== undefined;
    fileOptions.hidden = !isFile || (input.sampling !== undefined && !isBackProjected);
    fileOptions.toggleAttribute('data-built', isBackProjected);
    if (input.example) examples.set('example', input.name);
    const guessed = input.depths ? DEPTH_WORDS.maybe : isBackProjected ? '' : input.stored?.guesses;
    guesses.textContent = [assumedInWords(input.assumptions), guessed].filter(Boolean).join(' ');
    guesses.hidden = guesses.textContent === '';
    if (fileOptions.hidden) return;
    const { array: several } = input;
    arrayField.hidden = several === undefined;
    array.replaceChildren(...(several?.names ?? []).map((name) => new Option(name, name, false, name === several?.name)));
    fileName.textContent = `${input.name} (${input.kind})`;
    if (!input.stored) return;
    fields.set('pixel-size', Number(input.stored.pixelSize.toPrecision(8)));
    fields.set('height-scale', Number(input.stored.heightScale.toPrecision(8)));
    fields.set('no-data', input.stored.noData ?? '');
    span.textContent = spanInWords(input);
  });

  return {
    /** Opens an example by its name. @param {string} name @param {{ size: number, noise: number }} options replaced by the nearest ones of the menus */
    async openExample(name, options) {
      examples.set('example', name in EXAMPLE_FIELDS.example.options ? name : 'roof');
      for (const option of /** @type {const} */ (['size', 'noise'])) {
        const nearest = Object.keys(EXAMPLE_FIELDS[option].options).map(Number).sort((a, b) => Math.abs(a - options[option]) - Math.abs(b - options[option]))[0];
        examples.set(option, nearest);
      }
      await openChosenExample();
    },
    openFiles,
    reinterpretFile,
  };
}
