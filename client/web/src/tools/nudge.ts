// The arrow keys move the chosen goal in the plane of the view that the pointer was in last, PageUp and PageDown along
// its depth; plus and minus change its weight.
import { Vector3 } from "three";
import type { Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import { tidy } from "../state/place";
import type { Views } from "../views/views";
import { newId } from "./new_id";
import type { Requests } from "./requests";

const kStep = 0.01;
const kFineStep = 0.001;
const kWeightStep = 1.25;
/** Strokes that follow each other this fast are one step to undo. */
const kGestureMs = 1200;

const kDirections: Record<string, Vec3> = {
  ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0], PageUp: [0, 0, 1], PageDown: [0, 0, -1],
};

export class Nudge {
  private gesture = "";
  private lastMs = -Infinity;

  constructor(
    private readonly views: Views,
    private readonly model: Model,
    private readonly requests: Requests,
  ) {}

  /** True where the key was one of these. */
  key(key: string, fine: boolean, nowMs: number): boolean {
    const { model } = this;
    const id = model.selectedGoal;
    const direction = kDirections[key];
    const weigh = key === "+" || key === "=" ? kWeightStep : key === "-" ? 1 / kWeightStep : 0;
    if (id === null || (!direction && weigh === 0)) return false;
    if (nowMs - this.lastMs > kGestureMs) this.gesture = newId();
    this.lastMs = nowMs;
    if (weigh > 0) this.weigh(id, weigh);
    else if (direction && model.movable(id)) this.move(id, direction, fine ? kFineStep : kStep);
    return true;
  }

  private move(id: string, direction: Vec3, step: number): void {
    const target = this.model.goalTarget(id);
    if (!target) return;
    const view = this.views.panes.maximised ?? this.model.activeView;
    const camera = this.views.cameras.camera(view, this.views.panes.rect(view));
    const by = new Vector3(...direction).transformDirection(camera.matrixWorld).multiplyScalar(step);
    this.requests.moveGoal(id, tidy(by.add(new Vector3(...target)).toArray() as Vec3), this.gesture);
  }

  private weigh(id: string, by: number): void {
    const { weight = 10 } = this.model.scene.document.goals[id] ?? {};
    const times = (value: number) => Number((value * by).toPrecision(3));
    this.requests.setGoal(id, { weight: typeof weight === "number" ? times(weight) : { position: times(weight.position), orientation: times(weight.orientation) } }, this.gesture);
  }
}
