/** Shows a mesh that can be turned, by three.js, which is loaded with the first mesh. */
import { LineBuffers, programOf } from './gl.js';
import { lineFragment, lineVertex } from './shaders.js';
import { ARROW_DIRECTIONS } from './view-keys.js';

/** @import {Mesh} from '../api.js' */
/** @import {Program} from './gl.js' */
/** @import {Line} from './layer.js' */
/** @typedef {readonly [number, number, number]} Vector */

/** Radius of the drawn mesh, which is scaled to it. */
const MESH_RADIUS = 1;
/** Half of the shorter side of a view without zoom, in units of the drawn mesh. */
const VIEW_HALF_WIDTH = 1.04;
/** Share of the frame that the mesh fills at first. */
const FILLED_SHARE = 0.8;
/** Half of the side of the ground, and the distance of the light that casts the shadow, in units of the drawn mesh. */
const GROUND_HALF_WIDTH = 1.6;
const SHADOW_LIGHT_DISTANCE = 3;
/** Side of the map of the shadow, in pixels. A small one blurs its edge. */
const SHADOW_MAP_SIDE = 256;
/** Colour of a surface without colours of its own: paper. */
const PAPER_COLOUR = 0xe9eef2;
/** Angle of the first turn, in radians, and its duration, in milliseconds. */
const FIRST_TURN_RADIANS = 0.7;
const FIRST_TURN_MS = 1800;
/** Distance of the camera from the centre. */
const CAMERA_DISTANCE = 10;
/** Half of the visible depth range. A smaller one brings lines nearer to the surface they are drawn on. */
const VIEW_HALF_DEPTH = 2;
/** Rotation for a press of an arrow key. */
const KEY_TURN_RADIANS = Math.PI / 24;

export class MeshView {
  #three;
  #turned;
  #renderer;
  #scene;
  #camera;
  #controls;
  /** The objects left and right of the divider. @type {any[]} */
  #objects = [];
  #divider = 1;
  #material;
  #shadowLight;
  /** The plane beneath the mesh, on which its shadow lies; hidden until the axis is known that points upwards. */
  #ground;
  /** Lines on the object right of the divider. @type {LineBuffers | null} */
  #lines = null;
  /** @type {Program | null} */
  #lineProgram = null;
  /** @type {any} */
  #raycaster = null;
  /** Whether `setDirection` is turning the mesh, and not the user. */
  #isSettingDirection = false;
  /** The direction of view at the last change, as a string. */
  #lastDirection = '';
  /** Ends the first turn of the mesh. */
  #turning = new AbortController();

