import { describe, expect, it } from "vitest";
import { DaemonClock } from "../src/state/daemon_clock";
import { movedTo, turnedTo } from "../src/state/goals";
import { People } from "../src/state/people";
import { defaultSettings, loadSettings, saveSettings } from "../src/state/settings";
import { readLink } from "../src/tools/link";
import { entitiesText } from "../src/tools/requests";
import { snapped } from "../src/tools/snap";
import { swingEdge } from "../src/views/limit_view";
import { Vector3 } from "three";

const store = (text: string | null) => ({ text, getItem: () => text, setItem(_: string, value: string) { this.text = value; } });

describe("settings", () => {
  it("come back, and what is not theirs does not", () => {
    const kept = store(null);
    saveSettings(kept, { ...defaultSettings, theme: "light", snap: 0.05 });
    expect(loadSettings(store(kept.text))).toEqual({ ...defaultSettings, theme: "light", snap: 0.05 });
    expect(loadSettings(store('{"theme":7,"other":1,"user":"ana"}'))).toEqual({ ...defaultSettings, user: "ana" });
    expect(loadSettings(store("no json"))).toEqual(defaultSettings);
    expect(loadSettings(null)).toEqual(defaultSettings);
  });
});

describe("snapping", () => {
  it("is to the grid when on or while the key is held, and never moves what the drag did not", () => {
    const from: [number, number, number] = [0.123, 0.4, 0.7];
    const to: [number, number, number] = [0.123, 0.463, 0.731];
    expect(snapped({ snap: 0 }, to, from, false)).toEqual(to);
    const grid = [0.123, 0.45, 0.75].map((value) => expect.closeTo(value, 9));
    expect(snapped({ snap: 0.05 }, to, from, false)).toEqual(grid);
    expect(snapped({ snap: 0 }, to, from, true)).toEqual(grid);
    expect(snapped({ snap: 0.05 }, to, from, true)).toEqual(to);
  });
});

describe("a goal that is moved", () => {
  const quarter: [number, number, number, number, number, number, number] = [1, 0, 0, 0, 0, Math.SQRT1_2, Math.SQRT1_2];
  const world: [number, number, number] = [1, 1, 0];

  it("is edited in its own frame, its payload whole", () => {
    expect(movedTo({ position: [0, 0, 0] }, quarter, world)).toEqual({ position: [1, 0, 0] });
    expect(movedTo({ aim: { axis: [1, 0, 0], point: [0, 0, 0] } }, quarter, world)).toEqual({ aim: { axis: [1, 0, 0], point: [1, 0, 0] } });
    expect(movedTo({ plane: { point: [0, 0, 0], normal: [0, 0, 1], side: "above" } }, quarter, world)).toEqual({ plane: { point: [1, 0, 0], normal: [0, 0, 1], side: "above" } });
    expect(movedTo({ line: { point: [0, 0, 0], direction: [0, 1, 0] } }, quarter, world)).toEqual({ line: { point: [1, 0, 0], direction: [0, 1, 0] } });
  });

  it("is turned in its own frame", () => {
    const { orientation } = turnedTo(quarter, [0, 0, Math.SQRT1_2, Math.SQRT1_2]);
    expect(orientation?.quat_xyzw).toEqual([0, 0, 0, 1]);
  });
});

describe("people", () => {
  // With others there the page asks who holds what: its own hold came back, and took the goal out of its hand.
  it("a goal in one's own hand is held by nobody else", () => {
    const people = new People();
    people.holding = "mine";
    people.setHolds(new Map([["mine", "ana"], ["theirs", "bo"]]));
    expect(people.holder("mine")).toBeUndefined();
    expect(people.holder("theirs")).toBe("bo");
  });

  it("are told by what they have just edited, for a while", () => {
    const people = new People();
    people.me = "s1";
    people.sessions = [{ session: "s1", user: "ana" }, { session: "s2", user: "bo" }];
    expect(people.others.map(({ user }) => user)).toEqual(["bo"]);
    expect(people.edited("s1", [{ op: "replace", path: "/goals/g1/position" }], 0)).toBe(false);
    expect(people.edited("s2", [{ op: "replace", path: "/goals/g1/position" }], 0)).toBe(true);
    expect([people.editing("g1", 2000), people.editing("g2", 2000), people.editing("g1", 3000)]).toEqual(["bo", undefined, undefined]);
    expect(people.quiet(3000)).toBe(true);
  });
});

describe("the daemon's clock", () => {
  it("is known from the quickest ping", () => {
    const clock = new DaemonClock();
    expect(clock.ageMs(0, 0)).toBeNull();
    // The daemon is 5000 ms ahead; the first trip took 40 ms on the way there and 2 ms back, the second 1 ms each way.
    clock.heard(100, 142, 5140e6, 5140e6);
    clock.heard(200, 202, 5201e6, 5201e6);
    expect(clock.ageMs(5300e6, 310)).toBeCloseTo(10, 6);
  });
});

describe("a link", () => {
  it("is followed only where it holds together", () => {
    const link = { cameras: { focus: [0, 0, 1], zoom: 1, eye: [3, 0, 1], target: [0, 0, 1] }, split: { x: 0.5, y: 0.5 }, one: null, goal: null };
    const hash = (value: unknown) => "#" + new URLSearchParams({ view: JSON.stringify(value), token: "t" }).toString();
    expect(readLink(hash(link))).toEqual(link);
    expect(readLink(hash({ ...link, one: "cellar" }))).toBeNull();
    expect(readLink(hash({ ...link, cameras: { ...link.cameras, eye: [3, 0] } }))).toBeNull();
    expect(readLink(hash({ ...link, cameras: { ...link.cameras, zoom: 0 } }))).toBeNull();
    expect([readLink(""), readLink("#view=no"), readLink("#token=t")]).toEqual([null, null, null]);
  });
});

describe("steps", () => {
  it("are told by what they changed", () => {
    expect(entitiesText(["/goals/body.right_hand.position", "/figures/body/q", "/figures/body/pins"])).toBe("right hand, pose of body, pins of body");
    expect(entitiesText(["/goals/a", "/goals/b", "/goals/c", "/goals/d"])).toBe("a, b, c and 1 more");
  });
});

describe("a ball joint's edge", () => {
  it("is an ellipse about its centre", () => {
    const edge = swingEdge({ name: "j", type: "ball", position: [0, 0, 0], swing: { ellipse: [0.8, 0.5], center: [0, 0, 1] } }, new Vector3(0, 0, 1))!;
    const angles = edge.map((direction) => direction.angleTo(new Vector3(0, 0, 1)));
    expect(Math.max(...angles)).toBeCloseTo(0.8, 9);
    expect(Math.min(...angles)).toBeCloseTo(0.5, 9);
    // The first radius lies along X made perpendicular to the centre.
    expect(edge[0]!.x).toBeCloseTo(Math.sin(0.8), 9);
  });
});
