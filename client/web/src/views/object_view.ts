// The things of the environment.
import { MeshLambertMaterial } from "three";
import type { ObjectDocument } from "../protocol/types";
import type { Model } from "../state/model";
import { identity } from "../state/place";
import { Bodies, type Detail } from "./bodies";
import type { Palette } from "./palette";

export class ObjectView {
  readonly bodies: Bodies<string>;
  private shapesDrawn = "";
  private drawn: Array<[string, ObjectDocument]> = [];
  private sceneDrawn = -1;
  private poseDrawn = -1;
  private paintedFor: Palette | null = null;

  constructor(detail: Detail) {
    this.bodies = new Bodies(new MeshLambertMaterial(), true, detail);
  }

  get group() {
    return this.bodies.group;
  }

  update(model: Model, palette: Palette): void {
    const { scene, pose } = model.version;
    if (this.sceneDrawn === scene && this.poseDrawn === pose && this.paintedFor === palette) return;
    if (this.sceneDrawn !== scene) this.rebuild(model);
    [this.sceneDrawn, this.poseDrawn] = [scene, pose];
    this.drawn.forEach(([id], i) => this.bodies.place(i, model.objectTransform(id) ?? identity));
    if (this.paintedFor === palette) return;
    this.paintedFor = palette;
    this.drawn.forEach((_, i) => this.bodies.paint(i, palette.object));
  }

  private rebuild(model: Model): void {
    this.drawn = Object.entries(model.scene.document.objects).filter(([, { shape }]) => shape?.length);
    const shapes = JSON.stringify(this.drawn.map(([id, { shape }]) => [id, shape]));
    if (shapes === this.shapesDrawn) return;
    this.shapesDrawn = shapes;
    this.paintedFor = null;
    this.bodies.rebuild(this.drawn.map(([key, { shape = [] }]) => ({ key, shapes: shape })));
  }
}
