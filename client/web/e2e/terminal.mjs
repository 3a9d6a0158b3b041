// posectl view in a pseudo-terminal of its own: util-linux's `script` holds the terminal's other end.
import { spawn } from "node:child_process";
import { once } from "node:events";

export function openTerminal(program, url, { columns = 100, rows = 40 } = {}) {
  const command = `stty cols ${columns} rows ${rows}; exec '${program}' --host tcp://${new URL(url).host} view`;
  const child = spawn("script", ["-qefc", command, "/dev/null"], { stdio: ["pipe", "pipe", "inherit"], env: { ...process.env, TERM: "xterm-256color", LC_ALL: "C.UTF-8" } });
  let said = "";
  child.stdout.on("data", (bytes) => (said += bytes));
  return {
    /** All that it has written since it began. */
    get said() {
      return said;
    },
    press: (keys) => child.stdin.write(keys),
    async end() {
      if (child.exitCode !== null) return;
      child.stdin.write("q");
      await Promise.race([once(child, "exit"), new Promise((resolve) => setTimeout(resolve, 5000))]);
      child.kill();
    },
  };
}
