import { Box3, Plane, Vector3 } from 'three';
import { diagonal } from '../bounds.ts';
import { colourOf, spanOf } from '../colour.ts';
import { byId } from '../dom.ts';
import { significant } from '../format.ts';
import { isSolid, MADE, madeOf, SOLIDS, withResult } from '../made.ts';
import type { Solid } from '../made.ts';
import { shadesOf } from '../measure.ts';
import { heightOf } from '../plane.ts';
import { ITEMS } from '../state.ts';
import type { Item, Model, State } from '../state.ts';
import type { Store } from '../store.ts';
import { drawAxes } from './axes.ts';
import type { Box, Direction } from './framing.ts';
import { floorUnder } from './grid.ts';
import { Inspector } from './inspector.ts';
import { contourLines, distancePane, mapPane, planePane } from './layer.ts';
import { thickLines } from './lines.ts';
import { twoSidedMesh } from './mesh.ts';
import { Part } from './part.ts';
import { Placing } from './placing.ts';
import { normalsOf, pointsOf } from './points.ts';
import { Preview } from './preview.ts';
import { solidObjects } from './solids.ts';
import { Stage } from './stage.ts';
import { TexturingView } from './texturing.ts';

const BOUNDARY_PIXELS = 2.5;

/** What the view is fitted to. */
const BODIES: readonly Item[] = ['model', ...SOLIDS, 'second', 'proxy', 'fieldLines', 'textured'];
/** What is seen with the model when it is beside what was made of it. */
const BESIDE: readonly Item[] = ['model', 'boundary', 'normals', 'defects', 'second'];

/** The 3D view: shows what the store holds. */
export class View {
  readonly #store: Store<State>;
  readonly #stage: Stage;
  readonly #floor = new Part();
  readonly #pane = new Part();
  readonly #heat = new Part();
  /** A result that another one is held against. */
  readonly #against = new Part();
  readonly #items = Object.fromEntries(ITEMS.map((item) => [item, new Part()])) as Record<Item, Part>;
  readonly #preview: Preview;
  readonly #inspector: Inspector;
  readonly #placing: Placing;
  readonly #texturing: TexturingView;
  /** One plane, moved; the list is shared by all materials that are cut. */
  readonly #cutPlane = new Plane(new Vector3(0, 0, -1));
  #cut: Plane[] = [];

  constructor(store: Store<State>) {
    this.#store = store;
    this.#stage = new Stage(byId<HTMLCanvasElement>('canvas'));
    this.#stage.scene.add(...[this.#floor, this.#pane, this.#heat, this.#against, ...Object.values(this.#items)].map((part) => part.group));
    this.#preview = new Preview(store, this.#stage, this.#items.print);
    this.#inspector = new Inspector(store, this.#stage, this.#items.defects);
    this.#placing = new Placing(store, this.#stage, this.#items.second);
    this.#texturing = new TexturingView(store, this.#stage, this.#items);
    this.#stage.whole(() => this.#box());
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
    for (const solid of SOLIDS) this.#showSolid(solid);
    this.#showAgainst();
    this.#preview.refresh();
    this.#inspector.refresh();
    this.#placing.refresh();
    this.#texturing.refresh(this.#cut);
  }

  /** Of the bodies that are shown. */
  #box(): Box | undefined {
    const { visible, halves } = this.#store.state;
    const made = madeOf(this.#store.state);
    const box = new Box3();
    for (const item of BODIES) if (halves ? item === 'model' || item === made : visible[item]) box.expandByObject(this.#items[item].group);
    return box.isEmpty() ? undefined : { min: box.min.toArray(), max: box.max.toArray() };
  }

  /** From below, the floor would hide what stands on it. */
  #followCamera(): void {
    const { camera } = this.#stage;
    const { model } = this.#store.state;
    if (!model) return;
    drawAxes(byId<SVGElement>('axes'), camera);
    this.#floor.group.visible = camera.position.z > model.bounds.min[2] - model.geometry.origin[2];
  }

