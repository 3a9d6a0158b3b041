// The four views: what they draw, and how one moves in them.
import assert from "node:assert/strict";
import { apart, begin, drawnShare, figurePose, project, rectOf, state, until } from "../browser.mjs";

export const views = ["top", "perspective", "front", "side"];

export const checks = [
  ["a scene begins from the gallery", beginsFromGallery],
  ["the figure is in each of the four views", ({ page }) => drawsFigure(page)],
  ["a view is maximised by its key and by its title", maximises],
  ["the orthographic views zoom and pan together", navigates],
  ["the perspective view orbits, and a drag on nothing edits nothing", orbits],
  ["the panes are resized by their bars and by keys", resizes],
  ["the figure's eyes lead the perspective view", eyes],
  ["segment frames and limits come on demand", framesAndLimits],
  ["a link carries the view, and no token", carriesView],
  ["a picture is downloaded", downloads],
];

async function beginsFromGallery({ page }) {
  const before = (await state(page)).revision;
  await page.getByTestId("scenes").click();
  await page.getByTestId("scene-standing").click();
  await until(async () => (await state(page)).revision > before && (await state(page)).figures.body?.pose, "the new scene");
}

export async function drawsFigure(page) {
  const { figures } = await until(async () => {
    const now = await state(page);
    return Object.values(now.figures).every(({ pose }) => pose) && now;
  }, "poses");
  const places = Object.values(figures).flatMap(({ pose }) => pose.worldFromSegment.map((place) => place.slice(0, 3)));
  for (const view of views) {
    const rect = await rectOf(page, view);
    const { xs, ys } = await until(async () => {
      const dots = await Promise.all(places.map((place) => project(page, view, place)));
      const [xs, ys] = [dots.map(({ x }) => x), dots.map(({ y }) => y)];
      const across = Math.min(...xs) > rect.left && Math.max(...xs) < rect.right;
      return across && Math.min(...ys) > rect.top && Math.max(...ys) < rect.bottom && { xs, ys };
    }, `the figure to be framed in the ${view} view`);
    // The joints of an upright figure lie on a line from above; its body has some width.
    const x = Math.max(rect.left, Math.min(...xs) - 14);
    const y = Math.max(rect.top + 30, Math.min(...ys) - 14);
    const clip = { x, y, width: Math.min(rect.right, Math.max(...xs) + 14) - x, height: Math.min(rect.bottom, Math.max(...ys) + 14) - y };
    const share = await until(async () => {
      const drawn = await drawnShare(page, clip);
      return drawn > 0.1 && drawn;
    }, `the figure to be drawn in the ${view} view`);
    assert.ok(share < 0.99, `${view}: the ground is seen beside the figure`);
  }
}

async function maximises({ page }) {
  const shown = async () => (await Promise.all(views.map((view) => page.getByTestId(`view-${view}`).isVisible()))).filter(Boolean).length;
  await page.keyboard.press("2");
  assert.equal(await shown(), 1);
  assert.ok(await page.getByTestId("view-front").isVisible());
  await page.keyboard.press("2");
  assert.equal(await shown(), 4);
  await page.getByTestId("title-perspective").dblclick();
  assert.ok(await page.getByTestId("view-perspective").isVisible());
  assert.equal(await shown(), 1);
  await page.keyboard.press("Escape");
  assert.equal(await shown(), 4);
}

