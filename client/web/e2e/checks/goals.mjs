// Goals: made by a click, dragged in every view, weighed, explained.
import assert from "node:assert/strict";
import { apart, begin, call, distance, figurePose, project, rectOf, state, until } from "../browser.mjs";
import { choose } from "./body.mjs";

export const hand = "body.right_hand.position";

export const checks = [
  ["a click with the tool makes a goal at the hand", ({ page }) => makeByClick(page).then(() => {})],
  ["the cube is dragged in the front view and the hand follows", ({ page }) => drags(page, "front", [70, -90]).then(() => {})],
  ["the cube is dragged in the top view and the hand follows", ({ page }) => drags(page, "top", [25, 40])],
  ["the cube is dragged in the side view and the hand follows", ({ page }) => drags(page, "side", [30, 25])],
  ["the cube is dragged in the perspective view and the hand follows", ({ page }) => drags(page, "perspective", [-50, 30])],
  ["the gizmo moves it along one axis alone", gizmo],
  ["a drag with Ctrl snaps to the grid", snaps],
  ["a click on a site takes the site, elsewhere the point itself", sites],
  ["the weight slides over decades, and off is off", weighs],
  ["the list says state, error, share of force and why not", explains],
  ["weights decide where two goals pull against each other", balances],
  ["every kind of goal can be made, and its handle dragged", kinds],
  ["balance and posture of the whole figure are made by hand, and what it stands on is drawn", wholeFigure],
  ["an orientation goal is turned by its rings", turns],
  ["what is pointed at is labelled with distance and weight", labels],
  ["a goal that is taken away under the hand is said", refusal],
  ["what the daemon refuses is said, with its hint", refused],
];

export async function makeByClick(page, segment = "right_hand", view = "front") {
  await begin(page, "standing");
  const touch = await page.evaluate((name) => window.posed.views.touchPoint("body", name), segment);
  await page.keyboard.press("g");
  const at = await project(page, view, touch);
  await page.mouse.click(at.x, at.y);
  const id = `body.${segment}.position`;
  await until(async () => (await state(page)).goals[id]?.pose, "the goal");
  await until(async () => (await state(page)).selected.goal === id, "the goal to be chosen");
  return id;
}

/** Where a point is once the view stands: a page that has just opened still finds its size. */
async function still(page, view, point) {
  let last = await project(page, view, point);
  return until(async () => {
    // On a busy machine two looks may fall between the same two frames.
    await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
    const now = await project(page, view, point);
    const same = Math.hypot(now.x - last.x, now.y - last.y) < 0.01;
    last = now;
    return same && now;
  }, "the view to stand");
}

export async function drags(page, view, [dx, dy], id = hand) {
  if (!(await state(page)).goals[id]?.pose) await makeByClick(page);
  const before = (await state(page)).goals[id];
  const from = await still(page, view, before.target);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + dx, from.y + dy, { steps: 6 });
  // A page behind another has its next frame later.
  const held = await until(async () => {
    const { target } = (await state(page)).goals[id];
    const shown = await project(page, view, target);
    return Math.hypot(shown.x - from.x - dx, shown.y - from.y - dy) < 2 && target;
  }, "the cube to be under the pointer");
  await page.mouse.up();
  const after = await until(async () => {
    const { goals, scene } = await state(page);
    const kept = scene.goals[id].position && distance(scene.goals[id].position, held) < 1e-5;
    return kept && distance(goals[id].pose.target, held) < 1e-4 && goals[id].pose;
  }, "the daemon's answer to the drag");
  assert.ok(distance(after.touch, before.pose.touch) > 0.02, "the hand moved");
  return held;
}

async function gizmo({ page }) {
  await makeByClick(page);
  const before = (await state(page)).goals[hand].target;
  const [centre, { height }] = [await project(page, "side", before), await rectOf(page, "side")];
  // The arrow of the gizmo that points along +X, which is to the right in the side view.
  for (const reach of [0.09, 0.11, 0.07].map((share) => share * height)) {
    await page.mouse.move(centre.x + reach, centre.y);
    await page.mouse.down();
    await page.mouse.move(centre.x + reach + 50, centre.y + 35, { steps: 6 });
    await page.mouse.up();
    const now = (await state(page)).goals[hand].target;
    if (distance(now, before) < 1e-6) continue;
    assert.ok(now[0] - before[0] > 0.05, "it went along X");
    assert.ok(Math.abs(now[1] - before[1]) < 1e-5 && Math.abs(now[2] - before[2]) < 1e-5, "and along nothing else");
    return;
  }
  assert.fail("no handle of the gizmo was where its arrow is drawn");
}

async function snaps({ page }) {
  await makeByClick(page);
  const before = (await state(page)).goals[hand].target;
  const from = await project(page, "front", before);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.keyboard.down("Control");
  await page.mouse.move(from.x + 63, from.y - 57, { steps: 6 });
  await page.mouse.up();
  await page.keyboard.up("Control");
  const [, y, z] = await until(async () => {
    const { goals, scene } = await state(page);
    return distance(scene.goals[hand].position, before) > 0.1 && distance(scene.goals[hand].position, goals[hand].target) < 1e-5 && scene.goals[hand].position;
  }, "the daemon's answer");
  for (const value of [y, z]) assert.ok(Math.abs(value / 0.05 - Math.round(value / 0.05)) < 1e-4, `${value} lies on the grid of 5 cm`);
}

