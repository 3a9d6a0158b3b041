// Drives the viewer in a real browser against a living daemon:
//   POSED_URL=http://127.0.0.1:19870/ [POSED_SHOT=shot.png] [CHROMIUM=/usr/bin/chromium] npm run e2e
import { openViewer } from "./browser.mjs";
import { checks, takeShot } from "./checks.mjs";

const url = process.env.POSED_URL || "http://127.0.0.1:19870/";
const { browser, page, complaints, foreign } = await openViewer(url);
let failed = 0;

async function check(name, run) {
  const start = Date.now();
  try {
    await run(page);
    console.log(`ok    ${name} (${Date.now() - start} ms)`);
  } catch (error) {
    failed++;
    console.log(`FAIL  ${name}: ${error.message}`);
  }
}

for (const [name, run] of checks) await check(name, run);
await check("nothing was asked of another host", () => none(foreign));
await check("the page raised no error", () => none(complaints));
if (process.env.POSED_SHOT) await check("takes a screenshot", () => takeShot(page, process.env.POSED_SHOT));
await browser.close();

const count = checks.length + 2 + (process.env.POSED_SHOT ? 1 : 0);
console.log(`${count - failed} passed, ${failed} failed`);
process.exitCode = failed > 0 ? 1 : 0;

function none(list) {
  if (list.length > 0) throw new Error(list.join("; "));
}
