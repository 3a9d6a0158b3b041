// Drives the viewer in a real browser against a daemon of its own:
//   POSED_BIN=build/dev/bin POSED_VIEWER=build/dev/share/posed/viewer [CHROMIUM=...] [POSED_SHOTS=DIR] npm run e2e [-- FILTER]
// Each check is one line of output. One browser and one daemon serve all but the checks that need another daemon; suites
// of the same person share a page. No tracker where none is needed: what streams all the time is drawn all the time.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { launch, openPage } from "./browser.mjs";
import { Daemon } from "./daemon.mjs";
import * as body from "./checks/body.mjs";
import * as comfort from "./checks/comfort.mjs";
import * as connection from "./checks/connection.mjs";
import * as gallery from "./checks/gallery.mjs";
import * as goals from "./checks/goals.mjs";
import * as keyboard from "./checks/keyboard.mjs";
import * as line from "./checks/line.mjs";
import * as roles from "./checks/roles.mjs";
import * as speed from "./checks/speed.mjs";
import * as together from "./checks/together.mjs";
import * as trackers from "./checks/trackers.mjs";
import * as undo from "./checks/undo.mjs";
import * as views from "./checks/views.mjs";

const suites = { views, goals, undo, body, keyboard, together, trackers, gallery, comfort, speed, line, roles, connection };
const filter = process.argv[2] ?? "";
const bin = process.env.POSED_BIN ?? "build/dev/bin";
const viewer = ["--viewer.path", process.env.POSED_VIEWER ?? join(bin, "../share/posed/viewer")];
const program = join(bin, "posed");

const daemon = await new Daemon(program, viewer).start();
const browser = await launch();
const pages = [];
let passed = 0;
let failed = 0;
const tools = {
  daemon,
  /** Further pages and daemons, which are closed with the suite. */
  open: async (options = {}) => {
    const page = await openPage(browser, options.url ?? daemon.url, options);
    pages.push(page);
    return page;
  },
  daemonWith: (args, under) => new Daemon(program, [...viewer, ...args], under),
  /** Another program of the build; null where it was not built. */
  built: (name) => (existsSync(join(bin, name)) ? join(bin, name) : null),
  shots: process.env.POSED_SHOTS,
};

async function check(name, run) {
  const start = Date.now();
  try {
    // What a check replies is what it measured, or why it was not for this machine.
    const says = await run();
    if (typeof says === "string" && says.startsWith("SKIPPED")) console.log(says);
    else {
      passed++;
      console.log(`ok    ${name} (${Date.now() - start} ms)${typeof says === "string" ? `: ${says}` : ""}`);
    }
  } catch (error) {
    failed++;
    console.log(`FAIL  ${name}: ${error.message.split("\n").slice(0, 6).join(" | ")}`);
    const page = pages.at(-1);
    for (const open of pages) await open.mouse.up().catch(() => {});
    if (tools.shots && page) await page.screenshot({ path: join(tools.shots, `failed-${failed}.png`) }).catch(() => {});
  }
}

const shared = new Map();
for (const [suite, { checks, needs = {} }] of Object.entries(suites)) {
  const wanted = checks.filter(([name]) => `${suite}: ${name}`.includes(filter));
  if (wanted.length === 0) continue;
  const who = JSON.stringify(needs);
  if (!shared.has(who)) shared.set(who, await openPage(browser, daemon.url, needs));
  const page = shared.get(who);
  pages.unshift(page);
  for (const [name, run] of wanted) await check(`${suite}: ${name}`, () => run({ ...tools, page }));
  await check(`${suite}: no page complained, and none asked another host`, () => none(pages));
  // The shared page stays; those that the suite has opened go.
  for (const mine of pages.splice(0)) {
    mine.complaints = [];
    if (mine !== page) await mine.context().close();
  }
}
await browser.close();
await daemon.end();
console.log(`${passed} passed, ${failed} failed`);
process.exitCode = failed > 0 ? 1 : 0;

function none(list) {
  const said = list.flatMap(({ complaints, foreign }) => [...complaints, ...foreign]);
  if (said.length > 0) throw new Error(said.join("; "));
}
