// The bodies: one object a segment, placed where the pose stream says. No kinematics here.
import {
  BoxGeometry,
  CapsuleGeometry,
  Group,
  Mesh,
  MeshLambertMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
} from "three";
import type { FigureDocument, SegmentDocument, Shape, Transform, Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import { segmentColor } from "./palette";

export interface SegmentKey {
  figure: string;
  segment: string;
}

export class FigureView {
  readonly group = new Group();
  private readonly segments = new Map<string, Group[]>();
  private figuresDrawn = -1;

  update(model: Model): void {
    if (this.figuresDrawn !== model.version.figures) {
      this.figuresDrawn = model.version.figures;
      this.rebuild(model);
    }
    for (const [figure, segments] of this.segments) {
      const pose = model.poses.get(figure)?.worldFromSegment;
      // Between a new body's document and its first pose the two may differ in length.
      const fits = pose?.length === segments.length;
      segments.forEach((segment, i) => {
        segment.visible = fits;
        if (fits) placeSegment(segment, pose[i] as Transform);
      });
    }
  }

  private rebuild(model: Model): void {
    this.group.traverse((part) => {
      if (!(part instanceof Mesh)) return;
      (part.geometry as BufferGeometry).dispose();
      (part.material as MeshLambertMaterial).dispose();
    });
    this.group.clear();
    this.segments.clear();
    for (const [figure, document] of model.figures) {
      const built = document.segments.map((segment) => buildSegment(figure, segment, depthOf(document, segment)));
      this.segments.set(figure, built);
      if (built.length > 0) this.group.add(...built);
    }
  }
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

function buildSegment(figure: string, segment: SegmentDocument, depth: number): Group {
  const key: SegmentKey = { figure, segment: segment.name };
  const material = new MeshLambertMaterial({
    color: segmentColor(segment.name, depth),
  });
  const group = new Group();
  group.name = segment.name;
  const shapes = segment.shape?.length ? segment.shape : [bareBone(segment)];
  for (const shape of shapes) {
    const mesh = buildShape(shape, material);
    mesh.userData = key;
    group.add(mesh);
  }
  return group;
}

/** A segment without a shape still shows: a thin capsule from its joint to its touch point. */
function bareBone({ touch_point }: SegmentDocument): Shape {
  return { kind: "capsule", from: [0, 0, 0], to: touch_point, radius: 0.015 };
}

function buildShape(shape: Shape, material: MeshLambertMaterial): Mesh {
  if (shape.kind === "box") {
    const [x, y, z] = shape.half_size;
    return at(new Mesh(new BoxGeometry(2 * x, 2 * y, 2 * z), material), shape.center);
  }
  if (shape.kind === "ellipsoid") {
    const mesh = at(new Mesh(new SphereGeometry(1, 28, 16), material), shape.center);
    mesh.scale.set(...shape.radii);
    return mesh;
  }
  const from = new Vector3(...shape.from);
  const along = new Vector3(...shape.to).sub(from);
  const mesh = new Mesh(new CapsuleGeometry(shape.radius, along.length(), 5, 16), material);
  mesh.position.copy(from).addScaledVector(along, 0.5);
  mesh.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), along.normalize()));
  return mesh;
}

function at(mesh: Mesh, [x, y, z]: Vec3): Mesh {
  mesh.position.set(x, y, z);
  return mesh;
}

function placeSegment(segment: Group, [x, y, z, qx, qy, qz, qw]: Transform): void {
  segment.position.set(x, y, z);
  segment.quaternion.set(qx, qy, qz, qw);
}
