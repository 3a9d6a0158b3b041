// What a sensor can lead, and the binding that makes it so.
import type { BindingDocument } from "../protocol/types";
import type { Model } from "../state/model";
import { goalName, plain } from "../state/words";
import type { Requests } from "./requests";

export type Target = { goal: string } | { object: string } | { joint: string; figure: string } | { camera: string };

/** Whether sensors lead cameras and joints here too, with a clutch: a daemon says so in its hello. */
export function leadsMore(model: Model): boolean {
  return model.hello?.features?.includes("cameras") ?? false;
}

export function targetKey(target: Target): string {
  return JSON.stringify(target);
}

export function targetText(target: Target | null): string {
  if (!target) return "nothing";
  if ("goal" in target) return `goal ${goalName(target.goal)}`;
  if ("object" in target) return `object ${plain(target.object)}`;
  if ("camera" in target) return `camera ${target.camera}`;
  return `joint ${plain(target.joint)}`;
}

export function targetOf({ to }: BindingDocument): Target | null {
  if (to.goal !== undefined) return { goal: to.goal };
  if (to.object !== undefined) return { object: to.object };
  if (to.camera !== undefined) return { camera: to.camera };
  return to.joint === undefined ? null : { joint: to.joint, figure: to.figure ?? "body" };
}

/** All that a sensor could lead now. */
export function targetsOf(model: Model): Target[] {
  const { goals, objects } = model.scene.document;
  return [
    ...Object.entries(goals).filter(([, { position, orientation, relative_to = "world" }]) => (position || orientation) && relative_to === "world").map(([goal]) => ({ goal })).sort((a, b) => (a.goal < b.goal ? -1 : 1)),
    ...Object.keys(objects).map((object) => ({ object })),
    ...(leadsMore(model) ? [{ camera: "main" }] : []),
    ...(leadsMore(model) && model.selectedSegment ? jointOf(model, model.selectedSegment.figure, model.selectedSegment.segment) : []),
  ];
}

export function jointOf(model: Model, figure: string, segment: string): Target[] {
  const joint = model.figures.get(figure)?.segments.find(({ name }) => name === segment)?.joint;
  return joint && ["ball", "universal", "hinge"].includes(joint.type) ? [{ joint: joint.name, figure }] : [];
}

export function bindingsOf(model: Model, sensor: string): Array<[string, BindingDocument]> {
  return Object.entries(model.scene.document.bindings).filter(([, binding]) => binding.sensor === sensor).sort(([a], [b]) => (a < b ? -1 : 1));
}

const kMoves = ["x", "y", "z"];
const kTurns = ["rx", "ry", "rz"];

/** All that what it leads has. */
export function axesThere(model: Model, { to }: BindingDocument): string[] {
  if (to.joint !== undefined) return kTurns;
  const goal = to.goal === undefined ? undefined : model.scene.document.goals[to.goal];
  if (goal) return [...(goal.position ? kMoves : []), ...(goal.orientation ? kTurns : [])];
  return [...kMoves, ...kTurns];
}

export function axesOf(model: Model, binding: BindingDocument): string[] {
  return binding.axes ?? axesThere(model, binding);
}

/** What is bound already changes its sensor; else a new binding is made. */
export function bindTo(model: Model, requests: Requests, sensor: string, target: Target): void {
  const same = Object.entries(model.scene.document.bindings).find(([, binding]) => targetKey(targetOf(binding) ?? { goal: "" }) === targetKey(target));
  const id = same?.[0] ?? freeId(model, sensor), binding = { sensor, to: target, mode: "absolute" as const };
  if (!("camera" in target)) return requests.bind(id, binding);
  model.rides = { camera: target.camera };
  if (target.camera in model.scene.document.cameras) return requests.bind(id, binding);
  // Until the sensor speaks it looks at a standing person from the front.
  const made = { id: target.camera, position: [3, 0, 1.2], quat_xyzw: [0, 0, 1, 0] };
  void requests.apply("a camera", [{ method: "camera.set", params: made }, { method: "binding.set", params: { id, ...binding } }]);
}

/** A sensor's name has a colon, an id must not. */
function freeId(model: Model, sensor: string): string {
  const base = sensor.replace(/[^A-Za-z0-9_.-]/g, ".").slice(0, 58);
  let id = base;
  for (let n = 2; id in model.scene.document.bindings; n++) id = `${base}.${n}`;
  return id;
}