  #followStore(): void {
    let framed: object | undefined;
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
    this.#store.on(['plane', 'heat', 'distances', 'model'], () => this.#showPlane());
    this.#store.on(['layer', 'heat', 'distances'], () => this.#showLayer());
    for (const solid of SOLIDS) this.#store.on([solid === 'difference' ? 'comparison' : MADE[solid].slot], () => this.#showSolid(solid));
    this.#store.on(['against'], () => this.#showAgainst());
    this.#store.on(['visible'], () => this.#showVisible());
  }

  #showVisible(): void {
    const { visible } = this.#store.state;
    for (const item of ITEMS) this.#items[item].group.visible = visible[item];
    this.#pane.group.visible = this.#heat.group.visible = visible.layer;
    this.#against.group.visible = false;
    this.#stage.draw();
  }

  /** Only what was made of the model, or only what that is held against: the model, or another result. */
  #showHalf(isMade: boolean): void {
    const { visible, against } = this.#store.state;
    const made = madeOf(this.#store.state);
    const isBeside = (item: Item): boolean => BESIDE.includes(item) && (visible[item] || (item === 'second' && made === 'combined'));
    for (const item of ITEMS) this.#items[item].group.visible = isMade ? item === made : isBeside(item);
    this.#items.model.group.visible = !isMade;
    this.#against.group.visible = against !== undefined && !isMade;
    if (this.#against.group.visible) for (const item of ITEMS) this.#items[item].group.visible = false;
    this.#pane.group.visible = this.#heat.group.visible = false;
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
    this.#floor.replace(lines);
    const size = diagonal(bounds);
    if (indices) this.#items.model.replace(...twoSidedMesh({ positions, indices }, '--view-front', this.#cut));
    else this.#items.model.replace(pointsOf({ positions, normals, tints }, size, this.#cut));
    this.#items.boundary.replace(...(boundary.length > 0 ? [thickLines(boundary, '--view-edge', BOUNDARY_PIXELS, this.#cut)] : []));
    this.#items.normals.replace(...(normals ? [normalsOf(positions, normals, size, this.#cut)] : []));
    this.#stage.draw();
  }

  #showPlane(): void {
    const { model, plane, heat, distances } = this.#store.state;
    if (!model?.oriented) return this.#pane.replace();
    const { origin } = model.geometry;
    const z = heightOf(plane, model.bounds);
    this.#cutPlane.constant = z - origin[2];
    const rectangle = { min: [model.bounds.min[0], model.bounds.min[1]], max: [model.bounds.max[0], model.bounds.max[1]] } as const;
    // Colours of this height take the pane's place.
    this.#pane.replace(...((heat ?? distances)?.value.z === z ? [] : planePane(rectangle, z, origin)));
    this.#stage.draw();
  }

  #showLayer(): void {
    const { model, layer, heat, distances } = this.#store.state;
    const surroundings = { origin: model?.geometry.origin ?? new Float64Array(3), cut: this.#cut };
    const isColoured = heat !== undefined || distances !== undefined;
    this.#items.layer.replace(...(layer ? contourLines(layer.value, surroundings, isColoured) : []));
    if (heat) {
      const span = spanOf(heat.value.values);
      this.#heat.replace(mapPane(heat.value, (value) => colourOf(value, span), surroundings));
    } else this.#heat.replace(...(distances ? distancePane(distances.value, surroundings) : []));
    this.#stage.draw();
  }

  #showAgainst(): void {
    const { against } = this.#store.state;
    const objects = against && isSolid(against.item) ? solidObjects(against.item, withResult(this.#store.state, against), this.#cut) : [];
    this.#against.replace(...objects);
    this.#stage.draw();
  }

  #showSolid(solid: Solid): void {
    this.#items[solid].replace(...solidObjects(solid, this.#store.state, this.#cut));
    this.#stage.draw();
  }
}

function boxOf({ bounds: { min, max }, geometry: { origin } }: Model): Box {
  return {
    min: [min[0] - origin[0], min[1] - origin[1], min[2] - origin[2]],
    max: [max[0] - origin[0], max[1] - origin[1], max[2] - origin[2]],
  };
}
