/** Reads the sheets of a pattern's assembly as one mesh. */
/**
 * Reads an assembly. The rotation of its root node is ignored, so that z is up.
 * @param {Uint8Array} model a pattern's assembly, a GLB file in metres
 */
export function readAssemblyMesh(model) {
  const file = new DataView(model.buffer, model.byteOffset, model.byteLength);
  const length = file.getUint32(12, true);
  const { meshes, accessors, bufferViews, nodes, animations } = JSON.parse(new TextDecoder().decode(model.subarray(20, 20 + length)));
  /** The numbers of an accessor, four bytes each. @param {number} index of the accessor */
  const numbers = (index) => {
    const { bufferView, componentType } = accessors[index];
    const { byteOffset, byteLength } = bufferViews[bufferView];
    const bytes = model.slice(28 + length + byteOffset, 28 + length + byteOffset + byteLength);
    return componentType === 5126 ? new Float32Array(bytes.buffer) : new Uint32Array(bytes.buffer);
  };
  const { samplers, channels } = animations[0];
  /** The last keyframe of a node's animation. @param {number} node @param {string} path */
  const finalValue = (node, path) => {
    const { sampler } = channels.find((/** @type {any} */ { target }) => target.node === node && target.path === path);
    const values = numbers(samplers[sampler].output);
    return values.subarray(values.length / 2);
  };
  /** @type {[number[], number[]]} */
  const [positions, triangles] = [[], []];
  /** Index of the drawing's sheet of each vertex: parts come in another order, and are named as the sheets. @type {number[]} */
  const sheets = [];
  for (const [number, { name, mesh }] of nodes.entries()) {
    if (mesh === undefined) continue;
    const { attributes, indices, targets } = meshes[mesh].primitives[0];
    const [flat, bends] = [numbers(attributes.POSITION), numbers(targets[0].POSITION)];
    const [turn, shift] = [finalValue(number, 'rotation'), finalValue(number, 'translation')];
    const first = sheets.length;
    for (let i = 0; i < flat.length; i += 3) {
      sheets.push(Number(name.replace(/\D/g, '')) - 1);
      positions.push(...applyPose([0, 1, 2].map((k) => flat[i + k] + bends[i + k]), turn, shift));
    }
    for (const corner of numbers(indices)) triangles.push(first + corner);
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles), sheets: Uint32Array.from(sheets) };
}

/** Rotates a point by a quaternion, then translates it. @param {number[]} place @param {ArrayLike<number>} turn @param {ArrayLike<number>} shift */
function applyPose([x, y, z], turn, shift) {
  const [a, b, c, w] = Array.from(turn);
  const [u, v, t] = [2 * (b * z - c * y), 2 * (c * x - a * z), 2 * (a * y - b * x)];
  return [x + w * u + b * t - c * v + shift[0], y + w * v + c * u - a * t + shift[1], z + w * t + a * v - b * u + shift[2]];
}
