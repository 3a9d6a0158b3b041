// One's own steps, taken back with the pose that they changed.
import assert from "node:assert/strict";
import { apart, begin, distance, figurePose, project, state, until } from "../browser.mjs";
import { drags, hand, makeByClick } from "./goals.mjs";

export const needs = { user: "ana" };

export const checks = [
  ["Ctrl+Z after a drag brings the old pose back in one step, and Ctrl+Shift+Z the new one", undoesDrag],
  ["a scene that was replaced comes back", undoesScene],
  ["each undoes only its own, and gets the pose that was", undoesOwn],
  ["a step is undone from the list", undoesFromList],
];

async function settled(page) {
  let last = await figurePose(page);
  return until(async () => {
    const now = await figurePose(page);
    const still = apart(now, last) < 1e-6;
    last = now;
    return still && now;
  }, "the figure to stand still");
}

async function undoesDrag({ page }) {
  await makeByClick(page);
  const [before, target] = [await settled(page), (await state(page)).goals[hand].target];
  await drags(page, "front", [60, -120]);
  const after = await settled(page);
  assert.ok(apart(before, after) > 0.1);
  await page.keyboard.press("Control+z");
  await until(async () => distance((await state(page)).scene.goals[hand].position, target) < 1e-6, "the goal to be where it was");
  await until(async () => apart(await figurePose(page), before) < 2e-4, "the pose to be what it was");
  await page.keyboard.press("Control+Shift+z");
  await until(async () => apart(await figurePose(page), after) < 2e-4, "the pose of the drag");
}

async function undoesScene({ page }) {
  await makeByClick(page);
  const before = await settled(page);
  await page.keyboard.press("n");
  await page.getByTestId("scene-paper/sitting").click();
  await until(async () => (await state(page)).scene.goals.back, "the sitting figure");
  await page.keyboard.press("Control+z");
  await until(async () => hand in (await state(page)).scene.goals, "the goal of before");
  await until(async () => apart(await figurePose(page), before) < 2e-4, "the pose of before");
}

async function undoesOwn({ page, open }) {
  const id = await makeByClick(page);
  const { target } = (await state(page)).goals[id];
  const other = await open({ user: "bo" });
  await until(async () => id in (await state(other)).goals, "the goal at the other's");
  await drags(page, "front", [40, -70]);
  const touch = await other.evaluate(() => window.posed.views.touchPoint("body", "left_hand"));
  const at = await project(other, "front", touch);
  await other.keyboard.press("g");
  await other.mouse.click(at.x, at.y);
  const left = "body.left_hand.position";
  await until(async () => left in (await state(page)).goals, "the other's goal");
  await page.keyboard.press("Control+z");
  await until(async () => (await state(page)).goals[id].pose && distance((await state(page)).scene.goals[id].position, (await state(page)).goals[id].target) < 1e-6, "the first's own drag to be undone");
  await until(async () => (await page.getByTestId("toast").textContent()).includes("right hand"), "to be told what was undone");
  assert.ok(left in (await state(page)).scene.goals, "what the other made is there");
  await other.keyboard.press("Control+z");
  await until(async () => !(left in (await state(page)).scene.goals), "the other's own to go");
  assert.ok(id in (await state(page)).scene.goals);
  await until(async () => distance((await state(page)).goals[id].pose.touch, target) < 1e-3, "the hand to be where it was");
}

async function undoesFromList({ page }) {
  await begin(page, "standing");
  await makeByClick(page, "left_hand");
  await page.getByTestId("tab-together").click();
  const step = page.getByTestId("together-panel").locator(".history li").first();
  await until(async () => (await step.textContent().catch(() => "")).includes("left hand"), "the step in the list");
  await step.getByRole("button").click();
  await until(async () => !("body.left_hand.position" in (await state(page)).scene.goals), "the goal to go");
}
