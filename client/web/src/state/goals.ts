// Goals as the viewer handles them: their frames, where they are in the world, and the edits that move them.
import type { At, Frame, GoalDocument, Quat, Transform, Vec3 } from "../protocol/types";
import { apply, conjugate, identity, into, multiply, quatOf, tidy, unit } from "./place";
import type { Model } from "./model";

export interface GoalFields {
  position?: Vec3;
  orientation?: { quat_xyzw: Quat };
  aim?: GoalDocument["aim"];
  plane?: GoalDocument["plane"];
  line?: GoalDocument["line"];
  weight?: number | { position: number; orientation: number };
  priority?: number;
  tolerance?: number;
  enabled?: boolean;
}

/** Where a frame stands in the world now; null while nobody has told yet. */
export function frameTransform(model: Model, frame: Frame | undefined, figure: string | undefined): Transform | null {
  if (frame === undefined || frame === "world") return identity;
  if ("sensor" in frame) {
    const sample = model.samples.get(frame.sensor);
    return sample ? [...sample.position, ...sample.quat_xyzw] : null;
  }
  if ("object" in frame) return model.objectTransform(frame.object);
  return model.segmentTransform(frame.figure ?? figure ?? "", frame.segment);
}

/** The payload's own point: what a hand can move. */
export function payloadPoint(goal: GoalDocument): Vec3 | undefined {
  return goal.position ?? goal.aim?.point ?? goal.plane?.point ?? goal.line?.point;
}

/** The edit that brings a goal's point to a place in the world. Payloads are replaced whole, so their rest comes along. */
export function movedTo(goal: GoalDocument, frame: Transform, world: Vec3): GoalFields {
  const point = tidy(into(frame, world));
  if (goal.position) return { position: point };
  if (goal.aim) return { aim: { axis: goal.aim.axis, point } };
  if (goal.plane) return { plane: { ...goal.plane, point } };
  if (goal.line) return { line: { ...goal.line, point } };
  return {};
}

/** The edit that turns an orientation or a pose goal as this, in the world. */
export function turnedTo(frame: Transform, world: Quat): GoalFields {
  return { orientation: { quat_xyzw: tidy(unit(multiply(conjugate(quatOf(frame)), world))) } };
}

/** The segment and the point of it that a goal is at; null where the figure has no such place. */
export function placeOf(model: Model, figure: string, at: At | undefined): { segment: string; point: Vec3 } | null {
  if (at === undefined) return null;
  if (typeof at !== "string") return at;
  const document = model.figures.get(figure);
  const site = document?.sites?.[at];
  if (site) return site;
  const segment = document?.segments.find(({ name }) => name === at);
  return segment ? { segment: segment.name, point: segment.touch_point } : null;
}

/** Where a place of a figure is in the world now. */
export function worldOf(model: Model, figure: string, at: At): Vec3 | null {
  const place = placeOf(model, figure, at);
  const transform = place && model.segmentTransform(figure, place.segment);
  return place && transform ? apply(transform, place.point) : null;
}
