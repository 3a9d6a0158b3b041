import { beforeEach, describe, expect, it, vi } from "vitest";
import { Rpc } from "../src/protocol/rpc";
import { Session } from "../src/session";
import { Model } from "../src/state/model";
import { FakeSocket, settle } from "./fakes";

let socket: FakeSocket;
let model: Model;
let session: Session;

const figure = {
  id: "body",
  entity_revision: 1,
  document: { format: "posed.figure/1", root: "a", segments: [{ name: "a", touch_point: [0, 0, 0] }] },
};

beforeEach(async () => {
  vi.useFakeTimers();
  socket = new FakeSocket();
  const rpc = new Rpc(socket);
  socket.onmessage = ({ data }) => rpc.receive(String(data));
  model = new Model();
  session = new Session(rpc, model, () => {});
  const started = session.start();
  socket.answer("session.hello", { protocol: 1, daemon: { name: "posed", version: "0.1.0" }, session: "s1", boot: "b" });
  await settle();
  socket.answer("tracker.list", { trackers: [] });
  socket.answer("scene.list", { saved: ["monday"], templates: ["standing"] });
  for (let i = 0; i < 4; i++) {
    socket.answer("stream.subscribe", {});
    await settle();
  }
  await started;
  return () => {
    session.end();
    vi.useRealTimers();
  };
});

const frame = (stream: string, seq: number, data: object) => socket.say({ method: "stream.frame", params: { stream, seq, data } });
const acks = () => socket.sent.filter(({ method }) => method === "stream.ack").map(({ params }) => params);

describe("Session", () => {
  it("subscribes to the four streams, with credit where frames may be left out", () => {
    const subscribed = socket.sent.filter(({ method }) => method === "stream.subscribe").map(({ params }) => params);
    expect(subscribed).toEqual([
      { stream: "scene" },
      { stream: "pose", fields: ["world_from_segment", "goals", "objects"], max_rate_hz: 60, credit: 3 },
      { stream: "tracker", max_rate_hz: 60, credit: 3 },
      { stream: "stats" },
    ]);
    expect(model.templates).toEqual(["standing"]);
  });

  it("acks the newest frame once a drawing, as a notification", () => {
    frame("pose", 4, { t_ns: 1, revision: 1, figures: [] });
    frame("pose", 5, { t_ns: 2, revision: 1, figures: [] });
    expect(acks()).toEqual([]);
    session.streams.ackDrawn();
    session.streams.ackDrawn();
    expect(acks()).toEqual([{ stream: "pose", seq: 5 }]);
    expect(socket.sent.find(({ method }) => method === "stream.ack")).not.toHaveProperty("id");
  });

  it("counts what was left out", () => {
    socket.say({ method: "stream.lost", params: { stream: "pose", dropped: 14 } });
    socket.say({ method: "stream.lost", params: { stream: "pose", dropped: 2 } });
    expect(model.lost).toEqual({ pose: 16 });
  });

  it("asks for the bodies after a snapshot, and not when only the joints moved", async () => {
    frame("scene", 1, { revision: 3, document: { figures: { body: {} }, goals: {}, bindings: {} } });
    socket.answer("figure.list", { figures: [{ id: "body" }] });
    await settle();
    socket.answer("figure.get", figure);
    await settle();
    expect([...model.figures.keys()]).toEqual(["body"]);
    const asked = () => socket.methods().filter((method) => method === "figure.list").length;
    frame("scene", 2, { from_revision: 3, revision: 4, patch: [{ op: "add", path: "/figures/body/q", value: [1] }] });
    expect(asked()).toBe(1);
    frame("scene", 3, { from_revision: 4, revision: 5, patch: [{ op: "add", path: "/figures/body/stature", value: 1.6 }] });
    expect(asked()).toBe(2);
  });

  it("asks for one fresh snapshot when patches do not join up", async () => {
    frame("scene", 1, { revision: 3, document: {} });
    const asked = () => socket.sent.filter(({ params }) => params["stream"] === "scene").length;
    const before = asked();
    frame("scene", 2, { from_revision: 8, revision: 9, patch: [] });
    frame("scene", 3, { from_revision: 9, revision: 10, patch: [] });
    expect(asked()).toBe(before + 1);
    frame("scene", 4, { revision: 10, document: { goals: { g1: { at: "a" } } } });
    frame("scene", 5, { from_revision: 10, revision: 11, patch: [{ op: "remove", path: "/goals/g1" }] });
    expect(model.scene.revision).toBe(11);
    expect(model.scene.document.goals).toEqual({});
  });

  it("asks for the stations again and again, for no stream tells of them", async () => {
    await vi.advanceTimersByTimeAsync(2000);
    socket.answer("session.ping", {});
    await vi.advanceTimersByTimeAsync(0);
    expect(socket.methods().filter((method) => method === "tracker.list")).toHaveLength(2);
  });
});
