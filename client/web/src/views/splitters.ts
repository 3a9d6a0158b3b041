// The bars between the four panes: dragged, moved by the arrow keys, or put back to the middle by a double click.
/** Shares of the width and of the height that the left and the upper panes take. */
export interface Split {
  x: number;
  y: number;
}

const kLeast = 0.15;
const kStep = 0.03;

export class Splitters {
  private now: Split = { x: 0.5, y: 0.5 };
  private readonly bars: Record<"x" | "y", HTMLElement>;

  constructor(
    private readonly parent: HTMLElement,
    private readonly changed: () => void,
  ) {
    this.bars = { x: this.bar("x"), y: this.bar("y") };
    const cross = this.handle("splitter splitter-cross", ["x", "y"]);
    parent.append(this.bars.x, this.bars.y, cross);
    this.split = this.now;
  }

  get split(): Split {
    return this.now;
  }

  set split({ x, y }: Split) {
    this.now = { x: within(x), y: within(y) };
    this.parent.style.setProperty("--split-x", `${this.now.x * 100}%`);
    this.parent.style.setProperty("--split-y", `${this.now.y * 100}%`);
    for (const axis of ["x", "y"] as const) this.bars[axis].setAttribute("aria-valuenow", String(Math.round(this.now[axis] * 100)));
    this.changed();
  }

  private bar(axis: "x" | "y"): HTMLElement {
    const bar = this.handle(`splitter splitter-${axis}`, [axis]);
    bar.tabIndex = 0;
    bar.setAttribute("role", "separator");
    bar.setAttribute("aria-orientation", axis === "x" ? "vertical" : "horizontal");
    bar.setAttribute("aria-label", axis === "x" ? "Width of the left views" : "Height of the upper views");
    bar.setAttribute("aria-valuemin", String(kLeast * 100));
    bar.setAttribute("aria-valuemax", String(100 - kLeast * 100));
    bar.dataset["testid"] = `splitter-${axis}`;
    bar.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -kStep, ArrowUp: -kStep, ArrowRight: kStep, ArrowDown: kStep }[event.key];
      if (step === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      this.split = { ...this.now, [axis]: this.now[axis] + step };
    });
    return bar;
  }

  private handle(className: string, axes: ReadonlyArray<"x" | "y">): HTMLElement {
    const bar = document.createElement("div");
    bar.className = className;
    bar.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      bar.setPointerCapture(event.pointerId);
    });
    bar.addEventListener("pointermove", (event) => {
      if (!bar.hasPointerCapture(event.pointerId)) return;
      const area = this.parent.getBoundingClientRect();
      const at = { x: (event.clientX - area.left) / area.width, y: (event.clientY - area.top) / area.height };
      this.split = { ...this.now, ...Object.fromEntries(axes.map((axis) => [axis, at[axis]])) };
    });
    bar.addEventListener("dblclick", () => (this.split = { ...this.now, ...Object.fromEntries(axes.map((axis) => [axis, 0.5])) }));
    return bar;
  }
}

function within(share: number): number {
  return Math.min(Math.max(share, kLeast), 1 - kLeast);
}
