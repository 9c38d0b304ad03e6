import { Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, Vector2, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { cameraFor, sideOf } from './framing.ts';
import type { Box, CameraPlace, Direction } from './framing.ts';
import { tellMotion } from './mesh.ts';

/** Angle that one press of an arrow key turns the camera. */
const TURN_RADIANS = Math.PI / 24;
const ZOOM_PER_PRESS = 1.15;
/** Keeps the camera from looking exactly along z, where "up" would flip. */
const POLE_RADIANS = 0.01;

const REST_MILLISECONDS = 250;

/** Renderer, camera, lights and their controls. Draws only when something changed. */
export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(32, 1, 0.1, 1000);
  readonly #renderer: WebGLRenderer;
  readonly #controls: OrbitControls;
  readonly #beforeDraw: (() => void)[] = [];
  /** What to show in the left and the right half, if the view is split. */
  #halves: readonly (() => void)[] = [];
  #box?: Box;
  #wholeBox: () => Box | undefined = () => this.#box;
  #isWaiting = false;
  /** Runs while the camera moves. */
  #rest?: ReturnType<typeof setTimeout>;

  constructor(canvas: HTMLCanvasElement) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#renderer.localClippingEnabled = true;
    this.camera.up.set(0, 0, 1);
    this.#light();
    this.#controls = new OrbitControls(this.camera, canvas);
    this.#controls.addEventListener('change', () => this.#move());
    canvas.addEventListener('keydown', (event) => this.#onKey(event));
    new ResizeObserver(() => this.#resize(canvas)).observe(canvas);
  }

  /** Draws before the next frame is shown. */
  draw(): void {
    if (this.#isWaiting) return;
    this.#isWaiting = true;
    requestAnimationFrame(() => {
      this.#isWaiting = false;
      this.camera.updateMatrixWorld();
      for (const call of this.#beforeDraw) call();
      if (this.#halves.length > 0) this.#drawHalves();
      else this.#renderer.render(this.scene, this.camera);
    });
  }

  /** After a while without another move the camera is at rest. */
  #move(): void {
    if (this.#rest === undefined) tellMotion(this.scene, true);
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => {
      this.#rest = undefined;
      tellMotion(this.scene, false);
      this.draw();
    }, REST_MILLISECONDS);
    this.draw();
  }

  /** Splits the view: before each half is drawn, its function shows what belongs there. Without functions it is whole again. */
  split(halves: readonly (() => void)[]): void {
    this.#halves = halves;
    this.#resize(this.#renderer.domElement);
  }

  #drawHalves(): void {
    const size = this.#renderer.getSize(new Vector2());
    this.#renderer.setScissorTest(true);
    this.#halves.forEach((show, k) => {
      show();
      const half = [(k * size.x) / 2, 0, size.x / 2, size.y] as const;
      this.#renderer.setViewport(...half);
      this.#renderer.setScissor(...half);
      this.#renderer.render(this.scene, this.camera);
    });
    this.#renderer.setScissorTest(false);
    this.#renderer.setViewport(0, 0, size.x, size.y);
  }

  /** Calls before each drawing, with the camera where it will be. */
  beforeDraw(call: () => void): void {
    this.#beforeDraw.push(call);
  }

  get canvas(): HTMLCanvasElement {
    return this.#renderer.domElement;
  }

  /** Keeps the camera where it is, while something else follows the pointer. */
  hold(isHeld: boolean): void {
    this.#controls.enabled = !isHeld;
  }

  /** Looks at the whole box, from now on what there is; from where the camera is unless a direction is given. */
  frame(box: Box | undefined = this.#wholeBox(), direction?: Direction): void {
    if (!box) return;
    this.#box = box;
    this.#go(cameraFor(box, this.camera, this.#controls.target, direction));
  }

  /** Tells what is shown, to be looked at when the person asks for all of it. */
  whole(box: () => Box | undefined): void {
    this.#wholeBox = () => box() ?? this.#box;
  }

  /** Looks at a part of what there is, from the side that it faces if that is given. */
  look(part: Box, facing?: readonly number[]): void {
    const place = cameraFor(part, this.camera, this.#controls.target, facing && sideOf(facing, this.#arm()));
    const whole = cameraFor(this.#box ?? part, this.camera, this.#controls.target);
    this.#go({ ...place, far: Math.max(place.far, whole.far) });
  }

  #go({ position, target, near, far }: CameraPlace): void {
    this.camera.position.copy(position);
    this.camera.near = near;
    this.camera.far = far;
    this.camera.updateProjectionMatrix();
    this.#controls.target.copy(target);
    this.#controls.update();
    this.draw();
  }

  /** Light comes from beside the camera, so that no side lies in the dark. */
  #light(): void {
    const key = new DirectionalLight(0xffffff, 1.9);
    key.position.set(-0.5, 0.8, 1);
    this.camera.add(key, key.target);
    key.target.position.set(0, 0, -1);
    const sky = new HemisphereLight(new Color('#ffffff'), new Color('#8d8a86'), 1.35);
    sky.position.set(0, 0, 1);
    this.scene.add(this.camera, sky);
  }

  #resize(canvas: HTMLCanvasElement): void {
    const { clientWidth: width, clientHeight: height } = canvas;
    if (width === 0 || height === 0) return;
    this.#renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.#renderer.setSize(width, height, false);
    const whole = width / height;
    this.camera.aspect = whole / Math.max(1, this.#halves.length);
    // A half shows as much as the whole view does, smaller.
    this.camera.zoom = Math.min(1, this.camera.aspect / Math.min(1, whole));
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  #onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turns: Record<string, [number, number]> = {
      ArrowLeft: [-TURN_RADIANS, 0],
      ArrowRight: [TURN_RADIANS, 0],
      ArrowUp: [0, -TURN_RADIANS],
      ArrowDown: [0, TURN_RADIANS],
    };
    if (turns[event.key]) this.#turn(...turns[event.key]);
    else if (event.key === '+' || event.key === '=') this.#zoom(1 / ZOOM_PER_PRESS);
    else if (event.key === '-') this.#zoom(ZOOM_PER_PRESS);
    else if (event.key === 'f' || event.key === 'F' || event.key === 'Home') this.frame();
    else return;
    event.preventDefault();
  }

  /** From what is looked at to the camera. */
  #arm(): Vector3 {
    return new Vector3().subVectors(this.camera.position, this.#controls.target);
  }

  #turn(around: number, over: number): void {
    const arm = this.#arm();
    const polar = Math.acos(arm.z / arm.length());
    const turned = Math.min(Math.PI - POLE_RADIANS, Math.max(POLE_RADIANS, polar + over));
    const azimuth = Math.atan2(arm.y, arm.x) + around;
    const length = arm.length();
    arm.set(Math.sin(turned) * Math.cos(azimuth), Math.sin(turned) * Math.sin(azimuth), Math.cos(turned)).multiplyScalar(length);
    this.camera.position.addVectors(this.#controls.target, arm);
    this.#controls.update();
    this.draw();
  }

  #zoom(factor: number): void {
    const arm = this.#arm();
    this.camera.position.addVectors(this.#controls.target, arm.multiplyScalar(factor));
    this.#controls.update();
    this.draw();
  }
}
