// Saved poses as translucent bodies beside the living one.
import { MeshLambertMaterial } from "three";
import type { Shape, Transform } from "../protocol/types";
import type { Model } from "../state/model";
import { Bodies, type Detail } from "./bodies";
import { shapesOf } from "./figure_view";
import type { Palette } from "./palette";

export class GhostView {
  private readonly material = new MeshLambertMaterial({ transparent: true, opacity: 0.28, depthWrite: false });
  private readonly bodies: Bodies<string>;
  private drawn = "";

  constructor(detail: Detail) {
    this.bodies = new Bodies(this.material, false, detail);
  }

  get group() {
    return this.bodies.group;
  }

  update(model: Model, palette: Palette): void {
    const key = [model.version.ghosts, model.version.figures, palette.background].join();
    if (key === this.drawn) return;
    this.drawn = key;
    const parts: Array<{ key: string; shapes: readonly Shape[]; at: Transform }> = [];
    for (const { name, figure, world_from_segment } of model.ghosts) {
      const segments = model.figures.get(figure)?.segments ?? [];
      if (segments.length !== world_from_segment.length) continue;
      segments.forEach((segment, i) => parts.push({ key: name, shapes: shapesOf(segment), at: world_from_segment[i] as Transform }));
    }
    this.bodies.rebuild(parts);
    this.group.renderOrder = 2;
    parts.forEach(({ at }, i) => {
      this.bodies.place(i, at);
      this.bodies.paint(i, palette.ghost);
    });
  }
}
