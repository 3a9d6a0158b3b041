// The gizmo on what is chosen: moves or turns a goal, or turns the chosen segment about its joint.
import type { Quat, Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import { quatOf, originOf, tidy } from "../state/place";
import type { GizmoPlace } from "../views/gizmo";
import type { ViewName } from "../views/names";
import type { Views } from "../views/views";
import type { Drag } from "./drag";
import { turnSegment } from "./joints";
import { newId } from "./new_id";
import type { Requests } from "./requests";
import { snapped } from "./snap";

/** Where the gizmo is; null: nothing is chosen that it could move. */
export function gizmoPlace(model: Model): GizmoPlace | null {
  const id = model.selectedGoal;
  if (id !== null) {
    const position = model.goalTarget(id);
    if (!position || !model.mayEdit || model.people.holder(id)) return null;
    const turn = model.goalTurn(id);
    if (turn && (model.settings.gizmo === "turn" || !model.movable(id))) return { position, turn, mode: "rotate" };
    return model.movable(id) ? { position, turn: [0, 0, 0, 1], mode: "translate" } : null;
  }
  const chosen = model.chosenSegment();
  if (!chosen?.transform || !model.mayEdit || !turnable(chosen.document.joint?.type)) return null;
  return { position: originOf(chosen.transform), turn: quatOf(chosen.transform), mode: "rotate" };
}

function turnable(type: string | undefined): boolean {
  return type === "free" || type === "ball" || type === "universal" || type === "hinge";
}

export function dragGizmo(views: Views, model: Model, requests: Requests, name: ViewName, x: number, y: number): Drag | null {
  const rect = views.panes.rect(name);
  const camera = () => views.cameras.camera(name, rect);
  const start = gizmoPlace(model);
  if (!start || !views.gizmo.down(camera(), rect, x, y)) return null;
  const [goal, chosen, gesture] = [model.selectedGoal, model.chosenSegment(), newId()];
  if (goal !== null) requests.holdGoal(goal);
  return {
    move(toX, toY, snap) {
      const { position, turn, mode } = views.gizmo.move(camera(), rect, toX, toY);
      if (goal !== null && mode === "translate") requests.moveGoal(goal, tidy(snapped(model.settings, position as Vec3, start.position, snap)));
      else if (goal !== null) requests.turnGoal(goal, turn as Quat);
      else if (chosen) turnSegment(model, requests, chosen, turn as Quat, gesture);
    },
    end() {
      views.gizmo.up();
      if (goal !== null) requests.releaseGoal(goal);
      model.touch("local");
    },
  };
}
