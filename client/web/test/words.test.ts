import { describe, expect, it } from "vitest";
import { connectionText } from "../src/panels/bar";
import { atText, causesText, costText, errorText, sliderFromWeight, weightFromSlider } from "../src/panels/words";

describe("words", () => {
  it("name what a goal pulls", () => {
    expect(atText("right_hand")).toBe("right hand");
    expect(atText("right_hand/fingertip")).toBe("right hand / fingertip");
    expect(atText(undefined)).toBe("the whole figure");
    expect(atText({ segment: "head", point: [0, 0, 0.1] })).toBe("head (0.00, 0.00, 0.10)");
  });

  it("say errors in millimetres and name their causes", () => {
    expect(errorText(0.00042)).toBe("0.4 mm");
    expect(errorText(0.359)).toBe("359 mm");
    expect(causesText([{ goal: "g2" }, { beyond_m: 0.12 }])).toBe("held by g2 · 120 mm beyond reach");
    expect(causesText([{ goal: "left_knee" }, { goal: "body.right_hand.position" }])).toBe("held by left knee, right hand");
    expect(causesText([{ limit: "right_elbow", side: "max" }, { goal: "g2" }])).toBe("held by g2 · limited by right elbow (max)");
    expect(causesText([{ pin: "left_foot" }, { goal: "g2" }])).toBe("held by the pin of left foot, g2");
    expect(causesText(undefined)).toBe("");
    expect([costText(3.08e-31), costText(0.01234), costText(4.5)]).toEqual(["0", "0.0123", "4.5"]);
  });

  it("run the weight slider over four decades and back", () => {
    expect([-1, 0, 1, 3].map(weightFromSlider)).toEqual([0.1, 1, 10, 1000]);
    for (const weight of [0.1, 0.5, 2, 10, 40, 100, 1000]) expect(weightFromSlider(sliderFromWeight(weight))).toBe(weight);
    expect(sliderFromWeight(0)).toBe(-1);
  });

  it("count down to the next attempt", () => {
    expect(connectionText({ phase: "lost", retryAtMs: 3200 }, 1000)).toBe("lost, reconnecting in 3 s");
    expect(connectionText({ phase: "lost", retryAtMs: 3200 }, 9000)).toBe("lost, reconnecting in 0 s");
  });
});
