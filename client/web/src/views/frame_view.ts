// Segments marked by their coordinate systems, the paper's Figure 1: all of them on demand, else the chosen one's.
import { Quaternion, Vector3 } from "three";
import type { Model } from "../state/model";
import { FatLines } from "./fat_lines";
import { drawAxes } from "./goal_shapes";

export class FrameView {
  private readonly lines = new FatLines({ width: 2, order: 8 });

  get object() {
    return this.lines.object;
  }

  update(model: Model): void {
    this.lines.begin();
    for (const [figure, { segments }] of model.figures) {
      segments.forEach(({ name }, i) => {
        const chosen = model.selectedSegment?.figure === figure && model.selectedSegment.segment === name;
        const at = model.poses.get(figure)?.worldFromSegment[i];
        if (!at || !(chosen || model.settings.frames)) return;
        drawAxes(this.lines, new Vector3(at[0], at[1], at[2]), new Quaternion(at[3], at[4], at[5], at[6]), chosen ? 0.14 : 0.08);
      });
    }
    this.lines.end();
  }
}
