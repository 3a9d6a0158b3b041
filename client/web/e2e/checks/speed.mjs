// What the page costs: bytes, first paint, and its own script in a frame with five figures and forty goals.
import assert from "node:assert/strict";
import { gzipSync } from "node:zlib";
import { call, state, until } from "../browser.mjs";

const kBytes = 400 * 1024;
const kFigures = 5;
const kGoalsEach = 8;
const kWorkMs = 4;
const kWindow = 12;

export const checks = [
  ["less than 400 KiB, compressed, come to the browser", bytes],
  ["the first paint", firstPaint],
  ["script work a frame with five figures and forty goals", work],
  ["frames a second", frames],
];

async function bytes({ open }) {
  const page = await open({ waits: false });
  const bodies = [];
  page.on("response", (response) => bodies.push(response.body().catch(() => Buffer.alloc(0))));
  await page.reload({ waitUntil: "networkidle" });
  const sizes = (await Promise.all(bodies)).map((body) => gzipSync(body).length);
  const sum = sizes.reduce((a, b) => a + b, 0);
  assert.ok(sizes.length >= 3 && sum < kBytes, `${sum} bytes`);
  return `${(sum / 1024).toFixed(0)} KiB in ${sizes.length} files`;
}

/** Told, not judged: a machine that is busy with other things is not the page's doing. */
async function firstPaint({ open }) {
  const page = await open();
  const ms = await until(() => page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime), "the first paint");
  return `after ${Math.round(ms)} ms (wanted: 1500)`;
}

async function work({ open }) {
  // Small, so that a processor that draws lets some frames through; the script has the same work.
  const page = await open({ viewport: { width: 640, height: 420 } });
  const { revision: begun } = await call(page, "scene.new", { template: "standing", force: true });
  const segments = ["left_hand", "right_hand", "head", "upper_torso", "left_lower_arm", "right_lower_arm", "left_upper_leg", "right_upper_leg"];
  const { results } = await call(page, "edit.apply", {
    label: "a crowd",
    edits: Array.from({ length: kFigures }, (_, i) => (i === 0 ? [] : [{ method: "figure.set", params: { id: `body${i}`, template: "tempus", stature: 1.6 + i * 0.06 } }])).flat(),
  });
  assert.equal(results.length, kFigures - 1);
  const goals = Array.from({ length: kFigures * kGoalsEach }, (_, n) => {
    const [i, segment] = [Math.floor(n / kGoalsEach), segments[n % kGoalsEach]];
    return { method: "goal.set", params: { id: `g${n}`, figure: i === 0 ? "body" : `body${i}`, at: segment, position: [0.3, (i - 2) * 0.9, 0.7 + (n % kGoalsEach) * 0.1] } };
  });
  const { revision } = await call(page, "edit.apply", { label: "goals", edits: goals });
  await until(async () => (await state(page)).poseRevision >= revision && revision > begun, "the crowd's pose");
  await page.keyboard.press("f");
  // A goal that wanders keeps all of it moving. Judged by the quickest frame that drew, told with the medians: what a
  // busy machine does between two looks at the clock only adds, and is not the page's work.
  let moved = 0;
  const [medians, quickest] = [[], []];
  for (let window = 0; window < 3; window++) {
    const before = (await page.evaluate(() => window.posed.work)).length;
    await until(async () => {
      await call(page, "goal.set", { id: `g${moved % goals.length}`, position: [0.3 + 0.1 * Math.sin(moved), 0.1, 1 + 0.01 * (moved % 9)] });
      moved++;
      const now = (await page.evaluate(() => window.posed.work)).length;
      return now - before >= kWindow || now < before;
    }, "frames", 90_000);
    const last = (await page.evaluate(() => window.posed.work)).slice(-kWindow).sort((a, b) => a - b);
    medians.push(last[kWindow / 2]);
    quickest.push(last[0]);
  }
  const best = Math.min(...quickest);
  const told = `${best.toFixed(2)} ms in the quickest frame, medians of ${kWindow} frames ${medians.map((ms) => ms.toFixed(2)).join(" ")}`;
  assert.ok(best < kWorkMs, told);
  return told;
}

async function frames({ page }) {
  const renderer = await page.evaluate(() => {
    const gl = document.createElement("canvas").getContext("webgl2");
    return String(gl?.getParameter(gl.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER));
  });
  await call(page, "scene.new", { template: "standing", force: true });
  if (/swiftshader|llvmpipe|software/i.test(renderer)) return `SKIPPED: frames a second: no GPU here, a processor draws (${renderer.slice(0, 60)})`;
  return await page.getByTestId("meter-fps").textContent();
}
