// Where the four views look from, led by three's own controls. The orthographic three share one centre and one zoom.
import { Box3, MOUSE, OrthographicCamera, PerspectiveCamera, Quaternion, TOUCH, Vector3, type Camera } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import type { Quat, Vec3 } from "../protocol/types";
import { isOrtho, orthoBases, orthoNames, viewNames, type OrthoName, type ViewName } from "./names";
import type { PaneRect } from "./projection";

const kFieldOfView = 32;
/** Metres across the shorter side of an orthographic pane at zoom 1. */
const kSpan = 2.3;
const kOrthoMargin = 1.22;
// Less, because a box's corners reach farther than the body in it.
const kPerspectiveMargin = 1.06;
const kFar = 60;

/** What a link keeps of the views. */
export interface CameraState {
  focus: Vec3;
  zoom: number;
  eye: Vec3;
  target: Vec3;
}

/** Somebody else's hand on the perspective camera: a tracker, or a figure's eyes. Looks along its own +X, +Z is up. */
export interface Rider {
  position: Vec3;
  quat_xyzw: Quat;
  fov_y: number;
}

/** From three's camera, which looks along its own -Z with +Y up, to X forward and Z up. */
const cameraFromFrame = new Quaternion(0.5, -0.5, -0.5, 0.5);

export class Cameras {
  /** Changes with every move, so that drawing knows. */
  version = 0;
  readonly controls: Record<ViewName, OrbitControls>;
  private readonly ortho: Record<OrthoName, OrthographicCamera>;
  private readonly eye = new PerspectiveCamera(kFieldOfView, 1, 0.02, kFar);
  private readonly ridden = new PerspectiveCamera(kFieldOfView, 1, 0.02, kFar);
  private rider: Rider | null = null;
  private syncing = false;

  /** Without panes the cameras can be asked and fitted, but not led by a hand. */
  constructor(panes?: Record<ViewName, HTMLElement>) {
    this.eye.up.set(0, 0, 1);
    this.eye.position.set(3.5, -2.5, 1.85);
    this.ortho = Object.fromEntries(orthoNames.map((name) => [name, makeOrtho(name)])) as Record<OrthoName, OrthographicCamera>;
    this.controls = Object.fromEntries(viewNames.map((name) => [name, this.makeControls(name, panes?.[name])])) as Record<ViewName, OrbitControls>;
    this.lookAt(new Vector3(0, 0, 0.9));
    this.controls.perspective.target.set(0, 0, 0.9);
    this.controls.perspective.update();
  }

  /** The camera of a view, set for a pane of this shape. */
  camera(name: ViewName, rect: PaneRect): Camera {
    if (isOrtho(name)) return this.shaped(name, rect);
    const camera = this.rider ? this.ridden : this.eye;
    camera.aspect = rect.width / rect.height;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return camera;
  }

  get focus(): Vector3 {
    return this.controls.front.target;
  }

  /** What a view turns about and its light comes to. */
  centre(name: ViewName): Vector3 {
    return this.controls[name].target;
  }

  ride(rider: Rider | null): void {
    if (rider === null && this.rider === null) return;
    this.rider = rider;
    this.controls.perspective.enabled = rider === null;
    if (rider) {
      this.ridden.position.set(...rider.position);
      this.ridden.quaternion.set(...rider.quat_xyzw).multiply(cameraFromFrame);
      this.ridden.fov = (rider.fov_y * 180) / Math.PI;
    }
    this.version++;
  }

  /** Where the perspective view is led by hand, as a camera of the scene. */
  get here(): { position: Vec3; quat_xyzw: Quat } {
    const { x, y, z, w } = this.eye.quaternion.clone().multiply(cameraFromFrame.clone().invert());
    return { position: vec(this.eye.position), quat_xyzw: [x, y, z, w] };
  }

  get state(): CameraState {
    const { target } = this.controls.perspective;
    return { focus: vec(this.focus), zoom: this.ortho.front.zoom, eye: vec(this.eye.position), target: vec(target) };
  }

  restore({ focus, zoom, eye, target }: CameraState): void {
    for (const name of orthoNames) this.ortho[name].zoom = zoom;
    this.lookAt(new Vector3(...focus));
    this.eye.position.set(...eye);
    this.controls.perspective.target.set(...target);
    this.controls.perspective.update();
    this.version++;
  }

