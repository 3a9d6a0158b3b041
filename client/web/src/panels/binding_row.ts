// One binding: what it leads and how: absolute or relative, which axes, clutch, scale, filter.
import { html, nothing, type TemplateResult } from "lit-html";
import { live } from "lit-html/directives/live.js";
import type { BindingDocument, Filter } from "../protocol/types";
import type { Model } from "../state/model";
import { axesOf, axesThere, leadsMore, targetOf, targetText } from "../tools/bindings";
import type { Requests } from "../tools/requests";
import { clicked } from "./panel";

const kAllAxes = ["x", "y", "z", "rx", "ry", "rz"];
const kButtons = [0, 1, 2, 3];
const kActions = { recenter: "bring back", toggle: "stay or follow", save: "save the scene" } as const;

export function bindingRow(model: Model, requests: Requests, id: string, binding: BindingDocument): TemplateResult {
  const disabled = !model.mayEdit;
  const set = (fields: Partial<BindingDocument>) => requests.bind(id, fields);
  const axes = axesOf(model, binding);
  const toggle = (name: string) => {
    const next = axes.includes(name) ? axes.filter((other) => other !== name) : [...axes, name];
    if (next.length > 0) set({ axes: kAllAxes.filter((other) => next.includes(other)) });
    else model.say("A binding needs an axis", "remove the binding instead");
  };
  const scale = (event: Event) => {
    const value = (event.target as HTMLInputElement).valueAsNumber;
    if (Number.isFinite(value)) set({ scale: value });
  };
  const clutch = (event: Event) => {
    const { value } = event.target as HTMLSelectElement;
    set({ clutch: value === "" ? null : { button: Number(value) } });
  };
  return html`<div class="binding" data-testid="binding-${id}">
    <div class="line"><span class="grow">leads ${targetText(targetOf(binding))}</span>
      <button type="button" class="quiet" data-testid="binding-remove" aria-label="Let ${targetText(targetOf(binding))} go" ?disabled=${disabled} @click=${clicked(() => requests.unbind(id))}>×</button></div>
    <div class="line wrap">
      <select data-testid="binding-mode" aria-label="How it follows" title="absolute: it goes where the sensor is; relative: it moves as the sensor moves" ?disabled=${disabled}
        @change=${(event: Event) => set({ mode: (event.target as HTMLSelectElement).value as "absolute" | "relative" })}>
        ${(["absolute", "relative"] as const).map((mode) => html`<option ?selected=${mode === (binding.mode ?? "absolute")}>${mode}</option>`)}
      </select>
      ${axesThere(model, binding).map((name) => html`<button type="button" class="small" aria-pressed=${axes.includes(name)} aria-label=${name.length > 1 ? `turns about ${name[1]}` : `moves along ${name}`} ?disabled=${disabled}
        @click=${clicked(() => toggle(name))}>${name.length > 1 ? `⟳${name[1]}` : name}</button>`)}
      <label class="field">× <input type="number" step="0.1" data-testid="binding-scale" aria-label="Scale" .value=${String(binding.scale ?? 1)} ?disabled=${disabled} @change=${scale} /></label>
      ${leadsMore(model) ? html`<label class="field" title="It moves only while this button of the sensor is held">clutch <select data-testid="binding-clutch" ?disabled=${disabled} @change=${clutch}>
          <option value="" ?selected=${!binding.clutch}>none</option>
          ${kButtons.map((button) => html`<option value=${button} ?selected=${binding.clutch?.button === button}>button ${button}</option>`)}
        </select></label>` : nothing}
    </div>
    ${filterFields(binding, set, disabled)}
    ${leadsMore(model) ? buttonFields(binding, set, disabled) : nothing}
  </div>`;
}

/** What the sensor's buttons do when they are pressed. */
function buttonFields({ buttons = [], mode }: BindingDocument, set: (fields: Partial<BindingDocument>) => void, disabled: boolean): TemplateResult {
  const choose = (button: number, event: Event) => {
    const action = (event.target as HTMLSelectElement).value as keyof typeof kActions | "";
    const others = buttons.filter((other) => other.button !== button);
    set({ buttons: action === "" ? others : [...others, { button, do: action }].sort((a, b) => a.button - b.button) });
  };
  const does = (button: number) => buttons.find((other) => other.button === button)?.do;
  return html`<details data-testid="binding-buttons"><summary>buttons${buttons.length > 0 ? html` (${buttons.length})` : nothing}</summary>
    <div class="line wrap">${kButtons.map((button) => html`<label class="field">button ${button} <select data-testid="binding-button-${button}" ?disabled=${disabled} @change=${(event: Event) => choose(button, event)}>
      <option value="" ?selected=${!does(button)}>nothing</option>
      ${Object.entries(kActions).filter(([action]) => action !== "recenter" || mode === "relative" || does(button) === action).map(([action, says]) => html`<option value=${action} ?selected=${does(button) === action}>${says}</option>`)}
    </select></label>`)}</div>
  </details>`;
}

/** The One-Euro low pass (calm at rest, quick in motion) and how far ahead the daemon looks. */
function filterFields({ filter }: BindingDocument, set: (fields: Partial<BindingDocument>) => void, disabled: boolean): TemplateResult {
  const { one_euro, predict_ms = 0 } = filter ?? {};
  // What is left out is as nothing at all.
  const change = (next: Filter) => {
    const rest: Filter = { ...(next.one_euro ? { one_euro: next.one_euro } : {}), ...(next.predict_ms ? { predict_ms: next.predict_ms } : {}) };
    set({ filter: Object.keys(rest).length > 0 ? rest : null });
  };
  const kept = { ...(one_euro ? { one_euro } : {}), predict_ms };
  const number = (testid: string, says: string, title: string, value: number, least: number, most: number, step: number, run: (value: number) => void) => html`<label class="field" title=${title}>${says}
    <input type="number" min=${least} max=${most} step=${step} data-testid=${testid} .value=${String(value)} ?disabled=${disabled}
      @change=${(event: Event) => { const { valueAsNumber } = event.target as HTMLInputElement; if (Number.isFinite(valueAsNumber)) run(Math.min(Math.max(valueAsNumber, least), most)); }} /></label>`;
  return html`<div class="line wrap">
    <label class="field"><input type="checkbox" data-testid="binding-smooth" .checked=${live(one_euro !== undefined)} ?disabled=${disabled}
      @change=${(event: Event) => change((event.target as HTMLInputElement).checked ? { ...kept, one_euro: { min_cutoff_hz: 1, beta: 5 } } : { predict_ms })} /> smooth</label>
    ${one_euro ? html`
      ${number("binding-cutoff", "Hz", "Cutoff at rest: lower is calmer", one_euro.min_cutoff_hz ?? 1, 0.01, 1000, 0.1, (min_cutoff_hz) => change({ ...kept, one_euro: { ...one_euro, min_cutoff_hz } }))}
      ${number("binding-beta", "β", "How much the cutoff grows with speed, Hz for each metre or radian a second: higher lags less", one_euro.beta ?? 0, 0, 1000, 0.5, (beta) => change({ ...kept, one_euro: { ...one_euro, beta } }))}` : nothing}
    ${number("binding-predict", "ahead, ms", "Looks ahead, by up to 100 ms", predict_ms, 0, 100, 5, (ahead) => change({ ...kept, predict_ms: ahead }))}
  </div>`;
}
