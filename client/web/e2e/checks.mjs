// What the viewer must do against a living daemon. Each check is one line of output.
import assert from "node:assert/strict";
import { litShare, project, state, until } from "./browser.mjs";

const kGoal = "body.right_hand.position";
const kViews = ["top", "perspective", "front", "side"];

export const checks = [
  ["connects to the daemon", connects],
  ["begins a scene from the menu", beginsScene],
  ["draws the figure in each of the four views", drawsFigure],
  ["makes a goal by shift-click on the right hand", makesGoal],
  ["drags the cube in the front view and the hand follows", (page) => drags(page, "front", [70, -90])],
  ["drags the cube in the top view and the hand follows", (page) => drags(page, "top", [25, 40])],
  ["drags the cube in the side view and the hand follows", (page) => drags(page, "side", [30, 25])],
  ["drags the cube in the perspective view and the hand follows", (page) => drags(page, "perspective", [-50, 30])],
  ["sets a goal's weight and switches it off and on", setsWeight],
  ["maximises a view by its key and by its title", maximises],
  ["zooms and pans the orthographic views together", navigates],
  ["lists the tracker stations", listsTrackers],
  ["binds a sensor to the goal and lets it go", binds],
  ["removes the goal", removesGoal],
  ["shows what the daemon refuses", showsRefusal],
];

async function connects(page) {
  const pill = page.getByTestId("connection");
  await until(async () => (await pill.textContent()) === "connected", "the connection");
}

async function beginsScene(page) {
  const menu = page.getByTestId("scene-menu");
  await until(async () => (await menu.locator("option").count()) > 1, "the templates");
  const before = (await state(page)).revision;
  await menu.selectOption("new:standing");
  await until(async () => (await state(page)).revision > before, "the new scene");
  await until(async () => (await state(page)).figures.body?.pose, "the figure's pose");
}

async function drawsFigure(page) {
  const { figures } = await until(async () => {
    const now = await state(page);
    return now.figures.body?.pose && now;
  }, "a pose");
  const places = figures.body.pose.worldFromSegment.map(([x, y, z]) => [x, y, z]);
  assert.equal(places.length, figures.body.segments.length);
  for (const view of kViews) {
    const rect = await page.evaluate((name) => window.posed.views.rect(name).toJSON(), view);
    const { xs, ys } = await until(async () => {
      const dots = await Promise.all(places.map((place) => project(page, view, place)));
      const [xs, ys] = [dots.map(({ x }) => x), dots.map(({ y }) => y)];
      const across = Math.min(...xs) > rect.left && Math.max(...xs) < rect.right;
      return across && Math.min(...ys) > rect.top && Math.max(...ys) < rect.bottom && { xs, ys };
    }, `the figure to be framed in the ${view} view`);
    // The joints of an upright figure lie on a line from above; its body has some width.
    const clip = {
      x: Math.min(...xs) - 8,
      y: Math.min(...ys) - 8,
      width: Math.max(...xs) - Math.min(...xs) + 16,
      height: Math.max(...ys) - Math.min(...ys) + 16,
    };
    const share = await litShare(page, clip);
    assert.ok(share > 0.1, `${(share * 100).toFixed(1)} % of the figure's rectangle is lit in the ${view} view`);
  }
}

async function makesGoal(page) {
  const touch = await page.evaluate(() => window.posed.views.touchPoint("body", "right_hand"));
  const at = await project(page, "front", touch);
  await page.keyboard.down("Shift");
  await page.mouse.click(at.x, at.y);
  await page.keyboard.up("Shift");
  await until(async () => (await state(page)).goals[kGoal]?.pose, "the goal");
  await page.getByTestId(`goal-${kGoal}`).waitFor();
}

async function drags(page, view, [dx, dy]) {
  const before = (await state(page)).goals[kGoal];
  const from = await project(page, view, before.target);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + dx, from.y + dy, { steps: 8 });
  const held = (await state(page)).goals[kGoal].target;
  const shown = await project(page, view, held);
  assert.ok(Math.hypot(shown.x - from.x - dx, shown.y - from.y - dy) < 2, "the cube stays under the pointer");
  await page.mouse.up();
  const after = await until(async () => {
    const { goals, scene } = await state(page);
    const kept = distance(scene.goals[kGoal].position, held) < 1e-5;
    return kept && distance(goals[kGoal].pose.target, held) < 1e-4 && goals[kGoal].pose;
  }, "the daemon's answer to the drag");
  assert.ok(distance(after.touch, before.pose.touch) > 0.02, "the hand moved");
}

async function setsWeight(page) {
  const row = page.getByTestId(`goal-${kGoal}`);
  const weight = async () => (await state(page)).scene.goals[kGoal].weight;
  const goalState = async () => (await state(page)).goals[kGoal].pose?.state ?? "off";
  await row.getByTestId("goal-weight").fill("2");
  await until(async () => (await weight()) === 100, "the weight");
  assert.equal(await row.getByTestId("goal-weight-value").textContent(), "100");
  await row.getByTestId("goal-enabled").click();
  await until(async () => (await goalState()) === "off", "the goal to be off");
  await row.getByTestId("goal-enabled").click();
  await until(async () => (await goalState()) !== "off", "the goal to be on");
}

