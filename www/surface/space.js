/** Surfaces in space, drawn by WebGL 2: heights and normals are textures, so that no mesh is made of them. */
import { linesAt } from './anchors.js';
import { finished, Lines, Mesh, programOf, textureOf } from './gl.js';
import { texelsOf } from './look.js';
import { Quality } from './quality.js';
import { lineFragment, lineVertex, meshFragment, meshVertex, surfaceFragment, surfaceVertex } from './shaders.js';

/** @import {Anchored} from './anchors.js' */
/** @import {Camera} from './camera.js' */
/** @import {Program} from './gl.js' */
/** @import {Light} from './light.js' */
/** @import {Line} from './layer.js' */
/** @import {Texels} from './look.js' */
/** @import {Normals} from './normals.js' */

/**
 * @typedef {object} Relief
 * @property {Normals} normals
 * @property {ArrayLike<number>} heights of the same pixels, NaN for none
 * @property {number} heightScale
 * @property {{ left: number, top: number, width: number, height: number }} extent in lengths
 * @property {Texels} [texels] until they were shown
 */

/**
 * @typedef {object} Sheet a mesh on its way from one form to another
 * @property {Uint32Array} triangles
 * @property {readonly Float32Array[]} forms positions, one after the other
 * @property {Uint8Array} colours four bytes for each vertex; transparent is steel
 * @property {Float32Array} strains of the vertices
 * @property {Anchored} lines that are drawn on it
 * @property {(line: number) => Pick<Line, 'colour' | 'width'>} look of each of these
 */

/** @typedef {{ relief: Relief, textures: WebGLTexture[], colours: WebGLTexture | null, lines: Lines | null }} Side */

export class Space {
  #gl;
  #surface;
  #mesh;
  #line;
  /** @type {{ before: Side | null, after: Side | null }} */
  #sides = { before: null, after: null };
  /** @type {{ sheet: Sheet, mesh: Mesh } | null} */
  #laid = null;
  #quality;

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {() => void} finer it is worth drawing again
   * @throws where there is no WebGL 2
   */
  constructor(canvas, finer) {
    const gl = canvas.getContext('webgl2', { antialias: false, alpha: true, premultipliedAlpha: true });
    if (!gl) throw new Error('this browser has no WebGL 2');
    this.canvas = canvas;
    this.#quality = new Quality(finer);
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
    if (old && relief && isSame(old.relief, relief)) {
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
    const { width, height, heights, slopes } = relief.texels ?? texelsOf(normals, all, heightScale);
    // On the graphics card they are kept.
    delete relief.texels;
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
    this.#laid?.mesh.dispose();
    this.#laid = sheet && { sheet, mesh: new Mesh(this.#gl, this.#mesh, sheet) };
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
   */
  draw(camera, light, divider, laid) {
    const { canvas } = this;
    const density = Math.min(this.#quality.level.density, Math.max(1, devicePixelRatio) * 2);
    const size = { width: Math.max(1, Math.round(canvas.clientWidth * density)), height: Math.max(1, Math.round(canvas.clientHeight * density)) };
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    camera.size = size;
    this.#quality.draw(() => this.#draw(camera, light, divider, laid), () => finished(this.#gl));
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
      if (side === 'after' && this.#laid) {
        const { mesh, sheet: { forms, lines, look } } = this.#laid;
        this.#prepare(this.#mesh, camera, light);
        mesh.draw(laid);
        const folds = new Lines(gl, this.#line, linesAt(lines, forms, laid, look));
        this.#prepare(this.#line, camera, light);
        folds.draw();
        folds.dispose();
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

/** Whether textures of the one show the other. @param {Relief} a @param {Relief} b */
function isSame(a, b) {
  return a.heights === b.heights && a.normals === b.normals && a.heightScale === b.heightScale;
}
