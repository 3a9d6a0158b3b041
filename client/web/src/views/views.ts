// The one place that draws: four panes of one WebGL canvas, and only when something changed.
import { Box3, Vector3, WebGLRenderer } from "three";
import type { Model } from "../state/model";
import { Cameras } from "./cameras";
import { FigureView } from "./figure_view";
import { GoalView } from "./goal_view";
import { Labels, type Label } from "./labels";
import { isOrtho, viewNames, type ViewName } from "./names";
import { background } from "./palette";
import { Panes } from "./panes";
import { project, type PagePoint } from "./projection";
import { SensorView } from "./sensor_view";
import { Stage } from "./stage";

export class Views {
  readonly cameras = new Cameras();
  readonly panes: Panes;
  readonly figures = new FigureView();
  private readonly goals = new GoalView();
  private readonly sensors = new SensorView();
  private readonly stage = new Stage();
  private readonly renderer: WebGLRenderer;
  private readonly labels: Record<ViewName, Labels>;
  private drawn = "";
  /** The figures are framed once a pose of this revision has come; null once that is done. */
  private frameAt: number | null = 0;

  constructor(private readonly area: HTMLElement) {
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.setClearColor(background);
    this.renderer.setScissorTest(true);
    area.prepend(this.renderer.domElement);
    this.panes = new Panes(area);
    this.labels = Object.fromEntries(
      viewNames.map((name) => [name, new Labels(this.panes.elements[name])]),
    ) as Record<ViewName, Labels>;
    this.stage.scene.add(this.figures.group, this.goals.group, this.sensors.group);
  }

  draw(model: Model): void {
    const { figures, pose, scene, samples, local } = model.version;
    const now = [figures, pose, scene, samples, local, this.cameras.version, this.panes.version, this.frameAt].join();
    if (now === this.drawn) return;
    this.drawn = now;
    this.figures.update(model);
    this.goals.update(model);
    this.sensors.update(model);
    if (this.frameAt !== null && model.poseRevision >= this.frameAt && !this.bounds(model).isEmpty()) {
      this.frameAt = null;
      this.fit(model);
    }
    this.stage.scene.updateMatrixWorld();
    this.resize();
    for (const name of this.panes.visible()) this.drawPane(name, model);
  }

  /** A new scene stands elsewhere: frame it as soon as it is solved. */
  fitFrom(revision: number): void {
    this.frameAt = revision;
  }

  fit(model: Model): void {
    const rects = Object.fromEntries(this.panes.visible().map((name) => [name, this.panes.rect(name)]));
    this.cameras.fit(this.bounds(model), rects);
  }

  project(name: ViewName, point: Vector3): PagePoint {
    const rect = this.panes.rect(name);
    return project(this.cameras.camera(name, rect), rect, point);
  }

  /** Bodies and cubes; the sensors come and go and would make the frame jump. */
  private bounds(model: Model): Box3 {
    const box = new Box3();
    for (const segment of this.figures.group.children) if (segment.visible) box.expandByObject(segment);
    if (box.isEmpty()) return box;
    for (const id of Object.keys(model.scene.document.goals)) {
      const target = model.goalTarget(id);
      if (target) box.expandByPoint(new Vector3(...target));
    }
    return box;
  }

  private drawPane(name: ViewName, model: Model): void {
    const outer = this.area.getBoundingClientRect();
    const rect = this.panes.rect(name);
    if (rect.width < 1 || rect.height < 1) return;
    const camera = this.cameras.camera(name, rect);
    const left = rect.left - outer.left;
    const bottom = outer.bottom - (rect.top + rect.height);
    this.renderer.setViewport(left, bottom, rect.width, rect.height);
    this.renderer.setScissor(left, bottom, rect.width, rect.height);
    this.stage.face(name, camera, isOrtho(name) ? this.cameras.focus : this.cameras.target);
    this.goals.scaleFor(camera, rect);
    this.sensors.scaleFor(camera, rect);
    this.renderer.render(this.stage.scene, camera);
    this.labels[name].draw(this.labelsOf(name, model), rect);
  }

  private labelsOf(name: ViewName, model: Model): Label[] {
    const labels: Label[] = [...model.samples.values()].map(({ sensor, position }) => ({
      key: `sensor ${sensor}`, text: sensor, kind: "sensor", at: this.project(name, new Vector3(...position)),
    }));
    for (const id of new Set([model.hoveredGoal, model.selectedGoal])) {
      const target = id === null ? undefined : model.goalTarget(id);
      if (id === null || !target || !(id in model.scene.document.goals)) continue;
      labels.push({ key: `goal ${id}`, text: id, kind: "goal", at: this.project(name, new Vector3(...target)) });
    }
    return labels;
  }

  private resize(): void {
    const { width, height } = this.area.getBoundingClientRect();
    const ratio = Math.min(window.devicePixelRatio, 2);
    const canvas = this.renderer.domElement;
    if (canvas.width === Math.floor(width * ratio) && canvas.height === Math.floor(height * ratio)) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height);
  }
}