  /**
   * Creates a view on a canvas.
   * @param {HTMLCanvasElement} canvas
   * @param {(view: MeshView) => void} [turned] called when the user has turned the mesh
   * @param {Record<string, unknown>} [material] parameters of three.js for the material of surfaces
   * @throws without WebGL
   */
  static async create(canvas, turned = () => {}, material = {}) {
    const three = await import(new URL('../vendor/three.js', import.meta.url).href);
    return new MeshView(canvas, three, turned, material);
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {any} three the library, which has no types
   * @param {(view: MeshView) => void} turned
   * @param {Record<string, unknown>} material
   */
  constructor(canvas, three, turned, material) {
    this.canvas = canvas;
    this.#material = material;
    this.#three = three;
    this.#renderer = new three.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#scene = new three.Scene();
    this.#camera = new three.OrthographicCamera(-VIEW_HALF_WIDTH, VIEW_HALF_WIDTH, VIEW_HALF_WIDTH, -VIEW_HALF_WIDTH, CAMERA_DISTANCE - VIEW_HALF_DEPTH, CAMERA_DISTANCE + VIEW_HALF_DEPTH);
    this.#renderer.shadowMap.enabled = true;
    // One light moves with the camera; the other casts the shadow, from above.
    const light = new three.DirectionalLight(0xffffff, 1.9);
    light.position.set(-0.9, 0.8, 0.7);
    this.#camera.add(light);
    this.#shadowLight = new three.DirectionalLight(0xffffff, 0.6);
    this.#shadowLight.castShadow = true;
    this.#shadowLight.shadow.mapSize.set(SHADOW_MAP_SIDE, SHADOW_MAP_SIDE);
    this.#shadowLight.shadow.radius = 6;
    Object.assign(this.#shadowLight.shadow.camera, { left: -GROUND_HALF_WIDTH, right: GROUND_HALF_WIDTH, top: GROUND_HALF_WIDTH, bottom: -GROUND_HALF_WIDTH, near: 0.1, far: 2 * SHADOW_LIGHT_DISTANCE });
    this.#ground = new three.Mesh(new three.PlaneGeometry(2 * GROUND_HALF_WIDTH, 2 * GROUND_HALF_WIDTH), new three.ShadowMaterial({ opacity: 0.28 }));
    this.#ground.receiveShadow = true;
    this.#ground.visible = false;
    this.#scene.add(this.#camera, new three.HemisphereLight(0xffffff, 0xa8b2be, 1.1), this.#shadowLight, this.#ground);
    this.#turned = turned;
    this.#controls = this.#createControls();
    new ResizeObserver(() => this.#draw()).observe(canvas);
    canvas.addEventListener('keydown', (event) => {
      const arrow = ARROW_DIRECTIONS[event.key];
      if (!arrow) return;
      event.preventDefault();
      this.#controls.rotateLeft(-KEY_TURN_RADIANS * arrow[0]);
      this.#controls.rotateUp(KEY_TURN_RADIANS * arrow[1]);
      this.#controls.update();
    });
    this.setDirection([0, 0, -1]);
  }

  #createControls() {
    const controls = new this.#three.OrbitControls(this.#camera, this.canvas);
    controls.enablePan = false;
    controls.addEventListener('change', () => {
      this.#draw();
      const now = String(this.direction);
      // Zooming does not change the direction.
      if (!this.#isSettingDirection && now !== this.#lastDirection) this.#turned(this);
      this.#lastDirection = now;
    });
    return controls;
  }

  /** Sets the axis that points upwards; `setDirection` has to follow. @param {Vector} axis */
  setUp([x, y, z]) {
    this.#camera.up.set(x, y, z);
    // The controls read the axis only when they are created.
    this.#controls.dispose();
    this.#controls = this.#createControls();
    this.#ground.visible = true;
    // A little aside, so that the shadow shows at the foot of the mesh.
    this.#shadowLight.position.set(x + 0.25 * y, y + 0.25 * z, z + 0.25 * x).multiplyScalar(SHADOW_LIGHT_DISTANCE);
    this.#ground.lookAt(x, y, z);
    this.#layGround();
  }

  /** Lays the ground beneath the mesh. */
  #layGround() {
    if (!this.#ground.visible || this.#objects.length === 0) return;
    const { up } = this.#camera;
    const box = new this.#three.Box3().setFromObject(this.#objects[0]);
    this.#ground.position.copy(up).multiplyScalar(box.min.dot(up));
  }

  /** Zooms so that the mesh fills the frame as it is seen now. */
  fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (this.#objects.length === 0 || width === 0) return;
    this.#camera.updateMatrixWorld();
    const { array } = this.#objects[0].geometry.getAttribute('position');
    const point = new this.#three.Vector3();
    let [across, up] = [0, 0];
    for (let i = 0; i < array.length; i += 3) {
      point.fromArray(array, i).applyMatrix4(this.#camera.matrixWorldInverse);
      [across, up] = [Math.max(across, Math.abs(point.x)), Math.max(up, Math.abs(point.y))];
    }
    const [halfWidth, halfHeight] = [Math.max(1, width / height), Math.max(1, height / width)].map((side) => FILLED_SHARE * VIEW_HALF_WIDTH * side);
    this.#camera.zoom = Math.min(halfWidth / (across || 1), halfHeight / (up || 1));
    this.#draw();
  }

  /** Turns the mesh slowly to its present direction, once, unless the user takes hold of it or prefers less motion. */
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
      this.#isSettingDirection = true;
      this.#controls.rotateLeft(next - remaining);
      this.#controls.update();
      this.#isSettingDirection = false;
      remaining = next;
      if (share < 1) requestAnimationFrame(step);
      else turning.abort();
    };
    requestAnimationFrame(step);
  }

  /**
   * Shows a mesh, or two meshes on both sides of the divider.
   * @param {Mesh} mesh
   * @param {Mesh} [after] mesh right of the divider, in the same coordinates
   * @param {readonly Line[]} [lines] lines on the mesh right of the divider
   */
  show(mesh, after, lines = []) {
    for (const { geometry, material } of this.#objects) {
      geometry.dispose();
      material.dispose();
    }
    this.#scene.remove(...this.#objects);
    const frame = normalisingFrame(mesh.positions);
    this.#objects = [mesh, ...(after ? [after] : [])].map((one) => this.#createObject(one, frame));
    this.#scene.add(...this.#objects);
    this.#layGround();
    this.#setLines(lines, frame);
    this.#draw();
  }

  /** Replaces the lines. @param {readonly Line[]} lines @param {Frame} frame */
  #setLines(lines, frame) {
    this.#lines?.dispose();
    this.#lines = null;
    if (lines.length > 0) {
      const gl = this.#renderer.getContext();
      this.#lineProgram ??= programOf(gl, lineVertex, lineFragment);
      const { middle, scale } = frame;
      /** @param {readonly number[]} point */
      const placed = (point) => /** @type {[number, number, number]} */ (point.map((value, k) => (value - middle[k]) * scale));
      this.#lines = new LineBuffers(gl, this.#lineProgram, lines.map((line) => ({ ...line, points: line.points.map(placed) })));
    }
    // three.js caches the state of WebGL, which has changed.
    this.#renderer.resetState();
  }

  /** Creates the object of three.js for a mesh or a point cloud. @param {Mesh} mesh @param {Frame} frame */
  #createObject({ positions, triangles, colors }, frame) {
    const three = this.#three;
    const geometry = new three.BufferGeometry();
    geometry.setAttribute('position', new three.BufferAttribute(normalise(frame, positions), 3));
    if (colors) geometry.setAttribute('color', new three.BufferAttribute(colors, 3));
    const paint = colors ? { vertexColors: true } : { color: PAPER_COLOUR };
    if (triangles.length === 0) return new three.Points(geometry, new three.PointsMaterial({ ...paint, size: 2, sizeAttenuation: false }));
    geometry.setIndex(new three.BufferAttribute(triangles, 1));
    geometry.computeVertexNormals();
    const object = new three.Mesh(geometry, new three.MeshLambertMaterial({ ...paint, ...this.#material, side: three.DoubleSide }));
    object.castShadow = true;
    return object;
  }

  /** Moves the divider. @param {number} share of the canvas left of it */
  divide(share) {
    this.#divider = share;
    this.#draw();
  }

  /**
   * Finds the triangle at a place of the canvas.
   * @param {{ offsetX: number, offsetY: number }} place
   * @returns {{ after: boolean, triangle: number, shares: Vector } | null} `after`: right of the divider; `shares`: barycentric coordinates; null without a triangle
   */
  pick({ offsetX, offsetY }) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const after = this.#objects.length > 1 && offsetX >= this.#divider * width;
    const object = this.#objects[after ? 1 : 0];
    if (!object?.isMesh || width === 0) return null;
    this.#raycaster ??= new this.#three.Raycaster();
    this.#raycaster.setFromCamera({ x: (2 * offsetX) / width - 1, y: 1 - (2 * offsetY) / height }, this.#camera);
    const [first] = this.#raycaster.intersectObject(object, false);
    if (!first) return null;
    const { x, y, z } = first.barycoord;
    return { after, triangle: first.faceIndex, shares: [x, y, z] };
  }

  /** The direction of view. @returns {[number, number, number]} */
  get direction() {
    const { x, y, z } = this.#camera.position;
    const length = Math.hypot(x, y, z);
    return [-x / length, -y / length, -z / length];
  }

  /** Sets the direction of view, resets the zoom, and ends the first turn. @param {Vector} direction */
  setDirection([x, y, z]) {
    this.#turning.abort();
    this.#camera.zoom = 1;
    this.#camera.updateProjectionMatrix();
    this.#camera.position.set(-x, -y, -z).normalize().multiplyScalar(CAMERA_DISTANCE);
    this.#isSettingDirection = true;
    this.#controls.update();
    this.#isSettingDirection = false;
    this.#draw();
  }

  #draw() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0) return;
    this.#renderer.setPixelRatio(window.devicePixelRatio);
    this.#renderer.setSize(width, height, false);
    const across = VIEW_HALF_WIDTH * Math.max(1, width / height);
    const up = VIEW_HALF_WIDTH * Math.max(1, height / width);
    Object.assign(this.#camera, { left: -across, right: across, top: up, bottom: -up });
    this.#camera.updateProjectionMatrix();
    const line = this.#objects.length > 1 ? Math.round(this.#divider * width) : width;
    this.#renderer.setScissorTest(true);
    for (const [i, from, to] of [[0, 0, line], [1, line, width]]) {
      if (to <= from) continue;
      this.#objects.forEach((one, which) => (one.visible = which === i));
      this.#renderer.setScissor(from, 0, to - from, height);
      this.#renderer.render(this.#scene, this.#camera);
      if (i === 1) this.#drawLines();
    }
  }

  /** Draws the lines over the picture of three.js, by the same camera. */
  #drawLines() {
    if (!this.#lines || !this.#lineProgram) return;
    const gl = this.#renderer.getContext();
    const { program, uniform } = this.#lineProgram;
    const [right, up, towards] = [0, 4, 8].map((column) => this.#camera.matrixWorld.elements.slice(column, column + 3));
    const { elements: projection } = this.#camera.projectionMatrix;
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.disable(gl.CULL_FACE);
    gl.useProgram(program);
    gl.uniformMatrix3fv(uniform('axes'), false, [...right, ...up, ...towards]);
    gl.uniform3f(uniform('middle'), 0, 0, 0);
    gl.uniform1f(uniform('exaggeration'), 1);
    gl.uniform3f(uniform('scale'), projection[0], projection[5], -projection[10]);
    gl.uniform2f(uniform('shift'), 0, 0);
    gl.uniform2f(uniform('canvas'), this.canvas.width, this.canvas.height);
    gl.uniform1f(uniform('ratio'), window.devicePixelRatio);
    this.#lines.draw();
    this.#renderer.resetState();
  }
}

/** @typedef {{ middle: number[], scale: number }} Frame maps a mesh to the ball that the view shows */

/** The frame that centres positions and scales them to the radius of the drawn mesh. @param {Float64Array} positions @returns {Frame} */
function normalisingFrame(positions) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  positions.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3], value);
    high[i % 3] = Math.max(high[i % 3], value);
  });
  const scale = (2 * MESH_RADIUS) / (Math.hypot(...low.map((value, k) => high[k] - value)) || 1);
  return { middle: low.map((value, k) => (value + high[k]) / 2), scale };
}

/** Centres and scales positions, after which 32-bit floats are precise enough. @param {Frame} frame @param {Float64Array} positions */
function normalise({ middle, scale }, positions) {
  return Float32Array.from(positions, (value, i) => (value - middle[i % 3]) * scale);
}
