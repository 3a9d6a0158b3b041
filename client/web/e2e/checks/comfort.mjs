// For everybody: labels for screen readers, contrast in dark and light, a laptop, a tablet, a phone; the first steps.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { begin, call, project, rectOf, state, until } from "../browser.mjs";

const axe = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

export const checks = [
  ["axe finds nothing, in dark, in any panel or sheet", ({ page }) => accessible(page)],
  ["axe finds nothing in light", async ({ open }) => accessible(await open({ colorScheme: "light" }))],
  ["the colours are chosen, and stay", theme],
  ["lengths are in millimetres or metres", units],
  ["a small laptop, a tablet and a phone have all of it, and nothing that is told moves the views", small],
  ["the first steps teach by doing, once", firstSteps],
];

/** What axe has against the page as it is now: nothing. */
export async function findsNothing(page, where) {
  // By way of the driver: the page's own policy lets no foreign script in.
  await page.evaluate(await readFile(axe, "utf8"));
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(" & ")}`), [], where);
}

async function accessible(page) {
  await begin(page, "paper/unreachable");
  const look = (where) => findsNothing(page, where);
  await page.keyboard.press(".");
  await look("goals");
  await page.keyboard.press("]");
  await page.getByTestId("joint-panel").waitFor();
  await look("body");
  for (const tab of ["trackers", "together"]) {
    await page.getByTestId(`tab-${tab}`).click();
    await look(tab);
  }
  for (const key of ["?", "n"]) {
    await page.keyboard.press(key);
    await page.locator("dialog[open]").waitFor();
    await look(key);
    await page.keyboard.press("Escape");
  }
}

async function theme({ page }) {
  const now = () => page.evaluate(() => document.documentElement.dataset.theme);
  assert.equal(await now(), "dark");
  const button = page.getByTestId("theme");
  await button.click();
  await button.click();
  await until(async () => (await now()) === "light", "light");
  await page.reload();
  await until(async () => (await now()) === "light", "light after a reload");
  await button.click();
  await until(async () => (await now()) === "dark", "the system's own again");
  await until(async () => (await page.getByTestId("connection").textContent()) === "connected", "the connection");
}

async function units({ page }) {
  await begin(page, "paper/unreachable");
  await page.getByTestId("tab-goals").click();
  const error = page.getByTestId("goal-error").first();
  await until(async () => /mm$/.test(await error.textContent()), "millimetres");
  await page.getByTestId("units").click();
  await until(async () => /^\d\.\d{3} m$/.test(await error.textContent()), "metres");
  await page.getByTestId("units").click();
}

async function small({ open }) {
  for (const viewport of [{ width: 1180, height: 700 }, { width: 960, height: 580 }, { width: 820, height: 1100 }, { width: 420, height: 860 }]) {
    const page = await open({ viewport });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${viewport.width}: nothing sticks out`);
    for (const id of ["tab-goals", "tab-together", "help", "tool-goal"]) {
      const box = await page.getByTestId(id).boundingBox();
      assert.ok(box.x >= 0 && box.x + box.width <= viewport.width && box.y >= 0 && box.y + box.height <= viewport.height, `${id} is on the screen`);
    }
    for (const view of ["top", "front", "side", "perspective"]) assert.ok((await rectOf(page, view)).height > 90, `${view} has room`);
    // Whatever the meter says, the views stay where they are: a bar that wrapped would move them under a hand.
    const [meter, before] = [page.getByTestId("meter-age"), await rectOf(page, "front")];
    await meter.evaluate((age) => (age.firstChild.data = "12345 ms"));
    assert.deepEqual(await page.evaluate(() => document.querySelector("[data-testid=view-front]").getBoundingClientRect().toJSON()), before);
    await page.context().close();
  }
}

async function firstSteps({ open }) {
  const page = await open({ hints: true });
  await begin(page, "standing");
  const hints = page.getByTestId("hints");
  const now = () => hints.locator("li.now b").textContent();
  assert.equal(await now(), "Make a goal");
  const touch = await page.evaluate(() => window.posed.views.touchPoint("body", "right_hand"));
  const at = await project(page, "front", touch);
  await page.keyboard.press("g");
  await page.mouse.click(at.x, at.y);
  await until(async () => (await now()) === "Pull", "the second step");
  const from = await project(page, "front", (await state(page)).goals["body.right_hand.position"].target);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 40, from.y - 40, { steps: 4 });
  await page.mouse.up();
  await until(async () => (await now()) === "Change your mind", "the third step");
  await page.keyboard.press("Control+z");
  await until(async () => !(await hints.isVisible()), "the end of the lesson");
  await page.reload();
  await until(async () => (await page.getByTestId("connection").textContent()) === "connected", "the connection");
  assert.ok(!(await hints.isVisible()), "never again");
  await call(page, "scene.new", { template: "standing", force: true });
}
