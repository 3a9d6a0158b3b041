// One binding: what it leads and how: absolute or relative, which axes, clutch, scale, filter.
import { html, nothing, type TemplateResult } from "lit-html";
import { live } from "lit-html/directives/live.js";
import type { BindingDocument } from "../protocol/types";
import type { Model } from "../state/model";
import { axesOf, leadsMore, targetOf, targetText } from "../tools/bindings";
import type { Requests } from "../tools/requests";
import { clicked } from "./panel";

export function bindingRow(model: Model, requests: Requests, id: string, binding: BindingDocument): TemplateResult {
  const disabled = !model.mayEdit;
  const set = (fields: Partial<BindingDocument>) => requests.bind(id, fields);
  const axes = axesOf(binding);
  const toggle = (names: readonly string[]) => {
    const on = names.every((name) => axes.includes(name));
    const next = on ? axes.filter((name) => !names.includes(name)) : [...axes, ...names];
    if (next.length > 0) set({ axes: ["x", "y", "z", "rx", "ry", "rz"].filter((name) => next.includes(name)) });
    else model.say("A binding needs an axis", "remove the binding instead");
  };
  const scale = (event: Event) => {
    const value = (event.target as HTMLInputElement).valueAsNumber;
    if (Number.isFinite(value)) set({ scale: value });
  };
  return html`<div class="binding" data-testid="binding-${id}">
    <div class="line"><span class="grow">leads ${targetText(targetOf(binding))}</span>
      <button type="button" class="quiet" data-testid="binding-remove" aria-label="Let ${targetText(targetOf(binding))} go" ?disabled=${disabled} @click=${clicked(() => requests.unbind(id))}>×</button></div>
    <div class="line wrap">
      <select data-testid="binding-mode" aria-label="How it follows" title="absolute: it goes where the sensor is; relative: it moves as the sensor moves" ?disabled=${disabled}
        @change=${(event: Event) => set({ mode: (event.target as HTMLSelectElement).value as "absolute" | "relative" })}>
        ${(["absolute", "relative"] as const).map((mode) => html`<option ?selected=${mode === (binding.mode ?? "absolute")}>${mode}</option>`)}
      </select>
      ${[["x"], ["y"], ["z"], ["rx", "ry", "rz"]].map((names) => html`<button type="button" class="small" aria-pressed=${names.every((name) => axes.includes(name))} aria-label=${names.length > 1 ? "turns" : `moves along ${names[0]}`} ?disabled=${disabled}
        @click=${clicked(() => toggle(names))}>${names.length > 1 ? "turn" : names[0]}</button>`)}
      <label class="field">× <input type="number" step="0.1" data-testid="binding-scale" aria-label="Scale" .value=${String(binding.scale ?? 1)} ?disabled=${disabled} @change=${scale} /></label>
      ${leadsMore(model) ? html`<label class="field"><input type="checkbox" data-testid="binding-clutch" .checked=${live(Boolean(binding.clutch))} ?disabled=${disabled}
          @change=${(event: Event) => set({ clutch: (event.target as HTMLInputElement).checked ? { button: 0 } : null })} /> clutch: button</label>` : nothing}
    </div>
  </div>`;
}
