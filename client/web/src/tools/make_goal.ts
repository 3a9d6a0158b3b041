// Makes a goal where the pointer is on a figure: at a site or touch point that is near, else at the point itself. It
// begins where the point is now: nothing jumps.
import { Vector3 } from "three";
import type { At, GoalDocument, GoalKind, Vec3 } from "../protocol/types";
import { worldOf } from "../state/goals";
import type { Model } from "../state/model";
import { apply, into, quatOf, tidy } from "../state/place";
import { goalName } from "../state/words";
import type { ViewName } from "../views/names";
import type { Views } from "../views/views";
import { poleOf } from "./joints";
import type { Requests } from "./requests";

const kSnapPixels = 15;
const kMargin = 0.02;
const kPostureWeight = 0.5;
/** Higher than this above the ground nothing stands on it; within this two stand on the same floor. */
const kOffFloor = 0.3;
const kSameFloor = 0.1;

export interface Place {
  figure: string;
  segment: string;
  at: At;
  world: Vec3;
  text: string;
}

/** What a click here would give a goal to. */
export function placeAt(views: Views, model: Model, name: ViewName, x: number, y: number): Place | null {
  const hit = views.segmentAt(name, x, y);
  if (!hit) return null;
  const { figure, segment } = hit.key;
  const document = model.figures.get(figure);
  const named: string[] = [segment, ...Object.entries(document?.sites ?? {}).filter(([, site]) => site.segment === segment).map(([site]) => site)];
  let best: Place | null = null;
  let nearest = kSnapPixels;
  for (const at of named) {
    const world = worldOf(model, figure, at);
    if (!world) continue;
    const seen = views.project(name, new Vector3(...world));
    const away = Math.hypot(seen.x - x, seen.y - y);
    if (away >= nearest) continue;
    nearest = away;
    best = { figure, segment, at, world, text: goalName(at).replace("/", " · ") };
  }
  if (best) return best;
  const transform = model.segmentTransform(figure, segment);
  if (!transform) return null;
  const point = tidy(into(transform, hit.point.toArray() as Vec3));
  return { figure, segment, at: { segment, point }, world: apply(transform, point), text: `${goalName(segment)}, this point` };
}

export function makeGoal(requests: Requests, { figure, at, world }: Pick<Place, "figure" | "at" | "world">): void {
  const free = typeof at === "string" ? {} : { id: pointId(figure, at) };
  void requests.makeGoal(figure, at, { ...free, position: tidy(world) } as Partial<GoalDocument>);
}

/** Points without a name would all be FIGURE.SEGMENT.KIND, and the second click would move the first goal. */
function pointId(figure: string, at: { segment: string; point: Vec3 }): string {
  const digits = at.point.map((value) => Math.round(Math.abs(value) * 1000).toString(36)).join("");
  return `${figure}.${at.segment}.at-${digits}`.slice(0, 64);
}

/** A goal of any kind at a segment's touch point, met as the figure stands. */
export function makeGoalOfKind(model: Model, requests: Requests, figure: string, segment: string, kind: GoalKind | "pole"): void {
  const transform = model.segmentTransform(figure, segment);
  const world = worldOf(model, figure, segment);
  if (!transform || !world) return;
  const position = tidy(world);
  const orientation = { quat_xyzw: tidy(quatOf(transform)) };
  const other = model.figures.get(figure)?.mirror?.flatMap(([a, b]) => (a === segment ? [b] : b === segment ? [a] : []))[0];
  const payloads: Partial<Record<GoalKind | "pole", Partial<GoalDocument>>> = {
    position: { position },
    orientation: { orientation },
    pose: { position, orientation },
    aim: { aim: { axis: [1, 0, 0], point: tidy(apply(transform, [0.6, 0, 0])) } },
    plane: { plane: { point: position, normal: [0, 0, 1] } },
    line: { line: { point: position, direction: [0, 0, 1] } },
  };
  if (other) {
    const there = worldOf(model, figure, other);
    if (there) payloads.distance = { distance: { to: other, length: Math.round(Math.hypot(...world.map((value, i) => value - there[i]!)) * 1000) / 1000 } };
  }
  if (kind === "pole") {
    const pole = poleOf(model, figure, segment);
    if (pole) void requests.makeGoal(figure, pole.at, { aim: pole.aim, label: `${goalName(pole.at)} pole` });
    return;
  }
  const payload = payloads[kind];
  if (payload) void requests.makeGoal(figure, segment, payload);
}

/** Balance over what stands on the floor now; a posture as it is now, or towards rest: weak, for others to pull against. */
export async function makeGoalOfFigure(model: Model, requests: Requests, figure: string, kind: "balance" | "posture" | "rest"): Promise<void> {
  if (kind === "balance") {
    const support = standingOn(model, figure);
    if (support.length > 0) return requests.makeGoal(figure, null, { balance: { support, margin: kMargin } });
    return model.say("Nothing of the figure is near the floor", "stand it on something first");
  }
  if (kind === "rest") return requests.makeGoal(figure, null, { posture: { pose: "rest" }, weight: kPostureWeight });
  const [pose, reply] = await Promise.all([requests.readPose(figure), requests.readFigure(figure)]);
  if (!pose || !reply?.q_layout) return;
  const bends = reply.q_layout.filter(({ type, size }) => type !== "free" && size > 0);
  const joints = Object.fromEntries(bends.map(({ joint, at, size }) => [joint, size === 1 ? pose.q[at]! : pose.q.slice(at, at + size)]));
  return requests.makeGoal(figure, null, { posture: { joints }, weight: kPostureWeight });
}

/** The ends of limbs that are about as low as the lowest one. */
function standingOn(model: Model, figure: string): string[] {
  const segments = model.figures.get(figure)?.segments ?? [];
  const parents = new Set(segments.map(({ parent }) => parent));
  const ends = segments.flatMap(({ name }) => {
    const world = parents.has(name) ? null : worldOf(model, figure, name);
    return world ? [{ name, z: world[2] }] : [];
  });
  const lowest = Math.min(...ends.map(({ z }) => z));
  return lowest > kOffFloor ? [] : ends.filter(({ z }) => z < lowest + kSameFloor).map(({ name }) => name);
}

export function touchPoint(model: Model, figure: string, segment: string): Vec3 | null {
  return worldOf(model, figure, segment);
}
