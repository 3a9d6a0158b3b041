// A slider that the hand leads: while it slides, what the daemon answers does not move it.
import { html, type TemplateResult } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { newId } from "../tools/new_id";

export interface SliderLook {
  key: string;
  label: string;
  testid: string;
  min: number;
  max: number;
  step: number;
  value: number;
  text: string;
  disabled: boolean;
  /** Slides of one press are one gesture. */
  change(value: number, gesture: string): void;
}

/** What is under the hand, by the slider's key, until the hand lets go. */
const sliding = new Map<string, { value: number; gesture: string }>();
/** After letting go the answer may still be on its way. */
const kEchoMs = 350;

export function slider(look: SliderLook): TemplateResult {
  const held = sliding.get(look.key);
  const input = (event: Event) => {
    const value = (event.target as HTMLInputElement).valueAsNumber;
    const gesture = sliding.get(look.key)?.gesture ?? newId();
    sliding.set(look.key, { value, gesture });
    look.change(value, gesture);
  };
  const done = () => void setTimeout(() => sliding.delete(look.key), kEchoMs);
  return html`<label class="slider">
    <span class="slider-name">${look.label}</span>
    <input type="range" data-testid=${look.testid} aria-label=${look.label} aria-valuetext=${look.text} min=${look.min} max=${look.max} step=${look.step}
      .value=${live(String(held?.value ?? look.value))} ?disabled=${look.disabled} @input=${input} @change=${done} />
    <output data-testid="${look.testid}-value">${look.text}</output>
  </label>`;
}

/** The value to write beside a slider: the hand's, else the daemon's. */
export function shownValue(key: string, value: number): number {
  return sliding.get(key)?.value ?? value;
}
