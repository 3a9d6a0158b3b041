// The simulated tracker: seen, and bound to what it is to lead.
import assert from "node:assert/strict";
import { begin, call, distance, project, state, until } from "../browser.mjs";
import { findsNothing } from "./comfort.mjs";
import { hand, makeByClick } from "./goals.mjs";

const sensor = "simulated:1";

export const checks = [
  ["stations are listed with state, rate and places", withTracker(lists)],
  ["a sensor leads a goal, and lets it go", withTracker(leads)],
  ["a sensor is dropped on a cube", withTracker(drops)],
  ["a sensor leads an object", withTracker(leadsObject)],
  ["a sensor turns a joint", withTracker(turns)],
  ["a sensor is the camera, with a clutch", withTracker(looks)],
  ["a camera is put where one looks from, then into the figure's eyes, and looked through", seats],
  ["the walk calibrates a stylus: tip, known points, straight ahead, and says how far off it is; its button is shown", calibrates],
];

/** One daemon with a tracker and one page on it for most of these. */
let page = null;
function withTracker(run) {
  return async (tools) => {
    // The page is closed with the suite, and its daemon with it.
    if (!page) {
      const daemon = await tools.daemonWith(["--tracker", "simulated"]).start();
      page = await tools.open({ url: daemon.url });
      page.context().on("close", () => void daemon.end());
    }
    return run({ ...tools, page });
  };
}

const bindings = async (page) => Object.values((await state(page)).scene.bindings);

async function lists({ page }) {
  await page.getByTestId("tab-trackers").click();
  await until(async () => (await page.getByTestId("tracker-state").textContent()) === "streaming", "a station that streams");
  await until(async () => /^\d+ Hz$/.test(await page.getByTestId("tracker-rate").textContent()), "its rate");
  await until(async () => /^\d+ ms ±\d+\.\d ms$/.test(await page.getByTestId("tracker-age").textContent()), "the age and evenness of its samples");
  await until(async () => /\d/.test(await page.getByTestId(`sensor-${sensor}`).getByTestId("sensor-place").textContent()), "a sensor's place");
}

async function follows(page) {
  const poses = new Set();
  await until(async () => {
    poses.add(JSON.stringify((await state(page)).goals[hand].target));
    return poses.size > 2;
  }, "the goal to follow the sensor");
}

async function leads({ page }) {
  await makeByClick(page);
  await page.getByTestId("tab-trackers").click();
  const row = page.getByTestId(`sensor-${sensor}`);
  await row.getByTestId("sensor-target").selectOption({ label: "goal right hand" });
  await until(async () => (await bindings(page)).some(({ to }) => to.goal === hand), "the binding");
  await follows(page);
  await row.getByTestId("binding-mode").selectOption("relative");
  await until(async () => (await bindings(page))[0].mode === "relative", "the mode");
  await row.getByRole("button", { name: "moves along z" }).click();
  await until(async () => (await bindings(page))[0].axes.join("") === "xy", "the axes");
  await row.getByTestId("binding-scale").fill("0.5");
  await row.getByTestId("binding-scale").blur();
  await until(async () => (await bindings(page))[0].scale === 0.5, "the scale");
  await smooths(page, row);
  await acts(page, row);
  await findsNothing(page, "a binding's row");
  await row.getByTestId("binding-remove").click();
  await until(async () => Object.keys((await state(page)).scene.bindings).length === 0, "the binding to go");
}

