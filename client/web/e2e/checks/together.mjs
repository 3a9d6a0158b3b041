// Two people in one scene.
import assert from "node:assert/strict";
import { distance, project, state, until } from "../browser.mjs";
import { drags, makeByClick } from "./goals.mjs";

export const needs = { user: "ana" };

export const checks = [
  ["each sees who is here, and the other's edits as they come", seesOther],
  ["what one holds, the other cannot take, and is told who holds it", locks],
  ["a name that is changed is seen by others", renames],
];

async function seesOther({ page, open }) {
  const other = await open({ user: "bo" });
  page.other = other;
  const id = await makeByClick(page);
  await page.getByTestId("tab-together").click();
  await until(async () => (await page.getByTestId("together-panel").textContent()).includes("bo"), "bo in the list");
  await until(async () => (await state(other)).goals[id]?.pose, "the goal at the other's");
  const held = await drags(page, "front", [50, -80], id);
  await until(async () => distance((await state(other)).goals[id].target, held) < 1e-4, "the drag at the other's");
}

async function locks({ page }) {
  const { other } = page;
  const id = await makeByClick(page);
  await until(async () => (await state(other)).goals[id]?.pose, "the goal at the other's");
  await other.keyboard.press("f");
  const from = await project(page, "front", (await state(page)).goals[id].target);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 20, from.y - 30, { steps: 3 });
  // While the hand is on it, moving or not: a hold lasts until five idle seconds.
  const shake = setInterval(() => void page.mouse.move(from.x + 20 + Math.random() * 4, from.y - 30).catch(() => {}), 400);
  try {
    await other.getByTestId("tab-goals").click();
    await until(async () => (await other.getByTestId(`goal-${id}`).getByTestId("goal-held").textContent().catch(() => "")) === "held by ana", "to see who holds it");
    const at = await project(other, "front", (await state(other)).goals[id].target);
    await other.mouse.move(at.x, at.y);
    await other.mouse.down();
    await other.mouse.move(at.x + 80, at.y, { steps: 4 });
    await other.mouse.up();
    assert.match(await other.getByTestId("toast").textContent(), /ana holds/);
    const { target } = (await state(other)).goals[id];
    assert.ok(distance(target, (await state(page)).goals[id].target) < 0.03, "the cube stays with who holds it");
  } finally {
    clearInterval(shake);
    await page.mouse.up();
  }
  await until(async () => (await other.getByTestId(`goal-${id}`).getByTestId("goal-held").count()) === 0, "the lock to go");
  await until(async () => {
    const { goals, scene } = await state(page);
    const arrived = distance(scene.goals[id].position, goals[id].target) < 1e-5;
    return arrived && distance((await state(other)).goals[id].target, goals[id].target) < 1e-4;
  }, "where it was let go");
  await drags(other, "front", [40, -20], id);
}

async function renames({ page }) {
  const { other } = page;
  await other.getByTestId("tab-together").click();
  await other.getByTestId("my-name").fill("boris");
  await other.getByTestId("my-name").blur();
  await page.getByTestId("tab-together").click();
  await until(async () => (await page.getByTestId("together-panel").textContent()).includes("boris"), "the new name");
}
