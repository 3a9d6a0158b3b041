// The bodies of the figures: a segment is placed where the pose stream says. No kinematics here.
import { MeshLambertMaterial } from "three";
import type { FigureDocument, SegmentDocument, Shape, Transform } from "../protocol/types";
import type { Model } from "../state/model";
import { Bodies, type Detail } from "./bodies";
import { segmentColor, type Palette } from "./palette";

export interface SegmentKey {
  figure: string;
  segment: string;
}

export class FigureView {
  readonly bodies: Bodies<SegmentKey>;
  private first = new Map<string, number>();
  private figuresDrawn = -1;
  private paintedFor = "";

  constructor(detail: Detail) {
    this.bodies = new Bodies(new MeshLambertMaterial(), true, detail);
  }

  get group() {
    return this.bodies.group;
  }

  update(model: Model, palette: Palette): void {
    if (this.figuresDrawn !== model.version.figures) {
      this.figuresDrawn = model.version.figures;
      this.paintedFor = "";
      this.rebuild(model);
    }
    for (const [figure, { segments }] of model.figures) {
      const first = this.first.get(figure) ?? 0;
      const pose = model.poses.get(figure)?.worldFromSegment;
      // Between a new body's document and its first pose the two may differ in length.
      const fits = pose?.length === segments.length;
      segments.forEach((_, i) => {
        this.bodies.show(first + i, fits);
        if (fits) this.bodies.place(first + i, pose[i] as Transform);
      });
    }
    this.paint(model, palette);
  }

  private rebuild(model: Model): void {
    this.first.clear();
    const bodies: Array<{ key: SegmentKey; shapes: readonly Shape[] }> = [];
    for (const [figure, { segments }] of model.figures) {
      this.first.set(figure, bodies.length);
      for (const segment of segments) bodies.push({ key: { figure, segment: segment.name }, shapes: shapesOf(segment) });
    }
    this.bodies.rebuild(bodies);
  }

  private paint(model: Model, palette: Palette): void {
    const { selectedSegment, hoveredSegment } = model;
    const key = JSON.stringify([palette.background, selectedSegment, hoveredSegment]);
    if (key === this.paintedFor) return;
    this.paintedFor = key;
    for (const [figure, document] of model.figures) {
      const first = this.first.get(figure) ?? 0;
      document.segments.forEach((segment, i) => {
        const is = (key: SegmentKey | null) => key?.figure === figure && key.segment === segment.name;
        const [towards, share] = is(selectedSegment) ? [palette.selected, 0.75] : is(hoveredSegment) ? [palette.outline, 0.35] : [0, 0];
        this.bodies.paint(first + i, segmentColor(palette, segment.name, depthOf(document, segment)), towards, share);
      });
    }
  }
}

/** A segment without a shape still shows: a thin capsule from its joint to its touch point. */
export function shapesOf({ shape, touch_point }: SegmentDocument): readonly Shape[] {
  return shape?.length ? shape : [{ kind: "capsule", from: [0, 0, 0], to: touch_point, radius: 0.015 }];
}

function depthOf(document: FigureDocument, segment: SegmentDocument): number {
  let depth = 0;
  let parent = segment.parent;
  while (parent !== undefined && depth < 100) {
    const name: string = parent;
    parent = document.segments.find((other) => other.name === name)?.parent;
    depth++;
  }
  return depth;
}
