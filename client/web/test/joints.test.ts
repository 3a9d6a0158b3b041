import { describe, expect, it } from "vitest";
import type { Quat, Vec3 } from "../src/protocol/types";
import type { ChosenSegment, Model } from "../src/state/model";
import { apply, compose, into, multiply, rotate, unit } from "../src/state/place";
import { axisName, jointTurn, toggleLock, universalAngles, universalTurn } from "../src/tools/joints";
import type { Requests } from "../src/tools/requests";

const near = (a: readonly number[], b: readonly number[], digits = 5) => a.forEach((value, i) => expect(value).toBeCloseTo(b[i]!, digits));

describe("places", () => {
  const turn = unit([0.2, -0.4, 0.1, 0.8]);
  const frame = [1, 2, 3, ...turn] as [number, number, number, number, number, number, number];

  it("are carried into a frame and back", () => {
    near(apply(frame, into(frame, [0.4, -0.3, 1.2])), [0.4, -0.3, 1.2], 9);
    near(rotate([0, 0, Math.SQRT1_2, Math.SQRT1_2], [1, 0, 0]), [0, 1, 0], 9);
  });

  it("of a frame in a frame", () => {
    const inner = [0.1, 0, 0, 0, 0, Math.SQRT1_2, Math.SQRT1_2] as typeof frame;
    near(apply(compose(frame, inner), [1, 0, 0]), apply(frame, apply(inner, [1, 0, 0])), 9);
  });
});

describe("a joint by hand", () => {
  const axes: Vec3[] = [[0, 0, -1], [0, 1, 0]];

  it("has two angles where it has two axes", () => {
    for (const angles of [[0, 0], [1.2, 0], [2.6, -1.3], [0.4, 1.39]] as Array<[number, number]>) {
      const turn = universalTurn(angles, axes);
      near(universalAngles(turn, axes), angles);
      near(universalAngles(turn.map((value) => -value) as Quat, axes), angles);
    }
  });

  it("names what its axes do", () => {
    const limb: Vec3 = [0, 0.25, 0];
    expect(axes.map((axis, i) => axisName(axis, limb, i))).toEqual(["bend", "twist"]);
    expect([[-1, 0, 0], [0, 0, -1]].map((axis, i) => axisName(axis as Vec3, limb, i))).toEqual(["bend", "tilt"]);
  });

  it("turns so that its segment stands as the hand has it in the world", () => {
    const parent = unit([0.1, 0.3, -0.2, 0.9]);
    const rest = unit([0, 0.5, 0, 0.8]);
    const world = unit([0.3, 0.1, 0.6, 0.5]);
    const chosen = {
      parentTransform: [0, 0, 1, ...parent],
      document: { name: "a", touch_point: [0, 0, 1], joint: { name: "j", type: "ball", position: [0, 0, 0], quat_xyzw: rest } },
    } as unknown as ChosenSegment;
    near(multiply(multiply(parent, rest), jointTurn(chosen, world)), world);
  });
});

describe("a joint's padlock", () => {
  // The panel reads joints at its leisure: locked with what it showed, a joint that had just been bent went back.
  it("holds the joint as the daemon has it", async () => {
    const edits: object[] = [];
    const model = { scene: { document: { goals: {} } } } as unknown as Model;
    const requests = {
      readJoint: () => Promise.resolve({ figure: "body", joint: "elbow", value: [0, 0, 0.6, 0.8] }),
      edit: (method: string, params: object) => edits.push({ method, ...params }),
    } as unknown as Requests;
    await toggleLock(model, requests, "body", "elbow");
    expect(edits).toMatchObject([{ method: "goal.set", id: "body.elbow.lock", posture: { joints: { elbow: [0, 0, 0.6, 0.8] } } }]);
  });

  it("stays open where the joint can not be read", async () => {
    const model = { scene: { document: { goals: {} } } } as unknown as Model;
    const requests = { readJoint: () => Promise.resolve(undefined), edit: () => expect.fail("an edit") } as unknown as Requests;
    await toggleLock(model, requests, "body", "elbow");
  });
});
