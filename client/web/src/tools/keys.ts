// The keyboard: 1-4 maximise a view, F frames the figures, G makes a goal, Delete removes one.
import type { Model } from "../state/model";
import { titles, viewNames } from "../views/names";
import type { Views } from "../views/views";
import type { Requests } from "./requests";

export function listenToKeys(views: Views, model: Model, requests: Requests): void {
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isField(event.target)) return;
    const view = viewNames.find((name) => titles[name].key === event.key);
    if (view) views.panes.toggle(view);
    else if (event.key === "f") views.fit(model);
    else if (event.key === "g") toggleMaking(model, !model.makingGoal);
    else if (event.key === "Escape") escape(views, model);
    else if ((event.key === "Delete" || event.key === "Backspace") && model.selectedGoal) requests.removeGoal(model.selectedGoal);
  });
}

export function toggleMaking(model: Model, on: boolean): void {
  model.makingGoal = on;
  model.touch("local");
}

function escape(views: Views, model: Model): void {
  if (model.makingGoal) toggleMaking(model, false);
  else if (views.panes.maximised) views.panes.toggle(null);
  else model.select(null);
}

function isField(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest("input:not([type=checkbox], [type=range]), select, textarea") !== null;
}
