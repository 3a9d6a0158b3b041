// The chosen figure: its poses, its segments with their padlocks, and the joint of the chosen segment.
import { html, nothing, type TemplateResult } from "lit-html";
import { repeat } from "lit-html/directives/repeat.js";
import type { Model } from "../state/model";
import { costText, plain } from "../state/words";
import { lockOf } from "../tools/joints";
import type { Poses } from "../tools/poses";
import type { Requests } from "../tools/requests";
import type { JointPanel } from "./joint_panel";
import { padlock } from "./padlock";
import { Panel, clicked, section } from "./panel";

export class BodyPanel extends Panel {
  private figure = "";

  constructor(
    model: Model,
    private readonly requests: Requests,
    private readonly poses: Poses,
    private readonly joint: JointPanel,
  ) {
    super(section("panel", "body-panel", "Body"), model, ["scene", "pose", "local", "figures", "ghosts", "settings", "connection"]);
  }

  override update(nowMs: number): void {
    super.update(nowMs);
    this.joint.update(nowMs);
  }

  protected template(): TemplateResult {
    const { model } = this;
    const figures = [...model.figures.keys()];
    this.figure = model.selectedSegment?.figure ?? (figures.includes(this.figure) ? this.figure : (figures[0] ?? ""));
    if (!this.figure) return html`<h2>Body</h2><p class="empty">The scene holds no figure. Press <kbd>N</kbd> for the scenes.</p>`;
    const pose = model.poses.get(this.figure);
    const chooseFigure = (event: Event) => {
      this.figure = (event.target as HTMLSelectElement).value;
      model.choose(null);
      this.redraw();
    };
    return html`
      <h2>Body
        ${figures.length > 1 ? html`<select data-testid="figure-choice" aria-label="Figure" @change=${chooseFigure}>${figures.map((id) => html`<option ?selected=${id === this.figure}>${id}</option>`)}</select>` : nothing}
        <span class="grow"></span>
        <span class="figure-status" data-testid="figure-status" data-status=${pose?.status ?? ""}>${pose?.status ?? ""}</span>
        <span class="dim number">cost ${costText(pose?.cost ?? 0)}</span>
      </h2>
      ${this.own()}${this.saved()}
      ${this.joint.root}
      <h3>Segments</h3>
      ${this.segments()}`;
  }

  private own(): TemplateResult {
    const button = (testid: string, text: string, title: string, run: () => void) =>
      html`<button type="button" data-testid=${testid} title=${title} ?disabled=${!this.model.mayEdit} @click=${clicked(run)}>${text}</button>`;
    return html`<div class="line wrap">
      ${button("pose-start", "Start", "Standing, arms down", () => this.poses.reset(this.figure, "start"))}
      ${button("pose-rest", "T-pose", "The figure's rest", () => this.poses.reset(this.figure, "rest"))}
      ${button("pose-mirror", "Mirror", "Left and right change places", () => this.poses.mirror(this.figure))}
      ${button("pose-keep", "Keep pose", "Keeps this pose in this browser (P)", () => void this.keep())}
    </div>`;
  }

  keep(): Promise<void> {
    const taken = new Set(this.poses.list.map(({ name }) => name));
    let n = 1;
    while (taken.has(`pose ${n}`)) n++;
    return this.poses.save(this.figure || ([...this.model.figures.keys()][0] ?? "body"), `pose ${n}`);
  }

  private saved(): TemplateResult | typeof nothing {
    const mine = this.poses.list.filter(({ figure }) => figure === this.figure);
    if (mine.length === 0) return nothing;
    return html`<ul class="poses" aria-label="Kept poses">${repeat(mine, ({ name }) => name, ({ name }) => html`<li class="line" data-testid="pose-${name}">
      <label class="grow"><input type="checkbox" data-testid="ghost" .checked=${this.poses.shown(name)} @change=${(event: Event) => this.poses.show(name, (event.target as HTMLInputElement).checked)} /> ${name} <span class="dim">as a ghost</span></label>
      <button type="button" data-testid="pose-take" ?disabled=${!this.model.mayEdit} @click=${clicked(() => this.poses.take(name))}>Take</button>
      <button type="button" class="quiet" aria-label="Forget ${name}" @click=${clicked(() => this.poses.remove(name))}>×</button>
    </li>`)}</ul>`;
  }

  private segments(): TemplateResult {
    const { model } = this;
    const document = model.figures.get(this.figure);
    const pins = model.scene.document.figures[this.figure]?.pins ?? {};
    const depth = new Map<string, number>();
    for (const { name, parent } of document?.segments ?? []) depth.set(name, parent === undefined ? 0 : (depth.get(parent) ?? 0) + 1);
    return html`<ul class="segments" aria-label="Segments">${(document?.segments ?? []).map(({ name, joint }) => {
      const chosen = model.selectedSegment?.figure === this.figure && model.selectedSegment.segment === name;
      const pinned = name in pins;
      const locked = joint !== undefined && lockOf(model, this.figure, joint.name) !== null;
      return html`<li class="segment ${chosen ? "selected" : ""}" style="--depth:${depth.get(name) ?? 0}" data-testid="segment-${name}"
          @pointerenter=${() => this.point(name)} @pointerleave=${() => this.point(null)}>
        <button type="button" class="segment-name" aria-pressed=${chosen} @click=${clicked(() => model.choose({ figure: this.figure, segment: name }))}>${plain(name)}</button>
        ${locked ? html`<span class="badge">joint held</span>` : nothing}
        <button type="button" class="padlock" data-testid="pin" aria-pressed=${pinned} aria-label="Pin ${plain(name)}" title=${pinned ? "Pinned where it is: press to let go" : "Pin where it is (L)"}
          ?disabled=${!model.mayEdit} @click=${clicked(() => this.requests.pin(this.figure, name, pinned ? null : "pose"))}>${padlock(pinned)}</button>
      </li>`;
    })}</ul>`;
  }

  private point(segment: string | null): void {
    this.model.hoveredSegment = segment === null ? null : { figure: this.figure, segment };
    this.model.touch("local");
  }
}
