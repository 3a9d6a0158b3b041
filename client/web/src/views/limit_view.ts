// The range of the chosen joint: a cone for an ellipse or polygon of swing, an arc an axis for a box of angles, an arc
// for the twist; and where in it the limb is.
import { Quaternion, Vector3 } from "three";
import type { JointDocument, SegmentDocument, Transform, Vec3 } from "../protocol/types";
import { compose, identity } from "../state/place";
import type { Model } from "../state/model";
import { FatLines } from "./fat_lines";
import { axisColors, type Palette } from "./palette";

const kSteps = 48;

export class LimitView {
  private readonly lines = new FatLines({ width: 1.8, opacity: 0.9, order: 9 });

  get object() {
    return this.lines.object;
  }

  update(model: Model, palette: Palette): void {
    this.lines.begin();
    const chosen = model.chosenSegment();
    if (chosen && model.settings.limits) {
      const parent = chosen.parentTransform ?? identity;
      const { joint } = chosen.document;
      if (joint && chosen.parentTransform) this.draw(chosen.document, joint, compose(parent, [...joint.position, ...(joint.quat_xyzw ?? [0, 0, 0, 1])] as Transform), palette.limit);
    }
    this.lines.end();
  }

  private draw(segment: SegmentDocument, joint: JointDocument, frame: Transform, color: number): void {
    const origin = new Vector3(frame[0], frame[1], frame[2]);
    const turn = new Quaternion(frame[3], frame[4], frame[5], frame[6]);
    const rest = new Vector3(...segment.touch_point);
    const reach = Math.min(Math.max(rest.length(), 0.12), 0.35);
    const at = (direction: Vector3) => direction.clone().applyQuaternion(turn).multiplyScalar(reach).add(origin);
    const edge = swingEdge(joint, rest);
    if (edge) {
      edge.forEach((direction, i) => {
        const next = edge[(i + 1) % edge.length] as Vector3;
        for (const [a, b] of arc(direction, next)) this.lines.add(at(a), at(b), color);
        if (i % Math.max(1, Math.round(edge.length / 12)) === 0) this.lines.add(origin, at(direction), color);
      });
    }
    const colors = [axisColors.x, axisColors.y, axisColors.z];
    (joint.limits ?? []).forEach((range, i) => {
      const axis = joint.axes?.[i] ?? ([[1, 0, 0], [0, 1, 0], [0, 0, 1]] as Vec3[])[i];
      if (!range || !axis) return;
      this.drawRange(new Vector3(...axis).normalize(), range, rest, at, origin, colors[i] as number);
    });
    if (joint.twist) this.drawRange(rest.clone().normalize(), joint.twist, rest, (d) => at(d.multiplyScalar(0.45)), origin, axisColors.x);
  }

  /** An arc about an axis, of the limb at rest or of a direction across where the limb lies along the axis. */
  private drawRange(axis: Vector3, [low, high]: [number, number], rest: Vector3, at: (d: Vector3) => Vector3, origin: Vector3, color: number): void {
    let start = rest.clone().normalize();
    if (Math.abs(start.dot(axis)) > 0.7) start = Math.abs(axis.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
    start.addScaledVector(axis, -start.dot(axis)).normalize();
    const point = (angle: number) => at(start.clone().applyAxisAngle(axis, angle));
    for (let i = 0; i < kSteps; i++) {
      const [a, b] = [i, i + 1].map((step) => low + ((high - low) * step) / kSteps) as [number, number];
      this.lines.add(point(a), point(b), color);
    }
    for (const end of [low, high]) this.lines.add(origin, point(end), color);
  }
}

/** Directions along the edge of a ball joint's swing, in the joint's frame. */
export function swingEdge({ swing }: JointDocument, rest: Vector3): Vector3[] | null {
  if (!swing) return null;
  if ("polygon" in swing) return swing.polygon.map((corner) => new Vector3(...corner).normalize());
  const centre = swing.center ? new Vector3(...swing.center).normalize() : rest.clone().normalize();
  const helper = Math.abs(centre.x) < 0.999 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
  const u = helper.addScaledVector(centre, -helper.dot(centre)).normalize();
  const v = new Vector3().crossVectors(centre, u);
  return Array.from({ length: kSteps }, (_, i) => {
    const angle = (i / kSteps) * 2 * Math.PI;
    const [a, b] = [Math.cos(angle) * swing.ellipse[0], Math.sin(angle) * swing.ellipse[1]];
    const size = Math.hypot(a, b);
    return centre.clone().multiplyScalar(Math.cos(size)).addScaledVector(u, (Math.sin(size) * a) / size).addScaledVector(v, (Math.sin(size) * b) / size);
  });
}

/** The great circle between two directions, in short pieces. */
function arc(from: Vector3, to: Vector3): Array<[Vector3, Vector3]> {
  const pieces = Math.max(1, Math.ceil(from.angleTo(to) / 0.15));
  const point = (i: number) => from.clone().lerp(to, i / pieces).normalize();
  return Array.from({ length: pieces }, (_, i) => [point(i), point(i + 1)]);
}
