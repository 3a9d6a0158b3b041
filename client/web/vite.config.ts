import { defineConfig } from "vitest/config";
import { packed } from "./packed";

export default defineConfig({
  // Relative, so that the page works under any path a proxy puts it at.
  base: "./",
  plugins: [packed()],
  build: {
    target: "es2022",
    // three is most of the page; one chunk is one request.
    chunkSizeWarningLimit: 1000,
    // The polyfill would be an inline script, which a strict content policy refuses.
    modulePreload: { polyfill: false },
    // No data: URLs, for the same reason.
    assetsInlineLimit: 0,
  },
  server: {
    // `npm run dev` beside a daemon on its default port.
    proxy: { "/ws": { target: "ws://127.0.0.1:19870", ws: true } },
  },
  test: { include: ["test/**/*.test.ts"] },
});
