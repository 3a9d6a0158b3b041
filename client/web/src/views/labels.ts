// Names beside sensors and beside the goals that the user points at, as text over the canvas.
import type { PagePoint, PaneRect } from "./projection";

export interface Label {
  key: string;
  text: string;
  kind: "goal" | "sensor" | "held" | "segment";
  at: PagePoint;
}

/** About; and the gap to the point. */
const kLetterPixels = 6.6;

export class Labels {
  private readonly shown = new Map<string, HTMLElement>();

  constructor(private readonly pane: HTMLElement) {}

  draw(labels: readonly Label[], rect: PaneRect): void {
    const wanted = new Map(labels.map((label) => [label.key, label]));
    for (const [key, element] of this.shown) {
      if (wanted.has(key)) continue;
      element.remove();
      this.shown.delete(key);
    }
    for (const label of labels) {
      const element = this.shown.get(label.key) ?? this.add(label);
      if (element.textContent !== label.text) element.textContent = label.text;
      element.dataset["kind"] = label.kind;
      const { x, y, depth } = label.at;
      // On the other side of its point where it would run out of the pane.
      const across = Math.round(x - rect.left);
      const flips = across + label.text.length * kLetterPixels > rect.width;
      element.style.transform = `translate(${flips ? `calc(${across - 24}px - 100%)` : `${across}px`}, ${Math.round(y - rect.top)}px)`;
      element.hidden = Math.abs(depth) > 1;
    }
  }

  private add({ key }: Label): HTMLElement {
    const element = document.createElement("span");
    element.className = "label";
    this.pane.append(element);
    this.shown.set(key, element);
    return element;
  }
}
