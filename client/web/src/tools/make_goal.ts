// Makes a goal on the segment under the pointer, where its touch point is now: nothing jumps.
import { Quaternion, Vector3 } from "three";
import type { Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import type { ViewName } from "../views/names";
import type { Views } from "../views/views";
import { pickSegment } from "./pick";
import type { Requests } from "./requests";

export function makeGoal(views: Views, model: Model, requests: Requests, name: ViewName, x: number, y: number): boolean {
  const key = pickSegment(views, name, x, y);
  const touch = key && touchPoint(model, key.figure, key.segment);
  if (!key || !touch) return false;
  void requests.makeGoal(key.figure, key.segment, touch);
  return true;
}

export function touchPoint(model: Model, figure: string, segment: string): Vec3 | null {
  const segments = model.figures.get(figure)?.segments ?? [];
  const index = segments.findIndex(({ name }) => name === segment);
  const transform = model.poses.get(figure)?.worldFromSegment[index];
  const local = segments[index]?.touch_point;
  if (!transform || !local) return null;
  const [x, y, z, qx, qy, qz, qw] = transform;
  const point = new Vector3(...local).applyQuaternion(new Quaternion(qx, qy, qz, qw));
  return [point.x + x, point.y + y, point.z + z];
}