async function maximises(page) {
  const shown = async () => (await Promise.all(kViews.map((view) => page.getByTestId(`view-${view}`).isVisible()))).filter(Boolean).length;
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

async function navigates(page) {
  const length = async (view) => {
    const [a, b] = [await project(page, view, [0, 0, 0]), await project(page, view, view === "top" ? [0, 1, 0] : [0, 0, 1])];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  const before = { front: await length("front"), side: await length("side"), top: await length("top") };
  const rect = await page.evaluate(() => window.posed.views.rect("front").toJSON());
  await page.mouse.move(rect.left + 60, rect.bottom - 60);
  await page.mouse.wheel(0, -300);
  await until(async () => (await length("front")) > before.front * 1.1, "the front view to zoom");
  assert.ok((await length("side")) > before.side * 1.1 && (await length("top")) > before.top * 1.1, "the others zoom too");
  const floor = await project(page, "side", [0, 0, 0]);
  await page.mouse.down({ button: "right" });
  await page.mouse.move(rect.left + 60, rect.bottom - 100, { steps: 3 });
  await page.mouse.up({ button: "right" });
  const moved = await project(page, "side", [0, 0, 0]);
  assert.ok(Math.abs(floor.y - moved.y - 40) < 2, "height is panned in the side view as well");
  await page.keyboard.press("f");
}

async function listsTrackers(page) {
  const { trackers } = await until(async () => {
    const now = await state(page);
    return now.trackers.some(({ state: phase }) => phase === "streaming") && now;
  }, "a station that streams");
  for (const { tracker, sensors } of trackers) {
    await page.getByTestId(`tracker-${tracker}`).waitFor();
    for (const sensor of sensors) await page.getByTestId(`sensor-${sensor}`).waitFor();
  }
  await until(async () => Object.keys((await state(page)).sensors).length > 0, "a sensor's place");
}

async function binds(page) {
  const { trackers } = await state(page);
  const sensor = trackers.find(({ state: phase }) => phase === "streaming").sensors[0];
  const select = page.getByTestId(`sensor-${sensor}`).getByTestId("sensor-goal");
  await select.selectOption(kGoal);
  const bound = async () => {
    const { bindings } = (await state(page)).scene;
    return Object.values(bindings).some((binding) => binding.sensor === sensor && binding.to.goal === kGoal);
  };
  await until(bound, "the binding");
  const poses = new Set();
  await until(async () => {
    poses.add(JSON.stringify((await state(page)).goals[kGoal].target));
    return poses.size > 2;
  }, "the goal to follow the sensor");
  await select.selectOption("");
  await until(async () => !(await bound()), "the binding to go");
}

/** Another client takes the goal away while the hand is on its cube. */
async function showsRefusal(page) {
  await beginsScene(page); // the arm hangs down again, where the hand is in sight
  await makesGoal(page);
  const { target } = (await state(page)).goals[kGoal];
  const from = await project(page, "front", target);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.evaluate((id) => {
    const socket = new WebSocket(new URL("ws", document.baseURI).href.replace(/^http/, "ws"));
    socket.onopen = () => socket.send(JSON.stringify({ jsonrpc: "2.0", id: 1, method: "goal.remove", params: { id } }));
    return new Promise((resolve) => (socket.onmessage = () => resolve(socket.close())));
  }, kGoal);
  await until(async () => !(kGoal in (await state(page)).goals), "the goal to go");
  await page.mouse.move(from.x + 30, from.y + 30, { steps: 3 });
  await page.mouse.up();
  await page.getByTestId("toast").waitFor({ state: "visible" });
  assert.ok((await page.getByTestId("toast").textContent()).length > 0);
}

async function removesGoal(page) {
  await page.getByTestId(`goal-${kGoal}`).getByTestId("goal-remove").click();
  await until(async () => !(kGoal in (await state(page)).goals), "the goal to go");
}

function distance(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** A scene worth looking at: the paper's sitting figure. */
export async function takeShot(page, path) {
  const menu = page.getByTestId("scene-menu");
  const templates = await menu.locator("option").evaluateAll((options) => options.map(({ value }) => value));
  const wanted = ["new:paper/sitting", "new:standing"].find((name) => templates.includes(name));
  if (wanted) {
    const before = (await state(page)).revision;
    await menu.selectOption(wanted);
    await until(async () => (await state(page)).poseRevision > before, "the scene's pose");
  }
  await page.getByTestId("toast").waitFor({ state: "hidden" });
  await page.mouse.move(5, 5);
  await page.keyboard.press("f");
  await page.waitForTimeout(500);
  await page.screenshot({ path });
}
