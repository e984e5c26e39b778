/** Draws an input and its result in space, on both sides of a divider, by three.js, which is loaded with the first scene. */
import { oncePerFrame } from '../dom.js';
import { fillMatcap, lightFrom, MATCAP_SIDE_TEXELS } from './matcap.js';
import { addPictureKeys, KEY_MOVE_SHARE, MAX_ZOOM } from './zoom.js';

/** @import {Line} from './layer.js' */
/** @typedef {readonly [number, number, number]} Vector */
/** @typedef {{ low: readonly number[], high: readonly number[] }} Box */

/**
 * @typedef {object} Surface a mesh, or a cloud of points
 * @property {Float64Array | Float32Array} positions x, y, z of each vertex
 * @property {Uint32Array} triangles none for a cloud of points
 * @property {Float32Array} [colors] of the vertices, 0 to 1
 * @property {Float32Array} [uvs] places of the vertices in their texture, from its lower left corner
 * @property {readonly HTMLCanvasElement[]} [textures]
 * @property {Int32Array} [textureOf] index in `textures` for each triangle, −1 for none; by default 0
 */

/**
 * How surfaces look, and from where.
 * @typedef {object} Look
 * @property {Vector} up the axis that points upwards
 * @property {Vector} direction of the first view
 * @property {boolean} [isMetal] surfaces mirror the light, as steel; otherwise they are paper
 * @property {boolean} [isFaceted] triangles are shaded flat
 * @property {boolean} [isSeenFromAbove] the camera stays above the ground
 */
/** @typedef {{ after: boolean, triangle: number, shares: Vector, point: Vector }} Place a place of a surface; `after`: right of the divider; `shares`: barycentric coordinates */

/** Share of the frame that the surface fills at first. */
const FILLED_SHARE = 0.8;
/** Half of the side of the ground, and the distance of the light that casts the shadow, in radii of the box. */
const GROUND_HALF_WIDTH = 1.6;
const SHADOW_LIGHT_DISTANCE = 3;
/** Side of the map of the shadow, in pixels. A small one blurs its edge. */
const SHADOW_MAP_SIDE = 256;
/** Angle of the first turn, in radians, and its duration, in milliseconds. */
const FIRST_TURN_RADIANS = 0.7;
const FIRST_TURN_MS = 1800;
/** Distance of the camera from the centre, in radii of the box. */
const CAMERA_DISTANCE = 50;
/** Distance by which lines are drawn nearer than the surface that they lie on, in radii of the box. */
const LINE_OFFSET = 0.012;
/** Looks of paper from the front right and above, by the axis that points upwards. @type {Record<'y' | 'z', Look>} */
export const PAPER_LOOKS = {
  y: { up: [0, 1, 0], direction: [-0.5, -0.45, -0.75], isFaceted: true },
  z: { up: [0, 0, 1], direction: [-0.5, 0.75, -0.45], isFaceted: true },
};
/** Minimum enlargement. */
const MIN_ZOOM = 0.5;
/** Rotation for a press of an arrow key. */
const KEY_TURN_RADIANS = Math.PI / 24;

/** Loads three.js, which browsers fetch once. */
export const loadThree = () => import(new URL('../vendor/three.js', import.meta.url).href);

