/** The promise API, over a worker of its own. Documented in `index.d.ts`. */
import { contextOf, put } from './canvas.js';
import { Connection } from './connection.js';
import { controlOf } from './control.js';
import { asDepthOptions } from './depth-input.js';
import { DevelopableError, messageOf } from './errors.js';
import { explored, exploredMesh } from './explore.js';
import { asBytes, asField, asHeights, asImage, asInput, asLattice, asPixels, detached } from './input.js';
import { asFiles, asMesh, asMeshOrLattice, asPicture, wholeOf } from './mesh-input.js';
import { OpenSolver } from './open.js';
import { asEdges, pageOptions, plainEdges } from './page-input.js';
import { optionsOf } from './options.js';
import { makeDisposable } from './platform.js';
import { asPhoto, extentOf, placedOptions, printOptions } from './sheet-input.js';
import { orAborted, solve } from './solve.js';
import { asText, plainCopy, reading } from './values.js';
import { compile, locate } from './wasm-source.js';
import { transfer } from './wire.js';

/**
 * @typedef {import('./index.js').DevelopableWorker} DevelopableWorkerApi
 * @typedef {import('./index.js').WorkerOptions} WorkerOptions
 * @typedef {import('./index.js').FitOptions} FitOptions
 * @typedef {import('./types.js').HeightImage} HeightImage
 * @typedef {import('./types.js').Heightfield} Heightfield
 * @typedef {import('./connection.js').Remote} Remote
 */

/** Number of the last solver that was opened. */
let opened = 0;

/** @implements {Omit<DevelopableWorkerApi, typeof Symbol.dispose>} */
export class DevelopableWorker {
  #options;
  /** @type {Connection | undefined} */
  #connection;
  /** @type {Promise<import('./connection.js').Source[]> | undefined} */
  #wasm;
  #disposed = false;

  /** @param {WorkerOptions} [options] */
  constructor(options) {
    this.#options = optionsOf('worker', options);
  }

