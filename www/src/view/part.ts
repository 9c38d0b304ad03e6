import { Group, InstancedMesh, Plane } from 'three';
import type { BufferGeometry, Material, Mesh, Object3D } from 'three';
import type { Movable } from './mesh.ts';

/** What the parts of the view share. */
export interface Surroundings {
  /** The model's coordinates are the scene's plus this. */
  readonly origin: Float64Array;
  /** Planes that cut parts away; empty when nothing is cut. */
  readonly cut: Plane[];
}

/** A group whose former content is given back to the graphics card when it is replaced. */
export class Part {
  readonly group = new Group();

  replace(...objects: Object3D[]): void {
    for (const object of this.group.children) release(object);
    this.group.clear();
    if (objects.length > 0) this.group.add(...objects);
  }
}

function release(object: Object3D): void {
  object.traverse((child) => {
    const { geometry, material } = child as Partial<Mesh<BufferGeometry, Material & { map?: { dispose(): void } | null }>>;
    if (child instanceof InstancedMesh) child.dispose();
    geometry?.dispose();
    material?.map?.dispose();
    material?.dispose();
    (child.userData as Partial<Movable>).release?.();
  });
}