async function sites({ page }) {
  await begin(page, "standing");
  // Larger, so that fingertip and palm lie apart.
  await page.keyboard.press("2");
  const count = async () => Object.keys((await state(page)).scene.goals).length;
  const clickAt = async (point, dx = 0, dy = 0) => {
    const before = await count();
    const at = await project(page, "front", point);
    await page.keyboard.down("Shift");
    await page.mouse.click(at.x + dx, at.y + dy);
    await page.keyboard.up("Shift");
    await until(async () => (await count()) > before, "a goal more");
  };
  const head = await page.evaluate(() => window.posed.views.touchPoint("body", "head"));
  // The crown lies on the edge of the head as the front view draws it.
  await clickAt(head, 0, 3);
  assert.equal((await state(page)).scene.goals["body.head.position"].at, "head");
  const thigh = (await figurePose(page))[12].slice(0, 3);
  await clickAt([thigh[0], thigh[1], thigh[2] - 0.2]);
  await clickAt([thigh[0], thigh[1], thigh[2] - 0.3]);
  const points = Object.values((await state(page)).scene.goals).filter(({ at }) => at?.point);
  assert.equal(points.length, 2, "two points of one segment are two goals");
  assert.ok(points.every(({ at }) => at.segment === "left_upper_leg"));
  await page.keyboard.press("2");
}

async function weighs({ page }) {
  await makeByClick(page);
  const row = page.getByTestId(`goal-${hand}`);
  const weight = async () => (await state(page)).scene.goals[hand].weight;
  const goalState = async () => (await state(page)).goals[hand].pose?.state ?? "off";
  await row.getByTestId("goal-weight").fill("2");
  await until(async () => (await weight()) === 100, "the weight");
  await until(async () => (await row.getByTestId("goal-weight-value").textContent()) === "100", "its number");
  await row.getByTestId("goal-enabled").click();
  await until(async () => (await goalState()) === "off", "the goal to be off");
  await row.getByTestId("goal-enabled").click();
  await until(async () => (await goalState()) !== "off", "the goal to be on");
}

async function explains({ page }) {
  await makeByClick(page);
  await page.getByTestId(`goal-${hand}`).getByTestId("goal-z").fill("3500");
  await page.getByTestId(`goal-${hand}`).getByTestId("goal-z").blur();
  const row = page.getByTestId(`goal-${hand}`);
  await until(async () => (await row.getByTestId("goal-state").textContent()) !== "reached", "the goal to be out of reach");
  await until(async () => /pinned|reach|limit/.test(await row.getByTestId("goal-causes").textContent().catch(() => "")), "the causes in words");
  const causes = await row.getByTestId("goal-causes").textContent();
  assert.ok(!/[_{}]/.test(causes), `"${causes}" is plain words`);
  assert.match(await row.getByTestId("goal-error").textContent(), /^\d{3,4} mm$/);
  assert.match(await row.getByTestId("goal-share").textContent(), /^\d+ % of the force$/);
}

async function balances({ page }) {
  await begin(page, "paper/unreachable");
  const errors = async () => Object.values((await state(page)).goals).map(({ pose }) => pose.error).sort((a, b) => a - b);
  const before = await errors();
  const goals = (await state(page)).scene.goals;
  const weak = Object.keys(goals).find((id) => goals[id].weight === 10);
  const first = (await state(page)).goals[weak].pose.error;
  await page.keyboard.press(".");
  while ((await state(page)).selected.goal !== weak) await page.keyboard.press(".");
  await page.getByTestId(`goal-${weak}`).getByTestId("goal-weight").fill("3");
  await until(async () => (await state(page)).goals[weak].pose.error < first * 0.6, "the heavier goal to come nearer");
  assert.ok((await errors()).at(-1) > 0.01 && before.length === 2);
}

async function kinds({ page }) {
  await begin(page, "standing");
  const made = {};
  for (const [kind, payload] of [["orientation"], ["pose"], ["aim"], ["plane"], ["line"], ["distance"], ["pole", "aim"]]) {
    await choose(page, "left_hand");
    await page.getByTestId("tab-goals").click();
    const before = Object.keys((await state(page)).scene.goals);
    await page.getByTestId("add-goal").selectOption(kind);
    const id = await until(async () => Object.keys((await state(page)).scene.goals).find((other) => !before.includes(other)), `a goal of kind ${kind}`);
    made[kind] = id;
    assert.equal((await state(page)).scene.goals[id].kind, payload ?? kind);
    await call(page, "goal.set", { id, enabled: false });
  }
  const still = await figurePose(page);
  assert.ok(apart(still, await figurePose(page)) < 0.02, "goals of every kind are met where the figure stands");
  // The pole swivels the elbow: its point is a handle like another.
  await call(page, "goal.set", { id: made.pole, enabled: true });
  await until(async () => (await state(page)).goals[made.pole].pose?.state !== "off", "the pole to pull");
  const before = (await state(page)).goals[made.pole].target;
  const from = await project(page, "side", before);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x - 40, from.y - 60, { steps: 5 });
  await page.mouse.up();
  await until(async () => distance((await state(page)).scene.goals[made.pole].aim.point, before) > 0.05, "the pole's point to move");
}