  init() {
    return this.#request(async () => {});
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {FitOptions} [given]
   * @returns {Promise<any>} a surface, of the input's kind
   */
  async fit(input, given) {
    const { control, options: { transfer: handOver, ...options } } = controlOf('fit', given);
    if (!control.keep) control.signal?.throwIfAborted();
    const { field, buffers } = detached(asInput(input), { transfer: handOver });
    const sent = transfer(field, buffers);
    const surface = this.#request((remote) =>
      solve(remote, (id, interval) => remote.start(id, sent, options, interval), control));
    return orAborted(surface, control);
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./index.js').HandOver} [options]
   */
  async open(input, options) {
    const { field, buffers } = detached(asInput(input), options);
    const sent = transfer(field, buffers);
    const connection = this.#connect();
    opened += 1;
    const id = opened;
    await connection.request((remote) => remote.open(id, sent));
    const solver = new OpenSolver(connection, id);
    return /** @type {import('./index.js').OpenSolver} */ (/** @type {unknown} */ (solver)); // for `using`
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').OcclusionOptions} [given]
   */
  async occlusions(input, given) {
    const options = optionsOf('occlusions', given);
    const { field, buffers } = detached(asField(input));
    return this.#request((remote) => remote.occlusions(transfer(field, buffers), options));
  }

  /**
   * @param {Uint8Array | ArrayBuffer | Blob} bytes
   * @param {import('./types.js').ReadOptions} [given]
   */
  async read(bytes, given) {
    const options = optionsOf('read', given);
    const file = await ownBytes(bytes);
    return this.#request((remote) => remote.read(transfer(file, [file.buffer]), options));
  }

  /** @param {Uint8Array | ArrayBuffer | Blob} bytes */
  async npzArrays(bytes) {
    const file = await ownBytes(bytes);
    return this.#request((remote) => remote.npzArrays(transfer(file, [file.buffer])));
  }

  /** @param {HeightImage | Heightfield} input */
  async writeNpy(input) {
    const { field, buffers } = detached(asField(input));
    return this.#request((remote) => remote.writeNpy(transfer(field, buffers)));
  }

  /** @param {HeightImage | import('./types.js').Surface} input */
  async writePng(input) {
    const { field, buffers } = detached(asPixels(input));
    return this.#request((remote) => remote.writePng(transfer(field, buffers)));
  }

  /** @param {HeightImage | import('./types.js').Surface} input */
  async writeTiff(input) {
    const { field, buffers } = detached(asPixels(input));
    return this.#request((remote) => remote.writeTiff(transfer(field, buffers)));
  }

  /** @param {HeightImage | import('./types.js').Surface} input */
  async writeExr(input) {
    const { field, buffers } = detached(asPixels(input));
    return this.#request((remote) => remote.writeExr(transfer(field, buffers)));
  }

  /**
   * @param {Heightfield | import('./types.js').Mesh} input
   * @param {import('./index.js').WriteObjOptions} [given]
   */
  async writeObj(input, given) {
    const options = optionsOf('writeObj', given);
    const { field, buffers } = detached(asMeshOrLattice(input));
    return this.#request((remote) => remote.writeObj(transfer(field, buffers), options));
  }

  /** @param {string} picture */
  async writeMtl(picture) {
    const name = asText('INPUT', "the picture's name", picture);
    return this.#request((remote) => remote.writeMtl(name));
  }

  /** @param {Heightfield | import('./types.js').Mesh} input */
  async writePly(input) {
    const { field, buffers } = detached(asMeshOrLattice(input));
    return this.#request((remote) => remote.writePly(transfer(field, buffers)));
  }

  /** @param {Heightfield | import('./types.js').Mesh} input */
  async writeStl(input) {
    const { field, buffers } = detached(asMeshOrLattice(input));
    return this.#request((remote) => remote.writeStl(transfer(field, buffers)));
  }

  /**
   * @param {Heightfield | import('./types.js').Mesh} input
   * @param {import('./index.js').WriteGlbOptions} [given]
   */
  async writeGlb(input, given) {
    const { field, buffers } = detached(asMeshOrLattice(input));
    const { texture, ...rest } = optionsOf('writeGlb', given);
    const options = { ...rest, texture: texture === undefined || texture === null ? texture : await ownBytes(texture) };
    return this.#request((remote) => remote.writeGlb(transfer(field, buffers), options));
  }

  /**
   * @param {Uint8Array | ArrayBuffer | Blob} bytes
   * @param {import('./types.js').ReadMeshOptions} [given]
   */
  async readMesh(bytes, given) {
    const { files, ...rest } = optionsOf('readMesh', given);
    const options = { ...rest, files: new Map(asFiles(files)) };
    const file = await ownBytes(bytes);
    return this.#request((remote) => remote.readMesh(transfer(file, [file.buffer]), options));
  }

  /**
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./types.js').SampleMeshOptions} [given]
   */
  async sampleMesh(mesh, given) {
    const options = optionsOf('sampleMesh', given);
    const own = asMesh(mesh);
    return this.#request((remote) => remote.sampleMesh(own, options));
  }

  /**
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./index.js').FitMeshOptions} [given]
   * @returns {Promise<import('./types.js').MeshSurface>}
   */
  async fitMesh(mesh, given) {
    const { control, options } = controlOf('fitMesh', given);
    if (!control.keep) control.signal?.throwIfAborted();
    const { shape, own } = wholeOf(mesh);
    const found = this.#request((remote) =>
      solve(remote, (id, interval) => remote.startMesh(id, shape, options, interval), control));
    const surface = await orAborted(found, control);
    return /** @type {any} */ ({ ...own, ...surface });
  }

  /**
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./types.js').MeshAnalyzeOptions} [given]
   */
  async analyzeMesh(mesh, given) {
    const options = optionsOf('analyzeMesh', given);
    const { shape } = wholeOf(mesh);
    return this.#request((remote) => remote.analyzeMesh(shape, options));
  }

  /**
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./types.js').MeshRulingOptions} [given]
   */
  async meshRulings(mesh, given) {
    const options = optionsOf('meshRulings', given);
    const { shape } = wholeOf(mesh);
    return this.#request((remote) => remote.meshRulings(shape, options));
  }

  /**
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./types.js').MeshUnrollOptions} [given]
   */
  async unrollMesh(mesh, given) {
    const options = optionsOf('unrollMesh', given);
    const { shape } = wholeOf(mesh);
    return this.#request((remote) => remote.unrollMesh(shape, options));
  }

  /**
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./types.js').MeshPatternOptions} [given]
   */
  async patternMesh(mesh, given) {
    const options = optionsOf('patternMesh', given);
    const { shape } = wholeOf(mesh);
    return this.#request((remote) => remote.patternMesh(shape, options));
  }

  /**
   * @param {HeightImage} input
   * @param {import('./types.js').Intrinsics} intrinsics
   * @param {import('./types.js').DepthOptions} [given]
   */
  async backProject(input, intrinsics, given) {
    const known = asDepthOptions(given);
    const camera = /** @type {import('./types.js').Intrinsics} */ (optionsOf('camera', intrinsics));
    const { field, buffers } = detached(asImage(input));
    return this.#request((remote) => remote.backProject(transfer(field, buffers), camera, known));
  }

  /**
   * @template {Heightfield} F
   * @param {F} input
   * @param {import('./types.js').Picture | Blob} picture
   * @param {import('./types.js').PaintOptions} [given]
   * @returns {Promise<import('./types.js').Painted<F>>}
   */
  async paint(input, picture, given) {
    const own = reading('INPUT', 'the input', () => ({ ...input }));
    const { extent, camera } = optionsOf('paint', given);
    const { field, buffers } = detached(asLattice(own));
    const found = asPicture(isBlob(picture) ? await ownBytes(picture) : picture);
    const known = camera ?? field.camera ?? field.uvs;
    const place = { camera, extent: extent ?? (known ? undefined : extentOf(own)) };
    return { ...own, ...await this.#request((remote) => remote.paint(transfer(field, buffers), found, place)) };
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').AnalyzeOptions} [given]
   */
  async analyze(input, given) {
    const { reference, ...options } = optionsOf('analyze', given);
    const { field, buffers } = detached(asField(input));
    const other = reference === undefined ? undefined : asField(reference);
    return this.#request((remote) => remote.analyze(transfer(field, buffers), { ...options, reference: other }));
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').PatchOptions} [given]
   */
  async patches(input, given) {
    const options = optionsOf('patches', given);
    const { field, buffers } = detached(asField(input));
    return this.#request((remote) => remote.patches(transfer(field, buffers), options));
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').PictureOptions} [given]
   */
  async picture(input, given) {
    const options = placedOptions('picture', input, given);
    const { field, buffers } = detached(asField(input));
    return this.#request((remote) => remote.picture(transfer(field, buffers), options));
  }

  /**
   * @param {import('./types.js').Canvas} canvas
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').PictureOptions} [given]
   */
  async draw(canvas, input, given) {
    const context = contextOf(canvas);
    put(context, await this.picture(input, given));
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').RulingOptions} [given]
   */
  async rulings(input, given) {
    const options = optionsOf('rulings', given);
    const { field, buffers } = detached(asField(input));
    return this.#request((remote) => remote.rulings(transfer(field, buffers), options));
  }

  /** @param {Heightfield} input */
  async fitCylinder(input) {
    const { field, buffers } = detached(asHeights(input));
    return this.#request((remote) => remote.fitCylinder(transfer(field, buffers)));
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').UnrollOptions} [given]
   */
  async unroll(input, given) {
    const options = optionsOf('unroll', given);
    const { field, buffers } = detached(asField(input));
    return this.#request((remote) => remote.unroll(transfer(field, buffers), options));
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').PatternOptions} [given]
   */
  async pattern(input, given) {
    const options = optionsOf('pattern', given);
    const { field, buffers } = detached(asField(input));
    return this.#request((remote) => remote.pattern(transfer(field, buffers), options));
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./index.js').ExplorePatternOptions} [given]
   */
  explorePattern(input, given) {
    return explored(/** @type {import('./index.js').DevelopableWorker} */ (/** @type {unknown} */ (this)), input, given);
  }

  /**
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./index.js').ExplorePatternMeshOptions} [given]
   */
  explorePatternMesh(mesh, given) {
    return exploredMesh(/** @type {import('./index.js').DevelopableWorker} */ (/** @type {unknown} */ (this)), mesh, given);
  }

  /** @param {import('./types.js').Drawing} drawing */
  async writeSvg(drawing) {
    const own = plainCopy('the drawing', drawing);
    return this.#request((remote) => remote.writeSvg(own));
  }

  /**
   * @param {import('./types.js').Drawing} drawing
   * @param {import('./types.js').WritePdfOptions} [given]
   */
  async writePdf(drawing, given) {
    const own = plainCopy('the drawing', drawing);
    const options = optionsOf('writePdf', given);
    return this.#request((remote) => remote.writePdf(own, options));
  }

  /** @param {import('./types.js').Drawing} drawing */
  async writeDxf(drawing) {
    const own = plainCopy('the drawing', drawing);
    return this.#request((remote) => remote.writeDxf(own));
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').Photo} photo
   * @param {import('./types.js').DewarpOptions & import('./index.js').HandOver} [given]
   */
  async dewarp(input, photo, given) {
    const { transfer: handOver, ...options } = placedOptions('dewarp', input, given);
    const { field, buffers } = detached(asField(input));
    const sent = sending(photo, handOver);
    return this.#request((remote) => remote.dewarp(transfer(field, buffers), sent, options));
  }

  /**
   * @param {import('./types.js').Photo & { film35?: number }} photo
   * @param {import('./types.js').PageEdges | readonly import('./types.js').PageEdges[]} edges
   * @param {import('./types.js').DewarpPageOptions & import('./index.js').HandOver} [given]
   */
  async dewarpPage(photo, edges, given) {
    const { transfer: handOver, ...options } = pageOptions(photo, given);
    const pages = plainEdges(asEdges(edges));
    const sent = sending(photo, handOver);
    return this.#request((remote) => remote.dewarpPage(sent, pages, options));
  }

  /** @param {Uint8Array | ArrayBuffer | Blob} bytes */
  async readPhoto(bytes) {
    const file = await ownBytes(bytes);
    return this.#request((remote) => remote.readPhoto(transfer(file, [file.buffer])));
  }

  /**
   * @param {import('./types.js').SizedPhoto} photo
   * @param {import('./types.js').WritePhotoOptions & import('./index.js').HandOver} [given]
   */
  async writePhoto(photo, given) {
    const { transfer: handOver, ...options } = printOptions(photo, given);
    const sent = sending(photo, handOver);
    return this.#request((remote) => remote.writePhoto(sent, options));
  }

  /**
   * @param {import('./types.js').ExampleName} name
   * @param {import('./types.js').ExampleOptions} [given]
   */
  async example(name, given) {
    const options = optionsOf('example', given);
    const own = /** @type {import('./types.js').ExampleName} */ (asText('OPTION', 'the name of the example', name));
    return this.#request((remote) => remote.example(own, options));
  }

  get connected() {
    return this.#connection?.open === true;
  }

  get disposed() {
    return this.#disposed;
  }

  dispose() {
    this.#disposed = true;
    this.#connection?.close(new DevelopableError('DISPOSED', 'this worker has been disposed'));
  }

  /**
   * @template T
   * @param {(remote: Remote) => Promise<T>} run
   * @returns {Promise<T>}
   */
  async #request(run) {
    return this.#connect().request(run);
  }

  /** The worker that runs, or else a new one. */
  #connect() {
    if (this.#disposed) throw new DevelopableError('DISPOSED', 'this worker has been disposed');
    if (!this.#connection?.open) {
      const { wasm, filesWasm, imagesWasm, meshesWasm, fitmeshWasm, unrollWasm, patternsWasm } = this.#options;
      const sources = [wasm, filesWasm, imagesWasm, meshesWasm, fitmeshWasm, unrollWasm, patternsWasm];
      this.#wasm ??= Promise.all(sources.map(portable));
      this.#wasm.catch(() => (this.#wasm = undefined));
      this.#connection = new Connection(this.#options.workerUrl, this.#wasm);
    }
    return this.#connection;
  }
}
makeDisposable(DevelopableWorker);

/**
 * A photo on its way to the worker: itself, if it is to be handed over and that is possible, or a copy.
 * @param {import('./types.js').Photo} photo
 * @param {boolean} [handOver]
 */
function sending(photo, handOver = false) {
  const { width, height, data } = asPhoto(photo);
  const whole = data.buffer instanceof ArrayBuffer && data.byteLength === data.buffer.byteLength;
  const own = handOver && whole ? data : new Uint8Array(data);
  return transfer({ width, height, data: own }, [/** @type {ArrayBuffer} */ (own.buffer)]);
}

/**
 * A copy of a file's bytes, to be handed over.
 * @param {Uint8Array | ArrayBuffer | Blob} bytes
 */
async function ownBytes(bytes) {
  if (!isBlob(bytes)) return new Uint8Array(asBytes(bytes));
  try {
    return new Uint8Array(await bytes.arrayBuffer());
  } catch (cause) {
    throw new DevelopableError('INPUT', `the file could not be read: ${messageOf(cause)}`, { cause });
  }
}

/**
 * @param {unknown} value
 * @returns {value is Blob}
 */
function isBlob(value) {
  return typeof Blob === 'function' && reading('INPUT', 'the file', () => value instanceof Blob);
}

/**
 * What a worker can be told about where the wasm is, again and again.
 * @param {import('./types.js').InitInput | undefined} wasm
 * @returns {Promise<import('./connection.js').Source>}
 */
async function portable(wasm) {
  if (wasm === undefined) return undefined;
  try {
    // A relative address would count from the worker's script there.
    return typeof wasm === 'string' || wasm instanceof URL ? locate(wasm).href : await compile(wasm);
  } catch (cause) {
    throw new DevelopableError('INIT', `the wasm could not be loaded: ${messageOf(cause)}`, { cause });
  }
}
