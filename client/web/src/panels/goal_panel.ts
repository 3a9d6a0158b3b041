// The list of goals: what each pulls, how it fares, its share of the force and what stands in its way; the chosen one opens.
import { html, nothing, type TemplateResult } from "lit-html";
import { repeat } from "lit-html/directives/repeat.js";
import { live } from "lit-html/directives/live.js";
import type { GoalDocument, GoalPose, Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import { atText, causesText, frameText, goalName, isAngle, lengthText, degreesText, sliderFromWeight, weightFromSlider, weightText } from "../state/words";
import { addGoalMenu } from "./add_goal_menu";
import type { Requests } from "../tools/requests";
import { Panel, clicked, section } from "./panel";
import { shownValue, slider } from "./slider";

export class GoalPanel extends Panel {
  constructor(
    model: Model,
    private readonly requests: Requests,
  ) {
    super(section("panel", "goal-panel", "Goals"), model, ["scene", "pose", "local", "people", "settings", "connection", "figures"]);
  }

  protected template(): TemplateResult {
    const { goals, bindings } = this.model.scene.document;
    const ids = Object.keys(goals).sort();
    const leads = new Map(Object.values(bindings).map(({ to, sensor }) => [to.goal, sensor]));
    const pull = this.pulls();
    return html`
      <h2>Goals <span class="count">${ids.length || nothing}</span>${addGoalMenu(this.model, this.requests)}</h2>
      ${ids.length === 0 ? html`<p class="empty">No goals yet. Press <kbd>G</kbd> and click a part of the figure, or shift-click it, to give it one.</p>` : nothing}
      <ul class="rows" aria-label="Goals">${repeat(ids, (id) => id, (id) => this.row(id, goals[id]!, leads.get(id), pull))}</ul>`;
  }

  /** Force by goal, and the sum of each figure. */
  private pulls(): { of: Map<string, number>; sum: number } {
    const of = new Map([...this.model.poses.values()].flatMap(({ goals }) => goals.map(({ id, force }) => [id, Math.hypot(...(force ?? [0]))] as const)));
    return { of, sum: [...of.values()].reduce((a, b) => a + b, 0) };
  }

  private row(id: string, goal: GoalDocument, sensor: string | undefined, pull: { of: Map<string, number>; sum: number }): TemplateResult {
    const { model, requests } = this;
    const [pose, enabled, selected] = [model.goalPose(id), goal.enabled !== false, id === model.selectedGoal];
    const state = enabled ? (pose?.state ?? "off") : "off";
    const name = goal.label || goalName(id);
    const holder = model.people.holder(id);
    const share = pull.sum > 1e-3 ? (pull.of.get(id) ?? 0) / pull.sum : 0;
    const kind = goal.kind ?? "position";
    const notes = [
      kind === "position" ? "" : kind, atText(goal.at) === name ? "" : atText(goal.at), frameText(goal.relative_to),
      goal.priority ? `priority ${goal.priority}` : "", sensor ? `follows ${sensor}` : "",
    ].filter(Boolean).join(" · ");
    const causes = enabled ? causesText(pose?.causes, model.settings.lengths) : "";
    return html`<li class="row goal ${selected ? "selected" : ""}" data-testid="goal-${id}" data-state=${state} title=${id}
        @pointerdown=${() => model.select(id)} @pointerenter=${() => this.point(id)} @pointerleave=${() => this.point(null)}>
      <div class="line">
        <input type="checkbox" data-testid="goal-enabled" aria-label="${name} on" .checked=${live(enabled)} ?disabled=${!model.mayEdit}
          @change=${(event: Event) => requests.setGoal(id, { enabled: (event.target as HTMLInputElement).checked })} />
        <button type="button" class="goal-name" aria-pressed=${selected} @click=${clicked(() => model.select(id))}>${name}</button>
        ${holder ? html`<span class="held" data-testid="goal-held">held by ${holder}</span>` : nothing}
        <span class="goal-state" data-testid="goal-state">${state}</span>
        <span class="goal-error" data-testid="goal-error">${enabled && pose ? this.errorText(goal, pose) : ""}</span>
      </div>
      ${this.weights(id, goal)}
      ${share > 0.005 ? html`<div class="share" title="Its share of all force on the figures"><i style="width:${(share * 100).toFixed(1)}%"></i><span data-testid="goal-share">${Math.round(share * 100)} % of the force</span></div>` : nothing}
      ${causes ? html`<div class="causes" data-testid="goal-causes">${causes}</div>` : nothing}
      ${notes ? html`<div class="note">${notes}</div>` : nothing}
      ${selected ? this.details(id, goal) : nothing}
    </li>`;
  }

  private point(id: string | null): void {
    this.model.hoveredGoal = id;
    this.model.touch("local");
  }

  private errorText(goal: GoalDocument, { error }: GoalPose): string {
    return isAngle(goal.kind) ? `${lengthText(error, this.model.settings.lengths)} arc` : lengthText(error, this.model.settings.lengths);
  }

  private weights(id: string, goal: GoalDocument): TemplateResult {
    const { weight = 10 } = goal;
    if (typeof weight === "number") return this.weight(id, "weight", weight, (value) => value);
    return html`${this.weight(id, "place", weight.position, (position) => ({ ...weight, position }))}${this.weight(id, "turn", weight.orientation, (orientation) => ({ ...weight, orientation }))}`;
  }

  private weight(id: string, label: string, weight: number, whole: (value: number) => NonNullable<GoalDocument["weight"]>): TemplateResult {
    const key = `${id} ${label}`;
    const value = sliderFromWeight(weight);
    const shown = shownValue(key, value);
    return slider({
      key, label, testid: label === "turn" ? "goal-turn-weight" : "goal-weight", min: -1, max: 3, step: 0.01, value,
      text: shown === value ? weightText(weight) : weightText(weightFromSlider(shown)), disabled: !this.model.mayEdit,
      change: (moved, gesture) => this.requests.setGoal(id, { weight: whole(weightFromSlider(moved)) }, gesture),
    });
  }

  private details(id: string, goal: GoalDocument): TemplateResult {
    const { model, requests } = this;
    const target = model.goalTarget(id);
    const number = (field: "priority" | "tolerance", value: number, step: number, unit = "") => html`<label class="field">${field}${unit}
      <input type="number" step=${step} data-testid="goal-${field}" .value=${String(value)} ?disabled=${!model.mayEdit}
        @change=${(event: Event) => this.setNumber(id, field, (event.target as HTMLInputElement).valueAsNumber)} /></label>`;
    return html`<div class="details">
      ${target && model.movable(id) ? html`<div class="line fields">${(["x", "y", "z"] as const).map((axis, i) => this.coordinate(id, axis, i, target))}</div>` : nothing}
      <div class="line fields">
        ${number("priority", goal.priority ?? 0, 1)}
        ${typeof goal.tolerance === "object" ? nothing : number("tolerance", (goal.tolerance ?? 0) * 1000, 1, " mm")}
        <span class="grow"></span>
        <button type="button" class="danger" data-testid="goal-remove" ?disabled=${!model.mayEdit} @click=${clicked(() => requests.removeGoal(id))}>Remove</button>
      </div>
      ${goal.distance ? html`<div class="note">${goal.distance.compare ?? "equal"} ${lengthText(goal.distance.length, model.settings.lengths)} from ${atText(goal.distance.to)}</div>` : nothing}
      ${model.goalTurn(id) ? html`<div class="note">turned ${degreesText(2 * Math.acos(Math.min(1, Math.abs(model.goalTurn(id)![3]))))} from the world's axes; <kbd>E</kbd> turns, <kbd>W</kbd> moves</div>` : nothing}
    </div>`;
  }

  private coordinate(id: string, axis: "x" | "y" | "z", index: number, target: Vec3): TemplateResult {
    const scale = this.model.settings.lengths === "mm" ? 1000 : 1;
    const set = (event: Event) => {
      const value = (event.target as HTMLInputElement).valueAsNumber / scale;
      if (Number.isFinite(value)) this.requests.moveGoal(id, target.map((old, i) => (i === index ? value : old)) as Vec3, undefined);
    };
    return html`<label class="field axis-${axis}">${axis.toUpperCase()}
      <input type="number" step=${scale / 100} data-testid="goal-${axis}" .value=${(target[index]! * scale).toFixed(scale === 1 ? 3 : 0)} ?disabled=${!this.model.mayEdit} @change=${set} /></label>`;
  }

  private setNumber(id: string, field: "priority" | "tolerance", value: number): void {
    if (!Number.isFinite(value)) return;
    this.requests.setGoal(id, field === "priority" ? { priority: Math.round(value) } : { tolerance: Math.max(0, value) / 1000 });
  }
}
