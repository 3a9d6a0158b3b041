// Tracker stations with their sensors, and what each sensor leads.
import { html, nothing, type TemplateResult } from "lit-html";
import { repeat } from "lit-html/directives/repeat.js";
import type { SensorSample, TrackerInfo } from "../protocol/types";
import type { Model } from "../state/model";
import { lengthText } from "../state/words";
import { bindTo, bindingsOf, leadsMore, targetText, targetsOf, targetOf, targetKey } from "../tools/bindings";
import type { Requests } from "../tools/requests";
import { Calibrating } from "../tools/calibrating";
import { bindingRow } from "./binding_row";
import { cameraRows, type Here } from "./camera_rows";
import { calibrationWalk } from "./calibration_walk";
import { Panel, clicked, section } from "./panel";

const kButtons = 8;

export class TrackerPanel extends Panel {
  private readonly walk: Calibrating;

  constructor(
    model: Model,
    private readonly requests: Requests,
    private readonly here: Here,
  ) {
    super(section("panel", "tracker-panel", "Trackers"), model, ["scene", "trackers", "samples", "settings", "connection", "local", "figures"]);
    this.walk = new Calibrating(model, requests);
  }

  protected template(): TemplateResult {
    const { trackers } = this.model;
    return html`<h2>Trackers</h2>
      ${trackers.length === 0 ? html`<p class="empty">No tracker is attached. Start the daemon with <code>--tracker simulated</code> to try one.</p>` : html`<p class="empty">Drag a sensor onto a goal, a part of the body, an object or the perspective view: it leads what you drop it on.</p>`}
      <div class="rows">${repeat(trackers, ({ tracker }) => tracker, (tracker) => this.station(tracker))}</div>
      ${this.orphans()}
      ${leadsMore(this.model) ? cameraRows(this.model, this.requests, this.here) : nothing}`;
  }

  private station(info: TrackerInfo): TemplateResult {
    const { tracker, state, kind, rate_hz, message, sensors, bad_bytes } = info;
    return html`<div class="row tracker" data-testid="tracker-${tracker}" data-state=${state}>
      <div class="line"><span class="grow strong">${tracker}</span>
        <span class="tracker-state" data-testid="tracker-state">${state}</span></div>
      <div class="line"><span class="dim number" data-testid="tracker-rate">${rate_hz ? `${Math.round(rate_hz)} Hz` : ""}</span>
        <span class="grow"></span>${this.quality(tracker)}</div>
      ${message ? html`<div class="note" data-testid="tracker-message">${message}</div>` : nothing}
      ${bad_bytes ? html`<div class="note">${bad_bytes} bytes of ${kind} made no sense and were passed over</div>` : nothing}
      ${this.calibration(info)}
      ${repeat(sensors, (sensor) => sensor, (sensor) => this.sensor(sensor))}
    </div>`;
  }

  /** How old its newest samples are on this page, and how evenly they come. */
  private quality(tracker: string): TemplateResult | typeof nothing {
    const { model } = this;
    const heard = model.heardNs.get(tracker);
    const age = heard === undefined ? null : model.clock.ageMs(heard, performance.now());
    const stats = model.stats?.trackers?.find((other) => other.tracker === tracker);
    if (age === null || !stats) return nothing;
    const ms = (us: number) => `${(us / 1000).toFixed(1)} ms`;
    return html`<span class="dim number" data-testid="tracker-age" title="Age of the newest samples here. Those of the last second came up to ${ms(stats.lag_us)} late at the daemon, uneven by ${ms(stats.jitter_us)}">${ageText(age)} ±${ms(stats.jitter_us)}</span>`;
  }

