// All that is frequent, without a mouse.
import assert from "node:assert/strict";
import { begin, distance, figurePose, project, state, until } from "../browser.mjs";

export const checks = [
  ["a goal is made, moved, weighed, switched, undone and removed by keys alone", edits],
  ["a scene is chosen by keys alone", scenes],
  ["the sheet shows every key and closes", sheet],
  ["tabs, goals and padlocks are reached by Tab and the arrows", reaches],
];

const id = "body.left_hand.position";

async function edits({ page }) {
  await begin(page, "standing");
  // The arrows mean the view that the pointer was in last.
  const { x, y } = await project(page, "front", [0, 0, 1]);
  await page.mouse.move(x + 1, y);
  await page.mouse.move(x, y);
  while ((await state(page)).selected.segment?.segment !== "left_hand") await page.keyboard.press("]");
  await page.keyboard.press("Enter");
  await until(async () => (await state(page)).goals[id]?.pose && (await state(page)).selected.goal === id, "the goal");
  const before = (await state(page)).goals[id].target;
  for (let i = 0; i < 8; i++) await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Shift+ArrowRight");
  const moved = await until(async () => {
    const { position } = (await state(page)).scene.goals[id];
    return Math.abs(position[2] - before[2] - 0.08) < 1e-5 && Math.abs(position[1] - before[1] - 0.001) < 1e-5;
  }, "8 cm up and a millimetre to the right of the front view");
  assert.ok(moved);
  await page.keyboard.press("+");
  await until(async () => (await state(page)).scene.goals[id].weight === 12.5, "more weight");
  await page.keyboard.press("o");
  await until(async () => (await state(page)).scene.goals[id].enabled === false, "off");
  await page.keyboard.press("Control+z");
  await until(async () => (await state(page)).scene.goals[id].enabled !== false, "on again");
  await page.keyboard.press("Delete");
  await until(async () => !(id in (await state(page)).scene.goals), "the goal to go");
  while ((await state(page)).selected.segment?.segment !== "left_hand") await page.keyboard.press("]");
  await page.keyboard.press("l");
  await until(async () => "left_hand" in (await state(page)).scene.figures.body.pins, "the pin");
}

async function scenes({ page }) {
  await begin(page, "standing");
  const before = await figurePose(page);
  await page.keyboard.press("n");
  const wanted = page.getByTestId("scene-paper/sitting");
  for (let i = 0; i < 30 && !(await wanted.evaluate((card) => card === document.activeElement)); i++) await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await until(async () => (await state(page)).scene.goals.back && distance((await figurePose(page))[0].slice(0, 3), before[0].slice(0, 3)) > 0.2, "the sitting figure");
}

async function sheet({ page }) {
  await page.keyboard.press("?");
  const help = page.getByTestId("help-sheet");
  await help.waitFor();
  for (const says of ["Make a goal", "Undo what you did last", "Segment frames", "Pin the segment"]) assert.ok((await help.textContent()).includes(says), says);
  await until(() => help.locator("img").evaluate((image) => image.complete && image.naturalWidth > 100), "its picture");
  await page.keyboard.press("Escape");
  await help.waitFor({ state: "hidden" });
}

async function reaches({ page }) {
  await page.getByTestId("tab-goals").focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.evaluate(() => document.activeElement.id), "tab-body");
  assert.ok(await page.getByTestId("body-panel").isVisible());
  const pin = page.getByTestId("segment-lower_torso").getByTestId("pin");
  for (let i = 0; i < 40 && !(await pin.evaluate((button) => button === document.activeElement)); i++) await page.keyboard.press("Tab");
  await page.keyboard.press("Space");
  await until(async () => "lower_torso" in ((await state(page)).scene.figures.body.pins ?? {}), "the pin");
}
