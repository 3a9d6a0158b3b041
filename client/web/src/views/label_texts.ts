// What stands beside sensors, and beside the goals that the user points at or that others hold.
import { Vector3 } from "three";
import type { Model } from "../state/model";
import { goalName, lengthText, weightText } from "../state/words";
import type { Label } from "./labels";

/** A label with its place in the world: where that is on the page, each view says. */
export type LabelText = Omit<Label, "at"> & { point: Vector3 };

export function labelTexts(model: Model): LabelText[] {
  const labels: LabelText[] = [...model.samples.values()].map(({ sensor, position }) => ({
    key: `sensor ${sensor}`, text: sensor, kind: "sensor", point: new Vector3(...position),
  }));
  const { goals } = model.scene.document;
  const now = performance.now();
  for (const [id, goal] of Object.entries(goals)) {
    const [holder, editing] = [model.people.holder(id), model.people.editing(id, now)];
    const pointed = id === model.hoveredGoal || id === model.selectedGoal;
    if (!pointed && !holder && !editing) continue;
    const target = model.goalTarget(id);
    if (!target) continue;
    const pose = model.goalPose(id);
    const who = holder ? `held by ${holder}` : editing ? `${editing} edits` : "";
    const numbers = pose && pointed ? [lengthText(pose.error, model.settings.lengths), `weight ${weightText(goal.weight)}`] : [];
    const text = [goal.label || goalName(id), ...numbers, who].filter(Boolean).join("  ·  ");
    labels.push({ key: `goal ${id}`, text, kind: who ? "held" : "goal", point: new Vector3(...target) });
  }
  if (model.hoveredSegment && !model.hoveredGoal) {
    const transform = model.segmentTransform(model.hoveredSegment.figure, model.hoveredSegment.segment);
    const hint = model.hoveredPlace;
    if (hint) labels.push({ key: "segment", text: hint.text, kind: "segment", point: new Vector3(...hint.point) });
    else if (transform) labels.push({ key: "segment", text: goalName(model.hoveredSegment.segment), kind: "segment", point: new Vector3(transform[0], transform[1], transform[2]) });
  }
  return labels;
}
