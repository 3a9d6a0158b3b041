// The keyboard: one table, which is also what the sheet behind `?` shows.
import type { Model } from "../state/model";
import { worldOf } from "../state/goals";
import { titles, viewNames } from "../views/names";
import type { Views } from "../views/views";
import { toggleLock } from "./joints";
import { makeGoal } from "./make_goal";
import { Nudge } from "./nudge";
import type { Requests } from "./requests";

export interface Hands {
  views: Views;
  model: Model;
  requests: Requests;
  /** What the page itself shows and keeps. */
  page: { help(): void; gallery(): void; picture(): void; savePose(): void };
}

interface Key {
  keys: string;
  says: string;
  group: "Look" | "Goals" | "Body" | "Everything";
  run?: (hands: Hands, event: KeyboardEvent) => void;
}

export const keys: readonly Key[] = [
  ...viewNames.map((name): Key => ({ keys: titles[name].key, says: `${titles[name].name} view alone, and back`, group: "Look", run: ({ views }) => views.panes.toggle(name) })),
  { keys: "f", says: "Frame the figures", group: "Look", run: ({ views, model }) => views.fit(model) },
  { keys: "x", says: "Segment frames", group: "Look", run: ({ model }) => model.change({ frames: !model.settings.frames }) },
  { keys: "v", says: "See with the figure's eyes, and back", group: "Look", run: ({ model }) => toggleEyes(model) },
  { keys: "g", says: "Make a goal: then click on a body", group: "Goals", run: ({ model }) => toggleMaking(model, !model.makingGoal) },
  { keys: "Enter", says: "Make a goal at the chosen segment", group: "Goals", run: ({ model, requests }) => makeAtChosen(model, requests) },
  { keys: ",", says: "Previous goal", group: "Goals", run: ({ model }) => stepGoal(model, -1) },
  { keys: ".", says: "Next goal", group: "Goals", run: ({ model }) => stepGoal(model, 1) },
  { keys: "Arrows", says: "Move the goal 1 cm in the view (Shift: 1 mm; PageUp, PageDown: depth)", group: "Goals" },
  { keys: "+", says: "Pull harder", group: "Goals" },
  { keys: "-", says: "Pull less", group: "Goals" },
  { keys: "o", says: "Goal on or off", group: "Goals", run: ({ model, requests }) => toggleGoal(model, requests) },
  { keys: "w", says: "Gizmo moves", group: "Goals", run: ({ model }) => model.change({ gizmo: "move" }) },
  { keys: "e", says: "Gizmo turns", group: "Goals", run: ({ model }) => model.change({ gizmo: "turn" }) },
  { keys: "s", says: "Snap to 5 cm (or hold Ctrl in a drag)", group: "Goals", run: ({ model }) => model.change({ snap: model.settings.snap > 0 ? 0 : 0.05 }) },
  { keys: "Delete", says: "Remove the goal", group: "Goals", run: ({ model, requests }) => model.mayEdit && model.selectedGoal && requests.removeGoal(model.selectedGoal) },
  { keys: "[", says: "Previous segment", group: "Body", run: ({ model }) => stepSegment(model, -1) },
  { keys: "]", says: "Next segment", group: "Body", run: ({ model }) => stepSegment(model, 1) },
  { keys: "l", says: "Pin the segment, and let go", group: "Body", run: ({ model, requests }) => togglePin(model, requests) },
  { keys: "j", says: "Hold the segment's joint, and let go", group: "Body", run: ({ model, requests }) => void lockChosen(model, requests) },
  { keys: "p", says: "Keep this pose", group: "Body", run: ({ page }) => page.savePose() },
  { keys: "Ctrl+Z", says: "Undo what you did last", group: "Everything" },
  { keys: "Ctrl+Shift+Z", says: "Do it again", group: "Everything" },
  { keys: "n", says: "Scenes", group: "Everything", run: ({ page }) => page.gallery() },
  { keys: "c", says: "Take a picture", group: "Everything", run: ({ page }) => page.picture() },
  { keys: "Escape", says: "Leave the tool, the view, the choice", group: "Everything", run: ({ model, views }) => escape(views, model) },
  { keys: "?", says: "This sheet", group: "Everything", run: ({ page }) => page.help() },
];

