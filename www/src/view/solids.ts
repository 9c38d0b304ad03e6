import { BoxGeometry, Color, InstancedMesh, Matrix4, MeshStandardMaterial } from 'three';
import type { Object3D, Plane } from 'three';
import { shownRow } from '../comparison.ts';
import type { ComparedVoxels } from '../comparison.ts';
import { token } from '../dom.ts';
import type { Solid } from '../made.ts';
import type { Combined, Triangles } from '../results.ts';
import type { State } from '../state.ts';
import { twoSidedMesh } from './mesh.ts';

/** Cubes of wrong voxels are a little larger than these, so as not to flicker with what they lie on. */
const CUBE = 1.01;
/** More cubes than this are drawn in part: the picture is full of them. */
const MOST_CUBES = 300_000;

export function solidObjects(solid: Solid, state: State, cut: Plane[]): Object3D[] {
  const { model, voxels, surface, repair, offset, combined, comparison } = state;
  const scene = model?.geometry.origin ?? new Float64Array(3);
  const mesh = (triangles: (Triangles & { normals?: Float32Array }) | undefined, front: string): Object3D[] =>
    triangles ? moved(twoSidedMesh(triangles, front, cut), triangles.origin, scene) : [];
  switch (solid) {
    case 'voxels':
      // Shaded face by face.
      return mesh(voxels?.value.surface && { ...voxels.value.surface, normals: undefined } as Triangles, '--view-voxels');
    case 'surface':
      return mesh(surface?.value, '--view-surface');
    case 'repaired':
      return mesh(repair?.value.triangles, '--view-repaired');
    case 'offset':
      return mesh(offset?.value.mesh, '--view-offset');
    case 'combined':
      return combined ? combinedObjects(combined.value, scene, cut) : [];
    case 'difference':
      return comparison ? cubes(shownRow(comparison), scene, cut) : [];
  }
}

/** What is left of the model, and in another colour what is left of the second one. */
function combinedObjects({ triangles, operands }: Combined, scene: Float64Array, cut: Plane[]): Object3D[] {
  const of = (operand: number): Uint32Array => triangles.indices.filter((_, i) => (operands[Math.floor(i / 3)] === 0) === (operand === 0));
  const meshes = [0, 1].flatMap((operand) => {
    const indices = of(operand);
    return indices.length > 0 ? twoSidedMesh({ ...triangles, indices }, operand === 0 ? '--view-front' : '--view-second', cut) : [];
  });
  return moved(meshes, triangles.origin, scene);
}

/** A cube for each wrong voxel: missing, or too many. */
function cubes({ voxels: { counts, origin, spacing }, difference }: ComparedVoxels, scene: Float64Array, cut: Plane[]): Object3D[] {
  const ofKind = (places: Uint32Array, colourToken: string): Object3D[] => {
    if (places.length === 0) return [];
    const shown = Math.min(places.length, MOST_CUBES);
    const material = new MeshStandardMaterial({ color: new Color(token(colourToken)), roughness: 0.9, clippingPlanes: cut });
    const mesh = new InstancedMesh(new BoxGeometry(CUBE * spacing[0], CUBE * spacing[1], CUBE * spacing[2]), material, shown);
    const matrix = new Matrix4();
    for (let k = 0; k < shown; k++) {
      const place = places[Math.floor((k * places.length) / shown)];
      const cell = [place % counts[0], Math.floor(place / counts[0]) % counts[1], Math.floor(place / (counts[0] * counts[1]))];
      const [x, y, z] = cell.map((index, axis) => origin[axis] + index * spacing[axis] - scene[axis]);
      mesh.setMatrixAt(k, matrix.makeTranslation(x, y, z));
    }
    mesh.frustumCulled = false;
    return [mesh];
  };
  return [...ofKind(difference.lost, '--view-lost'), ...ofKind(difference.gained, '--view-gained')];
}

/** Of another origin into the scene. */
function moved<T extends Object3D>(objects: T[], origin: ArrayLike<number>, scene: Float64Array): T[] {
  for (const object of objects) object.position.set(origin[0] - scene[0], origin[1] - scene[1], origin[2] - scene[2]);
  return objects;
}
