import * as THREE from 'three';
import { init } from 'fast-winding';
import { soupArrays } from 'fast-winding/three';

const COUNT = 10_000;
const knot = new THREE.Mesh(new THREE.TorusKnotGeometry(10, 3, 200, 24), new THREE.MeshNormalMaterial({ wireframe: true, opacity: 0.15, transparent: true }));
const points = Float32Array.from({ length: 3 * COUNT }, () => 32 * (Math.random() - 0.5));

const fw = await init();
const soup = await fw.Soup.from(soupArrays(knot, { world: true }));
const inside = await soup.contains(points);
const share = inside.reduce((sum, is) => sum + is, 0) / COUNT;
document.querySelector('output').value = `${(100 * share).toFixed(1)} % of the box is inside the knot; ${fw.info.reason}`;

const geometry = new THREE.BufferGeometry();
geometry.setAttribute('position', new THREE.BufferAttribute(points, 3));
const [orange, grey] = [new THREE.Color('darkorange'), new THREE.Color('lightgrey')];
const colours = Float32Array.from([...inside].flatMap((is) => (is ? orange : grey).toArray()));
geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));

const scene = new THREE.Scene().add(knot, new THREE.Points(geometry, new THREE.PointsMaterial({ size: 0.35, vertexColors: true })));
scene.background = new THREE.Color('white');
const camera = new THREE.PerspectiveCamera(45, innerWidth / innerHeight, 1, 200);
camera.position.set(0, 0, 55);
const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);
renderer.setAnimationLoop((time) => {
  scene.rotation.y = time / 4000;
  renderer.render(scene, camera);
});
