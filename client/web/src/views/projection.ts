// From world to page pixels and back, the same for orthographic and perspective cameras.
import { OrthographicCamera, Plane, Ray, Vector3, type Camera } from "three";

/** A pane in page pixels, as getBoundingClientRect gives it. */
export interface PaneRect {
  left: number;
  top: number;
  width: number;
  height: number;
}

export interface PagePoint {
  x: number;
  y: number;
  /** Normalised device depth; beyond [-1, 1] the point is not seen. */
  depth: number;
}

export function project(camera: Camera, rect: PaneRect, point: Vector3): PagePoint {
  const ndc = point.clone().project(camera);
  return {
    x: rect.left + ((ndc.x + 1) / 2) * rect.width,
    y: rect.top + ((1 - ndc.y) / 2) * rect.height,
    depth: ndc.z,
  };
}

export function rayAt(camera: Camera, rect: PaneRect, x: number, y: number): Ray {
  const ndcX = ((x - rect.left) / rect.width) * 2 - 1;
  const ndcY = 1 - ((y - rect.top) / rect.height) * 2;
  const near = new Vector3(ndcX, ndcY, -1).unproject(camera);
  const far = new Vector3(ndcX, ndcY, 1).unproject(camera);
  return new Ray(near, far.sub(near).normalize());
}

/** Where the pixel meets the plane through `through` that is parallel to the view; null never happens in view. */
export function onViewPlane(camera: Camera, rect: PaneRect, x: number, y: number, through: Vector3): Vector3 | null {
  const normal = camera.getWorldDirection(new Vector3());
  const plane = new Plane().setFromNormalAndCoplanarPoint(normal, through);
  return rayAt(camera, rect, x, y).intersectPlane(plane, new Vector3());
}

const toPoint = new Vector3();

/** World metres that one page pixel spans at a point. Asked for each cube in each pane, so without projecting. */
export function metresPerPixel(camera: Camera, rect: PaneRect, at: Vector3): number {
  if (camera instanceof OrthographicCamera) return (camera.top - camera.bottom) / camera.zoom / rect.height;
  // The third row of the view matrix is the way out of the screen.
  const { elements } = camera.matrixWorld;
  toPoint.setFromMatrixPosition(camera.matrixWorld).sub(at);
  const depth = toPoint.x * elements[8]! + toPoint.y * elements[9]! + toPoint.z * elements[10]!;
  return (Math.max(depth, 1e-3) * 2) / camera.projectionMatrix.elements[5]! / rect.height;
}
