// Poses that are kept in this browser: saved, shown as ghosts, taken again. And the figure's own: T-pose, start, mirror.
import type { GoalDocument, Transform, Vec3 } from "../protocol/types";
import { movedTo, placeOf } from "../state/goals";
import type { Model } from "../state/model";
import { apply, tidy } from "../state/place";
import type { Store } from "../state/settings";
import type { Edit, Requests } from "./requests";

export interface SavedPose {
  name: string;
  figure: string;
  q: number[];
  world_from_segment: Transform[];
}

const kKey = "posed.poses";

export class Poses {
  list: SavedPose[];

  constructor(
    private readonly model: Model,
    private readonly requests: Requests,
    private readonly store: Store | null,
  ) {
    this.list = load(store);
  }

  async save(figure: string, name: string): Promise<void> {
    const pose = await this.requests.readPose(figure);
    if (!pose) return;
    const saved: SavedPose = { name, figure, q: tidy(pose.q), world_from_segment: pose.world_from_segment.map((row) => tidy(row) as Transform) };
    this.keep([...this.list.filter((other) => other.name !== name), saved]);
  }

  remove(name: string): void {
    this.show(name, false);
    this.keep(this.list.filter((other) => other.name !== name));
  }

  shown(name: string): boolean {
    return this.model.ghosts.some((ghost) => ghost.name === name);
  }

  show(name: string, on: boolean): void {
    const pose = this.list.find((other) => other.name === name);
    const rest = this.model.ghosts.filter((ghost) => ghost.name !== name);
    this.model.ghosts = on && pose ? [...rest, pose] : rest;
    this.model.touch("ghosts");
  }

  /** The body takes the pose, and what held the present one comes along: goals move to where their points then are. */
  take(name: string): void {
    const pose = this.list.find((other) => other.name === name);
    if (pose) void this.requests.apply(`pose ${name}`, takeEdits(this.model, pose));
  }

  /** The figure's own poses. Goals that would pull it back at once are switched off in the same step. */
  reset(figure: string, to: "rest" | "start"): void {
    this.own(figure, to === "rest" ? "T-pose" : "start pose", { method: "pose.reset", params: { figure, to } });
  }

  mirror(figure: string): void {
    this.own(figure, "mirror", { method: "pose.mirror", params: { figure } });
  }

  private own(figure: string, label: string, edit: Edit): void {
    const pulling = goalsOf(this.model, figure).filter(([, { enabled, kind }]) => enabled !== false && kind !== "balance");
    const off = pulling.map(([id]) => ({ method: "goal.set", params: { id, enabled: false } }));
    void this.requests.apply(label, [...off, ...repinned(this.model, figure, [edit])]).then((reply) => {
      if (reply && off.length > 0) this.model.say(`${off.length} ${off.length === 1 ? "goal is" : "goals are"} off, so that the pose stays`, "Ctrl+Z brings all back", true);
    });
  }

  private keep(list: SavedPose[]): void {
    this.list = list;
    try {
      this.store?.setItem(kKey, JSON.stringify(list));
    } catch {
      this.model.say("This browser keeps no more poses", "remove some");
    }
    this.model.touch("ghosts");
  }
}

function load(store: Store | null): SavedPose[] {
  try {
    const kept = JSON.parse(store?.getItem(kKey) ?? "[]") as SavedPose[];
    return Array.isArray(kept) ? kept.filter((pose) => Array.isArray(pose.q) && Array.isArray(pose.world_from_segment)) : [];
  } catch {
    return [];
  }
}

function goalsOf(model: Model, figure: string): Array<[string, GoalDocument]> {
  return Object.entries(model.scene.document.goals).filter(([, goal]) => model.goalFigure(goal) === figure);
}

/** Pins hold places: they are let go before a pose is set and hold again where it has put them. */
export function repinned(model: Model, figure: string, edits: Edit[]): Edit[] {
  const pins = Object.entries(model.scene.document.figures[figure]?.pins ?? {});
  const pin = (segment: string, hold: string | null): Edit => ({ method: "figure.pin", params: { figure, segment, hold } });
  return [...pins.map(([segment]) => pin(segment, null)), ...edits, ...pins.map(([segment, { hold }]) => pin(segment, hold))];
}

export function takeEdits(model: Model, pose: SavedPose): Edit[] {
  const { figure, q, world_from_segment } = pose;
  const segments = model.figures.get(figure)?.segments ?? [];
  const goals = goalsOf(model, figure).flatMap(([id, goal]): Edit[] => {
    const place = placeOf(model, figure, goal.at);
    const index = segments.findIndex(({ name }) => name === place?.segment);
    const [transform, frame] = [world_from_segment[index], model.goalFrame(goal)];
    if (!place || !transform || !frame || !goal.position || goal.enabled === false) return [];
    return [{ method: "goal.set", params: { id, ...movedTo(goal, frame, apply(transform, place.point) as Vec3) } }];
  });
  return [...repinned(model, figure, [{ method: "pose.set", params: { figure, q } }]), ...goals];
}
