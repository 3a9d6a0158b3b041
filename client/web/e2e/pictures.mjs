// Takes the pictures of the README, of the viewer's help and of its gallery from the real program:
//   POSED_BIN=build/release/bin npm run pictures
import { mkdir, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { begin, call, launch, openPage, rectOf, state, until } from "./browser.mjs";
import { Daemon } from "./daemon.mjs";

const web = join(dirname(fileURLToPath(import.meta.url)), "..");
const docs = join(web, "../../docs/pictures");
const bin = process.env.POSED_BIN ?? "build/release/bin";
const daemon = await new Daemon(join(bin, "posed"), ["--viewer.path", process.env.POSED_VIEWER ?? join(bin, "../share/posed/viewer")]).start();
const browser = await launch();

/** The page, an element or a rectangle of it, as WebP at this width. */
async function take(page, selector, width, path) {
  await page.mouse.move(5, 5);
  const clip = selector && typeof selector === "object" ? { clip: selector } : {};
  const png = await (typeof selector === "string" ? page.locator(selector).screenshot() : page.screenshot(clip));
  const webp = await page.evaluate(
    async ([base64, width]) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
      const canvas = new OffscreenCanvas(width, Math.round((bitmap.height * width) / bitmap.width));
      const context = canvas.getContext("2d");
      context.imageSmoothingQuality = "high";
      context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
      const blob = await canvas.convertToBlob({ type: "image/webp", quality: 0.85 });
      return [...new Uint8Array(await blob.arrayBuffer())];
    },
    [png.toString("base64"), width],
  );
  await mkdir(dirname(path), { recursive: true });
  await writeFile(path, Uint8Array.from(webp));
  console.log(`${path.slice(web.length - "client/web".length)} ${webp.length} bytes`);
}

/** Until the page has drawn what it knows. */
async function drawn(page) {
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  await page.waitForTimeout(400);
}

const fine = new URL("?draw=fine", daemon.url).href;
const small = await openPage(browser, fine, { viewport: { width: 1300, height: 760 }, colorScheme: "light" });
await small.keyboard.press("4");
const { templates } = await call(small, "scene.list");
for (const template of templates) {
  await begin(small, template);
  await small.waitForTimeout(2600); // who has just edited is told that long
  await small.keyboard.press("4");
  await small.keyboard.press("f");
  await drawn(small);
  const { left, right, top, bottom } = await rectOf(small, "perspective");
  // All of its height below the title: the figure fills it.
  const height = bottom - top - 30;
  const width = Math.min(right - left - 4, height * 1.2);
  await take(small, { x: (left + right - width) / 2, y: bottom - height - 2, width, height }, 240, join(web, "public/gallery", `${template.replace("/", "-")}.webp`));
}
await small.context().close();

for (const colorScheme of ["dark", "light"]) {
  const page = await openPage(browser, fine, { viewport: { width: 1360, height: 860 }, colorScheme });
  await begin(page, "paper/sitting");
  await drawn(page);
  await take(page, null, 1360, join(docs, `studio-${colorScheme}.webp`));
  if (colorScheme === "dark") await take(page, "main.views", 480, join(web, "public/help/studio.webp"));
  await begin(page, "standing");
  await call(page, "goal.set", { at: "right_hand", position: [0.55, -0.45, 1.75], weight: 40 });
  const { revision } = await call(page, "goal.set", { at: "left_hand", position: [0.5, 0.9, 0.75] });
  await until(async () => (await state(page)).poseRevision >= revision, "the pose");
  await page.getByTestId("tab-body").click();
  await page.getByTestId("segment-right_upper_arm").getByRole("button", { name: "right upper arm", exact: true }).click();
  await page.keyboard.press("f");
  await drawn(page);
  await take(page, null, 1360, join(docs, `joint-${colorScheme}.webp`));
  await page.context().close();
}
await browser.close();
await daemon.end();
