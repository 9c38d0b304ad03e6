import { Plane, Vector3 } from 'three';
import type { Mesh as ThreeMesh } from 'three';
import type { Mesh } from 'fast-winding';
import { byId } from '../dom.ts';
import { shadesOf } from '../measure.ts';
import { significant } from '../format.ts';
import { diagonal, planeHeight } from '../state.ts';
import type { Model, State } from '../state.ts';
import type { Store } from '../store.ts';
import { drawAxes } from './axes.ts';
import type { Box, Direction } from './framing.ts';
import { floorUnder } from './grid.ts';
import { contourLines, heatPane, planePane } from './layer.ts';
import { thickLines } from './lines.ts';
import { twoSidedMesh } from './mesh.ts';
import { Part } from './part.ts';
import { normalsOf, pointsOf } from './points.ts';
import { Preview } from './preview.ts';
import { Stage } from './stage.ts';

const BOUNDARY_PIXELS = 2.5;

/** The 3D view: shows what the store holds. */
export class View {
  readonly #store: Store<State>;
  readonly #stage: Stage;
  readonly #parts = { floor: new Part(), model: new Part(), boundary: new Part(), normals: new Part(), pane: new Part(), heat: new Part(), contours: new Part(), voxels: new Part(), surface: new Part(), print: new Part() };
  readonly #preview: Preview;
  /** One plane, moved; the list is shared by all materials that are cut. */
  readonly #cutPlane = new Plane(new Vector3(0, 0, -1));
  #cut: Plane[] = [];

  constructor(store: Store<State>) {
    this.#store = store;
    this.#stage = new Stage(byId<HTMLCanvasElement>('canvas'));
    this.#stage.scene.add(...Object.values(this.#parts).map((part) => part.group));
    this.#preview = new Preview(store, this.#stage, this.#parts.print);
    this.#stage.beforeDraw(() => this.#followCamera());
    this.#followStore();
    for (const button of document.querySelectorAll<HTMLButtonElement>('[data-view]')) {
      const direction = button.dataset.view === 'fit' ? undefined : (button.dataset.view as Direction);
      button.addEventListener('click', () => this.#stage.frame(undefined, direction));
    }
  }

  /** Draws everything anew, with the colours of the style sheet as they are now. */
  refresh(): void {
    this.#showModel();
    this.#showPlane();
    this.#showLayer();
    this.#showSolid('voxels', this.#store.state.voxels?.value.surface);
    this.#showSolid('surface', this.#store.state.surface?.value);
    this.#preview.refresh();
  }

  /** From below, the floor would hide what stands on it. */
  #followCamera(): void {
    const { camera } = this.#stage;
    const { model } = this.#store.state;
    if (!model) return;
    drawAxes(byId<SVGElement>('axes'), camera);
    this.#parts.floor.group.visible = camera.position.z > model.bounds.min[2] - model.geometry.origin[2];
  }

