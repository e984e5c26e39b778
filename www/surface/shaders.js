/** The shaders for surfaces, meshes and lines in space, in GLSL ES 3.00. */
import { STUDIO_GLSL } from './steel.js';

/** Height of a texel without data. */
export const NO_HEIGHT = -1e30;

/** The projection from space to the screen, which all vertex shaders share. */
const CAMERA = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform mat3 axes; // columns: to the right, up, towards the viewer
uniform vec3 middle;
uniform float exaggeration;
uniform vec3 scale; // of x and y on the screen, and of depth
uniform vec2 shift;
vec4 placed(vec3 point, float nearer) {
  vec3 d = (point - middle) * vec3(1.0, 1.0, exaggeration);
  vec3 seen = d * axes;
  return vec4(seen.xy * scale.xy + shift, -(seen.z * scale.z) - nearer, 1.0);
}
`;

/** A triangle strip for each row of quads. There are no attributes: heights come from a texture. */
export const surfaceVertex = `${CAMERA}
uniform sampler2D heights;
uniform vec4 extent; // left, top, width, height
uniform ivec2 cells;
out vec2 place;
float heightAt(ivec2 texel, ivec2 size) {
  return texelFetch(heights, clamp(texel, ivec2(0), size - 1), 0).r;
}
void main() {
  ivec2 node = ivec2(gl_VertexID / 2, gl_InstanceID + gl_VertexID % 2);
  place = vec2(node) / vec2(cells);
  ivec2 size = textureSize(heights, 0);
  vec2 at = place * vec2(size) - 0.5;
  ivec2 corner = ivec2(floor(at));
  vec2 t = at - vec2(corner);
  vec2 sum = vec2(0.0);
  for (int k = 0; k < 4; k++) {
    ivec2 step = ivec2(k & 1, k >> 1);
    float z = heightAt(corner + step, size);
    float weight = (step.x == 1 ? t.x : 1.0 - t.x) * (step.y == 1 ? t.y : 1.0 - t.y) + 1e-4;
    if (z > ${NO_HEIGHT.toExponential()} * 0.5) sum += weight * vec2(z, 1.0);
  }
  // Without data here, take the mean height of nearby texels.
  ivec2 reach = max(size / cells, ivec2(1));
  for (int r = 1; r <= 2 && sum.y == 0.0; r++) for (int k = 0; k < 9; k++) {
    float z = heightAt(corner + r * reach * ivec2(k % 3 - 1, k / 3 - 1), size);
    if (z > ${NO_HEIGHT.toExponential()} * 0.5) sum += vec2(z, 1.0);
  }
  float z = sum.y > 0.0 ? sum.x / sum.y : middle.z;
  gl_Position = placed(vec3(extent.x + place.x * extent.z, extent.y - place.y * extent.w, z), 0.0);
}`;

/** The colour of steel under the light, and its blend with other colours by soft light, as in `surface-view.js`. */
const SHADE = `
uniform vec3 light; // in the viewer's coordinates
uniform mat3 axes;
${STUDIO_GLSL}
vec3 softLight(vec3 base, vec3 top) {
  vec3 d = mix(sqrt(base), ((16.0 * base - 12.0) * base + 4.0) * base, vec3(lessThanEqual(base, vec3(0.25))));
  vec3 dark = base - (1.0 - 2.0 * top) * base * (1.0 - base);
  vec3 bright = base + (2.0 * top - 1.0) * (d - base);
  return mix(bright, dark, vec3(lessThanEqual(top, vec3(0.5))));
}
vec3 shaded(vec3 normal) {
  vec3 n = normalize(normal * axes);
  if (n.z < 0.0) n = -n;
  return steel(2.0 * n.z * dot(n.xy, light.xy) + (2.0 * n.z * n.z - 1.0) * light.z);
}
vec3 covered(vec3 metal, vec4 colour) {
  return colour.a > 0.0 ? mix(colour.rgb, softLight(colour.rgb, metal), 0.5) : metal;
}
`;

export const surfaceFragment = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D heights;
uniform sampler2D normals;
uniform sampler2D colours;
uniform bool coloured;
uniform float exaggeration;
in vec2 place;
out vec4 pixel;
${SHADE}
void main() {
  ivec2 size = textureSize(heights, 0);
  ivec2 texel = clamp(ivec2(place * vec2(size)), ivec2(0), size - 1);
  if (texelFetch(heights, texel, 0).r <= ${NO_HEIGHT.toExponential()} * 0.5) discard;
  vec2 xy = texture(normals, place).rg;
  vec3 metal = shaded(vec3(xy * exaggeration, sqrt(max(1e-4, 1.0 - dot(xy, xy)))));
  pixel = vec4(coloured ? covered(metal, texture(colours, place)) : metal, 1.0);
}`;

/** A mesh between two forms, with a colour for each vertex. */
export const meshVertex = `${CAMERA}
in vec3 from;
in vec3 to;
in vec4 colour;
uniform float share;
out vec3 point;
out vec4 tint;
void main() {
  vec3 at = mix(from, to, share);
  point = (at - middle) * vec3(1.0, 1.0, exaggeration);
  tint = colour;
  gl_Position = placed(at, 0.0);
}`;

export const meshFragment = `#version 300 es
precision highp float;
in vec3 point;
in vec4 tint;
out vec4 pixel;
${SHADE}
void main() {
  pixel = vec4(covered(shaded(normalize(cross(dFdx(point), dFdy(point)))), tint), 1.0);
}`;

/** A line segment as a bar of constant width on the screen; a segment of length 0 is a square. */
export const lineVertex = `${CAMERA}
in vec3 a;
in vec3 b;
in vec4 colour;
in float width;
uniform vec2 canvas;
uniform float ratio;
out vec4 tint;
void main() {
  vec4 from = placed(a, 0.002);
  vec4 to = placed(b, 0.002);
  vec2 along = (to.xy - from.xy) * canvas;
  float length = length(along);
  along = length > 1e-6 ? along / length : vec2(1.0, 0.0);
  vec2 aside = vec2(-along.y, along.x);
  bool end = gl_VertexID % 2 == 1;
  vec4 at = end ? to : from;
  vec2 offset = (end ? along : -along) * 0.5 + aside * (gl_VertexID < 2 ? 0.5 : -0.5);
  tint = colour;
  gl_Position = vec4(at.xy + offset * max(width * ratio, 1.5) * 2.0 / canvas, at.z, 1.0);
}`;

export const lineFragment = `#version 300 es
precision highp float;
in vec4 tint;
out vec4 pixel;
void main() { pixel = tint; }`;
