// One life of a connection: hello, subscriptions, and the things that have to be asked for.
import type { Rpc } from "./protocol/rpc";
import { Streams } from "./protocol/streams";
import type {
  CameraFrame,
  FigureReply,
  GoalDocument,
  HelloReply,
  HistoryStep,
  PingReply,
  PoseFrame,
  SceneFrame,
  SessionInfo,
  StatsFrame,
  StreamName,
  TrackerFrame,
  TrackerInfo,
} from "./protocol/types";
import type { Model } from "./state/model";
import { SceneGap, touchesFigures } from "./state/scene";

const kPollMs = 2000;
const kSilenceMs = 15_000;
const kHistorySteps = 30;
/** Others' edits come sixty a second while they drag: what is asked for anew after them waits this long. */
const kSettleMs = 400;

/** Who this page is to the daemon: the key brings its edits back under its own undo after a lost connection or a reload. */
export interface Identity {
  user: string;
  resume: string | null;
  kept(resume: string): void;
}

export class Session {
  readonly streams: Streams;
  private fetchingFigures = false;
  private figuresStale = false;
  private awaitingSnapshot = false;
  private settling = false;
  private ended = false;

  constructor(
    readonly rpc: Rpc,
    private readonly model: Model,
    private readonly giveUp: () => void,
    private readonly identity: Identity = { user: "", resume: null, kept() {} },
  ) {
    this.streams = new Streams(rpc);
  }

  async start(): Promise<void> {
    const { model, rpc } = this;
    const client = { name: "posed-web", version: "0.1.0" };
    // A daemon that asks for a token gets the one of the page's address, https://HOST/#token=...
    const token = new URLSearchParams(globalThis.location?.hash.slice(1) ?? "").get("token");
    const { user, resume } = this.identity;
    const hello = await rpc.request<HelloReply>("session.hello", {
      protocol: 1, client, ...(token ? { token } : {}), ...(user ? { user } : {}), ...(resume ? { resume } : {}),
    });
    if (hello.resume) this.identity.kept(hello.resume);
    model.beginSession(hello);
    await Promise.all([this.fetchTrackers(), this.fetchMenu(), this.subscribeScene()]);
    await this.streams.subscribe(
      { stream: "pose", fields: ["world_from_segment", "goals", "objects"], max_rate_hz: 60, credit: 3 },
      this.reader("pose", (data) => model.takePose(data as PoseFrame, performance.now())),
    );
    await this.streams.subscribe(
      { stream: "tracker", max_rate_hz: 60, credit: 3 },
      this.reader("tracker", (data) => model.takeTracker(data as TrackerFrame)),
    );
    await this.streams.subscribe({ stream: "stats" }, this.reader("stats", (data) => this.takeStats(data as StatsFrame)));
    if (hello.features?.includes("cameras")) {
      await this.streams.subscribe(
        { stream: "camera", max_rate_hz: 60, credit: 3 },
        this.reader("camera", (data) => model.takeCameras(data as CameraFrame)),
      );
    }
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

  private reader(stream: StreamName, frame: (data: unknown) => void) {
    return { frame, lost: (dropped: number) => this.model.countLost(stream, dropped) };
  }

  private subscribeScene(): Promise<void> {
    return this.streams.subscribe({ stream: "scene" }, this.reader("scene", (data) => this.takeScene(data as SceneFrame)));
  }

  private takeScene(frame: SceneFrame): void {
    if ("document" in frame) this.awaitingSnapshot = false;
    if (this.awaitingSnapshot) return;
    try {
      this.model.takeScene(frame, performance.now());
    } catch (error) {
      if (!(error instanceof SceneGap)) throw error;
      this.awaitingSnapshot = true;
      void this.subscribeScene().catch(() => {});
      return;
    }
    if (touchesFigures(frame)) void this.fetchFigures().catch(() => {});
    this.settle();
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

  /** What no stream tells and edits change: who holds what, and the steps that can be undone. */
  private settle(): void {
    if (this.settling) return;
    this.settling = true;
    setTimeout(() => {
      this.settling = false;
      if (!this.ended) void Promise.all([this.fetchHistory(), this.fetchPeople()]).catch(() => {});
    }, kSettleMs);
  }

  private async fetchHistory(): Promise<void> {
    const { steps } = await this.rpc.request<{ steps: HistoryStep[] }>("edit.history", { limit: kHistorySteps });
    this.model.history = steps;
    this.model.touch("history");
  }

  private async fetchPeople(): Promise<void> {
    const { model, rpc } = this;
    const { sessions } = await rpc.request<{ sessions: SessionInfo[] }>("session.list");
    model.setPeople(sessions);
    if (model.people.others.length === 0) return model.people.setHolds(new Map());
    const { goals } = await rpc.request<{ goals: Array<GoalDocument & { id: string; held_by?: string }> }>("goal.list");
    // A hold of one's own outlives the hand until the daemon has its last word.
    const held = goals.flatMap(({ id, held_by }) => (held_by && !model.localTargets.has(id) ? [[id, held_by] as const] : []));
    model.people.setHolds(new Map(held));
    model.touch("people");
  }

  private takeStats(stats: StatsFrame): void {
    this.model.stats = stats;
  }

  async fetchTrackers(): Promise<void> {
    const { trackers } = await this.rpc.request<{ trackers: TrackerInfo[] }>("tracker.list");
    this.model.setTrackers(trackers);
  }

  /** No stream tells a station's state, and a socket can die without a word: ask for both now and then. */
  private async poll(): Promise<void> {
    for (let pauseMs = 0; !this.ended; pauseMs = kPollMs) {
      await pause(pauseMs);
      if (this.ended) return;
      const sent = performance.now();
      const silence = setTimeout(this.giveUp, kSilenceMs);
      try {
        const { receive_t_ns, send_t_ns } = await this.rpc.request<PingReply>("session.ping");
        const now = performance.now();
        this.model.roundTripMs = now - sent;
        this.model.clock.heard(sent, now, receive_t_ns, send_t_ns);
        await Promise.all([this.fetchTrackers(), this.fetchPeople()]);
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
