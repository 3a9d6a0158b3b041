// Joints set by hand: by the paper's half-plane, deviation and twist, by turning the segment, and held by a padlock.
import type { JointValue, Quat, Transform, Vec3 } from "../protocol/types";
import type { ChosenSegment, Model } from "../state/model";
import { conjugate, identity, multiply, quatOf, rotate, tidy, unit } from "../state/place";
import type { Edit, Requests } from "./requests";

/** Strong enough to stand against ten goals of the usual weight. */
const kLockWeight = 100;

export interface Sliders {
  halfplane: number;
  deviation: number;
  twist: number;
}

/** A joint is held by a posture goal of its own. */
export function lockId(figure: string, joint: string): string {
  return `${figure}.${joint}.lock`.slice(0, 64);
}

export function lockOf(model: Model, figure: string, joint: string): string | null {
  const id = lockId(figure, joint);
  return model.scene.document.goals[id]?.posture?.joints?.[joint] === undefined ? null : id;
}

export function setJoint(model: Model, requests: Requests, figure: string, joint: string, value: JointValue, gesture: string): void {
  const fields = typeof value === "object" && !Array.isArray(value) ? value : { value };
  const edits: Edit[] = [{ method: "joint.set", params: { figure, joint, ...fields } }];
  const lock = lockOf(model, figure, joint);
  if (lock) edits.push({ method: "goal.set", params: { id: lock, posture: { joints: { [joint]: value } } } });
  latest.send(`${figure} ${joint}`, () => requests.apply(`turn ${joint}`, edits, gesture));
}

/** Only one edit of a joint is under way at a time; of those that wait, the newest goes. */
class Latest {
  private readonly busy = new Map<string, (() => Promise<unknown>) | null>();

  send(key: string, run: () => Promise<unknown>): void {
    if (this.busy.has(key)) {
      this.busy.set(key, run);
      return;
    }
    this.busy.set(key, null);
    void run().finally(() => {
      const next = this.busy.get(key);
      this.busy.delete(key);
      if (next) this.send(key, next);
    });
  }
}
const latest = new Latest();

/** The joint's own turn, where its segment is to stand like this in the world. */
export function jointTurn({ document, parentTransform }: ChosenSegment, world: Quat): Quat {
  const rest = multiply(quatOf(parentTransform ?? identity), document.joint?.quat_xyzw ?? [0, 0, 0, 1]);
  return unit(multiply(conjugate(rest), world));
}

export function turnSegment(model: Model, requests: Requests, chosen: ChosenSegment, world: Quat, gesture: string): void {
  const { joint } = chosen.document;
  if (!joint) return;
  const turn = tidy(jointTurn(chosen, world));
  const value = joint.type === "free" ? freeValue(chosen, world) : joint.type === "hinge" ? hingeAngle(turn, joint.axes?.[0] ?? [0, 0, 1]) : turn;
  setJoint(model, requests, chosen.figure, joint.name, value, gesture);
}

/** A free root keeps its place and turns. */
function freeValue({ transform }: ChosenSegment, world: Quat): number[] {
  const [x, y, z] = (transform ?? identity) as Transform;
  return tidy([x, y, z, ...world]);
}

function hingeAngle([x, y, z, w]: Quat, axis: number[]): number {
  return 2 * Math.atan2(x * axis[0]! + y * axis[1]! + z * axis[2]!, w);
}

/** Holds the joint as it stands when the daemon is asked: what a panel shows may be a moment old. */
export async function toggleLock(model: Model, requests: Requests, figure: string, joint: string): Promise<void> {
  const lock = lockOf(model, figure, joint);
  if (lock) return requests.removeGoal(lock);
  const now = await requests.readJoint(figure, joint);
  if (!now) return;
  const posture = { joints: { [joint]: now.value } };
  void requests.edit("goal.set", { id: lockId(figure, joint), figure, posture, weight: kLockWeight, label: `${joint.replaceAll("_", " ")} held` });
}

/** A universal joint's two angles, about its first axis and then its second, which stand on each other. */
export function universalAngles([x, y, z, w]: Quat, axes: readonly Vec3[]): [number, number] {
  const about = (axis: Vec3 | undefined) => (axis ? 2 * Math.atan2(x * axis[0] + y * axis[1] + z * axis[2], w) : 0);
  return [within(about(axes[0])), within(about(axes[1]))];
}

export function universalTurn([first, second]: readonly [number, number], axes: readonly Vec3[]): Quat {
  const about = (axis: Vec3 | undefined, angle: number): Quat => {
    const s = Math.sin(angle / 2);
    return axis ? [axis[0] * s, axis[1] * s, axis[2] * s, Math.cos(angle / 2)] : [0, 0, 0, 1];
  };
  return tidy(unit(multiply(about(axes[0], first), about(axes[1], second))));
}

function within(angle: number): number {
  return angle > Math.PI ? angle - 2 * Math.PI : angle < -Math.PI ? angle + 2 * Math.PI : angle;
}

/** What a turn about this axis does to the limb: it twists it, or bends it. */
export function axisName(axis: Vec3, limb: Vec3, index: number): string {
  const along = Math.abs(axis[0] * limb[0] + axis[1] * limb[1] + axis[2] * limb[2]) / (Math.hypot(...limb) || 1);
  return along > 0.9 ? "twist" : index === 0 ? "bend" : "tilt";
}

/** Knees bend forward and elbows back: a pole that the limb's middle joint is to point at, where it points now. */
export function poleOf(model: Model, figure: string, segment: string): { at: string; aim: { axis: [number, number, number]; point: [number, number, number] } } | null {
  const side = segment.startsWith("left_") ? "left_" : segment.startsWith("right_") ? "right_" : null;
  if (!side) return null;
  const arm = /_arm$|_hand$/.test(segment);
  if (!arm && !/_leg$|_foot$/.test(segment)) return null;
  const at = side + (arm ? "upper_arm" : "upper_leg");
  const chosen = model.chosenSegment({ figure, segment: at });
  if (!chosen?.transform) return null;
  const axis: [number, number, number] = arm ? [-1, 0, 0] : [1, 0, 0];
  const [place, turn] = [chosen.transform, quatOf(chosen.transform)];
  const [tip, out] = [rotate(turn, chosen.document.touch_point), rotate(turn, axis)];
  const point = tidy([0, 1, 2].map((i) => place[i]! + tip[i]! + 0.4 * out[i]!)) as [number, number, number];
  return { at, aim: { axis, point } };
}
