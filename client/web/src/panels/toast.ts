// What the daemon refused, with its hint, or what has just been done, for some seconds.
import { html, type TemplateResult } from "lit-html";
import type { Model } from "../state/model";
import { Panel } from "./panel";

const kShownMs = { good: 3500, bad: 7000 };

export class Toast extends Panel {
  private shown = 0;
  private hideAt = 0;

  constructor(model: Model) {
    const root = document.createElement("div");
    root.className = "toast";
    root.dataset["testid"] = "toast";
    root.hidden = true;
    root.addEventListener("click", () => (root.hidden = true));
    root.setAttribute("role", "status");
    super(root, model, ["toast"]);
  }

  override update(nowMs: number): void {
    const { toast, version } = this.model;
    if (version.toast !== this.shown && toast) {
      this.shown = version.toast;
      this.hideAt = nowMs + (toast.good ? kShownMs.good : kShownMs.bad);
      this.root.hidden = false;
      this.root.classList.toggle("good", toast.good);
    } else if (!this.root.hidden && nowMs > this.hideAt) this.root.hidden = true;
    super.update(nowMs);
  }

  protected template(): TemplateResult {
    return html`<div class="toast-message">${this.model.toast?.message ?? ""}</div><div class="toast-hint">${this.model.toast?.hint ?? ""}</div>`;
  }
}
