// Goals as the paper draws them: a cube, and a line from it to the point of the body that it pulls.
import {
  BoxGeometry,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  SphereGeometry,
  Vector3,
  type Camera,
} from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Model } from "../state/model";
import { goalColors } from "./palette";
import { metresPerPixel, type PaneRect } from "./projection";

const kCubeMetres = 0.045;
const kCubePixels = 13;
const kTouchPixels = 4;

const cubeGeometry = new BoxGeometry(1, 1, 1);
const edgeGeometry = new EdgesGeometry(cubeGeometry);
const touchGeometry = new SphereGeometry(1, 16, 12);

class GoalMark {
  readonly group = new Group();
  readonly cube = new Group();
  readonly touch: Mesh;
  private readonly solid = new MeshLambertMaterial();
  // The same cube again, faint and without depth: a reached goal lies inside the hand and must still be seen.
  private readonly ghost = new MeshBasicMaterial({ transparent: true, opacity: 0.45, depthTest: false, depthWrite: false });
  private readonly edges = new LineBasicMaterial({ transparent: true, depthTest: false, depthWrite: false });
  private readonly touchMaterial = new MeshBasicMaterial({ transparent: true, depthTest: false, depthWrite: false });
  private readonly lineMaterial = new LineMaterial({ linewidth: 2, transparent: true, depthTest: false, depthWrite: false });
  private readonly line = new LineSegments2(new LineSegmentsGeometry(), this.lineMaterial);

  constructor() {
    const ghost = new Mesh(cubeGeometry, this.ghost);
    const edges = new LineSegments(edgeGeometry, this.edges);
    this.touch = new Mesh(touchGeometry, this.touchMaterial);
    this.line.frustumCulled = false;
    this.line.renderOrder = 10;
    this.touch.renderOrder = 11;
    ghost.renderOrder = 12;
    edges.renderOrder = 13;
    this.cube.add(new Mesh(cubeGeometry, this.solid), ghost, edges);
    this.group.add(this.line, this.touch, this.cube);
  }

  set(target: Vector3, touch: Vector3 | null, color: number, strong: boolean, off: boolean): void {
    this.cube.position.copy(target);
    for (const material of [this.solid, this.ghost, this.touchMaterial, this.lineMaterial]) material.color.set(color);
    this.edges.color.set(strong ? 0xffffff : color).lerp(this.edges.color.clone().set(0xffffff), 0.35);
    this.lineMaterial.opacity = off ? 0.45 : 1;
    this.lineMaterial.linewidth = strong ? 3 : 2;
    this.touch.visible = this.line.visible = touch !== null;
    if (!touch) return;
    this.touch.position.copy(touch);
    this.line.geometry.setPositions([...target.toArray(), ...touch.toArray()]);
  }

  /** Never smaller on the screen than a hand can grab. */
  scaleFor(camera: Camera, rect: PaneRect): void {
    const perPixel = metresPerPixel(camera, rect, this.cube.position);
    this.cube.scale.setScalar(Math.max(kCubeMetres, kCubePixels * perPixel));
    this.touch.scale.setScalar(kTouchPixels * metresPerPixel(camera, rect, this.touch.position));
  }

  dispose(): void {
    for (const material of [this.solid, this.ghost, this.edges, this.touchMaterial, this.lineMaterial]) material.dispose();
    this.line.geometry.dispose();
  }
}

export class GoalView {
  readonly group = new Group();
  private readonly marks = new Map<string, GoalMark>();

  update(model: Model): void {
    const goals = model.scene.document.goals;
    for (const [id, mark] of this.marks) {
      if (id in goals && model.goalTarget(id)) continue;
      this.group.remove(mark.group);
      mark.dispose();
      this.marks.delete(id);
    }
    for (const id of Object.keys(goals)) {
      const target = model.goalTarget(id);
      if (!target) continue;
      const pose = model.goalPose(id);
      const off = goals[id]?.enabled === false;
      const state = off ? "off" : (pose?.state ?? "off");
      const touch = pose ? new Vector3(...pose.touch) : null;
      const strong = id === model.selectedGoal || id === model.hoveredGoal;
      this.mark(id).set(new Vector3(...target), touch, goalColors[state] ?? goalColors.off, strong, off);
    }
  }

  scaleFor(camera: Camera, rect: PaneRect): void {
    for (const mark of this.marks.values()) mark.scaleFor(camera, rect);
  }

  private mark(id: string): GoalMark {
    let mark = this.marks.get(id);
    if (!mark) {
      mark = new GoalMark();
      this.marks.set(id, mark);
      this.group.add(mark.group);
    }
    return mark;
  }
}