  /** Frames a box in all the panes that show; directions of view stay. */
  fit(box: Box3, rects: Partial<Record<ViewName, PaneRect>>): void {
    if (box.isEmpty()) return;
    const centre = box.getCenter(new Vector3());
    const size = box.getSize(new Vector3());
    let span = 0.3;
    for (const name of orthoNames) {
      const rect = rects[name];
      if (!rect) continue;
      const shorter = Math.min(rect.width, rect.height);
      const { right, up } = orthoBases[name];
      span = Math.max(span, (along(size, right) * shorter) / rect.width, (along(size, up) * shorter) / rect.height);
    }
    for (const name of orthoNames) this.ortho[name].zoom = kSpan / (span * kOrthoMargin);
    this.lookAt(centre);
    if (rects.perspective) this.fitPerspective(box, centre, rects.perspective);
    this.version++;
  }

  private fitPerspective(box: Box3, centre: Vector3, rect: PaneRect): void {
    const controls = this.controls.perspective;
    const back = this.eye.position.clone().sub(controls.target).normalize();
    controls.target.copy(centre);
    this.eye.position.copy(centre).add(back);
    controls.update();
    // Not `camera`, which may be ridden.
    this.eye.aspect = rect.width / rect.height;
    this.eye.updateProjectionMatrix();
    this.eye.position.copy(centre).addScaledVector(back, this.distanceFor(box, centre));
    controls.update();
  }

  /** The least distance from which every corner of the box is seen. */
  private distanceFor(box: Box3, centre: Vector3): number {
    const tan = Math.tan((kFieldOfView / 2) * (Math.PI / 180));
    const turn = this.eye.quaternion.clone().invert();
    let distance = 0.3;
    for (let corner = 0; corner < 8; corner++) {
      const at = (axis: "x" | "y" | "z", bit: number) => (corner & bit ? box.max : box.min)[axis];
      const offset = new Vector3(at("x", 1), at("y", 2), at("z", 4)).sub(centre).applyQuaternion(turn);
      const across = Math.max(Math.abs(offset.x) / this.eye.aspect, Math.abs(offset.y));
      distance = Math.max(distance, (across / tan) * kPerspectiveMargin + offset.z);
    }
    return distance;
  }

  private shaped(name: OrthoName, rect: PaneRect): OrthographicCamera {
    const camera = this.ortho[name];
    const perPixel = kSpan / Math.min(rect.width, rect.height);
    camera.right = (perPixel * rect.width) / 2;
    camera.left = -camera.right;
    camera.top = (perPixel * rect.height) / 2;
    camera.bottom = -camera.top;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return camera;
  }

  private makeControls(name: ViewName, pane: HTMLElement | undefined): OrbitControls {
    const camera = isOrtho(name) ? this.ortho[name] : this.eye;
    const controls = new OrbitControls(camera, pane ?? null);
    controls.zoomToCursor = true;
    if (isOrtho(name)) {
      controls.enableRotate = false;
      [controls.minZoom, controls.maxZoom] = [0.08, 60];
      controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.PAN };
      controls.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
      controls.addEventListener("change", () => this.follow(name));
    } else {
      [controls.minDistance, controls.maxDistance] = [0.2, 30];
      controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.ROTATE, RIGHT: MOUSE.PAN };
      controls.addEventListener("change", () => this.version++);
    }
    return controls;
  }

  /** What one orthographic view does, the other two do. */
  private follow(leader: OrthoName): void {
    if (this.syncing) return;
    for (const name of orthoNames) this.ortho[name].zoom = this.ortho[leader].zoom;
    this.lookAt(this.controls[leader].target);
  }

  private lookAt(centre: Vector3): void {
    this.syncing = true;
    const to = centre.clone();
    for (const name of orthoNames) {
      this.controls[name].target.copy(to);
      this.ortho[name].position.copy(to).addScaledVector(new Vector3(...orthoBases[name].back), kFar / 2);
      this.controls[name].update();
      this.ortho[name].updateMatrixWorld();
    }
    this.syncing = false;
    this.version++;
  }
}

function makeOrtho(name: OrthoName): OrthographicCamera {
  const camera = new OrthographicCamera(-1, 1, 1, -1, 0, kFar);
  camera.up.set(...orthoBases[name].up);
  return camera;
}

/** A size as seen along one of the world's axes. */
function along(size: Vector3, axis: Vec3): number {
  return Math.abs(size.dot(new Vector3(...axis)));
}

function vec({ x, y, z }: Vector3): Vec3 {
  const round = (value: number) => Math.round(value * 1e4) / 1e4;
  return [round(x), round(y), round(z)];
}
