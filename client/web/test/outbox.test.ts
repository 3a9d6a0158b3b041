import { beforeEach, describe, expect, it } from "vitest";
import { Rpc } from "../src/protocol/rpc";
import { Outbox } from "../src/tools/outbox";
import { FakeSocket, settle } from "./fakes";

let socket: FakeSocket;
let rpc: Rpc | null;
let waiting: number[];
let outbox: Outbox;

function connect(): void {
  socket = new FakeSocket();
  const now = new Rpc(socket);
  socket.onmessage = ({ data }) => now.receive(String(data));
  rpc = now;
}

beforeEach(() => {
  waiting = [];
  connect();
  outbox = new Outbox(() => rpc, (count) => waiting.push(count));
});

describe("Outbox", () => {
  it("answers with what the daemon says, refusals too", async () => {
    const done = outbox.edit("goal.set", { id: "g1" });
    socket.answer("goal.set", { revision: 4 });
    expect(await done).toEqual({ revision: 4 });
    const refused = outbox.edit("goal.remove", { id: "g1" });
    socket.say({ id: socket.sent.at(-1)?.id, error: { code: -32000, message: "no" } });
    await expect(refused).rejects.toThrow("no");
    expect(waiting.at(-1)).toBe(0);
  });

  it("loses no edit with the connection, and does none twice: the same `once` goes out again, in the same order", async () => {
    const replies = ["a", "b"].map((id) => outbox.edit("goal.set", { id }));
    const first = socket.sent.map(({ params }) => params);
    rpc?.fail();
    await settle();
    expect(waiting.at(-1)).toBe(2);
    rpc = null;
    const third = outbox.edit("goal.set", { id: "c" });
    expect(waiting.at(-1)).toBe(3);
    connect();
    outbox.resend();
    expect(socket.sent.map(({ params }) => params["id"])).toEqual(["a", "b", "c"]);
    expect(socket.sent.slice(0, 2).map(({ params }) => params)).toEqual(first);
    expect(new Set(socket.sent.map(({ params }) => params["once"])).size).toBe(3);
    for (const { id } of socket.sent) socket.say({ id, result: { revision: 1 } });
    expect(await Promise.all([...replies, third])).toHaveLength(3);
    expect(waiting.at(-1)).toBe(0);
  });
});
