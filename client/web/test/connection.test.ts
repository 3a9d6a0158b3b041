import { beforeEach, describe, expect, it } from "vitest";
import { Connection, type ConnectionState } from "../src/protocol/connection";
import type { Rpc } from "../src/protocol/rpc";
import { FakeClock, FakeSocket, settle } from "./fakes";

let clock: FakeClock;
let sockets: FakeSocket[];
let states: ConnectionState[];
let connection: Connection;

beforeEach(() => {
  clock = new FakeClock();
  sockets = [];
  states = [];
  const open = () => {
    sockets.push(new FakeSocket());
    return newest();
  };
  const opened = (rpc: Rpc) => rpc.request("session.hello").then(() => {});
  connection = new Connection(open, { opened, changed: (state) => states.push(state) }, clock);
});

const newest = () => sockets[sockets.length - 1] as FakeSocket;
const phase = () => states[states.length - 1];

async function succeed(): Promise<void> {
  newest().onopen?.();
  newest().answer("session.hello", {});
  await settle();
}

describe("Connection", () => {
  it("is connected only when the daemon has answered the hello", async () => {
    connection.connect();
    newest().onopen?.();
    await settle();
    expect(phase()).toEqual({ phase: "connecting" });
    newest().answer("session.hello", {});
    await settle();
    expect(phase()).toEqual({ phase: "connected" });
  });

  it("waits longer after each failure, up to ten seconds", () => {
    connection.connect();
    const pauses: number[] = [];
    for (let i = 0; i < 7; i++) {
      newest().onclose?.();
      const state = phase();
      if (state?.phase !== "lost") throw new Error("not lost");
      pauses.push(state.retryAtMs - clock.now());
      clock.pass(state.retryAtMs - clock.now());
    }
    expect(pauses).toEqual([500, 1000, 2000, 4000, 8000, 10_000, 10_000]);
    expect(sockets).toHaveLength(8);
  });

  it("starts with the short pause again after a good connection", async () => {
    connection.connect();
    newest().onclose?.();
    clock.pass(500);
    newest().onclose?.();
    clock.pass(1000);
    await succeed();
    newest().onclose?.();
    expect(phase()).toEqual({ phase: "lost", retryAtMs: clock.now() + 500 });
  });

  it("tries at once when asked, and not a second time when the pause ends", () => {
    connection.connect();
    newest().onclose?.();
    connection.connect();
    expect(sockets).toHaveLength(2);
    clock.pass(60_000);
    expect(sockets).toHaveLength(2);
  });

  it("gives up on a socket that opens and never answers", async () => {
    connection.connect();
    newest().onopen?.();
    clock.pass(15_000);
    await settle();
    expect(newest().closed).toBe(true);
    expect(phase()?.phase).toBe("lost");
    expect(states.filter(({ phase: each }) => each === "lost")).toHaveLength(1);
  });

  it("lets a closed old socket say nothing about the new one", async () => {
    connection.connect();
    const old = newest();
    connection.connect();
    await succeed();
    old.onclose?.();
    expect(phase()).toEqual({ phase: "connected" });
  });
});
