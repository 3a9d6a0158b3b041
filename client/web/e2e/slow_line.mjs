// A long line between a page and the daemon: a relay of sockets that holds every byte back for a while, both ways.
import { createConnection, createServer } from "node:net";
import { once } from "node:events";

/** `tripMs`: there and back. Bytes keep their order and their distance. */
export async function slowLine(url, tripMs) {
  const { hostname, port } = new URL(url);
  const sockets = new Set();
  const late = (from, to) => {
    sockets.add(from);
    const after = (run) => setTimeout(run, tripMs / 2);
    from.on("data", (bytes) => after(() => to.writable && to.write(bytes)));
    from.on("end", () => after(() => to.end()));
    from.on("close", () => sockets.delete(from));
    from.on("error", () => to.destroy());
  };
  const server = createServer((near) => {
    const far = createConnection({ host: hostname, port: Number(port), noDelay: true });
    near.setNoDelay(true);
    late(near, far);
    late(far, near);
  });
  server.listen(0, "127.0.0.1");
  await once(server, "listening");
  return {
    url: `http://127.0.0.1:${server.address().port}/`,
    end() {
      server.close();
      for (const socket of sockets) socket.destroy();
    },
  };
}
