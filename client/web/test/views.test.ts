import { Box3, Vector3, type OrthographicCamera } from "three";
import { describe, expect, it } from "vitest";
import { Cameras } from "../src/views/cameras";
import { viewNames, type ViewName } from "../src/views/names";
import { metresPerPixel, onViewPlane, project, rayAt } from "../src/views/projection";

const rects: Record<ViewName, { left: number; top: number; width: number; height: number }> = {
  top: { left: 0, top: 44, width: 480, height: 378 },
  perspective: { left: 480, top: 44, width: 480, height: 378 },
  front: { left: 0, top: 422, width: 480, height: 378 },
  side: { left: 480, top: 422, width: 300, height: 700 },
};

function seen(cameras: Cameras, name: ViewName, x: number, y: number, z: number) {
  return project(cameras.camera(name, rects[name]), rects[name], new Vector3(x, y, z));
}

/** Page pixels that a step of the world's axes makes in a view. */
function step(cameras: Cameras, name: ViewName, x: number, y: number, z: number): [number, number] {
  const { focus } = cameras;
  const a = seen(cameras, name, focus.x, focus.y, focus.z);
  const b = seen(cameras, name, focus.x + x, focus.y + y, focus.z + z);
  // Adding zero turns a negative zero into a plain one.
  return [Math.sign(Math.round(b.x - a.x)) + 0, Math.sign(Math.round(b.y - a.y)) + 0];
}

/** The same in the perspective view, from a point of one's own. */
function step4(cameras: Cameras, from: number[], by: number[]): [number, number] {
  const at = (v: number[]) => seen(cameras, "perspective", v[0]!, v[1]!, v[2]!);
  const [a, b] = [at(from), at(from.map((value, i) => value + by[i]!))];
  return [Math.sign(Math.round(b.x - a.x)) + 0, Math.sign(Math.round(b.y - a.y)) + 0];
}

