// A real daemon of the tests' own: started, killed and started again on the same port and data.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";

export class Daemon {
  url = "";
  #child = null;
  #data = "";
  #listen = "127.0.0.1:0";

  /** `args`: besides where it listens and keeps its data. `under`: a program, with its words, that runs the daemon. */
  constructor(program, args = [], under = []) {
    this.program = program;
    this.args = args;
    this.under = under;
  }

  /** A line to the program that runs the daemon: what the hand does that holds an emulated tracker's sensors. */
  act(line) {
    this.#child.stdin.write(`${line}\n`);
  }

  async start() {
    this.#data ||= await mkdtemp(join(tmpdir(), "posed-e2e-"));
    const [program, ...words] = [...this.under, this.program, "--listen", this.#listen, "--data", this.#data, ...this.args];
    const child = spawn(program, words, { stdio: [this.under.length > 0 ? "pipe" : "ignore", "pipe", "inherit"] });
    this.#child = child;
    const lines = createInterface({ input: child.stdout });
    const said = await Promise.race([
      once(lines, "line").then(([line]) => line),
      once(child, "exit").then(([code]) => Promise.reject(new Error(`${this.program} ended with ${code}`))),
    ]);
    lines.on("line", () => {});
    this.url = /http:\/\/[^ ]+/.exec(said)[0];
    this.#listen = new URL(this.url).host;
    return this;
  }

  async stop(signal = "SIGTERM") {
    const child = this.#child;
    this.#child = null;
    if (!child || child.exitCode !== null) return;
    child.stdin?.end();
    child.kill(signal);
    await once(child, "exit");
  }

  async end() {
    await this.stop();
    if (this.#data) await rm(this.#data, { recursive: true, force: true });
  }
}
