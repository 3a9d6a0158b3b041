// One life of a connection: hello, subscriptions, and the things that have to be asked for.
import type { Rpc } from "./protocol/rpc";
import { Streams } from "./protocol/streams";
import type { FigureReply, HelloReply, PoseFrame, SceneFrame, StatsFrame, TrackerFrame, TrackerInfo } from "./protocol/types";
import type { Model } from "./state/model";
import { SceneGap, touchesFigures } from "./state/scene";

const kPollMs = 2000;
const kSilenceMs = 15_000;

export class Session {
  readonly streams: Streams;
  private fetchingFigures = false;
  private figuresStale = false;
  private awaitingSnapshot = false;
  private ended = false;

  constructor(
    readonly rpc: Rpc,
    private readonly model: Model,
    private readonly giveUp: () => void,
  ) {
    this.streams = new Streams(rpc);
  }

  async start(): Promise<void> {
    const { model, rpc } = this;
    const client = { name: "posed-web", version: "0.1.0" };
    // A daemon that asks for a token gets the one of the page's address, https://HOST/#token=...
    const token = new URLSearchParams(globalThis.location?.hash.slice(1) ?? "").get("token");
    model.beginSession(
      await rpc.request<HelloReply>("session.hello", { protocol: 1, client, ...(token ? { token } : {}) }),
    );
    await Promise.all([this.fetchTrackers(), this.fetchMenu(), this.subscribeScene()]);
    await this.streams.subscribe(
      { stream: "pose", fields: ["world_from_segment", "goals"], max_rate_hz: 60, credit: 3 },
      this.reader("pose", (data) => model.takePose(data as PoseFrame, performance.now())),
    );
    await this.streams.subscribe(
      { stream: "tracker", max_rate_hz: 60, credit: 3 },
      this.reader("tracker", (data) => model.takeTracker(data as TrackerFrame)),
    );
    await this.streams.subscribe({ stream: "stats" }, this.reader("stats", (data) => this.takeStats(data as StatsFrame)));
    void this.poll();
  }

  end(): void {
    this.ended = true;
  }

  async fetchMenu(): Promise<void> {
    const reply = await this.rpc.request<{ saved?: string[]; templates?: string[] }>("scene.list");
    this.model.templates = reply.templates ?? [];
    this.model.saved = reply.saved ?? [];
    this.model.touch("menu");
  }

  private reader(stream: "pose" | "tracker" | "scene" | "stats", frame: (data: unknown) => void) {
    return { frame, lost: (dropped: number) => this.model.countLost(stream, dropped) };
  }

  private subscribeScene(): Promise<void> {
    return this.streams.subscribe({ stream: "scene" }, this.reader("scene", (data) => this.takeScene(data as SceneFrame)));
  }

  private takeScene(frame: SceneFrame): void {
    if ("document" in frame) this.awaitingSnapshot = false;
    if (this.awaitingSnapshot) return;
    try {
      this.model.takeScene(frame);
    } catch (error) {
      if (!(error instanceof SceneGap)) throw error;
      this.awaitingSnapshot = true;
      void this.subscribeScene().catch(() => {});
      return;
    }
    if (touchesFigures(frame)) void this.fetchFigures().catch(() => {});
  }

  /** Bursts of changes become one more round, never overlapping ones. */
  private async fetchFigures(): Promise<void> {
    this.figuresStale = true;
    if (this.fetchingFigures) return;
    this.fetchingFigures = true;
    try {
      while (this.figuresStale) {
        this.figuresStale = false;
        const { figures } = await this.rpc.request<{ figures: Array<{ id: string }> }>("figure.list");
        const asked = figures.map(({ id }) => this.rpc.request<FigureReply>("figure.get", { id }));
        this.model.setFigures(await Promise.all(asked));
      }
    } finally {
      this.fetchingFigures = false;
    }
  }

  private takeStats(stats: StatsFrame): void {
    this.model.stats = stats;
  }

  private async fetchTrackers(): Promise<void> {
    const { trackers } = await this.rpc.request<{ trackers: TrackerInfo[] }>("tracker.list");
    this.model.setTrackers(trackers);
  }

  /** No stream tells a station's state, and a socket can die without a word: ask for both now and then. */
  private async poll(): Promise<void> {
    while (!this.ended) {
      await pause(kPollMs);
      if (this.ended) return;
      const sent = performance.now();
      const silence = setTimeout(this.giveUp, kSilenceMs);
      try {
        await this.rpc.request("session.ping");
        this.model.roundTripMs = performance.now() - sent;
        await this.fetchTrackers();
      } catch {
        // A lost connection ends this session by itself.
      } finally {
        clearTimeout(silence);
      }
    }
  }
}

function pause(ms: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, ms));
}
