/** Of three.js, what the page turns meshes with; `vendor.mjs` makes one file of it. */
// @ts-expect-error three.js has no types of its own
export {
  Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, HemisphereLight, Mesh, MeshLambertMaterial, OrthographicCamera, PlaneGeometry, Points, PointsMaterial,
  Raycaster, Scene, ShadowMaterial, Vector3, WebGLRenderer,
} from 'three';
// @ts-expect-error likewise
export { OrbitControls } from 'three/addons/controls/OrbitControls.js';
