// Every scene of the gallery, with a figure inside the frame of every view; pictures of them are left to be looked at.
import assert from "node:assert/strict";
import { join } from "node:path";
import { begin, call, state } from "../browser.mjs";
import { drawsFigure } from "./views.mjs";

const names = [
  "standing", "empty", "paper/single-reach", "paper/two-reaches", "paper/unreachable", "paper/sitting", "paper/restrained", "paper/seat-belt", "paper/two-hands", "paper/straighten",
];

export const checks = [
  ["the gallery shows every scene that the daemon has", showsAll],
  ...names.map((name) => [name, (tools) => renders(tools, name)]),
];

async function showsAll({ page }) {
  const { templates } = await call(page, "scene.list");
  assert.deepEqual([...templates].sort(), [...names].sort());
  await page.keyboard.press("n");
  for (const name of names) {
    const card = page.getByTestId(`scene-${name}`);
    await card.scrollIntoViewIfNeeded();
    await card.locator("img").evaluate((image) => (image.complete ? undefined : new Promise((resolve) => (image.onload = resolve))));
    assert.ok(await card.locator("img").evaluate((image) => image.naturalWidth > 100), `a picture of ${name}`);
  }
  await page.keyboard.press("Escape");
}

async function renders({ page, shots }, name) {
  await begin(page, name);
  await drawsFigure(page);
  assert.equal(Object.keys((await state(page)).figures).length, 1);
  if (shots) await page.screenshot({ path: join(shots, `scene-${name.replace("/", "-")}.png`) });
}
