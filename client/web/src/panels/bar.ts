// The bar at the top: the connection, the tools, what is shown, and the meter that is honest about time.
import { html, nothing, type TemplateResult } from "lit-html";
import type { ConnectionState } from "../protocol/connection";
import type { Model } from "../state/model";
import { toggleMaking, type Hands } from "../tools/keys";
import { Panel, clicked } from "./panel";

const kMeterMs = 500;
const kWorkFrames = 60;

export interface BarActions {
  reconnect(): void;
  link(): void;
}

export class Bar extends Panel {
  private meterMs = -Infinity;
  private nowMs = 0;
  private age: number | null = null;

  constructor(
    model: Model,
    private readonly hands: Hands,
    private readonly actions: BarActions,
  ) {
    const root = document.createElement("header");
    root.className = "bar";
    super(root, model, ["connection", "local", "settings", "menu"]);
  }

  override update(nowMs: number): void {
    this.nowMs = nowMs;
    const lost = this.model.connection.phase !== "connected";
    if (nowMs - this.meterMs > kMeterMs) {
      this.meterMs = nowMs;
      this.redraw();
    }
    if (document.body.dataset["phase"] !== this.model.connection.phase) document.body.dataset["phase"] = this.model.connection.phase;
    document.body.classList.toggle("lost", lost);
    super.update(nowMs);
  }

  /** Of the pose that has just been drawn, on this page's clock. */
  drew(poseTimeNs: number, nowMs: number): void {
    this.age = this.model.clock.ageMs(poseTimeNs, nowMs);
  }

  protected template(): TemplateResult {
    const { model, hands, nowMs } = this;
    const { settings } = model;
    const { phase } = model.connection;
    const waiting = model.waitingEdits;
    const tool = (testid: string, text: string, title: string, on: boolean, run: () => void, edits = false) =>
      html`<button type="button" data-testid=${testid} title=${title} aria-pressed=${on} ?disabled=${edits && !model.mayEdit} @click=${clicked(run)}>${text}</button>`;
    return html`
      <h1 class="brand">posed</h1>
      <button type="button" class="connection" data-testid="connection" data-phase=${phase} title=${phase === "lost" ? "Click to try now" : daemonText(model)}
        @click=${() => phase === "lost" && this.actions.reconnect()}>${connectionText(model.connection, nowMs)}</button>
      <span role="status" class="waiting" data-testid="waiting" ?hidden=${waiting === 0}>${waiting} ${waiting === 1 ? "edit waits" : "edits wait"}</span>
      ${model.mayEdit ? nothing : html`<span class="badge" data-testid="role">view only</span>`}
      <button type="button" data-testid="scenes" title="Scenes (N)" @click=${clicked(hands.page.gallery)}>Scenes</button>
      <span class="tools" role="group" aria-label="Tools">
        ${tool("tool-goal", "+ Goal", "Then click a part of the figure (G, or shift-click)", model.makingGoal, () => toggleMaking(model, !model.makingGoal), true)}
        ${tool("tool-move", "Move", "The gizmo moves (W)", settings.gizmo === "move", () => model.change({ gizmo: "move" }), true)}
        ${tool("tool-turn", "Turn", "The gizmo turns (E)", settings.gizmo === "turn", () => model.change({ gizmo: "turn" }), true)}
        ${tool("tool-snap", "Snap", "Snap to 5 cm (S, or hold Ctrl)", settings.snap > 0, () => model.change({ snap: settings.snap > 0 ? 0 : 0.05 }), true)}
      </span>
      <span class="tools" role="group" aria-label="Undo">
        ${tool("bar-undo", "↶", "Undo (Ctrl+Z)", false, () => void hands.requests.undo(), true)}
        ${tool("bar-redo", "↷", "Do again (Ctrl+Shift+Z)", false, () => void hands.requests.redo(), true)}
      </span>
      <span class="tools" role="group" aria-label="Show">
        ${tool("frame-all", "Frame", "Frame the figures in all views (F)", false, () => hands.views.fit(model))}
        ${tool("show-frames", "Axes", "Segment frames (X)", settings.frames, () => model.change({ frames: !settings.frames }))}
        ${tool("show-limits", "Limits", "The range of the chosen joint", settings.limits, () => model.change({ limits: !settings.limits }))}
      </span>
      <span class="grow"></span>
      ${this.meter()}
      <span class="tools" role="group" aria-label="Page">
        ${tool("units", settings.lengths, "Lengths in millimetres or metres", false, () => model.change({ lengths: settings.lengths === "mm" ? "m" : "mm" }))}
        ${tool("theme", { auto: "◐", dark: "●", light: "○" }[settings.theme], `Colours: ${settings.theme}`, false, () => model.change({ theme: ({ auto: "dark", dark: "light", light: "auto" } as const)[settings.theme] }))}
        ${tool("link", "Link", "Copy a link that carries this view", false, this.actions.link)}
        ${tool("picture", "Picture", "Download a picture of the views (C)", false, hands.page.picture)}
        ${tool("help", "?", "Help and keys (?)", false, hands.page.help)}
      </span>`;
  }

  private meter(): TemplateResult {
    const { model, nowMs } = this;
    const work = model.work.slice(-kWorkFrames);
    const mean = work.reduce((a, b) => a + b, 0) / (work.length || 1);
    const lost = Object.entries(model.lost).map(([stream, count]) => `${stream} ${count}`).join(", ") || "none";
    const trip = model.roundTripMs === null ? "" : `, round trip ${model.roundTripMs.toFixed(1)} ms`;
    return html`<span class="meter" data-testid="meter">
      <span data-testid="meter-fps" title="Frames drawn in the last second, ${mean.toFixed(1)} ms of script each">${Math.round(model.frameMeter.perSecond(nowMs))} fps</span>
      <span data-testid="meter-age" title="From sample to screen, of the pose drawn last: the daemon's clock against this page's${trip}">${this.age === null ? "–" : `${this.age.toFixed(this.age < 10 ? 1 : 0)} ms`}</span>
      <span data-testid="meter-lost" title="Frames that the daemon left out because this page was slower: ${lost}">${model.lost.pose ?? 0} dropped</span>
    </span>`;
  }
}

export function connectionText(state: ConnectionState, nowMs: number): string {
  if (state.phase === "connecting") return "connecting…";
  if (state.phase === "connected") return "connected";
  return `lost, again in ${Math.max(0, Math.ceil((state.retryAtMs - nowMs) / 1000))} s`;
}

function daemonText(model: Model): string {
  return model.hello ? `${model.hello.daemon.name} ${model.hello.daemon.version}` : "";
}
