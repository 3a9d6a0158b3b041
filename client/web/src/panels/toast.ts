// What the daemon refused, with its hint, for some seconds.
import type { Model } from "../state/model";
import { element, setText } from "./dom";

const kShownMs = 7000;

export class Toast {
  readonly root = element("div", { className: "toast", testid: "toast" });
  private readonly message = element("div", { className: "toast-message" });
  private readonly hint = element("div", { className: "toast-hint" });
  private seen = 0;
  private hideAt = 0;

  constructor() {
    this.root.setAttribute("role", "alert");
    this.root.hidden = true;
    this.root.append(this.message, this.hint);
    this.root.addEventListener("click", () => (this.root.hidden = true));
  }

  update(model: Model, nowMs: number): void {
    if (this.seen !== model.version.toast && model.toast) {
      this.seen = model.version.toast;
      this.hideAt = nowMs + kShownMs;
      setText(this.message, model.toast.message);
      setText(this.hint, model.toast.hint);
      this.root.hidden = false;
    } else if (!this.root.hidden && nowMs > this.hideAt) {
      this.root.hidden = true;
    }
  }
}
