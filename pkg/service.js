/** What the worker offers its client: the direct API, with solves as jobs. Arrays are handed over. */
import * as direct from './direct.js';
import { takeCopiesFrom } from './copies.js';
import { DevelopableError } from './errors.js';
import { isImage } from './formats.js';
import { asBytes } from './input.js';
import { Job } from './job.js';
import { KeptSolver } from './kept.js';
import { asPicture } from './mesh-input.js';
import { paintOf } from './paint.js';
import { transfer, wrap } from './wire.js';

/** @type {Map<number, Job>} */
const jobs = new Map();

/** @type {Map<number, KeptSolver>} */
const kept = new Map();

/** @typedef {import('./input.js').Image | import('./input.js').Lattice} Input */

/** @typedef {import('./types.js').InitInput | undefined} Place */

/** @typedef {import('./direct.js').PartName} PartName */

/** Where the other wasm files are, each loaded when it is needed. @type {Partial<Record<PartName, Place>>} */
let places = {};

export const service = {
  /**
   * @param {Place[]} sources of the solver's wasm, the files', the images', the meshes', of fits to meshes, the unrolling's and the patterns'
   * @param {MessagePort} [copies] where to get copies of them, where nothing lies beside this script
   */
  init([wasm, files, images, meshes, fitmesh, unroll, patterns], copies) {
    if (copies) {
      /** @type {import('./vendor/comlink.mjs').Remote<typeof import('./copies.js').wasmCopy>} */
      const ask = wrap(copies);
      takeCopiesFrom((name) => ask(name));
    }
    places = { files, images, meshes, fitmesh, unroll, patterns };
    return direct.init(wasm);
  },

  /**
   * Begins a solve under a number of the client's choice, by which it can be stopped at any time.
   * @param {number} id
   * @param {Input} input
   * @param {import('./types.js').SolverOptions} options
   * @param {number} interval milliseconds between two pieces of news, at least
   */
  start(id, input, options, interval) {
    jobs.set(id, new Job(() => new direct.Solver(input, options), interval));
  },

  /**
   * Begins a solve over a mesh likewise.
   * @param {number} id
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./types.js').MeshSolverOptions} options
   * @param {number} interval
   */
  startMesh(id, mesh, options, interval) {
    const begin = async () => {
      await loaded('fitmesh');
      return new direct.MeshSolver(mesh, options);
    };
    jobs.set(id, new Job(begin, interval));
  },

  /**
   * Keeps a solver under a number of the client's choice.
   * @param {number} solver
   * @param {Input} input
   */
  open(solver, input) {
    kept.set(solver, new KeptSolver(input));
  },

  /**
   * Begins a solve, as `start` does, with a solver that is kept.
   * @param {number} solver
   * @param {number} id
   * @param {import('./types.js').SolverOptions} options
   * @param {number} interval
   */
  startOpen(solver, id, options, interval) {
    jobs.set(id, keptSolver(solver).start(options, interval));
  },

  /**
   * @param {number} solver
   * @param {Input} input
   */
  replace(solver, input) {
    keptSolver(solver).replace(input);
  },

  /**
   * Gives a kept solver up; harmless when there is none.
   * @param {number} solver
   */
  close(solver) {
    kept.get(solver)?.dispose();
    kept.delete(solver);
  },

  /**
   * Resolves when there is news of the solve: progress, or progress and the surface.
   * @param {number} id
   */
  async next(id) {
    const job = jobs.get(id);
    if (!job) throw new DevelopableError('DISPOSED', 'there is no such solve');
    const news = await job.next().catch((error) => {
      jobs.delete(id);
      throw error;
    });
    const { surface } = news;
    if (!surface) return news;
    jobs.delete(id);
    if ('positions' in surface) return transfer(news, buffersOf(surface.positions));
    return transfer(news, buffersOf(surface.heights, surface.image?.data));
  },

  /**
   * Stops a solve; harmless when there is none.
   * @param {number} id
   * @param {boolean} keep whether the best surface so far is wanted
   */
  stop(id, keep) {
    const job = jobs.get(id);
    if (keep) {
      job?.finish();
    } else {
      job?.drop();
      jobs.delete(id);
    }
  },

  /** @type {(input: Input, options?: import('./types.js').OcclusionOptions) => import('./types.js').DetectedOcclusions} */
  occlusions(input, options) {
    const result = direct.occlusions(/** @type {import('./types.js').HeightImage} */ (input), options);
    return transfer(result, buffersOf(result.vertices, result.edges, result.image));
  },

  /**
   * @param {Parameters<typeof direct.read>[0]} bytes
   * @param {Parameters<typeof direct.read>[1]} [options]
   */
  async read(bytes, options) {
    await (isImage(asBytes(bytes), options) ? loaded('images') : loaded('files'));
    const result = direct.read(bytes, options);
    return transfer(result, buffersOf(result.data));
  },

  /** @param {Parameters<typeof direct.npzArrays>[0]} bytes */
  async npzArrays(bytes) {
    await loaded('images');
    return direct.npzArrays(bytes);
  },

  writeNpy: written('files', direct.writeNpy),
  writePng: written('files', direct.writePng),
  writeTiff: written('images', direct.writeTiff),
  writeExr: written('images', direct.writeExr),
  writeObj: written('files', direct.writeObj),
  writeMtl: written('files', direct.writeMtl),
  writePly: written('meshes', direct.writePly),
  writeStl: written('meshes', direct.writeStl),
  writeGlb: written('meshes', direct.writeGlb),
  writePhoto: written('files', direct.writePhoto),
  writeSvg: written('patterns', direct.writeSvg),
  writePdf: written('patterns', direct.writePdf),
  writeDxf: written('patterns', direct.writeDxf),

  /** @param {Parameters<typeof direct.readPhoto>[0]} bytes */
  async readPhoto(bytes) {
    await withPictures([bytes]);
    const photo = direct.readPhoto(bytes);
    return transfer(photo, buffersOf(photo.data));
  },

  /** @type {(input: Input, picture: import('./types.js').Picture, options?: import('./types.js').PaintOptions) => Promise<ReturnType<typeof paintOf>>} */
  async paint(input, picture, options) {
    const seen = /** @type {import('./types.js').Heightfield} */ (input).camera ?? options?.camera;
    await Promise.all([withPictures([picture]), seen && loaded('meshes')]);
    const painted = paintOf(/** @type {import('./types.js').Heightfield} */ (input), picture, options);
    return transfer(painted, buffersOf(painted.uvs, painted.colors));
  },

  /** @type {(input: Input, options?: import('./types.js').AnalyzeOptions) => Promise<import('./types.js').Analysis>} */
  async analyze(input, options) {
    await loaded('unroll');
    const result = direct.analyze(heights(input), options);
    return transfer(result, buffersOf(result.gaussian, result.kappa1, result.kappa2, result.nuclearNorm));
  },

  /** @type {(input: Input, options?: import('./types.js').PatchOptions) => Promise<import('./types.js').PatchMap>} */
  async patches(input, options) {
    await loaded('unroll');
    const result = direct.patches(heights(input), options);
    return transfer(result, buffersOf(result.labels));
  },

  /** @type {(input: Input, options?: import('./types.js').PictureOptions) => Promise<import('./types.js').SurfacePicture>} */
  async picture(input, options) {
    await loaded('unroll');
    return direct.picture(heights(input), options);
  },

  /** @type {(input: Input, options?: import('./types.js').RulingOptions) => Promise<import('./types.js').RulingField>} */
  async rulings(input, options) {
    await loaded('unroll');
    const result = direct.rulings(heights(input), options);
    return transfer(result, buffersOf(result.directions, result.confidence));
  },

  /** @type {(input: Input) => Promise<import('./types.js').FittedCylinder>} */
  async fitCylinder(input) {
    const result = direct.fitCylinder(/** @type {import('./types.js').Heightfield} */ (input));
    return transfer(result, buffersOf(result.heights));
  },

  /** @type {(input: Input, options?: import('./types.js').UnrollOptions) => Promise<import('./types.js').Unrolling>} */
  async unroll(input, options) {
    await loaded('unroll');
    const result = direct.unroll(heights(input), options);
    const { vertices, positions, triangles, places, parts, stretches, overlaps } = result;
    return transfer(result, buffersOf(vertices, positions, triangles, places, parts, stretches, overlaps));
  },

  /** @type {(input: Input, options?: import('./types.js').PatternOptions) => Promise<import('./types.js').Drawing>} */
  async pattern(input, options) {
    await loaded('patterns');
    return direct.pattern(heights(input), options);
  },

  /** @type {(mesh: import('./types.js').Mesh, options?: import('./types.js').MeshAnalyzeOptions) => Promise<import('./types.js').MeshAnalysis>} */
  async analyzeMesh(mesh, options) {
    await loaded('fitmesh');
    const result = direct.analyzeMesh(mesh, options);
    return transfer(result, buffersOf(result.gaussian, result.kappa1, result.kappa2, result.nuclearNorm, result.rulings));
  },

  /** @type {(mesh: import('./types.js').Mesh, options?: import('./types.js').MeshRulingOptions) => Promise<import('./types.js').MeshRulings>} */
  async meshRulings(mesh, options) {
    await loaded('fitmesh');
    const result = direct.meshRulings(mesh, options);
    return transfer(result, buffersOf(result.directions, result.confidence));
  },

  /** @type {(mesh: import('./types.js').Mesh, options?: import('./types.js').MeshUnrollOptions) => Promise<import('./types.js').MeshUnrolling>} */
  async unrollMesh(mesh, options) {
    await loaded('patterns');
    const result = direct.unrollMesh(mesh, options);
    const { labels, positions, places, triangles, sheets } = result;
    return transfer(result, buffersOf(labels, positions, places, triangles, sheets));
  },

  /** @type {(mesh: import('./types.js').Mesh, options?: import('./types.js').MeshPatternOptions) => Promise<import('./types.js').Drawing>} */
  async patternMesh(mesh, options) {
    await loaded('patterns');
    return direct.patternMesh(mesh, options);
  },

  /** @type {(input: Input, photo: import('./types.js').Photo, options?: import('./types.js').DewarpOptions) => Promise<import('./types.js').Dewarped>} */
  async dewarp(input, photo, options) {
    await loaded('unroll');
    const result = direct.dewarp(heights(input), photo, options);
    return transfer(result, buffersOf(result.data, result.map, result.grid?.places));
  },

  /** @type {(photo: import('./types.js').Photo, edges: import('./types.js').PageEdges | readonly import('./types.js').PageEdges[], options?: import('./types.js').DewarpPageOptions) => Promise<import('./types.js').DewarpedPage>} */
  async dewarpPage(photo, edges, options) {
    await loaded('unroll');
    const result = direct.dewarpPage(photo, edges, options);
    const { positions, triangles, uvs } = result.mesh;
    return transfer(result, buffersOf(result.data, result.map, result.grid?.places, positions, triangles, uvs));
  },

  /**
   * @param {Parameters<typeof direct.readMesh>[0]} bytes
   * @param {Parameters<typeof direct.readMesh>[1]} [options]
   */
  async readMesh(bytes, options) {
    await loaded('meshes');
    const mesh = direct.readMesh(bytes, options);
    return transfer(mesh, buffersOf(mesh.positions, mesh.triangles, mesh.colors, mesh.uvs, mesh.textureOf));
  },

  /**
   * @param {Parameters<typeof direct.sampleMesh>[0]} mesh
   * @param {Parameters<typeof direct.sampleMesh>[1]} [options]
   */
  async sampleMesh(mesh, options) {
    await Promise.all([loaded('meshes'), mesh.textures && withPictures(mesh.textures)]);
    const sampled = direct.sampleMesh(mesh, options);
    return transfer(sampled, buffersOf(sampled.heights, sampled.colors, sampled.uvs, sampled.confidence));
  },

  /**
   * @param {Parameters<typeof direct.backProject>[0]} input
   * @param {Parameters<typeof direct.backProject>[1]} camera
   * @param {Parameters<typeof direct.backProject>[2]} [known]
   */
  async backProject(input, camera, known) {
    await loaded('meshes');
    const mesh = direct.backProject(input, camera, known);
    return transfer(mesh, buffersOf(mesh.positions, mesh.triangles, mesh.uvs, mesh.confidence));
  },

  /** @type {typeof direct.example} */
  example(name, options) {
    const result = direct.example(name, options);
    return transfer(result, buffersOf(result.input.data, result.truth));
  },
};