async function wholeFigure({ page }) {
  const { revision } = await call(page, "scene.new", { template: "standing", force: true });
  await call(page, "goal.clear", { figure: "body" });
  await until(async () => (await state(page)).poseRevision > revision && Object.keys((await state(page)).scene.goals).length === 0, "a figure without goals");
  await page.keyboard.press("Escape");
  await page.getByTestId("tab-goals").click();
  const rect = await rectOf(page, "top");
  const clip = { x: rect.left + 5, y: rect.top + 40, width: rect.width - 10, height: rect.height - 45 };
  const bare = (await page.screenshot({ clip })).length;
  await page.getByTestId("add-goal").selectOption("balance");
  const goal = await until(async () => (await state(page)).scene.goals["body.balance"], "the goal of balance");
  assert.deepEqual([...goal.balance.support].sort(), ["left_foot", "right_foot"]);
  await until(async () => (await page.screenshot({ clip })).length > bare * 1.02, "the support to be drawn");
  const before = await figurePose(page);
  await page.getByTestId("add-goal").selectOption("posture");
  const posture = await until(async () => (await state(page)).scene.goals["body.posture"]?.posture, "the goal of posture");
  assert.equal(Object.keys(posture.joints).length, 17);
  await until(async () => (await state(page)).goals["body.posture"].pose?.state === "reached", "the posture to be what it is");
  assert.ok(apart(before, await figurePose(page)) < 0.02, "it is met as the figure stands");
  await page.getByTestId("add-goal").selectOption("rest");
  await until(async () => (await state(page)).scene.goals["body.posture"].posture.pose === "rest", "the goal of rest");
  await until(async () => apart(before, await figurePose(page)) > 0.1, "the arms to rise");
}

async function turns({ page }) {
  await begin(page, "standing");
  await call(page, "goal.set", { id: "look", figure: "body", at: "head", orientation: { quat_xyzw: [0, 0, 0, 1] } });
  await until(async () => (await state(page)).goals.look?.pose, "the goal");
  await page.keyboard.press(".");
  while ((await state(page)).selected.goal !== "look") await page.keyboard.press(".");
  // The ring about Z is a circle in the top view.
  const turned = async () => Math.abs((await state(page)).scene.goals.look.orientation.quat_xyzw[2]) > 0.1;
  for (const radius of await ringRadii(page, "top")) {
    // A press that hits no ring pans.
    const centre = await project(page, "top", (await state(page)).goals.look.target);
    await page.mouse.move(centre.x + radius * 0.7, centre.y - radius * 0.7);
    await page.mouse.down();
    await page.mouse.move(centre.x + radius, centre.y + 5, { steps: 6 });
    await page.mouse.up();
    if (await until(turned, "a turn", 1200).catch(() => false)) return;
  }
  assert.fail("no ring was where it is drawn");
}

/** Where three's gizmo has its rings in an orthographic view: half of 0.85 quarters of the view's height, and near it. */
export async function ringRadii(page, view) {
  const { height } = await rectOf(page, view);
  return [0.106, 0.095, 0.118, 0.16].map((share) => share * height);
}

async function labels({ page }) {
  await makeByClick(page);
  await page.keyboard.press("Escape");
  const at = await project(page, "front", (await state(page)).goals[hand].target);
  await page.mouse.move(at.x + 1, at.y + 1);
  const label = page.getByTestId("view-front").locator(".label[data-kind=goal]");
  await until(async () => /mm.*weight 10/.test((await label.textContent().catch(() => "")) ?? ""), "the label");
}

/** Another client takes the goal away while the hand is on its cube. */
async function refusal({ page }) {
  await makeByClick(page);
  const from = await project(page, "front", (await state(page)).goals[hand].target);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await call(page, "goal.remove", { id: hand, force: true });
  await until(async () => !(hand in (await state(page)).goals), "the goal to go");
  await page.mouse.move(from.x + 30, from.y + 30, { steps: 3 });
  await page.mouse.up();
  await page.getByTestId("toast").waitFor({ state: "visible" });
  assert.match(await page.getByTestId("toast").textContent(), /removed the goal right hand/);
}

async function refused({ page }) {
  await page.keyboard.press("n");
  await page.getByTestId("save-name").fill("no such/name");
  await page.getByTestId("save-scene").click();
  await page.keyboard.press("Escape");
  await until(async () => /[./]/.test(await page.getByTestId("toast").textContent()), "the refusal");
  assert.ok((await page.getByTestId("toast").locator(".toast-hint").textContent()).length > 0);
}
