// The simulated tracker: seen, and bound to what it is to lead.
import assert from "node:assert/strict";
import { begin, call, distance, project, state, until } from "../browser.mjs";
import { hand, makeByClick } from "./goals.mjs";

const sensor = "simulated:1";

export const checks = [
  ["stations are listed with state, rate and places", withTracker(lists)],
  ["a sensor leads a goal, and lets it go", withTracker(leads)],
  ["a sensor is dropped on a cube", withTracker(drops)],
  ["a sensor leads an object", withTracker(leadsObject)],
  ["a sensor turns a joint", withTracker(turns)],
  ["a sensor is the camera, with a clutch", withTracker(looks)],
];

/** One daemon with a tracker and one page on it for all of these. */
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

async function lists({ page }) {
  await page.getByTestId("tab-trackers").click();
  await until(async () => (await page.getByTestId("tracker-state").textContent()) === "streaming", "a station that streams");
  assert.match(await page.getByTestId("tracker-rate").textContent(), /^\d+ Hz$/);
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
  await until(async () => Object.values((await state(page)).scene.bindings).some(({ to }) => to.goal === hand), "the binding");
  await follows(page);
  await row.getByTestId("binding-mode").selectOption("relative");
  await until(async () => Object.values((await state(page)).scene.bindings)[0].mode === "relative", "the mode");
  await row.getByRole("button", { name: "moves along z" }).click();
  await until(async () => Object.values((await state(page)).scene.bindings)[0].axes.join("") === "xy", "the axes");
  await row.getByTestId("binding-scale").fill("0.5");
  await row.getByTestId("binding-scale").blur();
  await until(async () => Object.values((await state(page)).scene.bindings)[0].scale === 0.5, "the scale");
  await row.getByTestId("binding-remove").click();
  await until(async () => Object.keys((await state(page)).scene.bindings).length === 0, "the binding to go");
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
  await until(async () => Object.values((await state(page)).scene.bindings).some(({ to }) => to.goal === hand), "the binding");
  await follows(page);
}

async function leadsObject({ page }) {
  await begin(page, "standing");
  await call(page, "object.set", { id: "box", position: [0.6, 0.2, 0.4], shape: [{ kind: "box", center: [0, 0, 0], half_size: [0.15, 0.15, 0.15] }] });
  await page.getByTestId("tab-trackers").click();
  await page.getByTestId(`sensor-${sensor}`).getByTestId("sensor-target").selectOption({ label: "object box" });
  await until(async () => Object.values((await state(page)).scene.bindings).some(({ to }) => to.object === "box"), "the binding");
  assert.ok(distance([0, 0, 0], (await state(page)).scene.objects.box.position) > 0);
}

const bindings = async (page) => Object.values((await state(page)).scene.bindings);

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
  await row.getByTestId("binding-clutch").click();
  await until(async () => (await bindings(page)).some(({ clutch }) => clutch?.button === 0), "the clutch");
  await row.getByTestId("binding-remove").click();
  await until(async () => (await bindings(page)).length === 0, "the binding to go");
}
