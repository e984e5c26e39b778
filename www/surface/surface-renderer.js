/** Renders surfaces in space by WebGL 2. Heights and normals are textures, so that no mesh has to be built. */
import { morphLines } from './anchored-lines.js';
import { waitForGpu, LineBuffers, MeshBuffers, programOf, textureOf } from './gl.js';
import { toTextures } from './textures.js';
import { AdaptiveQuality } from './adaptive-quality.js';
import { lineFragment, lineVertex, meshFragment, meshVertex, surfaceFragment, surfaceVertex } from './shaders.js';

/** @import {AnchoredLines} from './anchored-lines.js' */
/** @import {Camera} from './camera.js' */
/** @import {Program} from './gl.js' */
/** @import {Light} from './light.js' */
/** @import {Line} from './layer.js' */
/** @import {SurfaceTextures} from './textures.js' */
/** @import {Normals} from './normals.js' */

/**
 * @typedef {object} Relief
 * @property {Normals} normals
 * @property {ArrayLike<number>} heights of the same pixels, NaN for no data
 * @property {number} heightScale unit of length per unit of the heights
 * @property {{ left: number, top: number, width: number, height: number }} extent in the unit of length
 * @property {SurfaceTextures} [textures] until they are uploaded
 */

/**
 * @typedef {object} MorphingMesh a mesh that changes between several forms
 * @property {Uint32Array} triangles
 * @property {readonly Float32Array[]} forms positions of the vertices in each form
 * @property {Uint8Array} colours RGBA of each vertex; a transparent vertex has the colour of steel
 * @property {Float32Array} strains of the vertices
 * @property {AnchoredLines} lines drawn on the mesh
 * @property {(line: number) => Pick<Line, 'colour' | 'width'>} lineStyle colour and width of each line
 */

/** @typedef {{ relief: Relief, textures: WebGLTexture[], colours: WebGLTexture | null, lines: LineBuffers | null }} SideBuffers */

export class SurfaceRenderer {
  #gl;
  #surfaceProgram;
  #meshProgram;
  #lineProgram;
  /** @type {{ before: SideBuffers | null, after: SideBuffers | null }} */
  #sides = { before: null, after: null };
  /** @type {{ sheet: MorphingMesh, mesh: MeshBuffers } | null} */
  #morph = null;
  #quality;

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {() => void} onFiner called when drawing again would be finer
   * @throws where there is no WebGL 2
   */
  constructor(canvas, onFiner) {
    const gl = canvas.getContext('webgl2', { antialias: false, alpha: true, premultipliedAlpha: true });
    if (!gl) throw new Error('this browser has no WebGL 2');
    this.canvas = canvas;
    this.#quality = new AdaptiveQuality(onFiner);
    this.#gl = gl;
    this.#surfaceProgram = programOf(gl, surfaceVertex, surfaceFragment);
    this.#meshProgram = programOf(gl, meshVertex, meshFragment);
    this.#lineProgram = programOf(gl, lineVertex, lineFragment);
  }