  /** Which calibration counts, and the walk that makes one. */
  private calibration(info: TrackerInfo): TemplateResult {
    const { walk, requests } = this;
    const { tracker, calibration, calibrations = [], held_by, sensors } = info;
    const walking = walk.tracker === tracker;
    const disabled = !this.model.mayOperate || sensors.length === 0;
    const choose = (event: Event) => void requests.tracker("tracker.configure", { tracker, calibration: (event.target as HTMLSelectElement).value || null });
    return html`<div class="line wrap">
        <label class="field">calibration <select data-testid="calibration" ?disabled=${disabled} @change=${choose}>
          <option value="" ?selected=${!calibration}>none</option>
          ${calibrations.map(({ name }) => html`<option ?selected=${name === calibration}>${name}</option>`)}
        </select></label>
        ${held_by && !walking ? html`<span class="held" data-testid="tracker-held">held by ${held_by}</span>` : nothing}
        <span class="grow"></span>
        ${walking ? nothing : html`<button type="button" class="small" data-testid="calibrate" ?disabled=${disabled} @click=${clicked(() => void walk.open(tracker, sensors[0] ?? ""))}>Calibrate…</button>`}
      </div>
      ${walking ? calibrationWalk(this.model, walk, info) : nothing}`;
  }

  private sensor(sensor: string): TemplateResult {
    const { model, requests } = this;
    const sample = model.samples.get(sensor);
    const bound = bindingsOf(model, sensor);
    const targets = targetsOf(model);
    const choose = (event: Event) => {
      const select = event.target as HTMLSelectElement;
      const target = targets.find((one) => targetKey(one) === select.value);
      select.value = "";
      if (target) bindTo(model, requests, sensor, target);
    };
    return html`<div class="sensor" data-testid="sensor-${sensor}">
      <div class="line">
        <span class="chip" draggable=${model.mayEdit ? "true" : "false"} data-testid="sensor-chip" title="Drag me onto a goal, a part of the body, an object or the perspective view"
          @dragstart=${(event: DragEvent) => event.dataTransfer?.setData("text/x-posed-sensor", sensor)}>⠿ ${sensor}</span>
        <span class="grow"></span><span class="dim number" data-testid="sensor-place">${this.placeText(sample)}</span></div>
      ${this.buttons(sample)}
      ${sample?.flags?.length ? html`<div class="note">${sample.flags.join(", ")}</div>` : nothing}
      ${repeat(bound, ([id]) => id, ([id, binding]) => bindingRow(model, requests, id, binding))}
      <select data-testid="sensor-target" aria-label="What ${sensor} is to lead" ?disabled=${!model.mayEdit} @change=${choose}>
        <option value="">${bound.length > 0 ? "lead also…" : "leads nothing: choose…"}</option>
        ${targets.map((target) => html`<option value=${targetKey(target)}>${targetText(target)}</option>`)}
      </select>
    </div>`;
  }

  /** Those that are held now, by the numbers that a clutch goes by. */
  private buttons(sample: SensorSample | undefined): TemplateResult | typeof nothing {
    const held = Array.from({ length: kButtons }, (_, i) => i).filter((i) => ((sample?.buttons ?? 0) >> i) & 1);
    return held.length === 0 ? nothing : html`<div class="line" data-testid="sensor-buttons">${held.map((i) => html`<span class="pressed">button ${i}</span>`)}</div>`;
  }

  private placeText(sample: SensorSample | undefined): string {
    if (!sample) return "not seen";
    return sample.position.map((value) => lengthText(value, this.model.settings.lengths).replace(/ .*/, "")).join("  ");
  }

  /** Bindings outlive their station: one whose sensor is not attached must still be seen and let go. */
  private orphans(): TemplateResult | typeof nothing {
    const attached = new Set(this.model.trackers.flatMap(({ sensors }) => sensors));
    const orphans = Object.entries(this.model.scene.document.bindings).filter(([, { sensor }]) => !attached.has(sensor));
    if (orphans.length === 0) return nothing;
    return html`<div class="rows" data-testid="orphan-bindings">${orphans.map(([id, binding]) => html`<div class="row"><div class="note">${binding.sensor} is not attached: ${targetText(targetOf(binding))}</div>${bindingRow(this.model, this.requests, id, binding)}</div>`)}</div>`;
  }
}

function ageText(ms: number): string {
  return ms < 10_000 ? `${ms.toFixed(0)} ms` : `${(ms / 1000).toFixed(0)} s`;
}
