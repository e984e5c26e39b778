/** What WebGL draws: programs, textures, lines, and meshes between two of their forms. */

/** @import {Line} from './layer.js' */
/** @import {Sheet} from './space.js' */

/** @typedef {{ program: WebGLProgram, at: (uniform: string) => WebGLUniformLocation | null }} Program */

/**
 * @param {WebGL2RenderingContext} gl
 * @param {string} vertex
 * @param {string} fragment
 * @returns {Program}
 */
export function programOf(gl, vertex, fragment) {
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
export function textureOf(gl, filter, fill) {
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

export class Lines {
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

export class Mesh {
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

/**
 * When the graphics card has done what it was asked for. Nothing waits meanwhile.
 * @param {WebGL2RenderingContext} gl
 * @returns {Promise<void>}
 */
export function finished(gl) {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  return new Promise((resolve) => {
    const look = () => {
      if (fence && gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) return void setTimeout(look, 1);
      gl.deleteSync(fence);
      resolve();
    };
    setTimeout(look, 1);
  });
}