  /**
   * Sets the surface on a side of the divider.
   * @param {'before' | 'after'} side
   * @param {Relief | null} relief
   */
  setRelief(side, relief) {
    const gl = this.#gl;
    const old = this.#sides[side];
    if (old && relief && sharesTextures(old.relief, relief)) {
      this.#sides[side] = { ...old, relief };
      return;
    }
    for (const texture of [...(old?.textures ?? []), old?.colours ?? null]) gl.deleteTexture(texture);
    old?.lines?.dispose();
    if (!relief) {
      this.#sides[side] = null;
      return;
    }
    const { normals, heights: all, heightScale } = relief;
    const { width, height, heights, slopes } = relief.textures ?? toTextures(normals, all, heightScale);
    // The graphics card keeps the textures.
    delete relief.textures;
    this.#sides[side] = {
      relief,
      textures: [
        textureOf(gl, gl.NEAREST, () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, width, height, 0, gl.RED, gl.FLOAT, heights)),
        textureOf(gl, gl.LINEAR, () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.RG16F, width, height, 0, gl.RG, gl.FLOAT, slopes)),
      ],
      colours: null,
      lines: null,
    };
  }

  /** The surface on a side of the divider. @param {'before' | 'after'} side */
  relief(side) {
    return this.#sides[side]?.relief ?? null;
  }

  /**
   * Sets the colours and lines on a surface.
   * @param {'before' | 'after'} side
   * @param {TexImageSource | null} image that covers the surface's extent; null for steel
   * @param {readonly Line[]} lines
   */
  setOverlay(side, image, lines) {
    const gl = this.#gl;
    const buffers = this.#sides[side];
    if (!buffers) return;
    gl.deleteTexture(buffers.colours);
    buffers.lines?.dispose();
    buffers.colours = image && textureOf(gl, gl.LINEAR, () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image));
    buffers.lines = lines.length > 0 ? new LineBuffers(gl, this.#lineProgram, lines) : null;
  }

  /** Sets a mesh that is drawn in place of the result. @param {MorphingMesh | null} sheet */
  setMorphingMesh(sheet) {
    this.#morph?.mesh.dispose();
    this.#morph = sheet && { sheet, mesh: new MeshBuffers(this.#gl, this.#meshProgram, sheet) };
  }

  /** Says that nothing moves any more, so that the next picture may be finer. */
  rest() {
    this.#quality.rest();
  }

  /**
   * Draws both sides of the divider.
   * @param {Camera} camera
   * @param {Light} light
   * @param {number} divider share of the canvas that shows the input
   * @param {number} progress position of the mesh between its first form, 0, and its last, 1
   */
  draw(camera, light, divider, progress) {
    const { canvas } = this;
    const density = Math.min(this.#quality.level.density, Math.max(1, devicePixelRatio) * 2);
    const size = { width: Math.max(1, Math.round(canvas.clientWidth * density)), height: Math.max(1, Math.round(canvas.clientHeight * density)) };
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    camera.size = size;
    this.#quality.draw(() => this.#draw(camera, light, divider, progress), () => waitForGpu(this.#gl));
  }

  /**
   * @param {Camera} camera
   * @param {Light} light
   * @param {number} divider
   * @param {number} progress
   */
  #draw(camera, light, divider, progress) {
    const gl = this.#gl;
    const { width, height } = this.canvas;
    gl.viewport(0, 0, width, height);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.SCISSOR_TEST);
    const dividerColumn = Math.round(divider * width);
    for (const [side, from, to] of /** @type {const} */ ([['before', 0, dividerColumn], ['after', dividerColumn, width]])) {
      if (to <= from) continue;
      gl.scissor(from, 0, to - from, height);
      const buffers = this.#sides[side];
      if (side === 'after' && this.#morph) {
        const { mesh, sheet: { forms, lines, lineStyle } } = this.#morph;
        this.#prepare(this.#meshProgram, camera, light);
        mesh.draw(progress);
        const lineBuffers = new LineBuffers(gl, this.#lineProgram, morphLines(lines, forms, progress, lineStyle));
        this.#prepare(this.#lineProgram, camera, light);
        lineBuffers.draw();
        lineBuffers.dispose();
        continue;
      }
      if (!buffers) continue;
      this.#prepare(this.#surfaceProgram, camera, light);
      this.#drawRelief(buffers);
      if (!buffers.lines) continue;
      this.#prepare(this.#lineProgram, camera, light);
      buffers.lines.draw();
    }
  }

  /** Draws a heightfield as strips of quads, at most as many as the quality level allows. @param {SideBuffers} side */
  #drawRelief({ relief: { extent, normals: { width, height } }, textures, colours }) {
    const gl = this.#gl;
    // Detail finer than the quads is in the normals.
    const reduction = Math.min(1, this.#quality.level.cells / Math.max(width, height));
    const cells = [Math.max(2, Math.round(width * reduction)), Math.max(2, Math.round(height * reduction))];
    const { uniform } = this.#surfaceProgram;
    [...textures, colours].forEach((texture, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
    });
    gl.uniform1i(uniform('heights'), 0);
    gl.uniform1i(uniform('normals'), 1);
    gl.uniform1i(uniform('colours'), 2);
    gl.uniform1i(uniform('coloured'), colours ? 1 : 0);
    gl.uniform4f(uniform('extent'), extent.left, extent.top, extent.width, extent.height);
    gl.uniform2i(uniform('cells'), cells[0], cells[1]);
    gl.bindVertexArray(null);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 2 * (cells[0] + 1), cells[1]);
  }

  /**
   * Activates a program and sets its uniforms for camera and light.
   * @param {Program} program
   * @param {Camera} camera
   * @param {Light} light
   */
  #prepare({ program, uniform }, camera, light) {
    const gl = this.#gl;
    const { width, height } = camera.size;
    const shorterSide = Math.min(width, height);
    const { scale, centre, box, exaggeration } = camera;
    const diameter = Math.hypot(box.width, box.height, (box.high - box.low) * exaggeration);
    gl.useProgram(program);
    gl.uniformMatrix3fv(uniform('axes'), false, camera.axes.flat());
    gl.uniform3f(uniform('middle'), ...centre);
    gl.uniform1f(uniform('exaggeration'), exaggeration);
    gl.uniform3f(uniform('scale'), (2 * scale) / width, (2 * scale) / height, 0.45 / diameter);
    gl.uniform2f(uniform('shift'), (2 * camera.shift.x * shorterSide) / width, (2 * camera.shift.y * shorterSide) / height);
    gl.uniform2f(uniform('canvas'), width, height);
    gl.uniform1f(uniform('ratio'), width / this.canvas.clientWidth);
    // The light turns with the camera, so that level surfaces are equally bright from every side.
    const [y, z] = [light.y, Math.sqrt(1 - light.x ** 2 - light.y ** 2)];
    const [c, s] = [Math.cos(2 * camera.tip), Math.sin(2 * camera.tip)];
    gl.uniform3f(uniform('light'), light.x, c * y + s * z, c * z - s * y);
  }
}

/** Whether two surfaces have the same textures. @param {Relief} a @param {Relief} b */
function sharesTextures(a, b) {
  return a.heights === b.heights && a.normals === b.normals && a.heightScale === b.heightScale;
}
