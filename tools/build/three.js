/** Of three.js, what the page draws surfaces in space with; `vendor.mjs` makes one file of it. */
// @ts-expect-error three.js has no types of its own
export {
  Box3, BufferAttribute, BufferGeometry, CanvasTexture, ColorManagement, DataTexture, DirectionalLight, DoubleSide, Group, LinearFilter, LinearSRGBColorSpace, Mesh, MeshMatcapMaterial,
  OrthographicCamera, PlaneGeometry, Points, PointsMaterial, Raycaster, RepeatWrapping, Scene, ShadowMaterial, Vector3, WebGLRenderer,
} from 'three';
// @ts-expect-error likewise
export { LineMaterial, LineSegments2, LineSegmentsGeometry, OrbitControls } from 'three/addons';
