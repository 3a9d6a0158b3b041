// Who is here, what they hold, and what has been done, with one's own steps to take back.
import { html, nothing, type TemplateResult } from "lit-html";
import { repeat } from "lit-html/directives/repeat.js";
import type { HistoryStep, SessionInfo } from "../protocol/types";
import type { Model } from "../state/model";
import { entitiesText, type Requests } from "../tools/requests";
import { Panel, clicked, section } from "./panel";

export class TogetherPanel extends Panel {
  constructor(
    model: Model,
    private readonly requests: Requests,
    private readonly rename: (user: string) => void,
  ) {
    super(section("panel", "together-panel", "Together"), model, ["people", "history", "connection", "settings"]);
  }

  protected template(): TemplateResult {
    const { people, settings, history, hello } = this.model;
    const name = (event: Event) => this.rename((event.target as HTMLInputElement).value.trim());
    return html`
      <h2>Here now <span class="count">${people.others.length + 1}</span></h2>
      <ul class="people" aria-label="People">
        <li class="line"><span class="dot me"></span><label class="field grow">you <input data-testid="my-name" maxlength="40" placeholder="your name" .value=${settings.user} @change=${name} /></label>
          <span class="dim" data-testid="my-role">${hello?.role ?? ""}</span></li>
        ${repeat(people.others, ({ session }) => session, (other) => this.person(other))}
      </ul>
      <h2>What was done <span class="grow"></span>
        <button type="button" data-testid="undo" title="Undo (Ctrl+Z)" ?disabled=${!this.model.mayEdit} @click=${clicked(() => void this.requests.undo())}>Undo</button>
        <button type="button" data-testid="redo" title="Do again (Ctrl+Shift+Z)" ?disabled=${!this.model.mayEdit} @click=${clicked(() => void this.requests.redo())}>Redo</button>
      </h2>
      ${history.length === 0 ? html`<p class="empty">Nothing yet. Ctrl+Z takes back what you do, never what others do.</p>` : nothing}
      <ol class="history" aria-label="Edits, newest first">${repeat(history, ({ step }) => step, (step) => this.step(step))}</ol>`;
  }

  private person({ session, user, client }: SessionInfo): TemplateResult {
    return html`<li class="line" data-testid="person-${session}"><span class="dot"></span><span class="grow">${user || client?.name || session}</span><span class="dim">${client?.name ?? ""}</span></li>`;
  }

  private step({ step, user, session, method, label, entities, mine, undone }: HistoryStep): TemplateResult {
    const says = `${label || kVerbs[method] || method} ${entitiesText(entities)}`;
    return html`<li class="line ${undone ? "undone" : ""}" data-testid="step-${step}">
      <span class="grow">${says}</span><span class="dim">${mine ? "you" : user || session}</span>
      ${mine && this.model.mayEdit
        ? html`<button type="button" class="small" aria-label="${undone ? "Redo" : "Undo"} ${says}" @click=${clicked(() => void (undone ? this.requests.redo(step) : this.requests.undo(step)))}>${undone ? "redo" : "undo"}</button>`
        : nothing}
    </li>`;
  }
}

const kVerbs: Record<string, string> = {
  "goal.set": "set", "goal.remove": "removed", "goal.clear": "cleared", "figure.pin": "pinned", "figure.set": "set figure", "joint.set": "turned", "pose.set": "posed",
  "pose.reset": "reset", "pose.mirror": "mirrored", "scene.new": "new scene", "scene.open": "opened", "binding.set": "bound", "binding.remove": "unbound",
  "object.set": "set", "object.remove": "removed", "camera.set": "set camera", "camera.remove": "removed camera",
};
