// The calibration walk in a tracker's row: four steps, each of which says what to do with the sensor in the hand.
// Fields are written only where their value has changed: the row is written anew while somebody types.
import { html, nothing, type TemplateResult } from "lit-html";
import type { TrackerInfo, Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import { lengthText } from "../state/words";
import type { Calibrating } from "../tools/calibrating";
import { clicked } from "./panel";

export function calibrationWalk(model: Model, walk: Calibrating, { tracker, sensors }: TrackerInfo): TemplateResult {
  const length = (metres: number) => lengthText(metres, model.settings.lengths);
  const made = walk.made;
  const station = walk.sensor.split(":")[1] ?? "";
  const tip = made?.sensors[station]?.tip;
  const step = (testid: string, busy: string, text: string, run: () => void, disabled = false) =>
    html`<button type="button" data-testid=${testid} ?disabled=${disabled || walk.measuring !== ""} @click=${clicked(run)}>${walk.measuring === busy ? "measuring…" : text}</button>`;
  return html`<div class="walk" role="group" aria-label="Calibrate ${tracker}" data-testid="walk">
    <div class="line fields">
      <label class="field">stylus <select data-testid="walk-sensor" @change=${(event: Event) => walk.use((event.target as HTMLSelectElement).value)}>${sensors.map((sensor) => html`<option ?selected=${sensor === walk.sensor}>${sensor}</option>`)}</select></label>
      <label class="field">kept as <input type="text" data-testid="walk-name" placeholder="default" maxlength="64" .value=${walk.name} @change=${(event: Event) => (walk.name = (event.target as HTMLInputElement).value.trim())} /></label>
    </div>
    <ol>
      <li><b>Tip.</b> Hold the stylus's tip in one place and swing its other end for five seconds.
        <div class="line">${step("walk-tip", "tip", "Swing", () => void walk.swing())}
          <output data-testid="walk-tip-says">${tip ? `${length(Math.hypot(...tip.offset))} from the sensor, to ${length(tip.residual_m)}` : "not measured"}</output></div></li>
      <li><b>Points.</b> Touch three points or more whose place in the world you know, not in one line.
        ${walk.points.map((_, i) => pointRow(model, walk, i, step))}
        <div class="line"><button type="button" class="small" data-testid="walk-add" @click=${clicked(() => walk.add())}>+ point</button>
          ${step("walk-align", "align", "Align", () => void walk.align(), !walk.mayAlign)}
          <output data-testid="walk-align-says">${made?.points.length ? `fits to ${length(made.residual_m)}` : "not aligned"}</output></div></li>
      <li><b>Straight ahead.</b> A sensor that is glued on askew: hold it so that it should read as not turned at all.
        <div class="line">${step("walk-boresight", "boresight", "Boresight", () => void walk.boresight())}
          <output data-testid="walk-boresight-says">${made?.sensors[station]?.boresight ? `${walk.sensor} is read straight` : ""}</output></div></li>
      <li><b>Check.</b> Touch a point again, now and whenever you doubt.
        <div class="line wrap">${walk.points.map(({ world }, i) => step(`walk-check-${i}`, "check", `Point ${i + 1}`, () => void walk.check(world)))}
          <output data-testid="walk-check-says">${walk.checked ? `${length(walk.checked.off_m)} off` : ""}</output></div></li>
    </ol>
    <div class="line"><span class="grow"></span><button type="button" data-testid="walk-close" @click=${clicked(() => walk.close())}>Done</button></div>
  </div>`;
}

type Step = (testid: string, busy: string, text: string, run: () => void) => TemplateResult;

function pointRow(model: Model, walk: Calibrating, index: number, step: Step): TemplateResult {
  const { world, touch } = walk.points[index]!;
  const scale = model.settings.lengths === "mm" ? 1000 : 1;
  const set = (axis: number, event: Event) => {
    const value = (event.target as HTMLInputElement).valueAsNumber / scale;
    if (Number.isFinite(value)) walk.place(index, world.map((old, i) => (i === axis ? value : old)) as Vec3);
  };
  const aligned = touch && walk.made?.points.find(({ source }) => source.every((value, i) => Math.abs(value - touch.source[i]!) < 1e-9));
  const length = (metres: number) => lengthText(metres, model.settings.lengths);
  return html`<div class="line wrap" data-testid="walk-point-${index}">
    ${(["x", "y", "z"] as const).map((axis, i) => html`<label class="field axis-${axis}">${axis.toUpperCase()} <input type="number" step=${scale / 100} data-testid="walk-${axis}" aria-label="Point ${index + 1}, ${axis}" .value=${String(Number((world[i]! * scale).toFixed(4)))} @change=${(event: Event) => set(i, event)} /></label>`)}
    ${step("walk-touch", `point ${index}`, touch ? "Again" : "Touch", () => void walk.touch(index))}
    <output data-testid="walk-touch-says">${aligned ? `${length(aligned.residual_m)} off` : touch ? `touched, to ${length(touch.spread_m)}` : ""}</output>
    ${walk.points.length > 3 ? html`<button type="button" class="quiet" aria-label="Remove point ${index + 1}" @click=${clicked(() => walk.remove(index))}>×</button>` : nothing}
  </div>`;
}
