import { BackSide, BufferAttribute, BufferGeometry, Color, DoubleSide, FrontSide, Mesh, MeshStandardMaterial } from 'three';
import type { Object3D, Plane, Side } from 'three';
import { token } from '../dom.ts';

export interface Triangles {
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
  /** Without normals each face is shaded flat, as it is. */
  readonly normals?: Float32Array;
}

/** Meshes of more triangles are drawn once, not twice, while the camera moves. */
const LARGE = 200_000;

/** Triangles whose front has one colour and whose back another, so that flipped and open parts are seen. */
export function twoSidedMesh(triangles: Triangles, frontToken: string, cut: Plane[]): Mesh[] {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(triangles.positions, 3));
  geometry.setIndex(new BufferAttribute(triangles.indices, 1));
  if (triangles.normals) geometry.setAttribute('normal', new BufferAttribute(triangles.normals, 3));
  const material = (colour: string, side: Side, depthOffset: number): MeshStandardMaterial =>
    new MeshStandardMaterial({
      color: token(colour),
      side,
      roughness: 0.9,
      metalness: 0,
      flatShading: !triangles.normals,
      clippingPlanes: cut,
      polygonOffset: true,
      polygonOffsetFactor: depthOffset,
      polygonOffsetUnits: depthOffset,
    });
  // Lines on the mesh lie before it, and fronts before the backs they meet along a silhouette.
  const front = new Mesh(geometry, material(frontToken, FrontSide, 1));
  const back = new Mesh(geometry, material('--view-back', BackSide, 3));
  if (triangles.indices.length > 3 * LARGE) simplify(front, back, withBacks(material(frontToken, DoubleSide, 1)));
  return [front, back];
}

/** What `move` is told: whether the camera moves. */
export function tellMotion(scene: Object3D, isMoving: boolean): void {
  scene.traverse(({ userData }) => (userData as Partial<Movable>).move?.(isMoving));
}

/** What an object does when the camera starts to move and rests again, and when it is no longer needed. */
export interface Movable {
  move(isMoving: boolean): void;
  release(): void;
}

/** In motion both sides are drawn at once; the backs then show as specks along silhouettes, which motion hides. */
function simplify(front: Mesh<BufferGeometry, MeshStandardMaterial>, back: Mesh, both: MeshStandardMaterial): void {
  const own = front.material;
  const movable: Movable = {
    move(isMoving) {
      front.material = isMoving ? both : own;
      back.visible = !isMoving;
    },
    release() {
      own.dispose();
      both.dispose();
    },
  };
  Object.assign(front.userData, movable);
}

/** The material with another colour on the backs. */
function withBacks(material: MeshStandardMaterial): MeshStandardMaterial {
  const back = new Color(token('--view-back'));
  material.onBeforeCompile = (shader) => {
    shader.uniforms.back = { value: back };
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nuniform vec3 back;')
      .replace('#include <color_fragment>', '#include <color_fragment>\nif (!gl_FrontFacing) diffuseColor.rgb = back;');
  };
  return material;
}
