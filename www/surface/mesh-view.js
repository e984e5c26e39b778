/** A mesh to be turned, drawn by three.js, which is loaded when the first mesh is there. */

/** @import {Mesh} from '../api.js' */
/** @typedef {readonly [number, number, number]} Vector */

/** Radius of the mesh as it is drawn, and of what is seen at first. */
const RADIUS = 1;
const SEEN = 1.04;
const DISTANCE = 10;
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
  /** @type {any} */
  #shown = null;
  /** It is not turned by hand now. */
  #looking = false;
  /** The direction at the last change. */
  #last = '';

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {(view: MeshView) => void} [turned] by hand or by keys
   * @throws where there is no WebGL
   */
  static async on(canvas, turned = () => {}) {
    const three = await import(new URL('../vendor/three.js', import.meta.url).href);
    return new MeshView(canvas, three, turned);
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {any} three the library, which has no types
   * @param {(view: MeshView) => void} turned
   */
  constructor(canvas, three, turned) {
    this.canvas = canvas;
    this.#three = three;
    this.#renderer = new three.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#scene = new three.Scene();
    this.#camera = new three.OrthographicCamera(-SEEN, SEEN, SEEN, -SEEN, 0, 2 * DISTANCE);
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

  /** @param {Mesh} mesh */
  show({ positions, triangles, colors }) {
    const three = this.#three;
    if (this.#shown) {
      this.#scene.remove(this.#shown);
      this.#shown.geometry.dispose();
      this.#shown.material.dispose();
    }
    const geometry = new three.BufferGeometry();
    geometry.setAttribute('position', new three.BufferAttribute(centred(positions), 3));
    if (colors) geometry.setAttribute('color', new three.BufferAttribute(colors, 3));
    const paint = colors ? { vertexColors: true } : { color: 0x9fb2c4 };
    if (triangles.length > 0) {
      geometry.setIndex(new three.BufferAttribute(triangles, 1));
      geometry.computeVertexNormals();
      this.#shown = new three.Mesh(geometry, new three.MeshLambertMaterial({ ...paint, side: three.DoubleSide }));
    } else {
      this.#shown = new three.Points(geometry, new three.PointsMaterial({ ...paint, size: 2, sizeAttenuation: false }));
    }
    this.#scene.add(this.#shown);
    this.#draw();
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
    this.#renderer.render(this.#scene, this.#camera);
  }
}

/**
 * Moved and scaled into the ball that is seen: 32-bit floats are enough for that.
 * @param {Float64Array} positions
 */
function centred(positions) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  positions.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3], value);
    high[i % 3] = Math.max(high[i % 3], value);
  });
  const scale = (2 * RADIUS) / (Math.hypot(...low.map((value, k) => high[k] - value)) || 1);
  return Float32Array.from(positions, (value, i) => (value - (low[i % 3] + high[i % 3]) / 2) * scale);
}
