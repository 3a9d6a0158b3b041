// Where the four views look from. The orthographic three share one centre and one scale; the fourth orbits.
import { Box3, Matrix4, OrthographicCamera, PerspectiveCamera, Vector3, type Camera } from "three";
import { isOrtho, orthoBases, type Basis, type OrthoName, type ViewName } from "./names";
import { metresPerPixel, onViewPlane, type PaneRect } from "./projection";

const kFieldOfView = 32;
const kMargin = 1.22;
const kFar = 60;

function vector([x, y, z]: readonly [number, number, number]): Vector3 {
  return new Vector3(x, y, z);
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

  /** Frames what matters in all four views; directions of view stay. */
  fit(box: Box3): void {
    if (box.isEmpty()) return;
    const size = box.getSize(new Vector3());
    box.getCenter(this.focus);
    this.target.copy(this.focus);
    this.span = Math.max(size.x, size.z, size.y * 0.85, 0.3) * kMargin;
    const radius = Math.max(size.z, Math.hypot(size.x, size.y) * 0.8, 0.3) / 2;
    this.distance = (radius * kMargin) / Math.tan((kFieldOfView / 2) * (Math.PI / 180)) + size.x / 2;
    this.version++;
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
    const back: [number, number, number] = [
      flat * Math.cos(this.yaw), flat * Math.sin(this.yaw), Math.sin(this.pitch),
    ];
    const right: [number, number, number] = [-Math.sin(this.yaw), Math.cos(this.yaw), 0];
    const up = vector(back).cross(vector(right)).toArray() as [number, number, number];
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
