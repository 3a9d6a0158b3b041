// The last piece of the whole line: a page in a real browser has the pose that a tracker's bytes led to.
//   POSED_URL=http://127.0.0.1:PORT/ POSED_WANTED='[x,y,z]' node e2e/liberty.mjs
import { launch, openPage, state, until } from "./browser.mjs";

const wanted = JSON.parse(process.env.POSED_WANTED);
const browser = await launch();
const page = await openPage(browser, process.env.POSED_URL);

const near = (a, b, tolerance) => a.every((value, i) => Math.abs(value - b[i]) <= tolerance);

try {
  const goal = await until(async () => {
    const found = (await state(page)).goals.hand?.pose;
    return found && near(found.target, wanted, 2e-6) && found;
  }, "the goal at the sensor's place");
  if (!near(goal.touch, wanted, 1e-3)) throw new Error(`the hand is at ${goal.touch}, not at ${wanted}`);
  if (process.env.POSED_SHOT) await page.screenshot({ path: process.env.POSED_SHOT });
} catch (error) {
  console.log(`FAIL  ${error.message}`);
  process.exitCode = 1;
}
await browser.close();
