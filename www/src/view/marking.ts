import { Raycaster, Vector2, Vector3 } from 'three';
import type { Mesh } from 'three';
import type { ProxyGeometry } from 'fast-winding';
import type { Seam } from '../texture.ts';
import type { Stage } from './stage.ts';

/** A pointer that moves farther while it is down turns the camera. */
const CLICK_PIXELS = 4;
/** As near to an end of a seam, a click means that. */
const SNAP_PIXELS = 10;

/** What can be marked. */
export interface Markable {
  readonly mesh: Mesh;
  readonly proxy: ProxyGeometry;
  readonly origin: Float64Array;
  readonly seams: readonly Seam[];
  readonly start?: number;
}

/** Places on the proxy, marked by a click, or by the Enter key in the middle of the view. */
export class Marking {
  readonly #stage: Stage;
  readonly #target: () => Markable | undefined;
  readonly #mark: (vertex: number) => void;
  #down?: Vector2;

  constructor(stage: Stage, target: () => Markable | undefined, mark: (vertex: number) => void) {
    this.#stage = stage;
    this.#target = target;
    this.#mark = mark;
    const { canvas } = stage;
    canvas.addEventListener('pointerdown', ({ offsetX, offsetY, isPrimary, button }) => {
      this.#down = isPrimary && button === 0 ? new Vector2(offsetX, offsetY) : undefined;
    });
    canvas.addEventListener('pointerup', ({ offsetX, offsetY, isPrimary }) => {
      const at = new Vector2(offsetX, offsetY);
      if (isPrimary && this.#down && this.#down.distanceTo(at) <= CLICK_PIXELS) this.#at(at);
      this.#down = undefined;
    });
    canvas.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' || event.repeat || !this.#target()) return;
      this.#at(new Vector2(canvas.clientWidth / 2, canvas.clientHeight / 2));
      event.preventDefault();
    });
  }

  #at(pixel: Vector2): void {
    const target = this.#target();
    const vertex = target && this.#vertexAt(pixel, target);
    if (vertex !== undefined) this.#mark(vertex);
  }

  /** The corner of the triangle under a pixel that is next to it, or the end of a seam that is close by. */
  #vertexAt(pixel: Vector2, { mesh, proxy, origin, seams, start }: Markable): number | undefined {
    const { canvas, camera } = this.#stage;
    // The camera may have turned since the last frame.
    camera.updateMatrixWorld();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * pixel.x) / canvas.clientWidth - 1, 1 - (2 * pixel.y) / canvas.clientHeight), camera);
    const hit = ray.intersectObject(mesh, false)[0];
    if (!hit || hit.faceIndex == null) return undefined;
    const place = (vertex: number): Vector3 => new Vector3(...[0, 1, 2].map((k) => proxy.positions[3 * vertex + k] - origin[k]));
    const onScreen = (vertex: number): Vector2 => {
      const { x, y } = place(vertex).project(camera);
      return new Vector2(((x + 1) / 2) * canvas.clientWidth, ((1 - y) / 2) * canvas.clientHeight);
    };
    // One on the far side of the proxy is not as far from the camera as what is under the pixel.
    const reach = hit.distance * 0.02;
    const ends = seams.flatMap(({ picks }) => [picks[0], picks[picks.length - 1]]).concat(start ?? []);
    const close = ends.filter((vertex) => onScreen(vertex).distanceTo(pixel) <= SNAP_PIXELS && Math.abs(place(vertex).distanceTo(camera.position) - hit.distance) < reach);
    const corners = close.length > 0 ? close : [...proxy.indices.subarray(3 * hit.faceIndex, 3 * hit.faceIndex + 3)];
    return corners.reduce((best, vertex) => (place(vertex).distanceTo(hit.point) < place(best).distanceTo(hit.point) ? vertex : best));
  }
}
