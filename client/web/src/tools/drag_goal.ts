// Drags a cube in the plane through it that is parallel to the view.
import { Vector3 } from "three";
import type { Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import type { ViewName } from "../views/names";
import { onViewPlane } from "../views/projection";
import type { Views } from "../views/views";
import { pickGoal } from "./pick";
import type { Requests } from "./requests";
import type { Drag } from "./drag";

export function dragGoal(views: Views, model: Model, requests: Requests, name: ViewName, x: number, y: number): Drag | null {
  const goal = pickGoal(views, model, name, x, y);
  const target = goal === null ? undefined : model.goalTarget(goal);
  if (goal === null || !target) return null;
  if (!model.movable(goal)) {
    model.select(goal);
    return null;
  }
  const start = new Vector3(...target);
  const grabbed = pointOnPlane(views, name, x, y, start);
  if (!grabbed) return null;
  const offset = start.clone().sub(grabbed);
  model.select(goal);
  requests.holdGoal(goal);
  return {
    move(toX, toY) {
      const point = pointOnPlane(views, name, toX, toY, start);
      if (point) requests.moveGoal(goal, rounded(point.add(offset)));
    },
    end() {
      requests.releaseGoal(goal);
    },
  };
}

function pointOnPlane(views: Views, name: ViewName, x: number, y: number, through: Vector3): Vector3 | null {
  const rect = views.panes.rect(name);
  return onViewPlane(views.cameras.camera(name, rect), rect, x, y, through);
}

/** Micrometres are enough for a mouse, and keep the document readable. */
function rounded({ x, y, z }: Vector3): Vec3 {
  const round = (value: number) => Math.round(value * 1e6) / 1e6;
  return [round(x), round(y), round(z)];
}
