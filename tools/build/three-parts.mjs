/** What of three.js the page never reaches, left out of its file, for a bundler cannot know it: shaders are texts, and the renderer asks for every part. */
import { readFile, readdir } from 'node:fs/promises';
import { join } from 'node:path';
import { root } from '../util/paths.mjs';

const sources = join(root, 'node_modules/three/src');

/** The shaders of the materials that `three.js` exports, of the map of shadows, and what the renderer puts before each of them. */
const SHADERS = ['meshmatcap', 'points', 'shadow', 'depth', 'colorspace_pars_fragment'];

/** Parts that are asked for and do nothing, or less, here: headsets, light and backgrounds of images, effects, morphing, shared uniforms. @type {Record<string, string>} */
const STUBS = {
  'webxr/WebXRManager.js': `export class WebXRManager {
    enabled = false; isPresenting = false; cameraAutoUpdate = false;
    addEventListener() {} removeEventListener() {} setAnimationLoop() {} dispose() {}
    getEnvironmentBlendMode() {} hasDepthSensing() { return false; }
  }`,
  'webgl/WebGLEnvironments.js': 'export class WebGLEnvironments { get(texture) { return texture; } dispose() {} }',
  'webgl/WebGLBackground.js': `export class WebGLBackground {
    constructor(renderer, environments, state, objects, alpha) { Object.assign(this, { renderer, state, opacity: alpha ? 0 : 1 }); }
    render() {
      const { color, depth } = this.state.buffers;
      color.setClear(0, 0, 0, this.opacity, false);
      depth.setTest(true);
      depth.setMask(true);
      color.setMask(true);
      this.renderer.clear();
    }
    addToRenderList() {}
    setClearColor() {}
    getClearColor() {}
    getClearAlpha() {}
    dispose() {}
  }`,
  'renderers/WebGLCubeRenderTarget.js': 'export class WebGLCubeRenderTarget {}',
  'webgl/WebGLMorphtargets.js': 'export class WebGLMorphtargets { update() {} }',
  'webgl/WebGLOutput.js': 'export class WebGLOutput {}',
  'webgl/WebGLUniformsGroups.js': 'export class WebGLUniformsGroups { update() {} bind() {} dispose() {} }',
  'shaders/DFGLUTData.js': 'export function getDFGLUT() { return null; }',
};

/** A shader without comments and indents. @param {string} text */
const shorten = (text) => text.replace(/\/\*[^]*?\*\/|\/\/.*/g, '').replace(/\n\s+/g, '\n');

/** The list of shaders with their uniforms, without those of materials that are not used. @param {string} text */
const withoutOthers = (text) => text
  .replace(/\n\t(\w+): \{\n[^]*?\n\t\},?/g, (entry, name) => (SHADERS.some((used) => used.endsWith(name)) ? entry : ''))
  .replace(/\nShaderLib\.physical = [^]*?\n\};/, '');

/**
 * Plugin of a bundler that takes three.js from its sources, without what is not needed.
 * @returns {Promise<import('vite').Plugin>}
 */
export async function usedThree() {
  /** Texts of all shaders and their pieces by name. @type {Map<string, string>} */
  const texts = new Map();
  for (const folder of ['ShaderLib', 'ShaderChunk']) {
    const at = join(sources, 'renderers/shaders', folder);
    for (const file of await readdir(at)) texts.set(file.replace('.glsl.js', ''), await readFile(join(at, file), 'utf8'));
  }
  const library = await readFile(join(sources, 'renderers/shaders/ShaderLib.js'), 'utf8');
  const lines = await readFile(join(root, 'node_modules/three/examples/jsm/lines/LineMaterial.js'), 'utf8');
  const used = new Set(SHADERS);
  const waiting = [lines, ...SHADERS.map((name) => texts.get(name) ?? '')];
  for (let text = waiting.pop(); text !== undefined; text = waiting.pop()) {
    for (const [, name] of text.matchAll(/#include <(\w+)>/g)) {
      if (used.has(name)) continue;
      used.add(name);
      waiting.push(texts.get(name) ?? '');
    }
  }
  return {
    name: 'used-three',
    enforce: 'pre',
    resolveId: (id) => (id === 'three' ? join(sources, 'Three.js') : null),
    load(id) {
      const stub = Object.keys(STUBS).find((end) => id.endsWith(end));
      if (stub) return STUBS[stub];
      if (id.endsWith('/ShaderLib.js')) return withoutOthers(library);
      const shader = /\/(?:ShaderLib|ShaderChunk)\/(\w+)\.glsl\.js$/.exec(id)?.[1];
      if (!shader) return null;
      const text = texts.get(shader) ?? '';
      return used.has(shader) ? shorten(text) : text.replace(/`[^`]*`/g, "''");
    },
  };
}
