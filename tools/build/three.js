/** Of three.js, what the page turns meshes with; `vendor.mjs` makes one file of it. */
// @ts-expect-error three.js has no types of its own
export { BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, HemisphereLight, Mesh, MeshLambertMaterial, OrthographicCamera, Points, PointsMaterial, Raycaster, Scene, WebGLRenderer } from 'three';
// @ts-expect-error likewise
export { OrbitControls } from 'three/addons/controls/OrbitControls.js';
