// Tracker stations with their sensors, and what each sensor leads.
import { html, nothing, type TemplateResult } from "lit-html";
import { repeat } from "lit-html/directives/repeat.js";
import type { SensorSample, TrackerInfo } from "../protocol/types";
import type { Model } from "../state/model";
import { lengthText } from "../state/words";
import { bindTo, bindingsOf, targetText, targetsOf, targetOf, targetKey } from "../tools/bindings";
import type { Requests } from "../tools/requests";
import { bindingRow } from "./binding_row";
import { Panel, section } from "./panel";

export class TrackerPanel extends Panel {
  constructor(
    model: Model,
    private readonly requests: Requests,
  ) {
    super(section("panel", "tracker-panel", "Trackers"), model, ["scene", "trackers", "samples", "settings", "connection", "local"]);
  }

  protected template(): TemplateResult {
    const { trackers } = this.model;
    return html`<h2>Trackers</h2>
      ${trackers.length === 0 ? html`<p class="empty">No tracker is attached. Start the daemon with <code>--tracker simulated</code> to try one.</p>` : html`<p class="empty">Drag a sensor onto a goal, a part of the body, an object or the perspective view: it leads what you drop it on.</p>`}
      <div class="rows">${repeat(trackers, ({ tracker }) => tracker, (tracker) => this.station(tracker))}</div>
      ${this.orphans()}`;
  }

  private station({ tracker, state, kind, rate_hz, message, sensors, bad_bytes }: TrackerInfo): TemplateResult {
    return html`<div class="row tracker" data-testid="tracker-${tracker}" data-state=${state}>
      <div class="line"><span class="grow strong">${tracker}</span>
        <span class="dim number" data-testid="tracker-rate">${rate_hz ? `${Math.round(rate_hz)} Hz` : ""}</span>
        <span class="tracker-state" data-testid="tracker-state">${state}</span></div>
      ${message ? html`<div class="note" data-testid="tracker-message">${message}</div>` : nothing}
      ${bad_bytes ? html`<div class="note">${bad_bytes} bytes of ${kind} made no sense and were passed over</div>` : nothing}
      ${repeat(sensors, (sensor) => sensor, (sensor) => this.sensor(sensor))}
    </div>`;
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
      ${sample?.flags?.length ? html`<div class="note">${sample.flags.join(", ")}</div>` : nothing}
      ${repeat(bound, ([id]) => id, ([id, binding]) => bindingRow(model, requests, id, binding))}
      <select data-testid="sensor-target" aria-label="What ${sensor} is to lead" ?disabled=${!model.mayEdit} @change=${choose}>
        <option value="">${bound.length > 0 ? "lead also…" : "leads nothing: choose…"}</option>
        ${targets.map((target) => html`<option value=${targetKey(target)}>${targetText(target)}</option>`)}
      </select>
    </div>`;
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
