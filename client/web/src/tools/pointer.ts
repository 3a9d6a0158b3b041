// The mouse in the panes: decides which tool a press belongs to and hands the drag on to it.
import type { Drag } from "./drag";
import type { Model } from "../state/model";
import { isOrtho, viewNames, type ViewName } from "../views/names";
import type { Views } from "../views/views";
import { dragGoal } from "./drag_goal";
import { makeGoal } from "./make_goal";
import { pickGoal, pickSegment } from "./pick";
import type { Requests } from "./requests";

export function listenToPointer(views: Views, model: Model, requests: Requests): void {
  for (const name of viewNames) new PanePointer(views, model, requests, name);
}

class PanePointer {
  private drag: Drag | null = null;
  private readonly pane: HTMLElement;

  constructor(
    private readonly views: Views,
    private readonly model: Model,
    private readonly requests: Requests,
    private readonly name: ViewName,
  ) {
    this.pane = views.panes.elements[name];
    this.pane.addEventListener("pointerdown", (event) => this.down(event));
    this.pane.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"] as const) this.pane.addEventListener(end, () => this.up());
    this.pane.addEventListener("pointerleave", () => this.hover(null));
    this.pane.addEventListener("contextmenu", (event) => event.preventDefault());
    this.pane.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  private down(event: PointerEvent): void {
    if (this.drag || (event.target as Element).closest("header")) return;
    event.preventDefault();
    this.drag = this.choose(event);
    if (this.drag) this.pane.setPointerCapture(event.pointerId);
  }

  private choose(event: PointerEvent): Drag | null {
    const { views, model, requests, name } = this;
    const { clientX: x, clientY: y } = event;
    if (event.button !== 0) return this.panFrom(x, y);
    if (event.shiftKey || model.makingGoal) {
      const made = makeGoal(views, model, requests, name, x, y);
      if (made) model.makingGoal = false;
      else model.say("No segment is under the pointer", "click on a part of a figure to give it a goal");
      model.touch("local");
      return null;
    }
    const goal = dragGoal(views, model, requests, name, x, y);
    if (goal) return goal;
    return isOrtho(name) ? this.panFrom(x, y) : this.orbitFrom(x, y);
  }

  private panFrom(x: number, y: number): Drag {
    return follow(x, y, (dx, dy) => this.views.cameras.pan(this.name, this.views.panes.rect(this.name), dx, dy));
  }

  private orbitFrom(x: number, y: number): Drag {
    return follow(x, y, (dx, dy) => this.views.cameras.orbit(dx, dy));
  }

  private move(event: PointerEvent): void {
    if (this.drag) this.drag.move(event.clientX, event.clientY);
    else this.hover(event);
  }

  private up(): void {
    this.drag?.end();
    this.drag = null;
  }

  private hover(event: PointerEvent | null): void {
    const { views, model, name } = this;
    const goal = event && pickGoal(views, model, name, event.clientX, event.clientY);
    const making = event !== null && (event.shiftKey || model.makingGoal);
    const onSegment = making && event !== null && pickSegment(views, name, event.clientX, event.clientY) !== null;
    this.pane.style.cursor = onSegment ? "copy" : making ? "crosshair" : goal !== null ? "grab" : "";
    if (goal === model.hoveredGoal) return;
    model.hoveredGoal = goal;
    model.touch("local");
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    // Lines and pages are what some mice report instead of pixels.
    const pixels = event.deltaY * [1, 16, 400][event.deltaMode]!;
    const factor = Math.exp(Math.max(-300, Math.min(300, pixels)) * 0.0014);
    this.views.cameras.zoom(this.name, this.views.panes.rect(this.name), factor, event.clientX, event.clientY);
  }
}

function follow(x: number, y: number, by: (dx: number, dy: number) => void): Drag {
  return {
    move(toX, toY) {
      by(toX - x, toY - y);
      [x, y] = [toX, toY];
    },
    end() {},
  };
}