  #followStore(): void {
    const { state } = this.#store;
    let framed = state.model?.shape;
    this.#store.on(['settling', 'measure'], () => this.#showModel());
    this.#store.on(['halves'], ({ halves }) => {
      this.#stage.split(halves ? [() => this.#showHalf(false), () => this.#showHalf(true)] : []);
      this.#showVisible();
    });
    this.#store.on(['model'], ({ model }) => {
      this.#showModel();
      if (!model || model.shape === framed) return;
      framed = model.shape;
      this.#stage.frame(boxOf(model), 'corner');
    });
    this.#store.on(['cutAway'], () => {
      this.#cut = this.#store.state.cutAway ? [this.#cutPlane] : [];
      this.refresh();
    });
    this.#store.on(['plane', 'heat', 'model'], () => this.#showPlane());
    this.#store.on(['layer', 'heat'], () => this.#showLayer());
    this.#store.on(['voxels'], ({ voxels }) => this.#showSolid('voxels', voxels?.value.surface));
    this.#store.on(['surface'], ({ surface }) => this.#showSolid('surface', surface?.value));
    this.#store.on(['visible'], () => this.#showVisible());
  }

  #showVisible(visible = this.#store.state.visible): void {
    const { model, boundary, normals, pane, heat, contours, voxels, surface, print } = this.#parts;
    for (const [part, isVisible] of [
      [model, visible.model], [boundary, visible.boundary], [normals, visible.normals],
      [pane, visible.layer], [heat, visible.layer], [contours, visible.layer],
      [voxels, visible.voxels], [surface, visible.surface], [print, visible.print],
    ] as const) part.group.visible = isVisible;
    this.#stage.draw();
  }

  /** Only the model, or only what was made of it: the surface if there is one. */
  #showHalf(isMade: boolean): void {
    const { visible, surface } = this.#store.state;
    const { model, boundary, normals, pane, heat, contours, voxels, surface: surfacePart, print } = this.#parts;
    for (const part of [pane, heat, contours, print]) part.group.visible = false;
    model.group.visible = !isMade;
    boundary.group.visible = !isMade && visible.boundary;
    normals.group.visible = !isMade && visible.normals;
    surfacePart.group.visible = isMade && surface !== undefined;
    voxels.group.visible = isMade && surface === undefined;
  }

  #showModel(): void {
    const { model, settling, measure } = this.#store.state;
    if (!model) return;
    const { geometry, bounds } = model;
    const { positions, indices, boundary, origin } = geometry;
    const normals = settling ?? geometry.normals;
    const tints = measure && !settling ? shadesOf(measure.values) : undefined;
    const { lines, step } = floorUnder(bounds, origin);
    byId('grid-label').textContent = `grid ${significant(step)} mm`;
    this.#parts.floor.replace(lines);
    const size = diagonal(bounds);
    if (indices) this.#parts.model.replace(...twoSidedMesh({ positions, indices }, '--view-front', this.#cut));
    else this.#parts.model.replace(pointsOf({ positions, normals, tints }, size, this.#cut));
    this.#parts.boundary.replace(...(boundary.length > 0 ? [thickLines(boundary, '--view-edge', BOUNDARY_PIXELS, this.#cut)] : []));
    this.#parts.normals.replace(...(normals ? [normalsOf(positions, normals, size, this.#cut)] : []));
    this.#stage.draw();
  }

  #showPlane(): void {
    const { model, plane, heat } = this.#store.state;
    if (!model?.oriented) return this.#parts.pane.replace();
    const { origin } = model.geometry;
    const z = planeHeight(plane, model.bounds);
    this.#cutPlane.constant = z - origin[2];
    const rectangle = { min: [model.bounds.min[0], model.bounds.min[1]], max: [model.bounds.max[0], model.bounds.max[1]] } as const;
    // A heat map of this height takes the pane's place.
    this.#parts.pane.replace(...(heat?.value.z === z ? [] : planePane(rectangle, z, origin)));
    this.#stage.draw();
  }

  #showLayer(): void {
    const { model, layer, heat } = this.#store.state;
    const surroundings = { origin: model?.geometry.origin ?? new Float64Array(3), cut: this.#cut };
    this.#parts.contours.replace(...(layer ? contourLines(layer.value, surroundings, heat !== undefined) : []));
    this.#parts.heat.replace(...(heat ? [heatPane(heat.value, surroundings)] : []));
    this.#stage.draw();
  }

  #showSolid(item: 'voxels' | 'surface', mesh: Mesh | undefined): void {
    this.#parts[item].replace(...(mesh ? this.#solid(item, mesh) : []));
    this.#stage.draw();
  }

  /** Voxels are shaded face by face, a surface smoothly by its normals. */
  #solid(item: 'voxels' | 'surface', { positions, indices, normals, origin }: Mesh): ThreeMesh[] {
    const scene = this.#store.state.model?.geometry.origin ?? origin;
    const meshes = twoSidedMesh({ positions, indices, normals: item === 'surface' ? normals : undefined }, `--view-${item}`, this.#cut);
    for (const mesh of meshes) mesh.position.set(origin[0] - scene[0], origin[1] - scene[1], origin[2] - scene[2]);
    return meshes;
  }
}

function boxOf({ bounds: { min, max }, geometry: { origin } }: Model): Box {
  return {
    min: [min[0] - origin[0], min[1] - origin[1], min[2] - origin[2]],
    max: [max[0] - origin[0], max[1] - origin[1], max[2] - origin[2]],
  };
}
