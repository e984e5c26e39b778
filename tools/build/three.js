/** Of three.js, what the page draws surfaces in space with; `vendor.mjs` makes one file of it. */
// @ts-expect-error three.js has no types of its own
export {
  BufferAttribute, BufferGeometry, CanvasTexture, ColorManagement, DataTexture, DirectionalLight, DoubleSide, Group, LinearFilter, LinearSRGBColorSpace, Mesh, MeshMatcapMaterial,
  OrthographicCamera, PlaneGeometry, Points, PointsMaterial, Raycaster, Scene, ShadowMaterial, Vector3, WebGLRenderer,
} from 'three';
// @ts-expect-error likewise
export { OrbitControls } from 'three/addons/controls/OrbitControls.js';
// @ts-expect-error likewise
export { LineMaterial } from 'three/addons/lines/LineMaterial.js';
// @ts-expect-error likewise
export { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
// @ts-expect-error likewise
export { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
