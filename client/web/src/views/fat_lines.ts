// Many coloured lines of one width in one draw call. Filled anew whenever something moves, without allocating.
import { Color, InstancedInterleavedBuffer, InterleavedBufferAttribute, type Vector3 } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

export interface LineLook {
  width: number;
  opacity?: number;
  /** Seen through bodies. */
  onTop?: boolean;
  order?: number;
}

export class FatLines {
  readonly object: LineSegments2;
  private readonly geometry = new LineSegmentsGeometry();
  private places = new InstancedInterleavedBuffer(new Float32Array(6), 6, 1);
  private colors = new InstancedInterleavedBuffer(new Float32Array(6), 6, 1);
  private count = 0;
  private readonly color = new Color();

  constructor({ width, opacity = 1, onTop = true, order = 10 }: LineLook) {
    const material = new LineMaterial({ linewidth: width, vertexColors: true, opacity, depthTest: !onTop, depthWrite: false, transparent: true });
    this.object = new LineSegments2(this.geometry, material);
    this.object.frustumCulled = false;
    this.object.renderOrder = order;
    this.grow(16);
  }

  begin(): void {
    this.count = 0;
  }

  add(from: Vector3, to: Vector3, color: number): void {
    if (this.count * 6 === this.places.array.length) this.grow(this.count * 2);
    const { r, g, b } = this.color.set(color);
    this.places.array.set([from.x, from.y, from.z, to.x, to.y, to.z], this.count * 6);
    this.colors.array.set([r, g, b, r, g, b], this.count * 6);
    this.count++;
  }

  end(): void {
    this.places.needsUpdate = this.colors.needsUpdate = true;
    this.geometry.instanceCount = this.count;
    this.object.visible = this.count > 0;
  }

  private grow(lines: number): void {
    const [places, colors] = [new Float32Array(lines * 6), new Float32Array(lines * 6)];
    places.set(this.places.array);
    colors.set(this.colors.array);
    // The buffers on the GPU go with the old attributes.
    this.geometry.dispose();
    this.places = new InstancedInterleavedBuffer(places, 6, 1);
    this.colors = new InstancedInterleavedBuffer(colors, 6, 1);
    this.geometry.setAttribute("instanceStart", new InterleavedBufferAttribute(this.places, 3, 0));
    this.geometry.setAttribute("instanceEnd", new InterleavedBufferAttribute(this.places, 3, 3));
    this.geometry.setAttribute("instanceColorStart", new InterleavedBufferAttribute(this.colors, 3, 0));
    this.geometry.setAttribute("instanceColorEnd", new InterleavedBufferAttribute(this.colors, 3, 3));
  }
}
