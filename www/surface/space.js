/** Surfaces in space, drawn by WebGL 2: heights and normals are textures, so that no mesh is made of them. */
import { HOLE, UNIT } from './normals.js';
import { Quality } from './quality.js';
import { lineFragment, lineVertex, meshFragment, meshVertex, NO_HEIGHT, surfaceFragment, surfaceVertex } from './shaders.js';

/** @import {Camera} from './camera.js' */
/** @import {Light} from './light.js' */
/** @import {Line} from './layer.js' */
/** @import {Normals} from './normals.js' */

/**
 * @typedef {object} Relief
 * @property {Normals} normals
 * @property {ArrayLike<number>} heights of the same pixels, NaN for none
 * @property {number} heightScale
 * @property {{ left: number, top: number, width: number, height: number }} extent in lengths
 */

/**
 * @typedef {object} Sheet a mesh on its way from one form to another
 * @property {Uint32Array} triangles
 * @property {readonly Float32Array[]} forms positions, one after the other
 * @property {Uint8Array} colours four bytes for each vertex; transparent is steel
 */

/** @typedef {{ relief: Relief, textures: WebGLTexture[], colours: WebGLTexture | null, lines: Lines | null }} Side */

export class Space {
  #gl;
  #surface;
  #mesh;
  #line;
  /** @type {{ before: Side | null, after: Side | null }} */
  #sides = { before: null, after: null };
  /** @type {Mesh | null} */
  #sheet = null;
  #quality = new Quality();

  /**
   * @param {HTMLCanvasElement} canvas
   * @throws where there is no WebGL 2
   */
  constructor(canvas) {
    const gl = canvas.getContext('webgl2', { antialias: false, alpha: true, premultipliedAlpha: true });
    if (!gl) throw new Error('this browser has no WebGL 2');
    this.canvas = canvas;
    this.#gl = gl;
    this.#surface = programOf(gl, surfaceVertex, surfaceFragment);
    this.#mesh = programOf(gl, meshVertex, meshFragment);
    this.#line = programOf(gl, lineVertex, lineFragment);
  }