export class SceneView {
  #three;
  #ownSize;
  /** @type {Look} */
  #look = { up: [0, 0, 1], direction: [0, 0, -1] };
  #renderer;
  #scene;
  #camera;
  #controls;
  #raycaster;
  #shadowLight;
  /** The plane beneath the surface, on which its shadow lies. */
  #ground;
  /** The surface and the lines left and right of the divider. @type {{ surface: any, lines: any }[]} */
  #sides = [{ surface: null, lines: null }, { surface: null, lines: null }];
  /** Textures that hold the colour of each normal: of plain surfaces, and of those with colours of their own. @type {any[]} */
  #matcaps;
  #shownTilt = '';
  #shownSize = '';
  #divider = 1;
  /** Centre of the box, and the factor that makes its radius 1. */
  #frame = { middle: [0, 0, 0], scale: 1 };
  /** @type {Box} */
  #box = { low: [0, 0, 0], high: [0, 0, 0] };
  /** Whether `fit` was asked for while the canvas had no size. */
  #isFitDue = false;
  /** Materials by kind, which are kept so that their shaders are compiled once. @type {Map<string, any>} */
  #materials = new Map();
  #resizing = new ResizeObserver(() => {
    if (this.#canvasSize() !== this.#shownSize) this.draw();
  });
  /** Ends the first turn. */
  #turning = new AbortController();
  /** Draws the picture with the next frame. */
  drawSoon = oncePerFrame(() => this.draw());

  /**
   * Creates a scene on a canvas.
   * @param {HTMLCanvasElement} canvas
   * @param {{ width: number, height: number }} [size] of the picture in pixels, for a canvas that is not shown
   * @throws without WebGL 2
   */
  static async create(canvas, size) {
    const isFast = hasGraphicsCard();
    // The buffer is kept, so that the picture can be saved.
    const context = canvas.getContext('webgl2', { antialias: isFast, preserveDrawingBuffer: true });
    if (!context) throw new Error('this browser has no WebGL 2');
    return new SceneView(canvas, context, await loadThree(), isFast, size);
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {WebGL2RenderingContext} context
   * @param {any} three the library, which has no types
   * @param {boolean} isFast whether there is a graphics card
   * @param {{ width: number, height: number }} [size]
   */
  constructor(canvas, context, three, isFast, size) {
    this.canvas = canvas;
    this.isFast = isFast;
    this.#three = three;
    this.#ownSize = size;
    // Colours are those of the screen throughout.
    three.ColorManagement.enabled = false;
    this.#renderer = new three.WebGLRenderer({ canvas, context });
    this.#renderer.outputColorSpace = three.LinearSRGBColorSpace;
    Object.assign(this.#renderer.shadowMap, { enabled: true, autoUpdate: false });
    this.#renderer.setScissorTest(true);
    this.#matcaps = [0, 1].map(() => {
      const texels = new Uint8Array(4 * MATCAP_SIDE_TEXELS ** 2);
      return Object.assign(new three.DataTexture(texels, MATCAP_SIDE_TEXELS, MATCAP_SIDE_TEXELS), { magFilter: three.LinearFilter, minFilter: three.LinearFilter });
    });
    this.#camera = new three.OrthographicCamera(-1, 1, 1, -1, 0, 2 * CAMERA_DISTANCE);
    this.#raycaster = new three.Raycaster();
    this.#shadowLight = new three.DirectionalLight();
    this.#shadowLight.castShadow = true;
    const { shadow } = this.#shadowLight;
    shadow.mapSize.set(SHADOW_MAP_SIDE, SHADOW_MAP_SIDE);
    shadow.radius = 6;
    Object.assign(shadow.camera, { left: -GROUND_HALF_WIDTH, right: GROUND_HALF_WIDTH, top: GROUND_HALF_WIDTH, bottom: -GROUND_HALF_WIDTH, near: 0.1, far: 2 * SHADOW_LIGHT_DISTANCE });
    this.#ground = new three.Mesh(new three.PlaneGeometry(2 * GROUND_HALF_WIDTH, 2 * GROUND_HALF_WIDTH), new three.ShadowMaterial({ opacity: 0.28 }));
    Object.assign(this.#ground, { receiveShadow: true, visible: false });
    this.#scene = new three.Scene();
    this.#scene.add(this.#shadowLight, this.#ground);
    addPictureKeys(canvas, {
      move: (across, up, isShift) => {
        if (!isShift) return this.turn(KEY_TURN_RADIANS * across, -KEY_TURN_RADIANS * up);
        this.#controls.pan(KEY_MOVE_SHARE * canvas.clientWidth * across, -KEY_MOVE_SHARE * canvas.clientHeight * up);
        this.#controls.update();
      },
      zoom: (factor) => {
        this.#camera.zoom = Math.min(MAX_ZOOM, Math.max(MIN_ZOOM, this.#camera.zoom * factor));
        this.drawSoon();
      },
      reset: () => this.look(),
    });
    this.#controls = this.#createControls();
    this.#resizing.observe(canvas);
    this.setDirection(this.#look.direction);
  }

  #createControls() {
    const controls = new this.#three.OrbitControls(this.#camera, this.canvas);
    Object.assign(controls, { zoomToCursor: true, minZoom: MIN_ZOOM, maxZoom: MAX_ZOOM, maxPolarAngle: this.#look.isSeenFromAbove ? Math.PI / 2 : Math.PI });
    // The style sheet says which touches scroll the page.
    this.canvas.style.touchAction = '';
    controls.addEventListener('change', this.drawSoon);
    return controls;
  }

  /** Sets the box that the view shows; surfaces and lines have to follow. @param {Box} box */
  setBox({ low, high }) {
    const scale = 2 / (Math.hypot(...low.map((value, k) => high[k] - value)) || 1);
    this.#frame = { middle: low.map((value, k) => (value + high[k]) / 2), scale };
    this.#box = { low, high };
    this.#layGround();
  }

  /** Sets how surfaces look; surfaces and `look` have to follow. @param {Look} look */
  setLook(look) {
    const [x, y, z] = look.up;
    this.#look = look;
    this.#shownTilt = '';
    this.#camera.up.set(x, y, z);
    // The controls read the axis only when they are created.
    this.#controls.dispose();
    this.#controls = this.#createControls();
    this.#ground.visible = true;
    // A little aside, so that the shadow shows at the foot of the surface.
    this.#shadowLight.position.set(x + 0.25 * y, y + 0.25 * z, z + 0.25 * x).multiplyScalar(SHADOW_LIGHT_DISTANCE);
    // From where it lies, it would look elsewhere.
    this.#ground.position.setScalar(0);
    this.#ground.lookAt(x, y, z);
    this.#layGround();
  }

  /** Lays the ground beneath the box. */
  #layGround() {
    const { up } = this.#camera;
    this.#ground.position.copy(up).multiplyScalar(up.dot(this.#place(this.#box.low)));
    this.#renderer.shadowMap.needsUpdate = true;
    this.drawSoon();
  }

  /** A place in the units of the drawn box. @param {readonly number[]} place */
  #place(place) {
    const { middle, scale } = this.#frame;
    return new this.#three.Vector3(...place.map((value, k) => (value - middle[k]) * scale));
  }

  /** Places in the units of the drawn box, for which 32-bit floats are precise enough. @param {ArrayLike<number>} places */
  #scaled(places) {
    const { middle, scale } = this.#frame;
    const scaled = new Float32Array(places.length);
    for (let i = 0; i < places.length; i++) scaled[i] = (places[i] - middle[i % 3]) * scale;
    return new this.#three.BufferAttribute(scaled, 3);
  }

  /** @param {0 | 1} side @param {'surface' | 'lines'} what @param {any} object */
  #replace(side, what, object) {
    const old = this.#sides[side][what];
    old?.traverse((/** @type {any} */ { geometry, material }) => {
      geometry?.dispose();
      for (const textured of Array.isArray(material) ? material.slice(1) : []) {
        textured.map.dispose();
        textured.dispose();
      }
    });
    if (old) this.#scene.remove(old);
    this.#sides[side][what] = object;
    if (object) this.#scene.add(object);
    this.drawSoon();
  }

  /** Sets the surface on a side of the divider. @param {0 | 1} side @param {Surface | null} surface */
  setSurface(side, surface) {
    this.#renderer.shadowMap.needsUpdate = true;
    this.#replace(side, 'surface', surface && this.#createSurface(surface));
  }

  /** The material of a kind, which is created once. @param {string} kind @param {() => any} create */
  #material(kind, create) {
    if (!this.#materials.has(kind)) this.#materials.set(kind, create());
    return this.#materials.get(kind);
  }

  /** @param {Surface} surface */
  #createSurface({ positions, triangles, colors, uvs, textures, textureOf }) {
    const three = this.#three;
    const geometry = new three.BufferGeometry();
    geometry.setAttribute('position', this.#scaled(positions));
    if (colors) geometry.setAttribute('color', new three.BufferAttribute(colors, 3));
    if (uvs) geometry.setAttribute('uv', new three.BufferAttribute(uvs, 2));
    const vertexColors = colors !== undefined;
    if (triangles.length === 0) return new three.Points(geometry, this.#material(`points ${vertexColors}`, () => new three.PointsMaterial({ vertexColors, size: 2, sizeAttenuation: false })));
    geometry.setIndex(new three.BufferAttribute(triangles, 1));
    const flatShading = this.#look.isFaceted ?? false;
    if (!flatShading) geometry.computeVertexNormals();
    const plain = this.#material(`mesh ${vertexColors} ${flatShading}`, () => new three.MeshMatcapMaterial({
      vertexColors, flatShading, side: three.DoubleSide, matcap: this.#matcaps[vertexColors ? 1 : 0],
    }));
    const textured = textures?.map((image) => new three.MeshMatcapMaterial({
      map: Object.assign(new three.CanvasTexture(image), { wrapS: three.RepeatWrapping, wrapT: three.RepeatWrapping }), flatShading, side: three.DoubleSide, matcap: this.#matcaps[1],
    }));
    // Each run of triangles with the same texture is drawn by itself.
    const [count, texture] = [triangles.length / 3, (/** @type {number} */ triangle) => textureOf?.[triangle] ?? 0];
    for (let from = 0, to = 1; textured && from < count; to++) {
      if (to < count && texture(to) === texture(from)) continue;
      geometry.addGroup(3 * from, 3 * (to - from), texture(from) + 1);
      from = to;
    }
    const mesh = new three.Mesh(geometry, textured ? [plain, ...textured] : plain);
    mesh.castShadow = true;
    return mesh;
  }

  /** Sets the lines on a surface. @param {0 | 1} side @param {readonly Line[]} lines */
  setLines(side, lines) {
    const three = this.#three;
    const group = new three.Group();
    for (const width of new Set(lines.map((line) => line.width))) {
      const alike = lines.filter((line) => line.width === width);
      const geometry = new three.LineSegmentsGeometry();
      geometry.setPositions(this.#scaled(alike.flatMap(({ points }) => points.slice(1).flatMap((point, i) => [...points[i], ...point]))).array);
      geometry.setColors(alike.flatMap(({ points, colour }) => points.slice(1).flatMap(() => [...colour, ...colour].map((value) => value / 255))));
      group.add(new three.LineSegments2(geometry, this.#material(`line ${width}`, () => new three.LineMaterial({ linewidth: width, vertexColors: true }))));
    }
    this.#replace(side, 'lines', lines.length > 0 ? group : null);
  }

  /** Moves the divider. @param {number} share of the canvas left of it */
  divide(share) {
    this.#divider = share;
    this.drawSoon();
  }

  /** Zooms and moves the camera so that the surfaces fill the frame as they are seen now. */
  fit() {
    this.#isFitDue = this.#size.width === 0;
    if (this.#isFitDue) return;
    this.#camera.updateMatrixWorld();
    const point = new this.#three.Vector3();
    const box = new this.#three.Box3();
    for (const { array } of this.#sides.flatMap(({ surface }) => surface?.geometry.getAttribute('position') ?? [])) {
      for (let i = 0; i < array.length; i += 3) box.expandByPoint(point.fromArray(array, i).applyMatrix4(this.#camera.matrixWorldInverse));
    }
    if (box.isEmpty()) return;
    const size = box.getSize(point).toArray();
    this.#camera.zoom = Math.min(...this.#halfSides.map((side, k) => (2 * FILLED_SHARE * side) / (size[k] || 1)));
    const shift = box.getCenter(point).setZ(0).applyQuaternion(this.#camera.quaternion);
    this.#camera.position.add(shift);
    this.#controls.target.add(shift);
    this.drawSoon();
  }

  /** The size of the picture in CSS pixels. */
  get #size() {
    return this.#ownSize ?? { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
  }

  /** Half of the sides of the view without zoom, in the units of the drawn box. */
  get #halfSides() {
    const { width, height } = this.#size;
    return [Math.max(1, width / height), Math.max(1, height / width)];
  }

  /** Turns the surface slowly to its present direction, once, unless the user takes hold of it or prefers less motion. */
  turnOnce() {
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) return;
    this.#turning.abort();
    const turning = (this.#turning = new AbortController());
    const { signal } = turning;
    for (const event of ['pointerdown', 'keydown', 'wheel']) this.canvas.addEventListener(event, () => turning.abort(), { passive: true, signal });
    const start = performance.now();
    let remaining = 0;
    /** @param {number} now */
    const step = (now) => {
      if (signal.aborted) return;
      const share = Math.min(1, Math.max(0, (now - start) / FIRST_TURN_MS));
      const next = FIRST_TURN_RADIANS * (1 - share) ** 2;
      this.turn(next - remaining, 0);
      remaining = next;
      if (share < 1) requestAnimationFrame(step);
      else turning.abort();
    };
    requestAnimationFrame(step);
  }

  /** Turns the camera about the vertical and upwards. @param {number} across @param {number} up in radians */
  turn(across, up) {
    this.#controls.rotateLeft(across);
    this.#controls.rotateUp(up);
    this.#controls.update();
  }

  /** Sets the direction of view, resets zoom and place, and ends the first turn. @param {Vector} direction */
  setDirection(direction) {
    this.#turning.abort();
    this.#camera.zoom = 1;
    this.#controls.target.set(0, 0, 0);
    this.#camera.position.set(...direction).normalize().multiplyScalar(-CAMERA_DISTANCE);
    this.#controls.update();
    this.drawSoon();
  }

  /** Sets the direction of view and fits the surfaces into the frame. @param {Vector} [direction] by default that of the first view */
  look(direction = this.#look.direction) {
    this.setDirection(direction);
    this.fit();
  }

  /** Looks straight down. */
  lookDown() {
    const [x, y, z] = this.#look.up;
    this.look([-x, -y, -z]);
  }

  /** Angle of the camera in radians, from straight above. */
  get #tilt() {
    return this.#camera.up.angleTo(this.#camera.getWorldDirection(new this.#three.Vector3()).negate());
  }

  /** The place of a point on the canvas, in CSS pixels. @param {Vector} point @returns {[number, number]} */
  project(point) {
    this.#prepareCamera();
    const { x, y } = this.#place(point).project(this.#camera);
    const { width, height } = this.#size;
    return [((1 + x) / 2) * width, ((1 - y) / 2) * height];
  }

  /** Finds the triangle at a place of the canvas. @param {{ offsetX: number, offsetY: number }} place @returns {Place | null} null without a triangle */
  pick({ offsetX, offsetY }) {
    const { width, height } = this.#size;
    const side = this.#sides[1].surface && offsetX >= this.#divider * width ? 1 : 0;
    const { surface } = this.#sides[side];
    if (!surface?.isMesh || width === 0) return null;
    this.#prepareCamera();
    this.#raycaster.setFromCamera({ x: (2 * offsetX) / width - 1, y: 1 - (2 * offsetY) / height }, this.#camera);
    const [first] = this.#raycaster.intersectObject(surface, false);
    if (!first) return null;
    const { x, y, z } = first.barycoord;
    const { middle, scale } = this.#frame;
    return { after: side === 1, triangle: first.faceIndex, shares: [x, y, z], point: first.point.toArray().map((/** @type {number} */ value, /** @type {number} */ k) => value / scale + middle[k]) };
  }

  /** Fits the camera to the canvas. */
  #prepareCamera() {
    const [across, up] = this.#halfSides;
    Object.assign(this.#camera, { left: -across, right: across, top: up, bottom: -up });
    this.#camera.updateProjectionMatrix();
    this.#camera.updateMatrixWorld();
  }

  /** Colours the normals under the light. */
  #shade() {
    const { isMetal = false } = this.#look;
    const tilt = isMetal ? this.#tilt : 0;
    if (tilt.toFixed(3) === this.#shownTilt) return;
    this.#shownTilt = tilt.toFixed(3);
    this.#matcaps.forEach((matcap, i) => {
      fillMatcap(matcap.image.data, lightFrom(tilt), { isMetal, isPale: i === 1 });
      matcap.needsUpdate = true;
    });
  }

  /** Key of the canvas's size: width and height of its element, and pixels per CSS pixel. */
  #canvasSize(ratio = window.devicePixelRatio) {
    const { width, height } = this.#size;
    return [width, height, ratio].join();
  }

  /** Draws the picture now. @param {number} [ratio] pixels of the canvas per CSS pixel */
  draw(ratio = this.#ownSize ? 1 : window.devicePixelRatio) {
    const { width, height } = this.#size;
    if (width === 0) return;
    if (this.#isFitDue) this.fit();
    // A canvas that is resized, even to its own size, is made anew.
    const size = this.#canvasSize(ratio);
    if (size !== this.#shownSize) {
      this.#shownSize = size;
      this.#renderer.setPixelRatio(ratio);
      this.#renderer.setSize(width, height, false);
    }
    this.#prepareCamera();
    this.#shade();
    const offset = this.#camera.getWorldDirection(new this.#three.Vector3()).multiplyScalar(-LINE_OFFSET);
    const line = this.#sides[1].surface ? Math.round(this.#divider * width) : width;
    for (const [i, from, to] of [[0, 0, line], [1, line, width]]) {
      if (to <= from) continue;
      this.#sides.forEach(({ surface, lines }, which) => {
        if (surface) surface.visible = which === i;
        if (lines) Object.assign(lines, { visible: which === i }).position.copy(offset);
      });
      this.#renderer.setScissor(from, 0, to - from, height);
      this.#renderer.render(this.#scene, this.#camera);
    }
  }

  /** Frees the memory of the graphics card, and all that listens. */
  dispose() {
    this.#turning.abort();
    this.#resizing.disconnect();
    this.#controls.dispose();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
  }
}

/** Whether WebGL is drawn by a graphics card, and not by the processor, for which surfaces are coarser and edges not smoothed. */
function hasGraphicsCard() {
  const probe = document.createElement('canvas').getContext('webgl2');
  const name = String(probe?.getParameter(probe.getExtension('WEBGL_debug_renderer_info')?.UNMASKED_RENDERER_WEBGL ?? probe.RENDERER));
  probe?.getExtension('WEBGL_lose_context')?.loseContext();
  return !/swiftshader|llvmpipe|software|basic render/i.test(name);
}
