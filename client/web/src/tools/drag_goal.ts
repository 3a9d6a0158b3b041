// Drags a cube in the plane through it that is parallel to the view.
import { Vector3 } from "three";
import type { Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import { tidy } from "../state/place";
import type { ViewName } from "../views/names";
import { onViewPlane } from "../views/projection";
import type { Views } from "../views/views";
import type { Drag } from "./drag";
import { pickGoal } from "./pick";
import type { Requests } from "./requests";
import { snapped } from "./snap";

export function dragGoal(views: Views, model: Model, requests: Requests, name: ViewName, x: number, y: number): Drag | null {
  const goal = pickGoal(views, model, name, x, y);
  const target = goal === null ? undefined : model.goalTarget(goal);
  if (goal === null || !target) return null;
  model.select(goal);
  const holder = model.people.holder(goal);
  if (holder) model.say(`${holder} holds this goal`, "wait until it is let go, or ask");
  if (!model.movable(goal)) return still;
  const start = new Vector3(...target);
  const grabbed = pointOnPlane(views, name, x, y, start);
  if (!grabbed) return null;
  const offset = start.clone().sub(grabbed);
  let moved = false;
  return {
    move(toX, toY, fine) {
      const point = pointOnPlane(views, name, toX, toY, start);
      // A click that trembles is no drag.
      if (!point || (!moved && Math.hypot(toX - x, toY - y) < 3)) return;
      if (!moved) requests.holdGoal(goal);
      moved = true;
      requests.moveGoal(goal, tidy(snapped(model.settings, point.add(offset).toArray() as Vec3, target, fine)));
    },
    end() {
      if (moved) requests.releaseGoal(goal);
    },
  };
}

const still: Drag = { move() {}, end() {} };

function pointOnPlane(views: Views, name: ViewName, x: number, y: number, through: Vector3): Vector3 | null {
  const rect = views.panes.rect(name);
  return onViewPlane(views.cameras.camera(name, rect), rect, x, y, through);
}