/** The filter of the only binding, by its row. */
async function smooths(page, row) {
  const filter = async () => (await bindings(page))[0].filter ?? null;
  await row.getByTestId("binding-smooth").click();
  await until(async () => (await filter())?.one_euro?.min_cutoff_hz === 1, "the low pass");
  for (const [field, value] of [["cutoff", "0.5"], ["beta", "3"], ["predict", "20"]]) {
    await row.getByTestId(`binding-${field}`).fill(value);
    await row.getByTestId(`binding-${field}`).blur();
    // One field after the other: each is sent with what the daemon has of the others.
    await until(async () => JSON.stringify(await filter()).includes(`:${value}`), field);
  }
  const { one_euro, predict_ms } = await filter();
  assert.deepEqual([one_euro.min_cutoff_hz, one_euro.beta, predict_ms], [0.5, 3, 20]);
  await follows(page);
  await row.getByTestId("binding-smooth").click();
  await until(async () => (await filter())?.one_euro === undefined && (await filter())?.predict_ms === 20, "the low pass to go");
}

/** What the sensor's buttons do, by the row of the only binding. */
async function acts(page, row) {
  const buttons = row.getByTestId("binding-buttons");
  await buttons.locator("summary").click();
  for (const [button, action] of [["1", "stay or follow"], ["0", "bring back"]]) {
    await buttons.getByTestId(`binding-button-${button}`).selectOption({ label: action });
    await until(async () => JSON.stringify((await bindings(page))[0].buttons ?? []).includes(`"button":${button}`), action);
  }
  assert.deepEqual((await bindings(page))[0].buttons, [{ button: 0, do: "recenter" }, { button: 1, do: "toggle" }]);
  await buttons.getByTestId("binding-button-0").selectOption({ label: "nothing" });
  await until(async () => (await bindings(page))[0].buttons.length === 1, "one button to do nothing");
}

/** The driver's own dragging does not carry a page's data: the events are given as the browser gives them. */
export async function drop(page, from, view, point) {
  const at = await project(page, view, point);
  await page.evaluate(([sensor, view, { x, y }]) => {
    const data = new DataTransfer();
    const chip = document.querySelector(`[data-testid="sensor-${sensor}"] [data-testid=sensor-chip]`);
    chip.dispatchEvent(new DragEvent("dragstart", { dataTransfer: data, bubbles: true }));
    const pane = document.querySelector(`[data-testid=view-${view}]`);
    for (const type of ["dragover", "drop"]) pane.dispatchEvent(new DragEvent(type, { dataTransfer: data, clientX: x, clientY: y, bubbles: true, cancelable: true }));
  }, [from, view, at]);
}

async function drops({ page }) {
  await makeByClick(page);
  await page.getByTestId("tab-trackers").click();
  await drop(page, sensor, "front", (await state(page)).goals[hand].target);
  await until(async () => (await bindings(page)).some(({ to }) => to.goal === hand), "the binding");
  await follows(page);
}

async function leadsObject({ page }) {
  await begin(page, "standing");
  await call(page, "object.set", { id: "box", position: [0.6, 0.2, 0.4], shape: [{ kind: "box", center: [0, 0, 0], half_size: [0.15, 0.15, 0.15] }] });
  await page.getByTestId("tab-trackers").click();
  await page.getByTestId(`sensor-${sensor}`).getByTestId("sensor-target").selectOption({ label: "object box" });
  await until(async () => (await bindings(page)).some(({ to }) => to.object === "box"), "the binding");
  // Where it is drawn, though the document still has it where it was put.
  const seen = new Set();
  await until(async () => {
    seen.add(JSON.stringify((await state(page)).objects.box));
    return seen.size > 2;
  }, "the box to move");
  assert.deepEqual((await state(page)).scene.objects.box.position, [0.6, 0.2, 0.4]);
  await page.getByTestId("binding-remove").click();
  await until(async () => (await bindings(page)).length === 0, "the binding to go");
  const left = (await state(page)).scene.objects.box.position;
  assert.ok(distance([0.6, 0.2, 0.4], left) > 1e-3, "it stays where it was let go");
  await until(async () => distance(left, (await state(page)).objects.box) < 1e-5, "the box to be drawn there");
}

