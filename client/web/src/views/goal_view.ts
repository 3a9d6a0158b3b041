// Goals as the paper draws them: a cube, and a line from it to the point of the body that it pulls.
import {
  BackSide,
  BoxGeometry,
  Color,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
  type Camera,
  type Material,
} from "three";
import type { Quat } from "../protocol/types";
import type { Model } from "../state/model";
import { supportHull } from "../state/support";
import { FatLines } from "./fat_lines";
import { drawGoalShape, drawSupport } from "./goal_shapes";
import type { Palette } from "./palette";
import { metresPerPixel, type PaneRect } from "./projection";

const kCubeMetres = 0.042;
const kCubePixels = 13;
const kTouchPixels = 4.5;
const kRim = 1.22;

const cube = new BoxGeometry(1, 1, 1);
const ball = new SphereGeometry(1, 14, 10);

interface Mark {
  target: Vector3;
  touch: Vector3 | null;
  turn: Quaternion;
  color: number;
  rim: number;
}

export class GoalView {
  readonly group = new Group();
  private readonly thin = new FatLines({ width: 1.6, opacity: 0.85 });
  private readonly thick = new FatLines({ width: 3, order: 11 });
  // Drawn without depth: a reached goal lies inside the hand and must still be seen.
  private readonly rims = new Instances(cube, new MeshBasicMaterial({ side: BackSide, depthTest: false, depthWrite: false, transparent: true }), 12);
  private readonly faint = new Instances(cube, new MeshLambertMaterial({ depthTest: false, depthWrite: false, transparent: true, opacity: 0.8 }), 13);
  private readonly touches = new Instances(ball, new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true }), 14);
  private marks: Mark[] = [];

  constructor() {
    this.group.add(this.thin.object, this.thick.object);
    for (const { holder } of [this.rims, this.faint, this.touches]) this.group.add(holder);
  }

  update(model: Model, palette: Palette): void {
    this.marks = [];
    this.thin.begin();
    this.thick.begin();
    for (const [id, goal] of Object.entries(model.scene.document.goals)) {
      const place = model.goalTarget(id);
      if (!place) continue;
      const pose = model.goalPose(id);
      const off = goal.enabled === false;
      const color = palette.goals[off ? "off" : (pose?.state ?? "off")] ?? palette.goals.off;
      const strong = id === model.selectedGoal || id === model.hoveredGoal;
      const [target, touch] = [new Vector3(...place), pose ? new Vector3(...pose.touch) : null];
      const turn = new Quaternion(...(model.goalTurn(id) ?? ([0, 0, 0, 1] as Quat)));
      const lines = strong ? this.thick : this.thin;
      if (touch) lines.add(target, touch, color);
      drawGoalShape(lines, goal, model.goalFrame(goal), target, color, strong);
      if (goal.balance) drawSupport(lines, supportHull(model, goal), touch ?? target, color);
      this.marks.push({ target, touch, turn, color, rim: strong ? palette.outline : color });
    }
    this.thin.end();
    this.thick.end();
    const count = this.marks.length;
    for (const instances of [this.rims, this.faint, this.touches]) instances.reserve(count);
    this.marks.forEach(({ color, rim }, i) => {
      this.rims.paint(i, rim, 0.35, palette.background);
      this.faint.paint(i, color);
      this.touches.paint(i, color);
    });
  }

  /** Never smaller on the screen than a hand can grab. */
  scaleFor(camera: Camera, rect: PaneRect): void {
    this.marks.forEach(({ target, touch, turn }, i) => {
      const size = Math.max(kCubeMetres, kCubePixels * metresPerPixel(camera, rect, target));
      this.rims.place(i, target, turn, size * kRim);
      this.faint.place(i, target, turn, size);
      this.touches.place(i, touch ?? target, turn, touch ? kTouchPixels * metresPerPixel(camera, rect, touch) : 0);
    });
    for (const instances of [this.rims, this.faint, this.touches]) instances.sent();
  }
}

const matrix = new Matrix4();
const extent = new Vector3();
const tint = new Color();

/** An instanced mesh that grows. */
class Instances {
  readonly holder = new Group();
  private mesh: InstancedMesh;

  constructor(
    private readonly geometry: BufferGeometry,
    private readonly material: Material,
    private readonly order: number,
  ) {
    this.mesh = this.make(16);
  }

  reserve(count: number): void {
    if (count > this.mesh.instanceMatrix.count) {
      this.mesh.dispose();
      this.mesh = this.make(count * 2);
    }
    this.mesh.count = count;
  }

  place(index: number, at: Vector3, turn: Quaternion, size: number): void {
    this.mesh.setMatrixAt(index, matrix.compose(at, turn, extent.setScalar(size)));
  }

  paint(index: number, color: number, share = 0, towards = 0): void {
    this.mesh.setColorAt(index, tint.set(color).lerp(new Color(towards), share));
    this.mesh.instanceColor!.needsUpdate = true;
  }

  sent(): void {
    this.mesh.instanceMatrix.needsUpdate = true;
  }

  private make(capacity: number): InstancedMesh {
    const mesh = new InstancedMesh(this.geometry, this.material, capacity);
    mesh.setColorAt(0, tint);
    mesh.frustumCulled = false;
    mesh.renderOrder = this.order;
    mesh.count = 0;
    this.holder.clear();
    this.holder.add(mesh);
    return mesh;
  }
}
