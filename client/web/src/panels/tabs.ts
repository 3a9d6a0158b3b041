// The side of the page: one list of tabs, of which one shows.
import type { Panel } from "./panel";

export interface Tab {
  id: string;
  title: string;
  panel: Panel;
}

export class Tabs {
  readonly root = document.createElement("aside");
  private readonly buttons: HTMLButtonElement[] = [];
  private open = 0;

  constructor(private readonly tabs: readonly Tab[]) {
    this.root.className = "side";
    this.root.setAttribute("aria-label", "Panels");
    const list = document.createElement("div");
    list.className = "tabs";
    list.setAttribute("role", "tablist");
    tabs.forEach(({ id, title, panel }, i) => {
      const button = document.createElement("button");
      button.type = "button";
      button.id = `tab-${id}`;
      button.textContent = title;
      button.dataset["testid"] = `tab-${id}`;
      button.setAttribute("role", "tab");
      button.setAttribute("aria-controls", `panel-${id}`);
      button.addEventListener("click", () => this.show(i));
      button.addEventListener("keydown", (event) => this.key(event));
      list.append(button);
      this.buttons.push(button);
      panel.root.id = `panel-${id}`;
      panel.root.setAttribute("role", "tabpanel");
      panel.root.removeAttribute("aria-label");
      panel.root.setAttribute("aria-labelledby", button.id);
      panel.root.tabIndex = 0;
    });
    this.root.append(list, ...tabs.map(({ panel }) => panel.root));
    this.show(0);
  }

  showNamed(id: string): void {
    this.show(this.tabs.findIndex((tab) => tab.id === id));
  }

  /** A panel that nobody sees is not written. */
  update(nowMs: number): void {
    this.tabs[this.open]?.panel.update(nowMs);
  }

  private show(index: number): void {
    if (index < 0) return;
    this.open = index;
    this.tabs.forEach(({ panel }, i) => {
      panel.root.hidden = i !== index;
      this.buttons[i]!.setAttribute("aria-selected", String(i === index));
      this.buttons[i]!.tabIndex = i === index ? 0 : -1;
    });
  }

  private key(event: KeyboardEvent): void {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    // From the tab that has the focus, whichever is open.
    const now = this.buttons.indexOf(event.currentTarget as HTMLButtonElement);
    this.show((now + by + this.tabs.length) % this.tabs.length);
    this.buttons[this.open]?.focus();
  }
}