export function listenToKeys(hands: Hands): void {
  const nudge = new Nudge(hands.views, hands.model, hands.requests);
  window.addEventListener("keydown", (event) => {
    if (isField(event.target) || document.querySelector("dialog[open]")) return;
    if (event.ctrlKey || event.metaKey) {
      undoKeys(hands, event);
      return;
    }
    if (event.altKey) return;
    if (hands.model.mayEdit && nudge.key(event.key, event.shiftKey, performance.now())) {
      event.preventDefault();
      return;
    }
    // A button that has the focus is pressed by Enter, not the figure's.
    if (event.key === "Enter" && event.target instanceof Element && event.target.closest("button, summary, a, [role=tab], [role=option]")) return;
    const pressed = event.key === "Backspace" ? "Delete" : event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const key = keys.find(({ keys: name, run }) => run && name === pressed);
    if (!key?.run) return;
    event.preventDefault();
    key.run(hands, event);
  });
}

function undoKeys({ model, requests }: Hands, event: KeyboardEvent): void {
  const key = event.key.toLowerCase();
  if ((key !== "z" && key !== "y") || !model.mayEdit) return;
  event.preventDefault();
  void (key === "y" || event.shiftKey ? requests.redo() : requests.undo());
}

export function toggleMaking(model: Model, on: boolean): void {
  model.makingGoal = on && model.mayEdit;
  if (!model.makingGoal) model.hoveredPlace = null;
  model.touch("local");
}

function escape(views: Views, model: Model): void {
  if (model.makingGoal) toggleMaking(model, false);
  else if (views.panes.maximised) views.panes.toggle(null);
  else if (model.rides) toggleEyes(model);
  else {
    model.select(null);
    model.choose(null);
  }
}

function toggleEyes(model: Model): void {
  const figure = model.selectedSegment?.figure ?? [...model.figures.keys()][0];
  model.rides = model.rides || figure === undefined ? null : { eyes: figure };
  model.touch("local");
}

function makeAtChosen(model: Model, requests: Requests): void {
  const key = model.selectedSegment;
  const world = key && worldOf(model, key.figure, key.segment);
  if (key && world && model.mayEdit) makeGoal(requests, { figure: key.figure, at: key.segment, world });
}

function stepGoal(model: Model, by: number): void {
  const ids = Object.keys(model.scene.document.goals).sort();
  if (ids.length === 0) return;
  const now = model.selectedGoal === null ? (by > 0 ? -1 : 0) : ids.indexOf(model.selectedGoal);
  model.select(ids[(now + by + ids.length) % ids.length] as string);
}

function stepSegment(model: Model, by: number): void {
  const all = [...model.figures].flatMap(([figure, { segments }]) => segments.map(({ name }) => ({ figure, segment: name })));
  if (all.length === 0) return;
  const is = model.selectedSegment;
  const now = is ? all.findIndex(({ figure, segment }) => figure === is.figure && segment === is.segment) : by > 0 ? -1 : 0;
  model.choose(all[(now + by + all.length) % all.length] ?? null);
}

function toggleGoal(model: Model, requests: Requests): void {
  const id = model.selectedGoal;
  if (id !== null && model.mayEdit) requests.setGoal(id, { enabled: model.scene.document.goals[id]?.enabled === false });
}

function togglePin(model: Model, requests: Requests): void {
  const key = model.selectedSegment;
  if (!key || !model.mayEdit) return;
  const pinned = key.segment in (model.scene.document.figures[key.figure]?.pins ?? {});
  requests.pin(key.figure, key.segment, pinned ? null : "pose");
}

async function lockChosen(model: Model, requests: Requests): Promise<void> {
  const chosen = model.chosenSegment();
  const joint = chosen?.document.joint;
  if (!chosen || !joint || !model.mayEdit) return;
  await toggleLock(model, requests, chosen.figure, joint.name);
}

function isField(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest("input:not([type=checkbox], [type=range]), select, textarea") !== null;
}