describe("the views", () => {
  it("look the way their titles say", () => {
    const cameras = new Cameras();
    // Page y grows downwards.
    expect(step(cameras, "top", 0, 1, 0)).toEqual([1, 0]);
    expect(step(cameras, "top", 1, 0, 0)).toEqual([0, 1]);
    expect(step(cameras, "front", 0, 1, 0)).toEqual([1, 0]);
    expect(step(cameras, "front", 0, 0, 1)).toEqual([0, -1]);
    expect(step(cameras, "side", 1, 0, 0)).toEqual([1, 0]);
    expect(step(cameras, "side", 0, 0, 1)).toEqual([0, -1]);
    expect(step(cameras, "perspective", 0, 0, 1)).toEqual([0, -1]);
  });

  it("show nearer things nearer: the face in front, the right side at the side, the head on top", () => {
    const cameras = new Cameras();
    expect(seen(cameras, "front", 1, 0, 1).depth).toBeLessThan(seen(cameras, "front", 0, 0, 1).depth);
    expect(seen(cameras, "side", 0, -1, 1).depth).toBeLessThan(seen(cameras, "side", 0, 0, 1).depth);
    expect(seen(cameras, "top", 0, 0, 2).depth).toBeLessThan(seen(cameras, "top", 0, 0, 1).depth);
  });

  it.each(viewNames)("%s: a dragged point comes out under the pointer and stays in the view's plane", (name) => {
    const cameras = new Cameras();
    const rect = rects[name];
    const camera = cameras.camera(name, rect);
    const start = new Vector3(0.4, -0.3, 1.2);
    const from = project(camera, rect, start);
    const dragged = onViewPlane(camera, rect, from.x + 37, from.y - 21, start) as Vector3;
    const to = project(camera, rect, dragged);
    expect(to.x).toBeCloseTo(from.x + 37, 6);
    expect(to.y).toBeCloseTo(from.y - 21, 6);
    const out = camera.getWorldDirection(new Vector3());
    expect(dragged.clone().sub(start).dot(out)).toBeCloseTo(0, 9);
    expect(rayAt(camera, rect, to.x, to.y).distanceToPoint(dragged)).toBeCloseTo(0, 6);
  });

  it("leave the third coordinate of an orthographic drag exactly alone", () => {
    const cameras = new Cameras();
    const start = new Vector3(0.4, -0.3, 1.2);
    const drag = (name: ViewName) => onViewPlane(cameras.camera(name, rects[name]), rects[name], 111, 555, start) as Vector3;
    expect(drag("front").x).toBeCloseTo(0.4, 12);
    expect(drag("side").y).toBeCloseTo(-0.3, 12);
    expect(drag("top").z).toBeCloseTo(1.2, 12);
  });

  it("share scale and centre among the orthographic three", () => {
    const cameras = new Cameras();
    const scale = (name: ViewName) => metresPerPixel(cameras.camera(name, rects[name]), rects[name], cameras.focus);
    expect(scale("front")).toBeCloseTo(scale("top"), 9);
    const before = seen(cameras, "top", 0, 0, 0);
    // As a hand on the front view does it: by its controls.
    cameras.controls.front.target.y -= 0.1;
    cameras.controls.front.object.position.y -= 0.1;
    cameras.controls.front.dispatchEvent({ type: "change" });
    expect(seen(cameras, "top", 0, 0, 0).x - before.x).toBeCloseTo(0.1 / scale("top"), 6);
    const was = scale("front");
    (cameras.controls.side.object as OrthographicCamera).zoom = 2;
    cameras.controls.side.dispatchEvent({ type: "change" });
    expect(scale("front")).toBeCloseTo(was / 2, 9);
    expect(scale("top")).toBeCloseTo(was / 2, 9);
  });

  it("come back from what a link keeps of them", () => {
    const cameras = new Cameras();
    cameras.fit(new Box3(new Vector3(-0.2, -0.9, 0), new Vector3(0.3, 0.9, 1.75)), rects);
    const other = new Cameras();
    other.restore(JSON.parse(JSON.stringify(cameras.state)));
    for (const name of viewNames) {
      const [a, b] = [seen(cameras, name, 0.4, -0.3, 1.2), seen(other, name, 0.4, -0.3, 1.2)];
      expect(Math.hypot(a.x - b.x, a.y - b.y), name).toBeLessThan(0.5);
    }
  });

  it("are led by who rides along: X forward, Z up", () => {
    const cameras = new Cameras();
    cameras.ride({ position: [1, 2, 3], quat_xyzw: [0, 0, 0, 1], fov_y: 1 });
    const middle = seen(cameras, "perspective", 5, 2, 3);
    const rect = rects.perspective;
    expect([middle.x, middle.y]).toEqual([rect.left + rect.width / 2, rect.top + rect.height / 2].map((value) => expect.closeTo(value, 6)));
    expect(step4(cameras, [5, 2, 3], [0, 0, 0.1])).toEqual([0, -1]);
    expect(step4(cameras, [5, 2, 3], [0, 0.1, 0])).toEqual([-1, 0]);
  });

  it("frame a body with room to spare in all four", () => {
    const cameras = new Cameras();
    const box = new Box3(new Vector3(-0.2, -0.9, 0), new Vector3(0.3, 0.9, 1.75));
    cameras.fit(box, rects);
    for (const name of viewNames) {
      const rect = rects[name];
      for (let corner = 0; corner < 8; corner++) {
        const at = (axis: "x" | "y" | "z", bit: number) => (corner & bit ? box.max : box.min)[axis];
        const { x, y } = seen(cameras, name, at("x", 1), at("y", 2), at("z", 4));
        expect(x, name).toBeGreaterThan(rect.left);
        expect(x, name).toBeLessThan(rect.left + rect.width);
        expect(y, name).toBeGreaterThan(rect.top);
        expect(y, name).toBeLessThan(rect.top + rect.height);
      }
    }
  });
});
