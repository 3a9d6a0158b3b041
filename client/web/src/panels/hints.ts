// The first run: three steps, each done by doing it. Never again once done or closed.
import { html, nothing, type TemplateResult } from "lit-html";
import type { Model } from "../state/model";
import { Panel, section } from "./panel";

const kSteps: ReadonlyArray<readonly [title: string, says: string]> = [
  ["Make a goal", "Press G, then click a hand of the figure."],
  ["Pull", "Drag the cube, in any of the four views. The body follows."],
  ["Change your mind", "Ctrl+Z takes it back, pose and all. ? shows every key."],
];

export class Hints extends Panel {
  private step = 0;
  private goals = -1;
  private target = "";

  constructor(
    model: Model,
    private readonly done: () => void,
  ) {
    super(section("hints", "hints", "First steps"), model, ["scene", "local", "history", "settings", "toast", "connection"]);
  }

  override update(nowMs: number): void {
    if (!this.model.settings.hintsDone) this.follow();
    this.root.hidden = this.model.settings.hintsDone || !this.model.mayEdit || this.model.connection.phase !== "connected";
    super.update(nowMs);
  }

  /** One's own steps tell how far one is. */
  private follow(): void {
    const { scene, selectedGoal, localTargets, toast } = this.model;
    const goals = Object.keys(scene.document.goals).length;
    const dragging = localTargets.size > 0 ? [...localTargets.keys()].join() : "";
    if (this.step === 0 && this.goals >= 0 && goals > this.goals && selectedGoal !== null) this.go(1);
    else if (this.step === 1 && dragging !== "" && dragging !== this.target) this.go(2);
    else if (this.step === 2 && toast?.message.startsWith("Undone")) this.done();
    this.goals = goals;
    this.target = dragging;
  }

  private go(step: number): void {
    this.step = step;
    this.redraw();
  }

  protected template(): TemplateResult {
    return html`<ol>${kSteps.map(([title, says], i) => html`<li class=${i === this.step ? "now" : i < this.step ? "past" : ""} aria-current=${i === this.step ? "step" : nothing}><b>${title}</b><span>${says}</span></li>`)}</ol>
      <button type="button" class="quiet" data-testid="hints-close" aria-label="Close the first steps" @click=${this.done}>×</button>`;
  }
}
