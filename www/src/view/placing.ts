import { Euler, Group, MathUtils } from 'three';
import type { Object3D } from 'three';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';
import { centreOf, diagonal } from '../bounds.ts';
import type { Triple } from '../bounds.ts';
import { token } from '../dom.ts';
import type { Placement } from '../placement.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';
import { twoSidedMesh } from './mesh.ts';
import type { Part } from './part.ts';
import { pointsOf } from './points.ts';
import type { Stage } from './stage.ts';

/** Scales below this are no solids any more. */
const LEAST_SCALE = 1e-3;

/** The second model in the 3D view, with handles to move, turn and scale it. */
export class Placing {
  readonly #store: Store<State>;
  readonly #stage: Stage;
  readonly #part: Part;
  readonly #controls: TransformControls;
  readonly #handles: Object3D;
  /** Where the handles are: in the middle of the second model, which is its child. */
  readonly #pivot = new Group();

  constructor(store: Store<State>, stage: Stage, part: Part) {
    this.#store = store;
    this.#stage = stage;
    this.#part = part;
    this.#pivot.rotation.order = 'ZYX';
    this.#controls = new TransformControls(stage.camera, stage.canvas);
    this.#controls.setSize(0.8);
    this.#handles = this.#controls.getHelper();
    this.#controls.addEventListener('change', () => stage.draw());
    this.#controls.addEventListener('dragging-changed', ({ value }) => stage.hold(value === true));
    this.#controls.addEventListener('objectChange', () => store.set({ placement: this.#placement() }));
    stage.scene.add(this.#handles);
    store.on(['second'], () => this.refresh());
    store.on(['placement', 'second', 'model'], () => this.#place());
    store.on(['gizmo'], ({ gizmo }) => {
      this.#controls.setMode(gizmo);
      this.#controls.setSpace(gizmo === 'scale' ? 'local' : 'world');
    });
    store.on(['second', 'visible', 'halves', 'job'], () => this.#showHandles());
  }

  /** Draws the second model anew, with the colours of the style sheet as they are now. */
  refresh(): void {
    const { second } = this.#store.state;
    this.#controls.setColors(token('--view-x'), token('--view-y'), token('--view-z'), token('--view-chosen'));
    // Given back before they are taken from the pivot.
    this.#part.replace();
    this.#pivot.clear();
    if (second) {
      const { geometry, bounds } = second;
      const { positions, indices, normals, origin } = geometry;
      const objects = indices ? twoSidedMesh({ positions, indices }, '--view-second', []) : [pointsOf({ positions, normals }, diagonal(bounds), [])];
      const own = centreOf(bounds);
      for (const object of objects) object.position.set(origin[0] - own[0], origin[1] - own[1], origin[2] - own[2]);
      this.#pivot.add(...objects);
      this.#part.replace(this.#pivot);
    }
    this.#place();
    this.#showHandles();
  }

  #place(): void {
    const { placement: { centre, angles, scale }, model } = this.#store.state;
    const origin = model?.geometry.origin ?? [0, 0, 0];
    this.#pivot.position.set(centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]);
    this.#pivot.rotation.set(...(angles.map(MathUtils.degToRad) as [number, number, number]));
    this.#pivot.scale.setScalar(scale);
    this.#stage.draw();
  }

  /** What the handles have made of the placement: one scale for all axes, of which they pull one. */
  #placement(): Placement {
    const { placement, model } = this.#store.state;
    const origin = model?.geometry.origin ?? [0, 0, 0];
    const { position, scale, quaternion } = this.#pivot;
    const pulled = [scale.x, scale.y, scale.z].reduce((most, value) => (Math.abs(value - placement.scale) > Math.abs(most - placement.scale) ? value : most));
    const { x, y, z } = new Euler().setFromQuaternion(quaternion, 'ZYX');
    return {
      centre: [position.x + origin[0], position.y + origin[1], position.z + origin[2]],
      angles: this.#controls.mode === 'rotate' ? ([x, y, z].map(MathUtils.radToDeg) as unknown as Triple) : placement.angles,
      scale: Math.max(LEAST_SCALE, Math.abs(pulled)),
    };
  }

  #showHandles(): void {
    const { second, visible, halves, job } = this.#store.state;
    const isShown = second !== undefined && visible.second && !halves && !job;
    if (isShown) this.#controls.attach(this.#pivot);
    else this.#controls.detach();
    this.#stage.draw();
  }
}
