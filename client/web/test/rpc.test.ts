import { describe, expect, it, vi } from "vitest";
import { ConnectionLost, Rpc, RpcError } from "../src/protocol/rpc";
import { FakeSocket } from "./fakes";

describe("Rpc", () => {
  it("pairs replies with requests, whatever their order", async () => {
    const socket = new FakeSocket();
    const rpc = new Rpc(socket);
    const first = rpc.request("goal.get", { id: "a" });
    const second = rpc.request("goal.get", { id: "b" });
    expect(socket.sent).toEqual([
      { jsonrpc: "2.0", id: 1, method: "goal.get", params: { id: "a" } },
      { jsonrpc: "2.0", id: 2, method: "goal.get", params: { id: "b" } },
    ]);
    rpc.receive('{"jsonrpc":"2.0","id":2,"result":{"id":"b"}}');
    rpc.receive('{"jsonrpc":"2.0","id":1,"result":{"id":"a"}}');
    expect(await first).toEqual({ id: "a" });
    expect(await second).toEqual({ id: "b" });
  });

  it("gives a refusal its message, code and hint", async () => {
    const rpc = new Rpc(new FakeSocket());
    const reply = rpc.request("goal.set", { at: "right_hnd" });
    rpc.receive(
      '{"jsonrpc":"2.0","id":1,"error":{"code":-32000,"message":"no segment is called right_hnd",' +
        '"data":{"code":"unknown_segment","path":"/params/at","hint":"did you mean right_hand?"}}}',
    );
    const error = await reply.catch((refusal: unknown) => refusal);
    expect(error).toBeInstanceOf(RpcError);
    expect(error).toMatchObject({
      message: "no segment is called right_hnd",
      number: -32000,
      data: { code: "unknown_segment", hint: "did you mean right_hand?" },
    });
  });

  it("hands notifications up, takes batches, and sends notifications without an id", async () => {
    const socket = new FakeSocket();
    const rpc = new Rpc(socket);
    rpc.onNotification = vi.fn();
    const reply = rpc.request("session.ping");
    rpc.receive('[{"jsonrpc":"2.0","method":"stream.frame","params":{"stream":"pose"}},{"jsonrpc":"2.0","id":1,"result":{}}]');
    await reply;
    expect(rpc.onNotification).toHaveBeenCalledWith("stream.frame", { stream: "pose" });
    rpc.notify("stream.ack", { stream: "pose", seq: 3 });
    expect(socket.sent[1]).toEqual({ jsonrpc: "2.0", method: "stream.ack", params: { stream: "pose", seq: 3 } });
  });

  it("refuses what is open, and whatever comes later, once the socket is lost", async () => {
    const rpc = new Rpc(new FakeSocket());
    const open = rpc.request("session.ping");
    rpc.fail();
    await expect(open).rejects.toBeInstanceOf(ConnectionLost);
    await expect(rpc.request("session.ping")).rejects.toBeInstanceOf(ConnectionLost);
  });
});
