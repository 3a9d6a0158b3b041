import { describe, expect, it } from "vitest";
import { connectionText } from "../src/panels/bar";
import { atText, causesText, costText, frameText, lengthText, sliderFromWeight, weightFromSlider, weightText } from "../src/state/words";

describe("words", () => {
  it("name what a goal pulls", () => {
    expect(atText("right_hand")).toBe("right hand");
    expect(atText("right_hand/fingertip")).toBe("right hand / fingertip");
    expect(atText(undefined)).toBe("the whole figure");
    expect(atText({ segment: "head", point: [0, 0, 0.1] })).toBe("head (0.00, 0.00, 0.10)");
  });

  it("say errors in the unit that is liked", () => {
    expect(lengthText(0.00042, "mm")).toBe("0.4 mm");
    expect(lengthText(0.359, "mm")).toBe("359 mm");
    expect(lengthText(0.359, "m")).toBe("0.359 m");
    expect([costText(3.08e-31), costText(0.01234), costText(4.5)]).toEqual(["0", "0.0123", "4.5"]);
    expect([weightText(undefined), weightText(40), weightText({ position: 10, orientation: 2.5 })]).toEqual(["10", "40", "10 and 2.5"]);
  });

  it("say in plain words what stands in a goal's way", () => {
    const says = (...causes: Parameters<typeof causesText>[0] & object) => causesText(causes, "mm");
    expect(says({ limit: "right_elbow", side: "max" }, { beyond_m: 0.12 })).toBe("right elbow at its limit; 120 mm beyond reach");
    expect(says({ goal: "left_knee" }, { goal: "body.right_hand.position" })).toBe("held by left knee and right hand");
    expect(says({ limit: "right_elbow", side: "max" }, { limit: "right_elbow", side: "min" }, { goal: "g2" })).toBe("held by g2; right elbow at its limit");
    expect(says({ pin: "left_foot" }, { pin: "right_foot", figure: "other" })).toBe("left foot and right foot of other pinned");
    expect(causesText(undefined, "mm")).toBe("");
  });

  it("say what a goal rides on", () => {
    expect([frameText("world"), frameText(undefined), frameText({ object: "old_chair" })]).toEqual(["", "", "on old chair"]);
    expect(frameText({ figure: "other", segment: "left_hand" })).toBe("with other's left hand");
  });

  it("run the weight slider over four decades and back", () => {
    expect([-1, 0, 1, 3].map(weightFromSlider)).toEqual([0.1, 1, 10, 1000]);
    for (const weight of [0.1, 0.5, 2, 10, 40, 100, 1000]) expect(weightFromSlider(sliderFromWeight(weight))).toBe(weight);
    expect(sliderFromWeight(0)).toBe(-1);
  });

  it("count down to the next attempt", () => {
    expect(connectionText({ phase: "lost", retryAtMs: 3200 }, 1000)).toBe("lost, again in 3 s");
    expect(connectionText({ phase: "lost", retryAtMs: 3200 }, 9000)).toBe("lost, again in 0 s");
  });
});
