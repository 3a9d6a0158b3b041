// The walk that tells a tracker where it stands: its stylus's tip, known points that are touched, straight ahead, a check.
// The daemon measures and keeps; here is only how far one is.
import type { Calibration, TouchReply, Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import type { Requests } from "./requests";

export interface KnownPoint {
  world: Vec3;
  /** As it was touched; null: not yet. */
  touch: TouchReply | null;
}

const kSwingMs = 5000;
const kTouchMs = 500;
/** A hold lasts for five idle seconds. */
const kKeepMs = 2500;
const kFewest = 3;

export class Calibrating {
  tracker: string | null = null;
  sensor = "";
  /** Empty: the chosen calibration, else "default". */
  name = "";
  points: KnownPoint[] = [];
  /** What is being measured now. */
  measuring = "";
  /** The last check: how far off which point. */
  checked: { point: Vec3; off_m: number } | null = null;
  private keeping: ReturnType<typeof setInterval> | undefined;

  constructor(
    private readonly model: Model,
    private readonly requests: Requests,
  ) {}

  /** Nobody else configures or calibrates the tracker while the walk is open. */
  async open(tracker: string, sensor: string): Promise<void> {
    this.close();
    if (!(await this.requests.tracker("tracker.grab", { tracker }))) return;
    Object.assign(this, { tracker, sensor, name: "", checked: null, measuring: "" });
    this.points = [[0, 0, 0], [0.4, 0, 0], [0, 0.3, 0]].map((world) => ({ world: world as Vec3, touch: null }));
    this.keeping = setInterval(() => this.requests.keepTracker(tracker), kKeepMs);
    this.changed();
  }

  close(): void {
    if (this.tracker === null) return;
    clearInterval(this.keeping);
    void this.requests.tracker("tracker.release", { tracker: this.tracker });
    this.tracker = null;
    this.changed();
  }

  use(sensor: string): void {
    this.sensor = sensor;
    this.changed();
  }

  /** A point that is moved has to be touched again. */
  place(index: number, world: Vec3): void {
    this.points[index] = { world, touch: null };
    this.changed();
  }

  add(): void {
    this.points.push({ world: [0, 0, 0], touch: null });
    this.changed();
  }

  remove(index: number): void {
    if (this.points.length > kFewest) this.points.splice(index, 1);
    this.changed();
  }

  swing(): Promise<void> {
    return this.measure("tip", () => this.requests.tracker("tracker.tip", { sensor: this.sensor, ...this.named(), for_ms: kSwingMs }));
  }

  touch(index: number): Promise<void> {
    return this.measure(`point ${index}`, async () => {
      const touch = await this.requests.tracker<TouchReply>("tracker.touch", { sensor: this.sensor, for_ms: kTouchMs });
      const point = this.points[index];
      if (touch && point) point.touch = touch;
    });
  }

  get mayAlign(): boolean {
    return this.points.filter(({ touch }) => touch).length >= kFewest;
  }

  align(): Promise<void> {
    const points = this.points.flatMap(({ world, touch }) => (touch ? [{ source: touch.source, world }] : []));
    return this.measure("align", () => this.requests.tracker("tracker.align", { tracker: this.tracker, ...this.named(), points }));
  }

  boresight(): Promise<void> {
    return this.measure("boresight", () => this.requests.tracker("tracker.boresight", { sensor: this.sensor, ...this.named(), for_ms: kTouchMs }));
  }

  check(point: Vec3): Promise<void> {
    return this.measure("check", async () => {
      const touch = await this.requests.tracker<TouchReply>("tracker.touch", { sensor: this.sensor, for_ms: kTouchMs, point });
      this.checked = touch?.off_m === undefined ? null : { point, off_m: touch.off_m };
    });
  }

  /** The calibration that this walk makes, as the daemon has it. */
  get made(): Calibration | undefined {
    const info = this.model.trackers.find(({ tracker }) => tracker === this.tracker);
    return info?.calibrations?.find(({ name }) => name === (this.name || info.calibration));
  }

  private named(): { name?: string } {
    return this.name ? { name: this.name } : {};
  }

  private async measure(what: string, run: () => Promise<unknown>): Promise<void> {
    if (this.measuring) return;
    this.measuring = what;
    this.changed();
    await run();
    this.measuring = "";
    this.changed();
  }

  private changed(): void {
    this.model.touch("trackers");
  }
}
