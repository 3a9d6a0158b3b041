// What a goal of each kind asks for, beyond the cube at its target: a plane, a line, axes, a pole, a support.
import { Quaternion, Vector3 } from "three";
import type { GoalDocument, Transform, Vec3 } from "../protocol/types";
import { axisColors } from "./palette";
import type { FatLines } from "./fat_lines";

const kAxis = 0.11;

export function drawGoalShape(lines: FatLines, goal: GoalDocument, frame: Transform | null, target: Vector3, color: number, strong: boolean): void {
  if (!frame) return;
  const turn = new Quaternion(frame[3], frame[4], frame[5], frame[6]);
  const direction = (vector: Vec3) => new Vector3(...vector).applyQuaternion(turn).normalize();
  if (goal.orientation) drawAxes(lines, target, turn.clone().multiply(new Quaternion(...goal.orientation.quat_xyzw)), strong ? kAxis * 1.3 : kAxis);
  if (goal.plane) drawPlane(lines, target, direction(goal.plane.normal), color);
  if (goal.line) {
    const along = direction(goal.line.direction);
    lines.add(target.clone().addScaledVector(along, -0.4), target.clone().addScaledVector(along, 0.4), color);
  }
  if (goal.aim?.direction) drawArrow(lines, target, direction(goal.aim.direction), 0.2, color);
}

/** What a figure stands on, and the plumb line from its centre of mass to the floor. */
export function drawSupport(lines: FatLines, hull: readonly Vec3[] | null, centre: Vector3, color: number): void {
  if (!hull) return;
  // A little above the floor, or the floor would swallow it.
  const corners = hull.map(([x, y, z]) => new Vector3(x, y, z + 0.002));
  corners.forEach((corner, i) => lines.add(corner, corners[(i + 1) % corners.length]!, color));
  if (corners[0]) lines.add(centre, new Vector3(centre.x, centre.y, corners[0].z), color);
}

export function drawAxes(lines: FatLines, at: Vector3, turn: Quaternion, length: number): void {
  for (const [axis, color] of Object.entries(axisColors)) {
    const tip = new Vector3(axis === "x" ? length : 0, axis === "y" ? length : 0, axis === "z" ? length : 0);
    lines.add(at, tip.applyQuaternion(turn).add(at), color);
  }
}

function drawPlane(lines: FatLines, at: Vector3, normal: Vector3, color: number): void {
  const [u, v] = across(normal);
  const corner = (a: number, b: number) => at.clone().addScaledVector(u, a * 0.2).addScaledVector(v, b * 0.2);
  for (let i = -1; i <= 1; i += 0.5) {
    lines.add(corner(i, -1), corner(i, 1), color);
    lines.add(corner(-1, i), corner(1, i), color);
  }
  drawArrow(lines, at, normal, 0.12, color);
}

export function drawArrow(lines: FatLines, from: Vector3, direction: Vector3, length: number, color: number): void {
  const tip = from.clone().addScaledVector(direction, length);
  lines.add(from, tip, color);
  for (const side of across(direction)) {
    for (const sign of [1, -1]) {
      lines.add(tip, tip.clone().addScaledVector(direction, -0.25 * length).addScaledVector(side, sign * 0.12 * length), color);
    }
  }
}

/** Two directions that stand on this one and on each other. */
export function across(direction: Vector3): [Vector3, Vector3] {
  const helper = Math.abs(direction.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  const u = new Vector3().crossVectors(direction, helper).normalize();
  return [u, new Vector3().crossVectors(direction, u)];
}
