/** A mesh to be turned, drawn by three.js, which is loaded when the first mesh is there. */
import { Lines, programOf } from './gl.js';
import { lineFragment, lineVertex } from './shaders.js';

/** @import {Mesh} from '../api.js' */
/** @import {Program} from './gl.js' */
/** @import {Line} from './layer.js' */
/** @typedef {readonly [number, number, number]} Vector */

/** Radius of the mesh as it is drawn, and of what is seen at first. */
const RADIUS = 1;
const SEEN = 1.04;
const DISTANCE = 10;
/** What is seen lies so far before and behind the middle; the less, the nearer lines lie to what they are drawn on. */
const DEPTH = 2;
/** Turned by each press of an arrow key, in radians. */
const KEY_STEP = Math.PI / 24;
/** @type {Record<string, readonly [number, number]>} left and up */
const ARROWS = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class MeshView {
  #three;
  #renderer;
  #scene;
  #camera;
  #controls;
  /** What is shown left and right of the divider. @type {any[]} */
  #shown = [];
  #divider = 1;
  #material;
  /** On what is right of the divider. @type {Lines | null} */
  #lines = null;
  /** @type {Program | null} */
  #liner = null;
  /** @type {any} */
  #ray = null;
  /** It is not turned by hand now. */
  #looking = false;
  /** The direction at the last change. */
  #last = '';

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {(view: MeshView) => void} [turned] by hand or by keys
   * @param {Record<string, unknown>} [material] of surfaces, as three.js has it
   * @throws where there is no WebGL
   */
  static async on(canvas, turned = () => {}, material = {}) {
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
    this.#camera = new three.OrthographicCamera(-SEEN, SEEN, SEEN, -SEEN, DISTANCE - DEPTH, DISTANCE + DEPTH);
    // The light comes along with the viewer.
    const light = new three.DirectionalLight(0xffffff, 2.6);
    light.position.set(-0.9, 0.8, 0.7);
    this.#camera.add(light);
    this.#scene.add(this.#camera, new three.HemisphereLight(0xffffff, 0x8a94a0, 0.7));
    this.#controls = new three.OrbitControls(this.#camera, canvas);
    this.#controls.enablePan = false;
    this.#controls.addEventListener('change', () => {
      this.#draw();
      const now = String(this.direction);
      // Zooming turns nothing.
      if (!this.#looking && now !== this.#last) turned(this);
      this.#last = now;
    });
    new ResizeObserver(() => this.#draw()).observe(canvas);
    canvas.addEventListener('keydown', (event) => {
      const arrow = ARROWS[event.key];
      if (!arrow) return;
      event.preventDefault();
      this.#controls.rotateLeft(KEY_STEP * arrow[0]);
      this.#controls.rotateUp(KEY_STEP * arrow[1]);
      this.#controls.update();
    });
    this.look([0, 0, -1]);
  }

  /**
   * @param {Mesh} mesh
   * @param {Mesh} [after] at the same place, on the other side of the divider
   * @param {readonly Line[]} [lines] on what is after
   */
  show(mesh, after, lines = []) {
    for (const { geometry, material } of this.#shown) {
      geometry.dispose();
      material.dispose();
    }
    this.#scene.remove(...this.#shown);
    const frame = frameOf(mesh.positions);
    this.#shown = [mesh, ...(after ? [after] : [])].map((one) => this.#made(one, frame));
    this.#scene.add(...this.#shown);
    this.#rule(lines, frame);
    this.#draw();
  }

  /** @param {readonly Line[]} lines @param {Frame} frame */
  #rule(lines, frame) {
    this.#lines?.dispose();
    this.#lines = null;
    if (lines.length > 0) {
      const gl = this.#renderer.getContext();
      this.#liner ??= programOf(gl, lineVertex, lineFragment);
      const { middle, scale } = frame;
      /** @param {readonly number[]} point */
      const placed = (point) => /** @type {[number, number, number]} */ (point.map((value, k) => (value - middle[k]) * scale));
      this.#lines = new Lines(gl, this.#liner, lines.map((line) => ({ ...line, points: line.points.map(placed) })));
    }
    // three.js keeps in mind what was bound.
    this.#renderer.resetState();
  }

  /** @param {Mesh} mesh @param {Frame} frame */
  #made({ positions, triangles, colors }, frame) {
    const three = this.#three;
    const geometry = new three.BufferGeometry();
    geometry.setAttribute('position', new three.BufferAttribute(within(frame, positions), 3));
    if (colors) geometry.setAttribute('color', new three.BufferAttribute(colors, 3));
    const paint = colors ? { vertexColors: true } : { color: 0x9fb2c4 };
    if (triangles.length === 0) return new three.Points(geometry, new three.PointsMaterial({ ...paint, size: 2, sizeAttenuation: false }));
    geometry.setIndex(new three.BufferAttribute(triangles, 1));
    geometry.computeVertexNormals();
    return new three.Mesh(geometry, new three.MeshLambertMaterial({ ...paint, ...this.#material, side: three.DoubleSide }));
  }

  /** @param {number} share of the canvas that shows what was before */
  divide(share) {
    this.#divider = share;
    this.#draw();
  }

  /**
   * What is seen at a place of the canvas: which side of the divider, and where on which triangle.
   * @param {{ offsetX: number, offsetY: number }} place
   * @returns {{ after: boolean, triangle: number, shares: Vector } | null} `shares`: of its three corners
   */
  under({ offsetX, offsetY }) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const after = this.#shown.length > 1 && offsetX >= this.#divider * width;
    const shown = this.#shown[after ? 1 : 0];
    if (!shown?.isMesh || width === 0) return null;
    this.#ray ??= new this.#three.Raycaster();
    this.#ray.setFromCamera({ x: (2 * offsetX) / width - 1, y: 1 - (2 * offsetY) / height }, this.#camera);
    const [first] = this.#ray.intersectObject(shown, false);
    if (!first) return null;
    const { x, y, z } = first.barycoord;
    return { after, triangle: first.faceIndex, shares: [x, y, z] };
  }

  /** Where the viewer looks. @returns {[number, number, number]} */
  get direction() {
    const { x, y, z } = this.#camera.position;
    const length = Math.hypot(x, y, z);
    return [-x / length, -y / length, -z / length];
  }

  /** @param {Vector} direction */
  look([x, y, z]) {
    this.#camera.zoom = 1;
    this.#camera.updateProjectionMatrix();
    this.#camera.position.set(-x, -y, -z).normalize().multiplyScalar(DISTANCE);
    this.#looking = true;
    this.#controls.update();
    this.#looking = false;
    this.#draw();
  }

  #draw() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0) return;
    this.#renderer.setPixelRatio(window.devicePixelRatio);
    this.#renderer.setSize(width, height, false);
    const across = SEEN * Math.max(1, width / height);
    const up = SEEN * Math.max(1, height / width);
    Object.assign(this.#camera, { left: -across, right: across, top: up, bottom: -up });
    this.#camera.updateProjectionMatrix();
    const line = this.#shown.length > 1 ? Math.round(this.#divider * width) : width;
    this.#renderer.setScissorTest(true);
    for (const [i, from, to] of [[0, 0, line], [1, line, width]]) {
      if (to <= from) continue;
      this.#shown.forEach((one, which) => (one.visible = which === i));
      this.#renderer.setScissor(from, 0, to - from, height);
      this.#renderer.render(this.#scene, this.#camera);
      if (i === 1) this.#drawLines();
    }
  }

  /** Over what three.js has drawn, by the same camera. */
  #drawLines() {
    if (!this.#lines || !this.#liner) return;
    const gl = this.#renderer.getContext();
    const { program, at } = this.#liner;
    const [right, up, towards] = [0, 4, 8].map((column) => this.#camera.matrixWorld.elements.slice(column, column + 3));
    const { elements: projection } = this.#camera.projectionMatrix;
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.disable(gl.CULL_FACE);
    gl.useProgram(program);
    gl.uniformMatrix3fv(at('axes'), false, [...right, ...up, ...towards]);
    gl.uniform3f(at('middle'), 0, 0, 0);
    gl.uniform1f(at('exaggeration'), 1);
    gl.uniform3f(at('scale'), projection[0], projection[5], -projection[10]);
    gl.uniform2f(at('shift'), 0, 0);
    gl.uniform2f(at('canvas'), this.canvas.width, this.canvas.height);
    gl.uniform1f(at('ratio'), window.devicePixelRatio);
    this.#lines.draw();
    this.#renderer.resetState();
  }
}

/** @typedef {{ middle: number[], scale: number }} Frame into the ball that is seen */

/** @param {Float64Array} positions @returns {Frame} */
function frameOf(positions) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  positions.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3], value);
    high[i % 3] = Math.max(high[i % 3], value);
  });
  const scale = (2 * RADIUS) / (Math.hypot(...low.map((value, k) => high[k] - value)) || 1);
  return { middle: low.map((value, k) => (value + high[k]) / 2), scale };
}

/** Moved and scaled: 32-bit floats are enough for that. @param {Frame} frame @param {Float64Array} positions */
function within({ middle, scale }, positions) {
  return Float32Array.from(positions, (value, i) => (value - middle[i % 3]) * scale);
}
