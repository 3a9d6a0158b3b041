// Tracker stations with their sensors, and which goal each sensor leads.
import type { BindingDocument, SensorSample, TrackerInfo } from "../protocol/types";
import type { Model } from "../state/model";
import type { Requests } from "../tools/requests";
import { button, element, Rows, setOptions, setText } from "./dom";

export class TrackerPanel {
  readonly root = element("section", { className: "panel", testid: "tracker-panel" });
  private readonly list = element("div", { className: "rows" });
  private readonly empty = element("p", { className: "empty", text: "No tracker is attached. Start the daemon with --tracker simulated to try one." });
  private readonly rows: Rows<TrackerRow>;
  private readonly orphans = element("div", { testid: "orphan-bindings" });
  private seen = "";

  constructor(
    model: Model,
    private readonly requests: Requests,
  ) {
    this.root.append(element("h2", { text: "Trackers" }), this.empty, this.list, this.orphans);
    this.rows = new Rows(this.list, (tracker) => new TrackerRow(tracker, model, requests));
  }

  update(model: Model): void {
    const now = [model.version.scene, model.version.trackers, model.version.samples].join();
    if (now === this.seen) return;
    this.seen = now;
    this.rows.sync(model.trackers.map(({ tracker }) => tracker));
    this.empty.hidden = model.trackers.length > 0;
    for (const tracker of model.trackers) this.rows.rows.get(tracker.tracker)?.update(tracker, model);
    this.showOrphans(model);
  }

  /** Bindings outlive their station: one whose sensor is not attached must still be seen and let go. */
  private showOrphans(model: Model): void {
    const attached = new Set(model.trackers.flatMap(({ sensors }) => sensors));
    const orphans = Object.entries(model.scene.document.bindings).filter(([, { sensor }]) => !attached.has(sensor));
    const key = JSON.stringify(orphans);
    if (this.orphans.dataset["key"] === key) return;
    this.orphans.dataset["key"] = key;
    this.orphans.replaceChildren(
      ...orphans.map(([id, { sensor, to }]) => bindingLine(id, `${sensor} (not attached) leads ${to.goal ?? "?"}`, this.requests)),
    );
  }
}

function bindingLine(id: string, text: string, requests: Requests): HTMLElement {
  const remove = button("×", "binding-remove", `Remove ${id}`, () => requests.unbind(id));
  remove.className = "quiet";
  return element("div", { className: "line" }, element("span", { className: "grow dim", text }), remove);
}

class TrackerRow {
  readonly root: HTMLElement;
  private readonly state = element("span", { className: "tracker-state", testid: "tracker-state" });
  private readonly rate = element("span", { className: "dim", testid: "tracker-rate" });
  private readonly message = element("div", { className: "note", testid: "tracker-message" });
  private readonly sensors = element("div", { className: "sensors" });
  private readonly rows: Rows<SensorRow>;

  constructor(tracker: string, model: Model, requests: Requests) {
    this.root = element(
      "div",
      { className: "row tracker", testid: `tracker-${tracker}` },
      element("div", { className: "line" }, element("span", { className: "grow strong", text: tracker }), this.rate, this.state),
      this.message,
      this.sensors,
    );
    this.rows = new Rows(this.sensors, (sensor) => new SensorRow(sensor, model, requests));
  }

  update(tracker: TrackerInfo, model: Model): void {
    this.root.dataset["state"] = tracker.state;
    setText(this.state, tracker.state);
    setText(this.rate, tracker.rate_hz ? `${Math.round(tracker.rate_hz)} Hz` : "");
    setText(this.message, tracker.message ?? "");
    this.message.hidden = !tracker.message;
    this.rows.sync(tracker.sensors);
    for (const [sensor, row] of this.rows.rows) row.update(sensor, model);
  }
}

class SensorRow {
  readonly root: HTMLElement;
  private readonly place = element("span", { className: "dim number sensor-place", testid: "sensor-place" });
  private readonly goal = element("select", { testid: "sensor-goal", title: "The goal that follows this sensor" });
  private readonly mode = element("select", { testid: "sensor-mode", title: "absolute: the goal goes where the sensor is; relative: it moves as the sensor moves" });
  private readonly others = element("div", { className: "others" });

  constructor(sensor: string, private readonly model: Model, private readonly requests: Requests) {
    this.goal.setAttribute("aria-label", `goal that follows ${sensor}`);
    this.goal.addEventListener("change", () => this.choose(sensor));
    this.mode.setAttribute("aria-label", `how the goal follows ${sensor}`);
    this.mode.addEventListener("change", () => this.choose(sensor));
    this.root = element(
      "div",
      { className: "sensor", testid: `sensor-${sensor}` },
      element("div", { className: "line" }, element("span", { className: "triad" }), element("span", { className: "grow", text: sensor }), this.place),
      element("div", { className: "line" }, element("span", { className: "dim", text: "leads" }), this.goal, this.mode),
      this.others,
    );
  }

  update(sensor: string, model: Model): void {
    setText(this.place, placeText(model.samples.get(sensor)));
    const bound = bindingsOf(sensor, model);
    const [first, ...others] = bound;
    const led = first?.[1].to.goal;
    const goals = Object.keys(model.scene.document.goals).filter((id) => id === led || model.movable(id)).sort();
    setOptions(this.goal, [["", "no goal"], ...goals.map((id) => [id, id] as const)], led ?? "");
    setOptions(this.mode, [["absolute", "absolute"], ["relative", "relative"]], first?.[1].mode ?? (this.mode.value || "absolute"));
    const key = others.map(([id, { to }]) => `${id}>${to.goal}`).join();
    if (this.others.dataset["key"] === key) return;
    this.others.dataset["key"] = key;
    // One sensor may lead several goals; the select shows the first, the rest can be let go here.
    this.others.replaceChildren(...others.map(([id, { to }]) => bindingLine(id, `also ${to.goal ?? "?"}`, this.requests)));
  }

  private choose(sensor: string): void {
    const [first] = bindingsOf(sensor, this.model);
    const goal = this.goal.value;
    if (!goal) {
      if (first) this.requests.unbind(first[0]);
      return;
    }
    const id = first?.[0] ?? freeId(sensor, this.model);
    const mode = this.mode.value === "relative" ? "relative" : "absolute";
    this.requests.bind(id, { sensor, to: { goal }, axes: ["x", "y", "z"], mode });
  }
}

function bindingsOf(sensor: string, model: Model): Array<[string, BindingDocument]> {
  return Object.entries(model.scene.document.bindings)
    .filter(([, binding]) => binding.sensor === sensor)
    .sort(([a], [b]) => (a < b ? -1 : 1));
}

/** A sensor's name has a colon, an id must not. */
function freeId(sensor: string, model: Model): string {
  const base = sensor.replace(/[^A-Za-z0-9_.-]/g, ".").slice(0, 58);
  let id = base;
  for (let n = 2; id in model.scene.document.bindings; n++) id = `${base}.${n}`;
  return id;
}

function placeText(sample: SensorSample | undefined): string {
  if (!sample) return "not seen";
  const place = sample.position.map((value) => value.toFixed(2)).join("  ");
  return sample.flags?.length ? `${place}  ${sample.flags.join(" ")}` : place;
}
