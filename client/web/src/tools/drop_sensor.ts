// A sensor dropped on something in a view leads it: a goal's cube, an object, the joint of a part of the body, or, in the
// perspective view where nothing is, the camera.
import type { Model } from "../state/model";
import { viewNames, type ViewName } from "../views/names";
import type { Views } from "../views/views";
import { bindTo, jointOf, leadsMore, type Target } from "./bindings";
import { pickGoal } from "./pick";
import type { Requests } from "./requests";

const kType = "text/x-posed-sensor";

export function listenToDrops(views: Views, model: Model, requests: Requests): void {
  for (const name of viewNames) {
    const pane = views.panes.elements[name];
    pane.addEventListener("dragover", (event) => {
      if (event.dataTransfer?.types.includes(kType) && model.mayEdit) event.preventDefault();
    });
    pane.addEventListener("drop", (event) => {
      const sensor = event.dataTransfer?.getData(kType);
      if (!sensor) return;
      event.preventDefault();
      const target = targetAt(views, model, name, event.clientX, event.clientY);
      if (!target) model.say("Nothing here can follow a sensor", "drop it on a goal's cube, an object or a part of the body");
      else bindTo(model, requests, sensor, target);
    });
  }
}

function targetAt(views: Views, model: Model, name: ViewName, x: number, y: number): Target | null {
  const goal = pickGoal(views, model, name, x, y);
  if (goal) return { goal };
  const [segment, object] = [views.segmentAt(name, x, y), views.objectAt(name, x, y)];
  if (object && (!segment || object.distance < segment.distance)) return { object: object.key };
  if (segment && leadsMore(model)) return jointOf(model, segment.key.figure, segment.key.segment)[0] ?? null;
  return !segment && name === "perspective" && leadsMore(model) ? { camera: "main" } : null;
}