async function navigates({ page }) {
  const length = async (view) => {
    const [a, b] = [await project(page, view, [0, 0, 0]), await project(page, view, view === "top" ? [0, 1, 0] : [0, 0, 1])];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  const before = { front: await length("front"), side: await length("side"), top: await length("top") };
  const rect = await rectOf(page, "front");
  const [x, y] = [rect.left + 60, rect.bottom - 60];
  await page.mouse.move(x, y);
  const under = await project(page, "front", [0, 0, 0]);
  await page.mouse.wheel(0, -300);
  await until(async () => (await length("front")) > before.front * 1.1, "the front view to zoom");
  assert.ok((await length("side")) > before.side * 1.1 && (await length("top")) > before.top * 1.1, "the others zoom too");
  const zoom = (await length("front")) / before.front;
  const now = await project(page, "front", [0, 0, 0]);
  assert.ok(Math.abs(now.x - (x + (under.x - x) * zoom)) < 2, "what lies under the pointer stays there");
  const floor = await project(page, "side", [0, 0, 0]);
  await page.mouse.down({ button: "right" });
  await page.mouse.move(x, y - 40, { steps: 3 });
  await page.mouse.up({ button: "right" });
  const moved = await project(page, "side", [0, 0, 0]);
  assert.ok(Math.abs(floor.y - moved.y - 40) < 2, "height is panned in the side view as well");
  await page.keyboard.press("f");
}

async function orbits({ page }) {
  const rect = await rectOf(page, "perspective");
  const [before, revision] = [await project(page, "perspective", [1, 0, 0]), (await state(page)).revision];
  await page.mouse.move(rect.left + 40, rect.bottom - 40);
  await page.mouse.down();
  await page.mouse.move(rect.left + 140, rect.bottom - 60, { steps: 4 });
  await page.mouse.up();
  const after = await project(page, "perspective", [1, 0, 0]);
  assert.ok(Math.hypot(after.x - before.x, after.y - before.y) > 20, "the view turned");
  assert.equal((await state(page)).revision, revision);
}

async function resizes({ page }) {
  const before = await rectOf(page, "top");
  await page.mouse.move(before.right, before.top + 80);
  await page.mouse.down();
  await page.mouse.move(before.right - 120, before.top + 80, { steps: 3 });
  await page.mouse.up();
  const narrow = await rectOf(page, "top");
  assert.ok(Math.abs(before.width - narrow.width - 120) < 8, "the bar follows the hand");
  await page.getByTestId("splitter-y").focus();
  await page.keyboard.press("ArrowDown");
  assert.ok((await rectOf(page, "top")).height > before.height + 5);
  await page.getByTestId("splitter-x").dblclick({ position: { x: 3, y: 60 } });
  await page.getByTestId("splitter-y").dblclick({ position: { x: 60, y: 3 } });
  assert.ok(Math.abs((await rectOf(page, "top")).width - before.width) < 3);
}

async function eyes({ page }) {
  await begin(page, "standing");
  const before = await project(page, "perspective", [2, 0, 1.6]);
  await page.keyboard.press("v");
  await until(async () => (await page.getByTestId("title-perspective").textContent()).includes("eyes of body"), "the eyes");
  const [seen, rect] = [await project(page, "perspective", [4, 0, 1.6]), await rectOf(page, "perspective")];
  assert.ok(Math.abs(seen.x - (rect.left + rect.right) / 2) < 30, "what stands before the figure is before the eyes");
  await page.keyboard.press("v");
  await until(async () => Math.abs((await project(page, "perspective", [2, 0, 1.6])).x - before.x) < 1, "the camera to be where it was");
}

/** Pixels that the front view draws change when they are asked for. */
async function framesAndLimits({ page }) {
  const clip = await rectOf(page, "front");
  const shot = async () => (await page.screenshot({ clip: { x: clip.x + 5, y: clip.y + 40, width: clip.width - 10, height: clip.height - 45 } })).toString("base64");
  // The simulated sensors move in every picture: only what stands still can be compared, so they are looked for by size.
  const plain = (await shot()).length;
  await page.keyboard.press("x");
  await until(async () => (await shot()).length > plain * 1.02, "the frames");
  await page.keyboard.press("x");
  await page.getByTestId("tab-body").click();
  await page.getByTestId("segment-left_upper_arm").getByRole("button", { name: "left upper arm", exact: true }).click();
  await until(async () => (await state(page)).selected.segment?.segment === "left_upper_arm", "the choice");
  const limited = (await shot()).length;
  await page.getByTestId("show-limits").click();
  await until(async () => (await shot()).length < limited * 0.99, "the cone of the shoulder to go");
  await page.getByTestId("show-limits").click();
  await page.keyboard.press("Escape");
}

async function carriesView({ page, open }) {
  await page.keyboard.press("4");
  await page.getByTestId("link").click();
  const address = await until(() => page.evaluate(() => location.hash.includes("view=") && location.href), "the link");
  assert.ok(!address.includes("token"));
  const other = await open({ url: address, waits: true });
  await until(async () => (await rectOf(other, "perspective")).width > 600, "the maximised view");
  const pose = (await figurePose(page))[3].slice(0, 3);
  await until(async () => {
    const [a, b] = [await project(page, "perspective", pose), await project(other, "perspective", pose)];
    return Math.hypot(a.x - b.x, a.y - b.y) < 3;
  }, "both to look from the same place");
  assert.ok(apart(await figurePose(page), await figurePose(other)) < 1e-6);
  await page.keyboard.press("4");
}

async function downloads({ page }) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByTestId("picture").click()]);
  assert.match(download.suggestedFilename(), /^posed-.*\.png$/);
  const stream = await download.createReadStream();
  let size = 0;
  for await (const chunk of stream) size += chunk.length;
  assert.ok(size > 15_000, `${size} bytes are no picture of a figure`);
}
