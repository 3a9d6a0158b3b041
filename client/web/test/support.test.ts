import { describe, expect, it } from "vitest";
import type { FigureReply, Transform } from "../src/protocol/types";
import { Model } from "../src/state/model";
import { hull, supportHull } from "../src/state/support";

describe("what a figure stands on", () => {
  it("is the hull, counter-clockwise, without what lies inside or on an edge", () => {
    expect(hull([[0, 0], [2, 0], [1, 0], [1, 1], [2, 2], [0, 2], [0, 0]])).toEqual([[0, 0], [2, 0], [2, 2], [0, 2]]);
    expect(hull([[1, 1]])).toEqual([[1, 1]]);
  });

  const standing = (quat_xyzw: [number, number, number, number], pose: Transform) => {
    const model = new Model();
    const foot = { name: "foot", touch_point: [0.1, 0, 0] as [number, number, number], joint: { name: "root", type: "free" as const, position: [0, 0, 0] as [number, number, number], quat_xyzw }, shape: [{ kind: "box" as const, center: [0.1, 0, 0] as [number, number, number], half_size: [0.15, 0.05, 0.03] as [number, number, number] }] };
    model.setFigures([{ id: "body", entity_revision: 1, document: { format: "posed.figure/1", root: "foot", segments: [foot] } } satisfies FigureReply]);
    model.takePose({ t_ns: 1, revision: 1, figures: [{ figure: "body", world_from_segment: [pose] }] }, 0);
    return model;
  };
  const near = (corners: number[][]) => corners.map((corner) => corner.map((value) => expect.closeTo(value, 9)));

  it("is the soles of its boxes, where they are now", () => {
    const model = standing([0, 0, 0, 1], [1, 0, 0.5, 0, 0, 0, 1]);
    expect(supportHull(model, { balance: { support: ["foot"] } })).toEqual(near([[0.95, -0.05, 0.47], [1.25, -0.05, 0.47], [1.25, 0.05, 0.47], [0.95, 0.05, 0.47]]));
  });

  it("takes the face that is lowest at rest, however it is turned now", () => {
    // At rest its Y points down: the sole is the face at +Y.
    const model = standing([-Math.SQRT1_2, 0, 0, Math.SQRT1_2], [0, 0, 0, -Math.SQRT1_2, 0, 0, Math.SQRT1_2]);
    expect(supportHull(model, { balance: { support: ["foot"] } })).toEqual(near([[-0.05, -0.03, -0.05], [0.25, -0.03, -0.05], [0.25, 0.03, -0.05], [-0.05, 0.03, -0.05]]));
  });

  it("is nothing where nothing is known", () => {
    expect(supportHull(new Model(), { balance: { support: ["foot"] } })).toBeNull();
    expect(supportHull(standing([0, 0, 0, 1], [0, 0, 0, 0, 0, 0, 1]), { balance: { support: ["none"] } })).toBeNull();
  });
});
