// Where the four views look from. The orthographic three share one centre and one scale; the fourth orbits.
import { Box3, Matrix4, OrthographicCamera, PerspectiveCamera, Vector3, type Camera } from "three";
import type { Vec3 } from "../protocol/types";
import { isOrtho, orthoBases, orthoNames, type Basis, type OrthoName, type ViewName } from "./names";
import { metresPerPixel, onViewPlane, type PaneRect } from "./projection";

const kFieldOfView = 32;
const kOrthoMargin = 1.22;
// Less, because a box's corners reach farther than the body in it.
const kPerspectiveMargin = 1.06;
const kFar = 60;

function vector([x, y, z]: Vec3): Vector3 {
  return new Vector3(x, y, z);
}

/** A size as seen along one of the world's axes. */
function along(size: Vector3, axis: Vec3): number {
  return Math.abs(size.dot(vector(axis)));
}

export class Cameras {
  /** Changes with every move, so that drawing knows. */
  version = 0;
  readonly focus = new Vector3(0, 0, 0.9);
  /** Metres across the shorter side of an orthographic pane. */
  span = 2.3;
  readonly target = new Vector3(0, 0, 0.9);
  yaw = -0.62;
  pitch = 0.22;
  distance = 4.4;

  private readonly ortho: Record<OrthoName, OrthographicCamera> = {
    top: new OrthographicCamera(),
    front: new OrthographicCamera(),
    side: new OrthographicCamera(),
  };
  private readonly eye = new PerspectiveCamera(kFieldOfView, 1, 0.05, kFar);

  /** The camera of a view, set for a pane of this shape. */
  camera(name: ViewName, rect: PaneRect): Camera {
    return isOrtho(name) ? this.orthoCamera(name, rect) : this.perspectiveCamera(rect);
  }

  pan(name: ViewName, rect: PaneRect, dx: number, dy: number): void {
    const camera = this.camera(name, rect);
    const centre = isOrtho(name) ? this.focus : this.target;
    const scale = metresPerPixel(camera, rect, centre);
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    centre.addScaledVector(right, -dx * scale).addScaledVector(up, dy * scale);
    this.version++;
  }

  /** Factor below 1 comes nearer; what lies under the pointer stays there. */
  zoom(name: ViewName, rect: PaneRect, factor: number, x: number, y: number): void {
    const centre = isOrtho(name) ? this.focus : this.target;
    const before = onViewPlane(this.camera(name, rect), rect, x, y, centre);
    if (isOrtho(name)) this.span = clamp(this.span * factor, 0.05, 30);
    else this.distance = clamp(this.distance * factor, 0.2, 30);
    const after = onViewPlane(this.camera(name, rect), rect, x, y, centre);
    if (before && after) centre.add(before.sub(after));
    this.version++;
  }

  orbit(dx: number, dy: number): void {
    this.yaw -= dx * 0.008;
    this.pitch = clamp(this.pitch + dy * 0.008, -1.5, 1.5);
    this.version++;
  }

  /** Frames a box in all the panes that show; directions of view stay. */
  fit(box: Box3, rects: Partial<Record<ViewName, PaneRect>>): void {
    if (box.isEmpty()) return;
    box.getCenter(this.focus);
    this.target.copy(this.focus);
    const size = box.getSize(new Vector3());
    let span = 0.3;
    for (const name of orthoNames) {
      const rect = rects[name];
      if (!rect) continue;
      const shorter = Math.min(rect.width, rect.height);
      const { right, up } = orthoBases[name];
      span = Math.max(span, (along(size, right) * shorter) / rect.width, (along(size, up) * shorter) / rect.height);
    }
    this.span = span * kOrthoMargin;
    if (rects.perspective) this.distance = this.distanceFor(box, rects.perspective);
    this.version++;
  }

  /** The least distance from which every corner of the box is seen. */
  private distanceFor(box: Box3, rect: PaneRect): number {
    const camera = this.perspectiveCamera(rect);
    const tan = Math.tan((kFieldOfView / 2) * (Math.PI / 180));
    let distance = 0.3;
    for (let corner = 0; corner < 8; corner++) {
      const at = (axis: "x" | "y" | "z", bit: number) => (corner & bit ? box.max : box.min)[axis];
      const offset = new Vector3(at("x", 1), at("y", 2), at("z", 4)).sub(this.target);
      offset.applyQuaternion(camera.quaternion.clone().invert());
      const across = Math.max(Math.abs(offset.x) / camera.aspect, Math.abs(offset.y));
      distance = Math.max(distance, (across / tan) * kPerspectiveMargin + offset.z);
    }
    return distance;
  }

  private orthoCamera(name: OrthoName, rect: PaneRect): OrthographicCamera {
    const camera = this.ortho[name];
    const perPixel = this.span / Math.min(rect.width, rect.height);
    camera.right = (perPixel * rect.width) / 2;
    camera.left = -camera.right;
    camera.top = (perPixel * rect.height) / 2;
    camera.bottom = -camera.top;
    camera.near = 0;
    camera.far = kFar;
    camera.updateProjectionMatrix();
    const basis = orthoBases[name];
    place(camera, basis, this.focus.clone().addScaledVector(vector(basis.back), kFar / 2));
    return camera;
  }

  private perspectiveCamera(rect: PaneRect): PerspectiveCamera {
    const camera = this.eye;
    camera.aspect = rect.width / rect.height;
    camera.updateProjectionMatrix();
    const flat = Math.cos(this.pitch);
    const back: Vec3 = [
      flat * Math.cos(this.yaw), flat * Math.sin(this.yaw), Math.sin(this.pitch),
    ];
    const right: Vec3 = [-Math.sin(this.yaw), Math.cos(this.yaw), 0];
    const up = vector(back).cross(vector(right)).toArray() as Vec3;
    place(camera, { right, up, back }, this.target.clone().addScaledVector(vector(back), this.distance));
    return camera;
  }
}

function place(camera: Camera, { right, up, back }: Basis, position: Vector3): void {
  camera.position.copy(position);
  camera.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(vector(right), vector(up), vector(back)));
  camera.updateMatrixWorld(true);
}

function clamp(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}
