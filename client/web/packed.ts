// Beside each text file of the built page its bytes packed, as the daemon sends them: NAME.gz. Made once, when the page is built.
import { readdir, readFile, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { constants, gzipSync } from "node:zlib";
import type { Plugin } from "vite";

const kText = /\.(html|js|css|svg|json|txt)$/;
/** Under a packet's worth nothing is won. */
const kLeast = 1024;

export function packed(): Plugin {
  let out = "";
  return {
    name: "packed",
    apply: "build",
    configResolved: ({ root, build }) => void (out = resolve(root, build.outDir)),
    // The files of public/ are there by then, too.
    async closeBundle() {
      for (const entry of await readdir(out, { withFileTypes: true, recursive: true })) {
        if (!entry.isFile() || !kText.test(entry.name)) continue;
        const path = join(entry.path, entry.name);
        const bytes = await readFile(path);
        if (bytes.length >= kLeast) await writeFile(`${path}.gz`, gzipSync(bytes, { level: constants.Z_BEST_COMPRESSION }));
      }
    },
  };
}