  /**
   * @param {'before' | 'after'} side
   * @param {Relief | null} relief
   */
  show(side, relief) {
    const gl = this.#gl;
    const old = this.#sides[side];
    for (const texture of [...(old?.textures ?? []), old?.colours ?? null]) gl.deleteTexture(texture);
    old?.lines?.dispose();
    if (!relief) {
      this.#sides[side] = null;
      return;
    }
    const { normals: { width, height, xy }, heights, heightScale } = relief;
    const values = new Float32Array(width * height);
    const slopes = new Float32Array(2 * width * height);
    for (let i = 0; i < values.length; i++) {
      const hole = xy[2 * i] === HOLE;
      values[i] = hole ? NO_HEIGHT : heights[i] * heightScale;
      if (hole) continue;
      slopes[2 * i] = xy[2 * i] / UNIT;
      slopes[2 * i + 1] = xy[2 * i + 1] / UNIT;
    }
    this.#sides[side] = {
      relief,
      textures: [
        textureOf(gl, gl.NEAREST, () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, width, height, 0, gl.RED, gl.FLOAT, values)),
        textureOf(gl, gl.LINEAR, () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.RG16F, width, height, 0, gl.RG, gl.FLOAT, slopes)),
      ],
      colours: null,
      lines: null,
    };
  }

  /** @param {'before' | 'after'} side */
  relief(side) {
    return this.#sides[side]?.relief ?? null;
  }

  /**
   * Colours and lines on a surface, until others are put there.
   * @param {'before' | 'after'} side
   * @param {TexImageSource | null} image over the surface's extent
   * @param {readonly Line[]} lines
   */
  cover(side, image, lines) {
    const gl = this.#gl;
    const there = this.#sides[side];
    if (!there) return;
    gl.deleteTexture(there.colours);
    there.lines?.dispose();
    there.colours = image && textureOf(gl, gl.LINEAR, () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image));
    there.lines = lines.length > 0 ? new Lines(gl, this.#line, lines) : null;
  }

  /** A mesh in the place of the result. @param {Sheet | null} sheet */
  lay(sheet) {
    this.#sheet?.dispose();
    this.#sheet = sheet && new Mesh(this.#gl, this.#mesh, sheet);
  }

  /** Nothing moves any more: there may be time for a finer picture. */
  rest() {
    this.#quality.rest();
  }

  /**
   * @param {Camera} camera
   * @param {Light} light
   * @param {number} divider share of the canvas that shows what was before
   * @param {number} laid how far the mesh is on its way
   * @returns {boolean} whether it is worth drawing again, more finely
   */
  draw(camera, light, divider, laid) {
    const gl = this.#gl;
    const { canvas } = this;
    const density = Math.min(this.#quality.level.density, Math.max(1, devicePixelRatio) * 2);
    const size = { width: Math.max(1, Math.round(canvas.clientWidth * density)), height: Math.max(1, Math.round(canvas.clientHeight * density)) };
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    camera.size = size;
    return this.#quality.draw(
      () => this.#draw(camera, light, divider, laid),
      () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)),
    );
  }

  /**
   * @param {Camera} camera
   * @param {Light} light
   * @param {number} divider
   * @param {number} laid
   */
  #draw(camera, light, divider, laid) {
    const gl = this.#gl;
    const { width, height } = this.canvas;
    gl.viewport(0, 0, width, height);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.SCISSOR_TEST);
    const line = Math.round(divider * width);
    for (const [side, from, to] of /** @type {const} */ ([['before', 0, line], ['after', line, width]])) {
      if (to <= from) continue;
      gl.scissor(from, 0, to - from, height);
      const there = this.#sides[side];
      if (side === 'after' && this.#sheet) {
        this.#prepare(this.#mesh, camera, light);
        this.#sheet.draw(laid);
        continue;
      }
      if (!there) continue;
      this.#prepare(this.#surface, camera, light);
      this.#drawRelief(there);
      if (!there.lines) continue;
      this.#prepare(this.#line, camera, light);
      there.lines.draw();
    }
  }

  /** @param {Side} side */
  #drawRelief({ relief: { extent, normals: { width, height } }, textures, colours }) {
    const gl = this.#gl;
    // What is finer is in the normals.
    const share = Math.min(1, this.#quality.level.cells / Math.max(width, height));
    const cells = [Math.max(2, Math.round(width * share)), Math.max(2, Math.round(height * share))];
    const { at } = this.#surface;
    [...textures, colours].forEach((texture, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
    });
    gl.uniform1i(at('heights'), 0);
    gl.uniform1i(at('normals'), 1);
    gl.uniform1i(at('colours'), 2);
    gl.uniform1i(at('coloured'), colours ? 1 : 0);
    gl.uniform4f(at('extent'), extent.left, extent.top, extent.width, extent.height);
    gl.uniform2i(at('cells'), cells[0], cells[1]);
    gl.bindVertexArray(null);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 2 * (cells[0] + 1), cells[1]);
  }

  /**
   * @param {Program} program
   * @param {Camera} camera
   * @param {Light} light
   */
  #prepare({ program, at }, camera, light) {
    const gl = this.#gl;
    const { width, height } = camera.size;
    const least = Math.min(width, height);
    const { scale, middle, box, exaggeration } = camera;
    const reach = Math.hypot(box.width, box.height, (box.high - box.low) * exaggeration);
    gl.useProgram(program);
    gl.uniformMatrix3fv(at('axes'), false, camera.axes.flat());
    gl.uniform3f(at('middle'), ...middle);
    gl.uniform1f(at('exaggeration'), exaggeration);
    gl.uniform3f(at('scale'), (2 * scale) / width, (2 * scale) / height, 0.45 / reach);
    gl.uniform2f(at('shift'), (2 * camera.shift.x * least) / width, (2 * camera.shift.y * least) / height);
    gl.uniform2f(at('canvas'), width, height);
    gl.uniform1f(at('ratio'), width / this.canvas.clientWidth);
    // Turned along, so that what is level is as bright from every side.
    const [y, z] = [light.y, Math.sqrt(1 - light.x ** 2 - light.y ** 2)];
    const [c, s] = [Math.cos(2 * camera.tip), Math.sin(2 * camera.tip)];
    gl.uniform3f(at('light'), light.x, c * y + s * z, c * z - s * y);
  }
}

/** @typedef {{ program: WebGLProgram, at: (uniform: string) => WebGLUniformLocation | null }} Program */

/**
 * @param {WebGL2RenderingContext} gl
 * @param {string} vertex
 * @param {string} fragment
 * @returns {Program}
 */
function programOf(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [type, source] of /** @type {const} */ ([[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]])) {
    const shader = gl.createShader(type);
    if (!shader) throw new Error('WebGL gives no shader');
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    // Only where linking fails is it worth asking.
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    const logs = (gl.getAttachedShaders(program) ?? []).map((shader) => gl.getShaderInfoLog(shader));
    throw new Error(`a shader could not be built: ${[gl.getProgramInfoLog(program), ...logs].join(' ')}`);
  }
  /** @type {Map<string, WebGLUniformLocation | null>} */
  const places = new Map();
  return {
    program,
    at: (uniform) => {
      if (!places.has(uniform)) places.set(uniform, gl.getUniformLocation(program, uniform));
      return places.get(uniform) ?? null;
    },
  };
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {number} filter
 * @param {() => void} fill
 */
