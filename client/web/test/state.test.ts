import { describe, expect, it } from "vitest";
import type { GoalPose, SensorSample, TrackerInfo, Vec3 } from "../src/protocol/types";
import { Meter } from "../src/state/meter";
import { Model } from "../src/state/model";
import { applySceneFrame, emptyScene, SceneGap, touchesFigures } from "../src/state/scene";

const snapshot = { revision: 7, document: { goals: { g1: { at: "right_hand", position: [0, 0, 1] as Vec3, weight: 10 } } } };

describe("the scene", () => {
  it("is a snapshot with its patches", () => {
    let scene = applySceneFrame(emptyScene, structuredClone(snapshot));
    scene = applySceneFrame(scene, {
      from_revision: 7,
      revision: 8,
      by: "s1",
      patch: [
        { op: "replace", path: "/goals/g1/weight", value: 40 },
        { op: "add", path: "/goals/g2", value: { at: "left_hand" } },
        { op: "add", path: "/bindings/b1", value: { sensor: "simulated:1", to: { goal: "g1" } } },
      ],
    });
    scene = applySceneFrame(scene, { from_revision: 8, revision: 9, patch: [{ op: "remove", path: "/goals/g2" }] });
    expect(scene.revision).toBe(9);
    expect(scene.document.goals).toEqual({ g1: { at: "right_hand", position: [0, 0, 1], weight: 40 } });
    expect(Object.keys(scene.document.bindings)).toEqual(["b1"]);
    expect(scene.document.figures).toEqual({});
  });

  it("takes a patch of the whole document", () => {
    const scene = applySceneFrame(applySceneFrame(emptyScene, structuredClone(snapshot)), {
      from_revision: 7, revision: 8, patch: [{ op: "replace", path: "", value: { goals: {} } }],
    });
    expect(scene.document).toEqual({ figures: {}, goals: {}, objects: {}, bindings: {}, cameras: {} });
  });

  it("says so when a patch does not join up or does not fit", () => {
    const scene = applySceneFrame(emptyScene, structuredClone(snapshot));
    expect(() => applySceneFrame(scene, { from_revision: 9, revision: 10, patch: [] })).toThrow(SceneGap);
    const unfit = { from_revision: 7, revision: 8, patch: [{ op: "remove" as const, path: "/goals/g9/weight" }] };
    expect(() => applySceneFrame(scene, unfit)).toThrow(SceneGap);
  });

  it("knows which patches change a body", () => {
    const touches = (path: string) => touchesFigures({ from_revision: 1, revision: 2, patch: [{ op: "replace", path }] });
    expect(["", "/figures", "/figures/body", "/figures/body/stature"].map(touches)).toEqual([true, true, true, true]);
    expect(["/figures/body/q", "/figures/body/q/3", "/goals/g1", "/bindings"].map(touches)).toEqual([false, false, false, false]);
  });
});

const goal = (target: Vec3): GoalPose => ({ id: "g1", touch: [0, 0, 0], target, error: 0, state: "reached" });

function pose(model: Model, revision: number, target: Vec3): void {
  const world_from_segment: [[number, number, number, number, number, number, number]] = [[0, 0, 1, 0, 0, 0, 1]];
  model.takePose({ t_ns: 1, revision, figures: [{ figure: "body", world_from_segment, goals: [goal(target)] }] }, 0);
}

