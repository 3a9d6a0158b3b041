// three's own gizmo on what is chosen, drawn in every pane and led by whoever listens to the pointer.
import { Object3D, type Camera, type Scene } from "three";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";
import type { Quat, Vec3 } from "../protocol/types";
import type { PaneRect } from "./projection";

export interface GizmoPlace {
  position: Vec3;
  turn: Quat;
  mode: "translate" | "rotate";
}

type Pointer = Parameters<TransformControls["pointerDown"]>[0];

export class Gizmo {
  readonly proxy = new Object3D();
  private controls: TransformControls | null = null;

  constructor(private readonly scene: Scene) {
    scene.add(this.proxy);
  }

  get dragging(): boolean {
    return this.controls?.dragging ?? false;
  }

  /** Called when drawing; while it is dragged the hand says where it is. */
  put(place: GizmoPlace | null, camera: Camera): void {
    if (!place) {
      if (this.controls?.object) this.controls.detach();
      return;
    }
    const controls = (this.controls ??= this.make(camera));
    if (controls.dragging) return;
    this.proxy.position.set(...place.position);
    this.proxy.quaternion.set(...place.turn);
    if (controls.mode !== place.mode) controls.setMode(place.mode);
    if (controls.space !== (place.mode === "rotate" ? "local" : "world")) controls.setSpace(place.mode === "rotate" ? "local" : "world");
    if (!controls.object) controls.attach(this.proxy);
    this.proxy.updateMatrixWorld();
  }

  /** Before a pane is drawn: handles have their size on its screen. */
  face(camera: Camera): void {
    if (!this.controls?.object) return;
    this.controls.camera = camera;
    this.controls.getHelper().updateMatrixWorld();
  }

  /** Which handle lies under the pointer, none: null. */
  hover(camera: Camera, rect: PaneRect, x: number, y: number): string | null {
    if (!this.controls?.object || this.controls.dragging) return null;
    this.face(camera);
    this.controls.pointerHover(pointer(rect, x, y));
    return this.controls.axis;
  }

  down(camera: Camera, rect: PaneRect, x: number, y: number): boolean {
    if (this.hover(camera, rect, x, y) === null) return false;
    this.controls!.pointerDown(pointer(rect, x, y));
    return this.dragging;
  }

  move(camera: Camera, rect: PaneRect, x: number, y: number): GizmoPlace {
    this.face(camera);
    this.controls!.pointerMove(pointer(rect, x, y, -1));
    const { position, quaternion } = this.proxy;
    const mode = this.controls!.mode === "rotate" ? "rotate" : "translate";
    return { position: position.toArray(), turn: quaternion.toArray() as Quat, mode };
  }

  up(): void {
    this.controls?.pointerUp({ button: 0 } as Pointer);
  }

  private make(camera: Camera): TransformControls {
    const controls = new TransformControls(camera);
    controls.setSize(0.85);
    const helper = controls.getHelper();
    // Above the bodies, as the cubes are.
    helper.traverse((part) => (part.renderOrder = 20));
    this.scene.add(helper);
    return controls;
  }
}

/** What the controls call a pointer: a place between -1 and 1, and a button. */
function pointer(rect: PaneRect, x: number, y: number, button = 0): Pointer {
  const place = { x: ((x - rect.left) / rect.width) * 2 - 1, y: 1 - ((y - rect.top) / rect.height) * 2, button };
  return place as unknown as Pointer;
}
