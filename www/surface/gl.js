/** WebGL resources: programs, textures, and the buffers of lines and morphing meshes. */

/** @import {Line} from './layer.js' */
/** @import {MorphingMesh} from './surface-renderer.js' */

/** @typedef {{ program: WebGLProgram, uniform: (uniform: string) => WebGLUniformLocation | null }} Program */

/**
 * Compiles and links a program.
 * @param {WebGL2RenderingContext} gl
 * @param {string} vertex source of the vertex shader
 * @param {string} fragment source of the fragment shader
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
    // Compilation is checked only if linking fails: a check would wait for the compiler.
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    const logs = (gl.getAttachedShaders(program) ?? []).map((shader) => gl.getShaderInfoLog(shader));
    throw new Error(`a shader could not be built: ${[gl.getProgramInfoLog(program), ...logs].join(' ')}`);
  }
  /** @type {Map<string, WebGLUniformLocation | null>} */
  const locations = new Map();
  return {
    program,
    uniform: (uniform) => {
      if (!locations.has(uniform)) locations.set(uniform, gl.getUniformLocation(program, uniform));
      return locations.get(uniform) ?? null;
    },
  };
}

/**
 * Creates a texture.
 * @param {WebGL2RenderingContext} gl
 * @param {number} filter of minification and magnification
 * @param {() => void} fill uploads the image
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

/** A vertex array with its buffers. */
class VertexArray {
  /** @type {WebGLBuffer[]} */
  #buffers = [];
  #array;

  /** @param {WebGL2RenderingContext} gl @param {Program} program */
  constructor(gl, { program }) {
    this.gl = gl;
    this.program = program;
    this.#array = gl.createVertexArray();
  }

  /** Creates a buffer. @param {number} target @param {AllowSharedBufferSource} data */
  addBuffer(target, data) {
    const { gl } = this;
    const buffer = gl.createBuffer();
    if (buffer) this.#buffers.push(buffer);
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return buffer;
  }

  /**
   * Binds an attribute of the program to a buffer.
   * @param {string} name
   * @param {number} count number of components
   * @param {number} type of the components
   * @param {WebGLBuffer | null} buffer
   * @param {{ stride?: number, offset?: number, perInstance?: boolean }} [where] in bytes; `perInstance`: one value per instance, not per vertex
   */
  bindAttribute(name, count, type, buffer, { stride = 0, offset = 0, perInstance = false } = {}) {
    const { gl } = this;
    const place = gl.getAttribLocation(this.program, name);
    if (place < 0) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, count, type, type === gl.UNSIGNED_BYTE, stride, offset);
    gl.vertexAttribDivisor(place, perInstance ? 1 : 0);
  }

  bind() {
    this.gl.bindVertexArray(this.#array);
  }

  dispose() {
    for (const buffer of this.#buffers) this.gl.deleteBuffer(buffer);
    this.gl.deleteVertexArray(this.#array);
  }
}

/** Polylines as instanced segments. */
export class LineBuffers {
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
    const arrays = (this.#arrays = new VertexArray(gl, program));
    arrays.bind();
    const places = arrays.addBuffer(gl.ARRAY_BUFFER, numbers);
    const instanced = /** @type {const} */ ({ stride: 28, perInstance: true });
    arrays.bindAttribute('a', 3, gl.FLOAT, places, instanced);
    arrays.bindAttribute('b', 3, gl.FLOAT, places, { ...instanced, offset: 12 });
    arrays.bindAttribute('width', 1, gl.FLOAT, places, { ...instanced, offset: 24 });
    arrays.bindAttribute('colour', 4, gl.UNSIGNED_BYTE, arrays.addBuffer(gl.ARRAY_BUFFER, colours), { perInstance: true });
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

/** A mesh with several forms, drawn between two of them. */
export class MeshBuffers {
  #arrays;
  #program;
  #forms;
  #count;

  /**
   * @param {WebGL2RenderingContext} gl
   * @param {Program} program
   * @param {MorphingMesh} sheet
   */
  constructor(gl, program, { triangles, forms, colours }) {
    this.#program = program;
    this.#count = triangles.length;
    const arrays = (this.#arrays = new VertexArray(gl, program));
    arrays.bind();
    arrays.addBuffer(gl.ELEMENT_ARRAY_BUFFER, triangles);
    arrays.bindAttribute('colour', 4, gl.UNSIGNED_BYTE, arrays.addBuffer(gl.ARRAY_BUFFER, colours));
    this.#forms = forms.map((form) => arrays.addBuffer(gl.ARRAY_BUFFER, form));
    gl.bindVertexArray(null);
  }

  /** @param {number} share position between the first form, 0, and the last, 1 */
  draw(share) {
    const { gl } = this.#arrays;
    const place = share * (this.#forms.length - 1);
    const first = Math.min(this.#forms.length - 2, Math.floor(place));
    this.#arrays.bind();
    this.#arrays.bindAttribute('from', 3, gl.FLOAT, this.#forms[first]);
    this.#arrays.bindAttribute('to', 3, gl.FLOAT, this.#forms[first + 1]);
    gl.uniform1f(this.#program.uniform('share'), place - first);
    gl.drawElements(gl.TRIANGLES, this.#count, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
  }

  dispose() {
    this.#arrays.dispose();
  }
}

/**
 * Resolves when the graphics card has finished all commands, by polling a fence.
 * @param {WebGL2RenderingContext} gl
 * @returns {Promise<void>}
 */
export function waitForGpu(gl) {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  return new Promise((resolve) => {
    const poll = () => {
      if (fence && gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) return void setTimeout(poll, 1);
      gl.deleteSync(fence);
      resolve();
    };
    setTimeout(poll, 1);
  });
}
