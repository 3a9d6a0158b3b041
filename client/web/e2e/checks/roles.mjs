// Who may only look, looks: on a daemon that asks for tokens.
import assert from "node:assert/strict";
import { createHash, randomBytes } from "node:crypto";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { project, state, until } from "../browser.mjs";

export const checks = [["a viewer sees everything and can touch nothing", viewerOnly]];

async function viewerOnly({ open, daemonWith }) {
  const folder = await mkdtemp(join(tmpdir(), "posed-tokens-"));
  const [viewer, editor] = [randomBytes(16).toString("hex"), randomBytes(16).toString("hex")];
  const digest = (token) => createHash("sha256").update(token).digest("hex");
  await writeFile(join(folder, "tokens"), `viewer vi sha256:${digest(viewer)}\neditor ed sha256:${digest(editor)}\n`, { mode: 0o600 });
  const daemon = await daemonWith(["--auth.tokens", join(folder, "tokens")]).start();
  try {
    const editing = await open({ url: `${daemon.url}#token=${editor}` });
    const looking = await open({ url: `${daemon.url}#token=${viewer}` });
    assert.equal((await state(looking)).role, "viewer");
    await looking.getByTestId("role").waitFor();
    assert.ok(await looking.getByTestId("tool-goal").isDisabled());
    const touch = await editing.evaluate(() => window.posed.views.touchPoint("body", "right_hand"));
    const at = await project(editing, "front", touch);
    await editing.keyboard.press("g");
    await editing.mouse.click(at.x, at.y);
    const id = "body.right_hand.position";
    await until(async () => (await state(looking)).goals[id]?.pose, "the editor's goal at the viewer's");
    const [before, cube] = [(await state(looking)).revision, await project(looking, "front", (await state(looking)).goals[id].target)];
    await looking.mouse.move(cube.x, cube.y);
    await looking.mouse.down();
    await looking.mouse.move(cube.x + 60, cube.y - 60, { steps: 4 });
    await looking.mouse.up();
    for (const key of ["g", "Delete", "ArrowUp", "Control+z", "l", "o"]) await looking.keyboard.press(key);
    await looking.getByTestId("tab-goals").click();
    assert.ok(await looking.getByTestId(`goal-${id}`).getByTestId("goal-weight").isDisabled());
    // The editor's next edit is the next revision: nothing of the viewer's came between.
    await editing.keyboard.press("ArrowUp");
    await until(async () => (await state(looking)).revision > before, "the editor's edit");
    assert.equal((await state(looking)).revision, before + 1);
    assert.ok(!(await looking.getByTestId("toast").isVisible()), "nothing was even asked");
  } finally {
    await daemon.end();
    await rm(folder, { recursive: true, force: true });
  }
}
