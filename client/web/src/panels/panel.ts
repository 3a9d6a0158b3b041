// A part of the page that is written anew when what it shows has changed; numbers that stream, at most some times a second.
import { render, type TemplateResult } from "lit-html";
import type { Model, Topic } from "../state/model";

/** What streams sixty times a second; nobody reads numbers that fast. */
const kStreams: readonly Topic[] = ["pose", "samples", "cameras"];
const kStreamPauseMs = 150;

export abstract class Panel {
  private seen = "";
  private streamsSeen = "";
  private drawnMs = -Infinity;

  constructor(
    readonly root: HTMLElement,
    protected readonly model: Model,
    private readonly topics: readonly Topic[],
  ) {}

  update(nowMs: number): void {
    const at = (topic: Topic) => this.model.version[topic];
    const now = this.topics.filter((topic) => !kStreams.includes(topic)).map(at).join();
    const streams = this.topics.filter((topic) => kStreams.includes(topic)).map(at).join();
    const streamed = streams !== this.streamsSeen && nowMs - this.drawnMs >= kStreamPauseMs;
    if (now === this.seen && !streamed) return;
    [this.seen, this.streamsSeen, this.drawnMs] = [now, streams, nowMs];
    this.redraw();
  }

  redraw(): void {
    render(this.template(), this.root);
  }

  protected abstract template(): TemplateResult;
}

export function section(className: string, testid: string, label: string): HTMLElement {
  const made = document.createElement("section");
  made.className = className;
  made.dataset["testid"] = testid;
  made.setAttribute("aria-label", label);
  return made;
}

/** A button that was clicked gives the keyboard back to the views; one that was pressed by a key keeps the focus. */
export function clicked(run: () => void): (event: MouseEvent) => void {
  return (event) => {
    run();
    if (event.detail > 0 && event.currentTarget instanceof HTMLElement) event.currentTarget.blur();
  };
}
