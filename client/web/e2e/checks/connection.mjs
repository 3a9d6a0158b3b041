// The daemon goes away under an open page, and comes back.
import assert from "node:assert/strict";
import { distance, project, state, until } from "../browser.mjs";
import { drags, hand, makeByClick } from "./goals.mjs";

export const checks = [["a killed daemon is shown; what was edited meanwhile waits, goes out, and the camera stays", survives]];

async function survives({ page, daemon }) {
  await makeByClick(page);
  await page.keyboard.press("4");
  await page.keyboard.press("4");
  await page.mouse.move(700, 500);
  const cameras = await page.evaluate(() => window.posed.views.cameras);
  await daemon.stop("SIGKILL");
  await until(async () => (await page.getByTestId("connection").textContent()).startsWith("lost"), "the loss to be shown");
  const from = await project(page, "front", (await state(page)).goals[hand].target);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 50, from.y - 80, { steps: 5 });
  await page.mouse.up();
  const held = (await state(page)).goals[hand].target;
  const shown = await project(page, "front", held);
  assert.ok(Math.hypot(shown.x - from.x - 50, shown.y - from.y + 80) < 3, "the cube follows the hand without a daemon");
  await until(async () => /wait/.test(await page.getByTestId("waiting").textContent()) && (await state(page)).waiting > 0, "the edit to be seen waiting");
  // Refused sockets are all that the page may complain of meanwhile.
  await daemon.start();
  await until(async () => (await page.getByTestId("connection").textContent()) === "connected", "the connection", 60_000);
  await until(async () => distance((await state(page)).scene.goals[hand].position, held) < 1e-5, "the edit to be done");
  await until(async () => (await state(page)).waiting === 0 && distance((await state(page)).goals[hand].pose.touch, held) < 0.01, "the hand to be there");
  assert.deepEqual(await page.evaluate(() => window.posed.views.cameras), cameras, "the camera stayed");
  await drags(page, "front", [-30, 30]);
  await page.keyboard.press("Control+z");
  await until(async () => distance((await state(page)).scene.goals[hand].position, held) < 1e-5, "the undo after all that");
  page.complaints.splice(0, Infinity, ...page.complaints.filter((text) => !/WebSocket connection to .* failed|ERR_CONNECTION_REFUSED/.test(text)));
}