describe("the model", () => {
  it("puts the cube under the hand, else where the pose says, else where the document says", () => {
    const model = new Model();
    model.takeScene(structuredClone(snapshot));
    expect(model.goalTarget("g1")).toEqual([0, 0, 1]);
    pose(model, 7, [0, 0, 2]);
    expect(model.goalTarget("g1")).toEqual([0, 0, 2]);
    model.setLocalTarget("g1", [0, 0, 3]);
    pose(model, 8, [0, 0, 2.5]);
    expect(model.goalTarget("g1")).toEqual([0, 0, 3]);
  });

  it("has an object where a sensor leads it, and where it was let go until the document says so", () => {
    const model = new Model();
    model.takeScene({ revision: 7, document: { objects: { box: { position: [0, 0, 1] } } } });
    const at = (revision: number, ...z: number[]) =>
      model.takePose({ t_ns: 1, revision, figures: [], objects: z.map((z) => ({ object: "box", world_from_object: [0, 0, z, 0, 0, 0, 1] })) }, 0);
    expect(model.objectTransform("box")).toEqual([0, 0, 1, 0, 0, 0, 1]);
    at(7, 2);
    expect(model.objectTransform("box")).toEqual([0, 0, 2, 0, 0, 0, 1]);
    at(8);
    at(8);
    expect(model.objectTransform("box")?.[2]).toBe(2);
    model.takeScene({ from_revision: 7, revision: 8, patch: [{ op: "replace", path: "/objects/box/position", value: [0, 0, 2.5] }] });
    expect(model.objectTransform("box")?.[2]).toBe(2.5);
    expect(model.objectTransform("gone")).toBeNull();
  });

  it("shows what is no position in the world, and does not move it", () => {
    const model = new Model();
    const position: Vec3 = [0, 0, 1];
    model.takeScene({
      revision: 7,
      document: {
        goals: {
          g1: { kind: "aim", at: "head" },
          held: { kind: "position", at: "head", position, relative_to: "world" },
          near: { kind: "position", at: "head", position, relative_to: { figure: "body", segment: "neck" } },
          calm: { kind: "posture" },
        },
      },
    });
    expect(["g1", "held", "near", "calm", "gone"].map((id) => model.movable(id))).toEqual([false, true, false, false, false]);
    expect(["g1", "held", "near", "calm"].map((id) => model.goalTarget(id))).toEqual([undefined, position, undefined, undefined]);
    pose(model, 7, [0, 0, 2]);
    expect(model.goalTarget("g1")).toEqual([0, 0, 2]);
  });

  it("ends the local echo with the pose that has the last edit, not before", () => {
    const model = new Model();
    model.takeScene(structuredClone(snapshot));
    model.setLocalTarget("g1", [0, 0, 3]);
    model.endLocalTarget("g1", 12);
    pose(model, 11, [0, 0, 2]);
    expect(model.goalTarget("g1")).toEqual([0, 0, 3]);
    pose(model, 12, [0, 0, 3.0001]);
    expect(model.goalTarget("g1")).toEqual([0, 0, 3.0001]);
    model.setLocalTarget("g1", [0, 0, 4]);
    model.endLocalTarget("g1", 12);
    expect(model.localTargets.size).toBe(0);
  });

  it("drops the echo at once when the daemon refuses", () => {
    const model = new Model();
    model.takeScene(structuredClone(snapshot));
    pose(model, 1, [0, 0, 2]);
    model.setLocalTarget("g1", [0, 0, 3]);
    model.endLocalTarget("g1", null);
    expect(model.goalTarget("g1")).toEqual([0, 0, 2]);
  });

  it("forgets a selected goal that is gone, and the pose of a figure that is gone", () => {
    const model = new Model();
    model.takeScene(structuredClone(snapshot));
    model.select("g1");
    model.takeScene({ from_revision: 7, revision: 8, patch: [{ op: "remove", path: "/goals/g1" }] });
    expect(model.selectedGoal).toBeNull();
    pose(model, 8, [0, 0, 1]);
    model.setFigures([]);
    expect(model.poses.size).toBe(0);
  });

  it("takes a tracker frame as complete for its device, and only for it", () => {
    const model = new Model();
    const station = (tracker: string): TrackerInfo => ({ tracker, kind: tracker, state: "streaming", sensors: [`${tracker}:1`, `${tracker}:2`] });
    const sample = (sensor: string): SensorSample => ({ sensor, position: [0, 0, 0], quat_xyzw: [0, 0, 0, 1] });
    model.setTrackers([station("a"), station("b")]);
    model.takeTracker({ t_ns: 1, device: "a", sensors: [sample("a:1"), sample("a:2")] });
    model.takeTracker({ t_ns: 1, device: "b", sensors: [sample("b:1")] });
    model.takeTracker({ t_ns: 2, device: "a", sensors: [sample("a:2")] });
    expect([...model.samples.keys()].sort()).toEqual(["a:2", "b:1"]);
    model.setTrackers([station("b")]);
    expect([...model.samples.keys()]).toEqual(["b:1"]);
  });

  it("starts a session without what only the last one knew, and keeps what is under the hand", () => {
    const model = new Model();
    pose(model, 40, [0, 0, 2]);
    model.setLocalTarget("g1", [0, 0, 3]);
    model.beginSession({ protocol: 1, daemon: { name: "posed", version: "0" }, session: "s2", boot: "c" });
    expect([model.poseRevision, model.localTargets.size, model.poses.size]).toEqual([-1, 1, 1]);
  });
});

describe("Meter", () => {
  it("counts the last second", () => {
    const meter = new Meter();
    for (let ms = 0; ms < 2000; ms += 20) meter.count(ms);
    expect(meter.perSecond(1999)).toBe(50);
    expect(meter.perSecond(2480)).toBe(25);
    expect(meter.perSecond(9000)).toBe(0);
  });
});
