// One line for each figure: how its solve ended and what its goals cost.
import type { Model } from "../state/model";
import { element, Rows, setText } from "./dom";
import { costText } from "./words";

export class FigurePanel {
  readonly root = element("section", { className: "panel", testid: "figure-panel" });
  private readonly list = element("div", { className: "rows" });
  private readonly empty = element("p", { className: "empty", text: "The scene holds no figure. Begin a new scene from the menu." });
  private readonly rows: Rows<FigureRow>;
  private seen = "";

  constructor() {
    this.root.append(element("h2", { text: "Figures" }), this.empty, this.list);
    this.rows = new Rows(this.list, (id) => new FigureRow(id));
  }

  update(model: Model): void {
    const now = [model.version.figures, model.version.pose].join();
    if (now === this.seen) return;
    this.seen = now;
    this.rows.sync([...model.figures.keys()]);
    this.empty.hidden = model.figures.size > 0;
    for (const [id, row] of this.rows.rows) {
      const pose = model.poses.get(id);
      setText(row.status, pose?.status ?? "");
      row.root.dataset["status"] = pose?.status ?? "";
      setText(row.cost, pose ? `cost ${costText(pose.cost)}` : "");
    }
  }
}

class FigureRow {
  readonly root: HTMLElement;
  readonly status = element("span", { className: "figure-status", testid: "figure-status" });
  readonly cost = element("span", { className: "dim number" });

  constructor(id: string) {
    this.root = element(
      "div",
      { className: "row figure", testid: `figure-${id}` },
      element("div", { className: "line" }, element("span", { className: "strong grow", text: id }), this.cost, this.status),
    );
  }
}
