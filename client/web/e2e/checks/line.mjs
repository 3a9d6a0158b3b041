// Others on the line: a page that is far away, and a terminal beside it.
import assert from "node:assert/strict";
import { begin, distance, figurePose, apart, project, state, until } from "../browser.mjs";
import { slowLine } from "../slow_line.mjs";
import { openTerminal } from "../terminal.mjs";
import { hand, makeByClick } from "./goals.mjs";

const kTripMs = 200;

export const checks = [
  ["200 ms away the cube is under the pointer on the next frame, the figure as it arrives", farAway],
  ["a goal nudged in posectl view moves in the browser, and the browser's in the terminal", terminal],
];

async function farAway({ open, daemon }) {
  const line = await slowLine(daemon.url, kTripMs);
  const pages = [];
  try {
    const page = await open({ url: line.url });
    pages.push(page);
    await makeByClick(page);
    const trip = await page.evaluate(async () => {
      const start = performance.now();
      await fetch("/healthz", { cache: "no-store" });
      return performance.now() - start;
    });
    assert.ok(trip > kTripMs, `the line is as long as it is to be: ${trip} ms`);
    const from = await project(page, "front", (await state(page)).goals[hand].target);
    // All in the page, frame by frame: where the pointer went, where the cube is drawn one frame later, and since when the figure has moved.
    const told = await page.evaluate(async ([id, { x, y }]) => {
      const pane = document.querySelector("[data-testid=view-front]");
      const frame = () => new Promise((resolve) => requestAnimationFrame(() => resolve(performance.now())));
      const point = (type, px, py) => pane.dispatchEvent(new PointerEvent(type, { pointerId: 1, isPrimary: true, bubbles: true, cancelable: true, button: type === "pointermove" ? -1 : 0, buttons: type === "pointerup" ? 0 : 1, clientX: px, clientY: py }));
      const touch = () => window.posed.state.goals[id].pose.touch;
      const [touched, start] = [touch(), performance.now()];
      point("pointermove", x, y);
      point("pointerdown", x, y);
      const off = [];
      let followed = null;
      for (let i = 1; i <= 60; i++) {
        const [px, py] = [x + i, y - i];
        point("pointermove", px, py);
        const drawn = window.posed.drawn;
        const now = await frame();
        const seen = window.posed.views.project("front", window.posed.state.goals[id].target);
        off.push(Math.hypot(seen.x - px, seen.y - py));
        if (window.posed.drawn === drawn) off.push(Infinity);
        if (followed === null && Math.hypot(...touch().map((value, k) => value - touched[k])) > 1e-3) followed = now - start;
      }
      point("pointerup", x + 60, y - 60);
      return { worst: Math.max(...off), followed };
    }, [hand, from]);
    assert.ok(told.worst < 2, `the cube was ${told.worst} pixels from the pointer`);
    assert.ok(told.followed === null || told.followed >= kTripMs, `the figure moved after ${told.followed} ms, before any answer could be here`);
    const { target } = (await state(page)).goals[hand];
    await until(async () => distance((await state(page)).goals[hand].pose.target, target) < 1e-4, "the figure to come after");
    return `cube within ${told.worst.toFixed(2)} pixels, the figure after ${told.followed === null ? "the drag" : `${Math.round(told.followed)} ms`}`;
  } finally {
    // First, or the page would complain of the line that is gone.
    for (const page of pages) await page.context().close();
    line.end();
  }
}

async function terminal({ page, daemon, built }) {
  await makeByClick(page);
  const view = openTerminal(built("posectl"), daemon.url);
  try {
    await until(() => view.said.includes("right_hand") || view.said.includes("right hand"), "the goal in the terminal's list");
    const [before, pose] = [(await state(page)).goals[hand].target, await figurePose(page)];
    const shift = "\x1b[1;2A";
    // The view's own keys: the next goal until it is this one, then up, ten steps at once.
    await until(async () => {
      view.press("n");
      await new Promise((resolve) => setTimeout(resolve, 100));
      view.press(shift);
      return until(async () => distance((await state(page)).goals[hand].target, before) > 0.05, "", 1500).catch(() => false);
    }, "the nudge in the browser");
    const after = (await state(page)).goals[hand].target;
    assert.ok(Math.abs(distance(after, before) % 0.01) < 1e-4 || Math.abs((distance(after, before) % 0.01) - 0.01) < 1e-4, "whole steps");
    await until(async () => apart(pose, await figurePose(page)) > 0.02, "the figure to follow it");
    const told = view.said.length;
    await page.keyboard.press("Escape");
    await begin(page, "paper/sitting");
    await until(() => /back/.test(view.said.slice(told)), "the browser's new scene in the terminal");
  } finally {
    await view.end();
  }
}
