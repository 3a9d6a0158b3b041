// The four panes of the page that lie over the one canvas: titles, sizes, and which one is maximised.
import { titles, viewNames, type ViewName } from "./names";
import type { PaneRect } from "./projection";
import { Splitters, type Split } from "./splitters";

export class Panes {
  readonly elements: Record<ViewName, HTMLElement>;
  maximised: ViewName | null = null;
  version = 0;
  private readonly splitters: Splitters;
  private rects!: Record<ViewName, DOMRect>;
  private measuredFor = -1;

  constructor(private readonly parent: HTMLElement) {
    this.elements = Object.fromEntries(viewNames.map((name) => [name, this.build(name)])) as Record<ViewName, HTMLElement>;
    this.splitters = new Splitters(parent, () => this.version++);
    const resized = new ResizeObserver(() => this.version++);
    resized.observe(parent);
    // What stands above can come and go and leave the size as it is.
    resized.observe(document.body);
    window.addEventListener("resize", () => this.version++);
  }

  get split(): Split {
    return this.splitters.split;
  }

  set split(split: Split) {
    this.splitters.split = split;
  }

  toggle(name: ViewName | null): void {
    this.maximised = this.maximised === name ? null : name;
    this.parent.classList.toggle("one", this.maximised !== null);
    for (const view of viewNames) this.elements[view].hidden = this.maximised !== null && view !== this.maximised;
    this.version++;
  }

  visible(): ViewName[] {
    return viewNames.filter((name) => !this.elements[name].hidden);
  }

  /** Asking the browser may make it lay the page out, so it is asked once for each change. */
  rect(name: ViewName): PaneRect {
    if (this.measuredFor !== this.version) {
      this.measuredFor = this.version;
      this.rects = Object.fromEntries(viewNames.map((view) => [view, this.elements[view].getBoundingClientRect()])) as Record<ViewName, DOMRect>;
    }
    return this.rects[name];
  }

  /** What stands in a pane's title beside its name. */
  says(name: ViewName, text: string): void {
    const says = this.elements[name].querySelector(".pane-says");
    if (says && says.textContent !== text) says.textContent = text;
  }

  private build(name: ViewName): HTMLElement {
    const { key, name: called, axes, says } = titles[name];
    const pane = document.createElement("section");
    pane.className = `pane pane-${name}`;
    pane.dataset["testid"] = `view-${name}`;
    pane.dataset["view"] = name;
    pane.setAttribute("aria-label", `${called} view`);
    const title = document.createElement("header");
    title.dataset["testid"] = `title-${name}`;
    title.title = `Double-click or press ${key} to maximise`;
    title.append(span("pane-key", key), span("pane-name", called));
    for (const [axis, arrow] of axes) title.append(span(`axis axis-${axis}`, `${axis.toUpperCase()}${arrow}`));
    title.append(span("pane-says", says));
    title.addEventListener("dblclick", () => this.toggle(name));
    pane.append(title);
    this.parent.append(pane);
    return pane;
  }
}

function span(className: string, text: string): HTMLSpanElement {
  const element = document.createElement("span");
  element.className = className;
  element.textContent = text;
  return element;
}
