// The things of the environment, where the document says they stand.
import { MeshLambertMaterial } from "three";
import type { Transform } from "../protocol/types";
import type { Model } from "../state/model";
import { Bodies, type Detail } from "./bodies";
import type { Palette } from "./palette";

export class ObjectView {
  readonly bodies: Bodies<string>;
  private shapesDrawn = "";
  private sceneDrawn = -1;
  private paintedFor: Palette | null = null;

  constructor(detail: Detail) {
    this.bodies = new Bodies(new MeshLambertMaterial(), true, detail);
  }

  get group() {
    return this.bodies.group;
  }

  update(model: Model, palette: Palette): void {
    if (this.sceneDrawn === model.version.scene && this.paintedFor === palette) return;
    this.sceneDrawn = model.version.scene;
    const drawn = Object.entries(model.scene.document.objects).filter(([, { shape }]) => shape?.length);
    const shapes = JSON.stringify(drawn.map(([id, { shape }]) => [id, shape]));
    if (shapes !== this.shapesDrawn) {
      this.shapesDrawn = shapes;
      this.paintedFor = null;
      this.bodies.rebuild(drawn.map(([key, { shape = [] }]) => ({ key, shapes: shape })));
    }
    drawn.forEach(([, { position = [0, 0, 0], quat_xyzw = [0, 0, 0, 1] }], i) => this.bodies.place(i, [...position, ...quat_xyzw] as Transform));
    if (this.paintedFor === palette) return;
    this.paintedFor = palette;
    drawn.forEach((_, i) => this.bodies.paint(i, palette.object));
  }
}
