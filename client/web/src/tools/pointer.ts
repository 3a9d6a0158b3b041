// The mouse in the panes: decides which tool a press belongs to. What belongs to none goes on to the view's own controls.
import type { Model } from "../state/model";
import { viewNames, type ViewName } from "../views/names";
import type { Views } from "../views/views";
import type { Drag } from "./drag";
import { dragGizmo, gizmoPlace } from "./drag_gizmo";
import { dragGoal } from "./drag_goal";
import { makeGoal, placeAt } from "./make_goal";
import { pickGoal } from "./pick";
import type { Requests } from "./requests";

const kClickPixels = 4;

export function listenToPointer(views: Views, model: Model, requests: Requests): void {
  for (const name of viewNames) new PanePointer(views, model, requests, name);
}

class PanePointer {
  private drag: Drag | null = null;
  /** Where a press began that may become a click on a body. */
  private pressed: { x: number; y: number } | null = null;
  private readonly pane: HTMLElement;

  constructor(
    private readonly views: Views,
    private readonly model: Model,
    private readonly requests: Requests,
    private readonly name: ViewName,
  ) {
    this.pane = views.panes.elements[name];
    // Before the view's controls, which listen to the same pane.
    this.pane.addEventListener("pointerdown", (event) => this.down(event), { capture: true });
    this.pane.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"] as const) this.pane.addEventListener(end, (event) => this.up(event));
    this.pane.addEventListener("pointerleave", () => !this.drag && this.hover(null));
    this.pane.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  private down(event: PointerEvent): void {
    if ((event.target as Element).closest("header, button")) {
      event.stopPropagation();
      return;
    }
    if (this.drag) return;
    this.pressed = event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
    this.drag = event.button === 0 ? this.choose(event) : null;
    if (!this.drag) return;
    this.pressed = null;
    event.preventDefault();
    event.stopImmediatePropagation();
    this.pane.setPointerCapture(event.pointerId);
  }

  private choose(event: PointerEvent): Drag | null {
    const { views, model, requests, name } = this;
    const { clientX: x, clientY: y } = event;
    if (!model.mayEdit) {
      const goal = pickGoal(views, model, name, x, y);
      if (goal) model.select(goal);
      return null;
    }
    if (event.shiftKey || model.makingGoal) {
      const place = placeAt(views, model, name, x, y);
      if (place) {
        makeGoal(requests, place);
        model.makingGoal = false;
      } else model.say("No segment is under the pointer", "click on a part of a figure to give it a goal");
      model.touch("local");
      return { move() {}, end() {} };
    }
    return dragGizmo(views, model, requests, name, x, y) ?? dragGoal(views, model, requests, name, x, y);
  }

  private move(event: PointerEvent): void {
    if (this.drag) this.drag.move(event.clientX, event.clientY, event.ctrlKey || event.metaKey);
    else if (event.buttons === 0) this.hover(event);
  }

  private up(event: PointerEvent): void {
    this.drag?.end();
    this.drag = null;
    const { pressed } = this;
    this.pressed = null;
    if (!pressed || event.type !== "pointerup" || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > kClickPixels) return;
    const hit = this.views.segmentAt(this.name, event.clientX, event.clientY);
    if (hit) this.model.choose(hit.key);
    else this.model.select(null), this.model.choose(null);
  }

  private hover(event: PointerEvent | null): void {
    const { views, model, name } = this;
    const before = JSON.stringify([model.hoveredGoal, model.hoveredSegment, model.hoveredPlace]);
    const making = event !== null && (event.shiftKey || model.makingGoal) && model.mayEdit;
    const goal = event && !making ? pickGoal(views, model, name, event.clientX, event.clientY) : null;
    const place = event && goal === null ? placeAt(views, model, name, event.clientX, event.clientY) : null;
    const rect = views.panes.rect(name);
    const handle = event && !making && gizmoPlace(model) ? views.gizmo.hover(views.cameras.camera(name, rect), rect, event.clientX, event.clientY) : null;
    model.hoveredGoal = goal;
    model.hoveredSegment = place && { figure: place.figure, segment: place.segment };
    model.hoveredPlace = place && making ? { point: place.world, text: place.text } : null;
    this.pane.style.cursor = making ? (place ? "copy" : "crosshair") : handle !== null ? "move" : goal !== null ? "grab" : place ? "pointer" : "";
    if (event) model.activeView = name;
    if (before !== JSON.stringify([model.hoveredGoal, model.hoveredSegment, model.hoveredPlace]) || handle !== this.handle) model.touch("local");
    this.handle = handle;
  }
  private handle: string | null = null;
}