async function turns({ page }) {
  await begin(page, "standing");
  await page.getByTestId("tab-trackers").click();
  await drop(page, sensor, "front", [0.05, 0, 1.68]);
  await until(async () => (await bindings(page)).some(({ to }) => to.joint === "head"), "the binding to the head's joint");
  const turned = new Set();
  await until(async () => {
    const { segments, pose } = (await state(page)).figures.body;
    turned.add(JSON.stringify(pose.worldFromSegment[segments.indexOf("head")]));
    return turned.size > 2;
  }, "the head to turn");
}

async function looks({ page }) {
  await begin(page, "standing");
  await page.getByTestId("tab-trackers").click();
  const row = page.getByTestId(`sensor-${sensor}`);
  await row.getByTestId("sensor-target").selectOption({ label: "camera main" });
  await until(async () => (await bindings(page)).some(({ to }) => to.camera === "main"), "the binding");
  assert.deepEqual((await state(page)).rides, { camera: "main" });
  const seen = new Set();
  await until(async () => {
    seen.add(JSON.stringify((await state(page)).cameras));
    return seen.size > 2;
  }, "the camera to move");
  await row.getByTestId("binding-clutch").selectOption({ label: "button 0" });
  await until(async () => (await bindings(page)).some(({ clutch }) => clutch?.button === 0), "the clutch");
  await row.getByTestId("binding-remove").click();
  await until(async () => (await bindings(page)).length === 0, "the binding to go");
}

async function seats({ page, open, daemon }) {
  page = await open({ url: daemon.url });
  await begin(page, "standing");
  await page.getByTestId("tab-trackers").click();
  const points = [[0, 0, 0], [0.4, 0.3, 1.2], [0, -0.3, 1.6]];
  const seen = () => Promise.all(points.map((point) => project(page, "perspective", point)));
  const before = await seen();
  await page.getByTestId("camera-add").click();
  const row = page.getByTestId("camera-main");
  await row.waitFor();
  // The same angle as the view's own, and what is seen through it is what was seen.
  await row.getByTestId("camera-fov").fill("32");
  await row.getByTestId("camera-fov").blur();
  await row.getByTestId("camera-through").click();
  await until(async () => (await page.getByTestId("title-perspective").textContent()).includes("camera main"), "the camera");
  await until(async () => (await seen()).every(({ x, y }, i) => Math.hypot(x - before[i].x, y - before[i].y) < 3), "the same picture through it");
  await row.getByTestId("camera-seat").selectOption({ label: "the eyes of body" });
  await until(async () => (await state(page)).scene.cameras.main.relative_to?.segment === "head", "the camera in the head");
  const streamed = async () => (await state(page)).cameras.find(({ camera }) => camera === "main");
  await until(async () => (await streamed())?.position[2] > 1.5, "the camera at the eyes' height");
  const place = (await streamed()).position;
  await call(page, "goal.set", { at: "head", position: [0.4, 0.2, 1.4] });
  await until(async () => distance((await streamed()).position, place) > 0.1, "the camera to go with the head");
  await row.getByTestId("camera-through").click();
  await row.getByTestId("camera-remove").click();
  await until(async () => !("main" in (await state(page)).scene.cameras), "the camera to go");
  const after = await seen();
  assert.ok(after.every(({ x, y }, i) => Math.hypot(x - before[i].x, y - before[i].y) < 1), "the view is where it was");
}

/** Where the emulated source stands: turned about Z, and moved. In its own frame, with Y right and Z down. */
function sourceFrom([x, y, z]) {
  const [turn, dx, dy, dz] = [(10 * Math.PI) / 180, x + 0.6, y + 0.1, z - 0.7];
  return [Math.cos(turn) * dx + Math.sin(turn) * dy, Math.sin(turn) * dx - Math.cos(turn) * dy, -dz];
}

