// The browser, its pages, and the little that every check needs of them.
import { chromium } from "playwright-core";

const flags = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update",
  "--disable-sync", "--disable-quic", "--no-first-run", "--enable-unsafe-swiftshader",
];
// Small, for a processor draws; wide enough for all that a laptop shows.
const kSize = { width: 960, height: 580 };

export function launch() {
  return chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: flags });
}

/** A page of a person of its own. What it complains about and what it asks of other hosts is noted. */
export async function openPage(browser, url, { viewport = kSize, colorScheme = "dark", user = "", hints = false, waits = true, deviceScaleFactor = 1 } = {}) {
  const context = await browser.newContext({ viewport, colorScheme, deviceScaleFactor, acceptDownloads: true });
  const settings = JSON.stringify({ user, hintsDone: !hints });
  await context.addInitScript((kept) => localStorage.getItem("posed.settings") ?? localStorage.setItem("posed.settings", kept), settings);
  const page = await context.newPage();
  page.complaints = [];
  page.foreign = [];
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !fromTaking(message.text())) page.complaints.push(message.text());
  });
  page.on("request", (request) => {
    if (!["blob:", "data:"].includes(new URL(request.url()).protocol) && new URL(request.url()).host !== new URL(url).host) page.foreign.push(request.url());
  });
  await page.goto(url);
  if (waits) await until(async () => (await page.getByTestId("connection").textContent()) === "connected", "the connection");
  return page;
}

/** Reading the canvas back for a screenshot is slow, and the driver says so: the tests' doing, not the page's. */
function fromTaking(text) {
  return text.includes("GPU stall due to ReadPixels");
}

/** Polls until `read` gives something truthy; slow machines get a generous while. */
export async function until(read, what, timeoutMs = 30_000) {
  const end = Date.now() + timeoutMs;
  for (;;) {
    const value = await read();
    if (value) return value;
    if (Date.now() > end) throw new Error(`waited in vain for ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 40));
  }
}

export const state = (page) => page.evaluate(() => window.posed.state);

export const project = (page, view, point) => page.evaluate(([v, p]) => window.posed.views.project(v, p), [view, point]);

export const rectOf = (page, view) => page.evaluate((name) => window.posed.views.rect(name).toJSON(), view);

/** Another client, on a line of its own. */
export const call = (page, method, params = {}) =>
  page.evaluate(
    ([method, params]) =>
      new Promise((resolve, reject) => {
        const socket = new WebSocket(new URL("ws", document.baseURI).href.replace(/^http/, "ws").replace(/#.*/, ""));
        socket.onopen = () => socket.send(JSON.stringify({ jsonrpc: "2.0", id: 1, method, params }));
        socket.onmessage = ({ data }) => {
          const { result, error } = JSON.parse(data);
          socket.close();
          if (error) reject(new Error(error.message));
          else resolve(result);
        };
      }),
    [method, params],
  );

/** A scene begun by another client, seen and framed by the page. */
export async function begin(page, template) {
  const { revision } = await call(page, "scene.new", { template, force: true });
  await until(async () => (await state(page)).poseRevision >= revision, `the pose of ${template}`);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await page.keyboard.press("f");
}

export const figurePose = async (page, figure = "body") => (await state(page)).figures[figure].pose.worldFromSegment;

export function distance(a, b) {
  return Math.hypot(...a.map((value, i) => value - b[i]));
}

/** The greatest way that any segment went between two poses. */
export function apart(a, b) {
  return Math.max(...a.map((place, i) => distance(place.slice(0, 3), b[i].slice(0, 3))));
}

/** Share of a page rectangle's pixels that differ clearly from its corners' colour, which is the ground's. */
export async function drawnShare(page, clip) {
  const png = await page.screenshot({ clip });
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    const ground = [data[0], data[1], data[2]];
    let drawn = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (Math.abs(data[i] - ground[0]) + Math.abs(data[i + 1] - ground[1]) + Math.abs(data[i + 2] - ground[2]) > 90) drawn++;
    }
    return drawn / (data.length / 4);
  }, png.toString("base64"));
}
