// Pins, joints and poses.
import assert from "node:assert/strict";
import { apart, begin, call, distance, figurePose, project, state, until } from "../browser.mjs";
import { ringRadii } from "./goals.mjs";

export const checks = [
  ["a click on a part of the body chooses it", choosesByClick],
  ["a padlock pins a hand, and lets go", pins],
  ["sliders set a joint, in one step to undo", slides],
  ["a held joint stands against a goal", holds],
  ["a segment is turned by its rings", turns],
  ["T-pose, mirror and start; goals that would pull are off", poses],
  ["a pose is kept, shown as a ghost and taken again", keeps],
];

const elbow = "left_lower_arm";
/** By its name in the list. */
export const choose = async (page, segment) => {
  await page.getByTestId("tab-body").click();
  await page.getByTestId(`segment-${segment}`).getByRole("button", { name: segment.replaceAll("_", " "), exact: true }).click();
  await until(async () => (await state(page)).selected.segment?.segment === segment, `${segment} to be chosen`);
};

async function choosesByClick({ page }) {
  await begin(page, "standing");
  const place = (await figurePose(page))[12].slice(0, 3);
  const at = await project(page, "front", [place[0], place[1], place[2] - 0.2]);
  await page.mouse.click(at.x, at.y);
  await until(async () => (await state(page)).selected.segment?.segment === "left_upper_leg", "the thigh to be chosen");
  await until(async () => (await page.getByTestId("tab-body").getAttribute("aria-selected")) === "true", "the tab to open");
  await until(async () => /left hip/.test(await page.getByTestId("joint-panel").textContent()), "the joint in the panel");
}

async function pins({ page }) {
  await begin(page, "standing");
  await page.getByTestId("tab-body").click();
  const pin = page.getByTestId("segment-left_hand").getByTestId("pin");
  await pin.click();
  await until(async () => (await state(page)).scene.figures.body.pins.left_hand?.hold === "pose", "the pin");
  await until(async () => (await pin.getAttribute("aria-pressed")) === "true", "the closed padlock");
  const held = await page.evaluate(() => window.posed.views.touchPoint("body", "left_hand"));
  const { revision } = await call(page, "goal.set", { at: "right_hand", position: [0.5, -0.6, 1.3] });
  await until(async () => (await state(page)).poseRevision >= revision, "the pose");
  const now = await page.evaluate(() => window.posed.views.touchPoint("body", "left_hand"));
  assert.ok(distance(held, now) < 0.002, `the pinned hand moved ${distance(held, now)} m`);
  await pin.click();
  await until(async () => !("left_hand" in (await state(page)).scene.figures.body.pins), "the pin to go");
}

async function slides({ page }) {
  await begin(page, "standing");
  await choose(page, elbow);
  const before = await figurePose(page);
  const bend = page.getByTestId("joint-bend");
  await bend.waitFor();
  // As a hand slides: many inputs, one change at the end.
  await bend.evaluate((input) => {
    for (const value of ["0.4", "0.8", "1.2"]) {
      input.value = value;
      input.dispatchEvent(new Event("input", { bubbles: true }));
    }
    input.dispatchEvent(new Event("change", { bubbles: true }));
  });
  const index = (await state(page)).figures.body.segments.indexOf("left_hand");
  await until(async () => distance((await figurePose(page))[index].slice(0, 3), before[index].slice(0, 3)) > 0.15, "the forearm to bend");
  const joint = await call(page, "joint.get", { joint: "left_elbow" });
  assert.ok(Math.abs(joint.deviation - 1.2) < 0.02, `the elbow deviates ${joint.deviation}`);
  await until(async () => (await page.getByTestId("joint-bend-value").textContent()) === "68.8°", "the number in degrees");
  await page.keyboard.press("Control+z");
  await until(async () => apart(await figurePose(page), before) < 1e-3, "the arm to hang as before");
  // A ball has the paper's three.
  await choose(page, "head");
  await choose(page, "left_upper_arm");
  await page.getByTestId("joint-deviation").fill("0.9");
  await until(async () => Math.abs((await call(page, "joint.get", { joint: "left_shoulder" })).deviation - 0.9) < 0.05, "the arm to rise");
}

