// Rigid bodies made of a document's shapes, all of a kind in one draw call: segments, objects, ghosts.
import {
  BatchedMesh,
  BoxGeometry,
  CapsuleGeometry,
  Color,
  Group,
  Matrix4,
  Quaternion,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
  type Material,
  type Raycaster,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { Shape, Transform } from "../protocol/types";

const one = new Vector3(1, 1, 1);
const matrix = new Matrix4();
const place = new Vector3();
const turn = new Quaternion();
const tint = new Color();

export interface Hit<K> {
  key: K;
  point: Vector3;
  distance: number;
}

/** Pieces around and along a round shape: a processor that draws has no time for more than it must. */
export interface Detail {
  around: number;
  along: number;
}

export const fine: Detail = { around: 32, along: 20 };
export const plain: Detail = { around: 10, along: 7 };

export class Bodies<K> {
  readonly group = new Group();
  private batch: BatchedMesh | null = null;
  private keys: K[] = [];

  constructor(
    private readonly material: Material,
    private readonly shadows: boolean,
    private readonly detail: Detail,
  ) {}

  /** Bodies in this order: the index is what `place` and `paint` take. */
  rebuild(bodies: ReadonlyArray<{ key: K; shapes: readonly Shape[] }>): void {
    if (this.batch) {
      this.group.remove(this.batch);
      this.batch.dispose();
      this.batch = null;
    }
    this.keys = bodies.map(({ key }) => key);
    if (bodies.length === 0) return;
    const geometries = bodies.map(({ shapes }) => geometryOf(shapes, this.detail));
    const vertices = geometries.reduce((sum, { attributes }) => sum + attributes["position"]!.count, 0);
    const indices = geometries.reduce((sum, { index }) => sum + index!.count, 0);
    const batch = new BatchedMesh(bodies.length, vertices, indices, this.material);
    for (const geometry of geometries) {
      batch.addInstance(batch.addGeometry(geometry));
      geometry.dispose();
    }
    batch.frustumCulled = batch.perObjectFrustumCulled = batch.sortObjects = false;
    batch.castShadow = batch.receiveShadow = this.shadows;
    this.batch = batch;
    this.group.add(batch);
  }

  place(index: number, [x, y, z, qx, qy, qz, qw]: Transform): void {
    this.batch?.setMatrixAt(index, matrix.compose(place.set(x, y, z), turn.set(qx, qy, qz, qw), one));
  }

  show(index: number, visible: boolean): void {
    if (this.batch && this.batch.getVisibleAt(index) !== visible) this.batch.setVisibleAt(index, visible);
  }

  paint(index: number, color: number, towards = color, share = 0): void {
    this.batch?.setColorAt(index, tint.set(color).lerp(new Color(towards), share));
  }

  hit(caster: Raycaster): Hit<K> | null {
    if (!this.batch) return null;
    const first = caster.intersectObject(this.batch, false)[0];
    if (first?.batchId === undefined) return null;
    return { key: this.keys[first.batchId] as K, point: first.point, distance: first.distance };
  }
}

function geometryOf(shapes: readonly Shape[], detail: Detail): BufferGeometry {
  const parts = shapes.map((shape) => geometryOfShape(shape, detail));
  const merged = mergeGeometries(parts);
  for (const part of parts) part.dispose();
  return merged;
}

function geometryOfShape(shape: Shape, { around, along: rings }: Detail): BufferGeometry {
  if (shape.kind === "box") {
    const [x, y, z] = shape.half_size;
    return new BoxGeometry(2 * x, 2 * y, 2 * z).translate(...shape.center);
  }
  if (shape.kind === "ellipsoid") {
    // applyMatrix4 turns the normals by the inverse transpose, as an ellipsoid needs.
    return new SphereGeometry(1, around, rings).scale(...shape.radii).translate(...shape.center);
  }
  const from = new Vector3(...shape.from);
  const along = new Vector3(...shape.to).sub(from);
  const length = along.length();
  const upright = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), length > 0 ? along.clone().divideScalar(length) : along.set(0, 1, 0));
  const middle = new Vector3(...shape.from).add(new Vector3(...shape.to)).multiplyScalar(0.5);
  return new CapsuleGeometry(shape.radius, length, Math.ceil(rings / 3), Math.ceil(around * 0.65)).applyQuaternion(upright).translate(middle.x, middle.y, middle.z);
}