/** A FASTRAK at a serial port, in software; its stylus is held where the walk asks for it. */
async function calibrates({ open, daemonWith, built }) {
  const emulated = built("serial_emulated_run");
  if (!emulated) return "SKIPPED: the calibration walk: serial_emulated_run is not built";
  const daemon = await daemonWith(["--tracker", "fastrak:{PORT}@115200"], [emulated, "fastrak"]).start();
  const page = await open({ url: daemon.url, user: "ana" });
  try {
    await page.getByTestId("tab-trackers").click();
    await until(async () => "fastrak:1" in (await state(page)).sensors, "the stylus");
    const says = (id) => page.getByTestId(`walk-${id}-says`).textContent();
    // The tip is 0.12, 0.005, -0.01 m from the sensor: 120.5 mm.
    daemon.act("pivot 1 0.8 0.1 -0.2 0.12 0.005 -0.01");
    await page.getByTestId("calibrate").click();
    await page.getByTestId("walk").waitFor();
    await findsNothing(page, "the walk");
    await page.getByTestId("walk-name").fill("monday");
    await page.getByTestId("walk-name").blur();
    await page.getByTestId("walk-tip").click();
    await until(async () => /^12\d(\.\d)? mm from the sensor/.test(await says("tip")), "the tip", 60_000);
    assert.equal((await state(page)).trackers[0].held_by, "ana");
    // Held straight, so that the tip is where the sensor is and a little: the hand moves the sensor.
    const hold = async ([x, y, z]) => {
      const [sx, sy, sz] = sourceFrom([x, y, z]);
      const at = [sx - 0.12, sy - 0.005, sz + 0.01];
      daemon.act(`pose 1 ${at.join(" ")}`);
      await until(async () => {
        const seen = await call(page, "tracker.touch", { sensor: "fastrak:1", for_ms: 50, force: true }).catch(() => null);
        return seen && seen.spread_m < 1e-4 && distance(seen.source, [sx, -sy, -sz]) < 2e-3;
      }, "the hand to be there");
    };
    const points = [[0, 0, 0.8], [0.4, 0, 0.8], [0, 0.3, 0.8]];
    for (const [i, point] of points.entries()) {
      const row = page.getByTestId(`walk-point-${i}`);
      for (const [j, axis] of ["x", "y", "z"].entries()) {
        await row.getByTestId(`walk-${axis}`).fill(String(point[j] * 1000));
        await row.getByTestId(`walk-${axis}`).blur();
      }
      await hold(point);
      await row.getByTestId("walk-touch").click();
      await until(async () => /touched/.test(await row.getByTestId("walk-touch-says").textContent()), `point ${i + 1} to be touched`);
    }
    await page.getByTestId("walk-align").click();
    await until(async () => /^fits to \d\.\d mm$/.test(await says("align")), "the alignment");
    const { calibration, calibrations } = (await state(page)).trackers[0];
    assert.equal(calibration, "monday");
    assert.ok(calibrations[0].residual_m < 2e-3 && calibrations[0].author === "ana", JSON.stringify(calibrations[0]));
    assert.ok(distance(calibrations[0].world_from_source.slice(0, 3), [-0.6, -0.1, 0.7]) < 5e-3, "the source is where it stands");
    await page.getByTestId("walk-boresight").click();
    await until(async () => /read straight/.test(await says("boresight")), "the boresight");
    // A hand that misses by 18 mm is told so.
    await hold([0.4, 0, 0.818]);
    await page.getByTestId("walk-check-1").click();
    await until(async () => /^1[78]\.\d mm off$|^19\.\d mm off$/.test(await says("check")), "the check");
    daemon.act("button 1");
    await until(async () => (await page.getByTestId("sensor-buttons").textContent().catch(() => "")).includes("button 0"), "the button");
    daemon.act("button 0");
    await page.getByTestId("sensor-buttons").waitFor({ state: "detached" });
    await page.getByTestId("walk-close").click();
    await page.getByTestId("calibration").selectOption({ label: "none" });
    await until(async () => !(await state(page)).trackers[0].calibration, "no calibration to count");
    return await until(async () => !(await state(page)).trackers[0].held_by, "the hold to end");
  } finally {
    await daemon.end();
  }
}