async function holds({ page }) {
  await begin(page, "standing");
  await choose(page, elbow);
  await page.getByTestId("joint-bend").fill("1.5");
  await until(async () => Math.abs((await call(page, "joint.get", { joint: "left_elbow" })).deviation - 1.5) < 0.05, "the bent elbow");
  const lock = page.getByTestId("joint-lock");
  await lock.click();
  await until(async () => (await lock.getAttribute("aria-pressed")) === "true", "the closed padlock");
  const { revision } = await call(page, "goal.set", { at: "left_hand", position: [0, 1.5, 1.4] });
  await until(async () => (await state(page)).poseRevision >= revision, "the pull");
  assert.ok(Math.abs((await call(page, "joint.get", { joint: "left_elbow" })).deviation - 1.5) < 0.35, "the elbow stays bent");
  await lock.click();
  await until(async () => (await call(page, "joint.get", { joint: "left_elbow" })).deviation < 1, "the elbow to give way");
}

async function turns({ page }) {
  await begin(page, "standing");
  await choose(page, "head");
  const index = (await state(page)).figures.body.segments.indexOf("head");
  const before = (await figurePose(page))[index];
  for (const radius of await ringRadii(page, "top")) {
    const centre = await project(page, "top", (await figurePose(page))[index].slice(0, 3));
    await page.mouse.move(centre.x + radius * 0.7, centre.y - radius * 0.7);
    await page.mouse.down();
    await page.mouse.move(centre.x + radius, centre.y + 5, { steps: 6 });
    await page.mouse.up();
    const turned = async () => distance((await figurePose(page))[index].slice(3), before.slice(3)) > 0.1;
    if (await until(turned, "a turn", 1500).catch(() => false)) return;
    await choose(page, "head");
  }
  assert.fail("no ring of the head was where it is drawn");
}

async function poses({ page }) {
  await begin(page, "standing");
  await call(page, "goal.set", { id: "pull", at: "left_hand", position: [0.4, 0.3, 1.2] });
  await until(async () => (await state(page)).goals.pull?.pose, "the goal");
  await page.getByTestId("tab-body").click();
  const hand = (await state(page)).figures.body.segments.indexOf("left_hand");
  await page.getByTestId("pose-rest").click();
  await until(async () => (await figurePose(page))[hand][1] > 0.7, "the arms to stand out");
  await until(async () => (await state(page)).scene.goals.pull.enabled === false, "the goal to be off");
  await page.getByTestId("pose-start").click();
  await until(async () => (await figurePose(page))[hand][1] < 0.4, "the arms to hang");
  await choose(page, elbow);
  await page.getByTestId("joint-bend").fill("1.4");
  const right = (await state(page)).figures.body.segments.indexOf("right_hand");
  await until(async () => (await figurePose(page))[hand][2] > (await figurePose(page))[right][2] + 0.05, "the left arm to bend");
  await page.getByTestId("pose-mirror").click();
  await until(async () => (await figurePose(page))[right][2] > (await figurePose(page))[hand][2] + 0.05, "the right arm to be the bent one");
}

async function keeps({ page }) {
  await begin(page, "standing");
  await page.getByTestId("tab-body").click();
  await call(page, "goal.set", { id: "reach", at: "left_hand", position: [0.5, 0.3, 1.4] });
  await until(async () => (await state(page)).goals.reach?.pose?.state === "reached", "the reach");
  const kept = await figurePose(page);
  await page.keyboard.press("p");
  const row = page.getByTestId("pose-pose 1");
  await row.waitFor();
  const { revision } = await call(page, "goal.set", { id: "reach", position: [0.1, 0.7, 0.9] });
  await until(async () => (await state(page)).poseRevision >= revision && apart(await figurePose(page), kept) > 0.2, "another pose");
  await row.getByTestId("ghost").check();
  await row.getByTestId("pose-take").click();
  await until(async () => apart(await figurePose(page), kept) < 0.01, "the kept pose");
  assert.ok(distance((await state(page)).scene.goals.reach.position, [0.5, 0.3, 1.4]) < 0.005, "its goal came along");
  await row.getByTestId("ghost").uncheck();
}
