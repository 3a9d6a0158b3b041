// The list of goals: what each pulls, how it fares, its weight, and whether it is on.
import type { GoalDocument, GoalPose } from "../protocol/types";
import type { Model } from "../state/model";
import type { Requests } from "../tools/requests";
import { button, element, Rows, setText } from "./dom";
import { atText, causesText, errorText, goalName, sliderFromWeight, weightFromSlider, weightText } from "./words";

export class GoalPanel {
  readonly root = element("section", { className: "panel", testid: "goal-panel" });
  private readonly list = element("div", { className: "rows" });
  private readonly count = element("span", { className: "count" });
  private readonly empty = element("p", { className: "empty", text: "No goals yet. Shift-click a part of the figure, or press G and click, to give it one." });
  private readonly rows: Rows<GoalRow>;
  private seen = "";

  constructor(model: Model, requests: Requests) {
    this.root.append(element("h2", {}, "Goals ", this.count), this.empty, this.list);
    this.rows = new Rows(this.list, (id) => new GoalRow(id, model, requests));
  }

  update(model: Model): void {
    const now = [model.version.scene, model.version.pose, model.version.local].join();
    if (now === this.seen) return;
    this.seen = now;
    const { goals, bindings } = model.scene.document;
    const ids = Object.keys(goals).sort();
    this.rows.sync(ids);
    this.empty.hidden = ids.length > 0;
    setText(this.count, ids.length > 0 ? String(ids.length) : "");
    const sensorOf = new Map(Object.values(bindings).map(({ to, sensor }) => [to.goal, sensor]));
    for (const [id, row] of this.rows.rows) {
      row.update(goals[id] as GoalDocument, model.goalPose(id), id === model.selectedGoal, sensorOf.get(id));
    }
  }
}

class GoalRow {
  readonly root: HTMLElement;
  private readonly name = element("span", { className: "goal-name" });
  private readonly state = element("span", { className: "goal-state", testid: "goal-state" });
  private readonly error = element("span", { className: "goal-error", testid: "goal-error" });
  private readonly note = element("div", { className: "goal-note" });
  private readonly enabled = element("input", { testid: "goal-enabled", title: "On or off" });
  private readonly weight = element("input", { testid: "goal-weight", title: "Weight: how hard this goal pulls" });
  private readonly weightValue = element("output", { testid: "goal-weight-value" });
  private sliding = false;

  constructor(
    private readonly id: string,
    model: Model,
    private readonly requests: Requests,
  ) {
    this.enabled.type = "checkbox";
    this.enabled.setAttribute("aria-label", `${id} on`);
    this.enabled.addEventListener("change", () => requests.setGoal(id, { enabled: this.enabled.checked }));
    this.weight.type = "range";
    [this.weight.min, this.weight.max, this.weight.step] = ["-1", "3", "0.01"];
    this.weight.setAttribute("aria-label", `${id} weight`);
    this.weight.addEventListener("input", () => {
      this.sliding = true;
      const weight = weightFromSlider(this.weight.valueAsNumber);
      setText(this.weightValue, weightText(weight));
      requests.setGoal(id, { weight });
    });
    this.weight.addEventListener("change", () => (this.sliding = false));
    const remove = button("×", "goal-remove", `Remove ${id}`, () => requests.removeGoal(id));
    remove.className = "quiet";
    this.root = element(
      "div",
      { className: "row goal", testid: `goal-${id}`, title: id },
      element("div", { className: "line" }, this.enabled, this.name, this.state, this.error),
      element("div", { className: "line" }, element("span", { className: "dim", text: "weight" }), this.weight, this.weightValue, remove),
      this.note,
    );
    this.root.addEventListener("pointerdown", () => model.select(id));
  }

  update(goal: GoalDocument, pose: GoalPose | undefined, selected: boolean, sensor: string | undefined): void {
    const enabled = goal.enabled !== false;
    // Two weights are more than one slider can say: it shows the first.
    const two = typeof goal.weight === "object";
    const weight = typeof goal.weight === "object" ? goal.weight.position : (goal.weight ?? 10);
    const state = enabled ? (pose?.state ?? "off") : "off";
    this.root.classList.toggle("selected", selected);
    this.root.dataset["state"] = state;
    const [name, at] = [goal.label || goalName(this.id), atText(goal.at)];
    setText(this.name, name);
    setText(this.state, state);
    setText(this.error, enabled && pose ? errorText(pose.error) : "");
    const kind = goal.kind === undefined || goal.kind === "position" ? "" : goal.kind;
    const notes = [kind, at === name ? "" : `at ${at}`, sensor ? `follows ${sensor}` : "", enabled ? causesText(pose?.causes) : ""].filter(Boolean);
    setText(this.note, notes.join(" · "));
    this.note.hidden = notes.length === 0;
    // What the user has just set stays until the daemon has answered.
    if (this.sliding || this.requests.busy(this.id)) return;
    if (this.enabled.checked !== enabled) this.enabled.checked = enabled;
    this.weight.disabled = two;
    const slider = String(sliderFromWeight(weight));
    if (this.weight.value !== slider) this.weight.value = slider;
    setText(this.weightValue, weightText(weight));
  }
}