function textureOf(gl, filter, fill) {
  const texture = gl.createTexture();
  if (!texture) throw new Error('WebGL gives no texture');
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  fill();
  return texture;
}

/** Buffers of a vertex array, which go together. */
class Arrays {
  /** @type {WebGLBuffer[]} */
  #buffers = [];
  #array;

  /** @param {WebGL2RenderingContext} gl @param {Program} program */
  constructor(gl, { program }) {
    this.gl = gl;
    this.program = program;
    this.#array = gl.createVertexArray();
  }

  /** @param {number} target @param {AllowSharedBufferSource} data */
  put(target, data) {
    const { gl } = this;
    const buffer = gl.createBuffer();
    if (buffer) this.#buffers.push(buffer);
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return buffer;
  }

  /**
   * @param {string} name
   * @param {number} count
   * @param {number} type
   * @param {WebGLBuffer | null} buffer
   * @param {{ stride?: number, offset?: number, each?: boolean }} [where] `each`: one for an instance
   */
  point(name, count, type, buffer, { stride = 0, offset = 0, each = false } = {}) {
    const { gl } = this;
    const place = gl.getAttribLocation(this.program, name);
    if (place < 0) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, count, type, type === gl.UNSIGNED_BYTE, stride, offset);
    gl.vertexAttribDivisor(place, each ? 1 : 0);
  }

  bind() {
    this.gl.bindVertexArray(this.#array);
  }

  dispose() {
    for (const buffer of this.#buffers) this.gl.deleteBuffer(buffer);
    this.gl.deleteVertexArray(this.#array);
  }
}

class Lines {
  #arrays;
  #count;

  /**
   * @param {WebGL2RenderingContext} gl
   * @param {Program} program
   * @param {readonly Line[]} lines
   */
  constructor(gl, program, lines) {
    this.#count = lines.reduce((sum, { points }) => sum + Math.max(1, points.length - 1), 0);
    const numbers = new Float32Array(7 * this.#count);
    const colours = new Uint8Array(4 * this.#count);
    let segment = 0;
    for (const { points, width, colour } of lines) {
      for (let i = 0; i < Math.max(1, points.length - 1); i++, segment++) {
        numbers.set([...points[i], ...(points[i + 1] ?? points[i]), width], 7 * segment);
        colours.set([...colour, 255], 4 * segment);
      }
    }
    const arrays = (this.#arrays = new Arrays(gl, program));
    arrays.bind();
    const places = arrays.put(gl.ARRAY_BUFFER, numbers);
    const each = /** @type {const} */ ({ stride: 28, each: true });
    arrays.point('a', 3, gl.FLOAT, places, each);
    arrays.point('b', 3, gl.FLOAT, places, { ...each, offset: 12 });
    arrays.point('width', 1, gl.FLOAT, places, { ...each, offset: 24 });
    arrays.point('colour', 4, gl.UNSIGNED_BYTE, arrays.put(gl.ARRAY_BUFFER, colours), { each: true });
    gl.bindVertexArray(null);
  }

  draw() {
    const { gl } = this.#arrays;
    this.#arrays.bind();
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.#count);
    gl.bindVertexArray(null);
  }

  dispose() {
    this.#arrays.dispose();
  }
}

class Mesh {
  #arrays;
  #program;
  #forms;
  #count;

  /**
   * @param {WebGL2RenderingContext} gl
   * @param {Program} program
   * @param {Sheet} sheet
   */
  constructor(gl, program, { triangles, forms, colours }) {
    this.#program = program;
    this.#count = triangles.length;
    const arrays = (this.#arrays = new Arrays(gl, program));
    arrays.bind();
    arrays.put(gl.ELEMENT_ARRAY_BUFFER, triangles);
    arrays.point('colour', 4, gl.UNSIGNED_BYTE, arrays.put(gl.ARRAY_BUFFER, colours));
    this.#forms = forms.map((form) => arrays.put(gl.ARRAY_BUFFER, form));
    gl.bindVertexArray(null);
  }

  /** @param {number} share of the way through all forms */
  draw(share) {
    const { gl } = this.#arrays;
    const place = share * (this.#forms.length - 1);
    const first = Math.min(this.#forms.length - 2, Math.floor(place));
    this.#arrays.bind();
    this.#arrays.point('from', 3, gl.FLOAT, this.#forms[first]);
    this.#arrays.point('to', 3, gl.FLOAT, this.#forms[first + 1]);
    gl.uniform1f(this.#program.at('share'), place - first);
    gl.drawElements(gl.TRIANGLES, this.#count, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
  }

  dispose() {
    this.#arrays.dispose();
  }
}