/** A field as any caller's. @param {Input} input */
function heights(input) {
  return /** @type {import('./types.js').HeightImage} */ (input);
}

/** @param {number} solver */
function keptSolver(solver) {
  const found = kept.get(solver);
  if (!found) throw new DevelopableError('DISPOSED', 'there is no such solver');
  return found;
}

/** @param {PartName} part */
const loaded = (part) => direct.load({ [part]: places[part] });

/**
 * What it takes to read pictures, and to paint with them.
 * @param {import('./types.js').Picture[]} pictures
 */
async function withPictures(pictures) {
  const others = pictures.some((picture) => {
    const given = asPicture(picture);
    return given instanceof Uint8Array && isImage(given);
  });
  await Promise.all([loaded('files'), others && loaded('images')]);
}

/**
 * @template T, O
 * @param {PartName} part
 * @param {(input: T, options?: O) => Uint8Array<ArrayBuffer>} write
 */
function written(part, write) {
  /**
   * @param {T} input
   * @param {O} [options]
   */
  return async (input, options) => {
    await loaded(part);
    const bytes = write(input, options);
    return transfer(bytes, buffersOf(bytes));
  };
}

/** @param {(ArrayBufferView | undefined)[]} arrays */
function buffersOf(...arrays) {
  return arrays.flatMap((array) => (array?.buffer instanceof ArrayBuffer ? [array.buffer] : []));
}
