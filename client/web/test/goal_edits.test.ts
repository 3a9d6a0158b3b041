import { beforeEach, describe, expect, it } from "vitest";
import type { EditReply } from "../src/protocol/types";
import { GoalEdits } from "../src/tools/goal_edits";
import { FakeClock, settle } from "./fakes";

interface Asked {
  params: object;
  answer(revision: number): void;
  refuse(): void;
}

let asked: Asked[];
let settled: Array<[string, number | null]>;
let failures: unknown[];
let edits: GoalEdits;
let clock: FakeClock;

beforeEach(() => {
  asked = [];
  settled = [];
  failures = [];
  const request = (method: string, params: object) =>
    new Promise<EditReply>((resolve, reject) => {
      expect(method).toBe("goal.set");
      asked.push({ params, answer: (revision) => resolve({ revision }), refuse: () => reject(new Error("no")) });
    });
  clock = new FakeClock();
  edits = new GoalEdits(request, {
    settled: (goal, revision) => settled.push([goal, revision]),
    failed: (error) => failures.push(error),
  }, clock);
});

const params = () => asked.map((each) => each.params);

describe("GoalEdits", () => {
  it("sends at once, and the newest of what came meanwhile after it", async () => {
    for (let i = 0; i < 50; i++) edits.set("g1", { position: [i, 0, 0] });
    expect(params()).toEqual([{ id: "g1", position: [0, 0, 0] }]);
    asked[0]?.answer(5);
    await settle();
    expect(params().slice(1)).toEqual([{ id: "g1", position: [49, 0, 0] }]);
    expect(settled).toEqual([]);
    asked[1]?.answer(6);
    await settle();
    expect(asked).toHaveLength(2);
    expect(settled).toEqual([["g1", 6]]);
    expect(edits.busy("g1")).toBe(false);
  });

  it("does not wait for answers over a long line: spaced, and eight at most are under way", async () => {
    for (let ms = 0; ms < 600; ms += 10) {
      edits.set("g1", { position: [ms, 0, 0] });
      clock.pass(10);
    }
    expect(params()).toHaveLength(8);
    expect(params().slice(0, 3)).toEqual([0, 30, 60].map((ms) => ({ id: "g1", position: [expect.closeTo(ms, -1.5), 0, 0] })));
    asked.forEach(({ answer }, i) => answer(i + 1));
    await settle();
    expect(params().at(-1)).toEqual({ id: "g1", position: [590, 0, 0] });
    expect(settled).toEqual([]);
    asked.at(-1)?.answer(99);
    await settle();
    expect(settled).toEqual([["g1", 99]]);
  });

  it("adds up different fields that wait", async () => {
    edits.set("g1", { position: [0, 0, 0] });
    edits.set("g1", { weight: 3 });
    edits.set("g1", { enabled: false });
    edits.set("g1", { weight: 4 });
    asked[0]?.answer(1);
    await settle();
    expect(params()[1]).toEqual({ id: "g1", weight: 4, enabled: false });
  });

  it("lets two goals go side by side", () => {
    edits.set("g1", { weight: 1 });
    edits.set("g2", { weight: 2 });
    expect(params()).toEqual([{ id: "g1", weight: 1 }, { id: "g2", weight: 2 }]);
  });

  it("tells a refusal, and goes on with what waits", async () => {
    edits.set("g1", { weight: 1 });
    edits.set("g1", { weight: 2 });
    asked[0]?.refuse();
    await settle();
    expect(failures).toHaveLength(1);
    asked[1]?.refuse();
    await settle();
    expect(settled).toEqual([["g1", null]]);
    edits.set("g1", { weight: 3 });
    expect(asked).toHaveLength(3);
  });
});
