// The one place that draws: four panes of one WebGL canvas, and only when something changed.
import { Box3, Raycaster, Vector3, type WebGLRenderer } from "three";
import type { Model } from "../state/model";
import { fine, plain, type Hit } from "./bodies";
import { Cameras } from "./cameras";
import { FigureView, type SegmentKey } from "./figure_view";
import { FrameView } from "./frame_view";
import { GhostView } from "./ghost_view";
import { Gizmo, type GizmoPlace } from "./gizmo";
import { GoalView } from "./goal_view";
import { Labels } from "./labels";
import { labelTexts, type LabelText } from "./label_texts";
import { LimitView } from "./limit_view";
import { titles, viewNames, type ViewName } from "./names";
import { ObjectView } from "./object_view";
import { palettes, type Palette, type Theme } from "./palette";
import { Panes } from "./panes";
import { project, rayAt, type PagePoint } from "./projection";
import { drawsPlainly, makeRenderer } from "./renderer";
import { riderOf } from "./rider";
import { SensorView } from "./sensor_view";
import { Stage } from "./stage";

const kDrawnTopics = ["figures", "pose", "scene", "samples", "local", "ghosts", "cameras", "settings", "people", "connection"] as const;

export class Views {
  readonly panes: Panes;
  readonly cameras: Cameras;
  readonly figures: FigureView;
  readonly gizmo: Gizmo;
  private readonly objects: ObjectView;
  private readonly ghosts: GhostView;
  private readonly goals = new GoalView();
  private readonly frames = new FrameView();
  private readonly limits = new LimitView();
  private readonly sensors = new SensorView();
  private readonly stage: Stage;
  private readonly renderer: WebGLRenderer;
  private readonly labels: Record<ViewName, Labels>;
  private palette: Palette = palettes.dark;
  private drawn = "";
  /** The figures are framed once a pose of this revision has come; null once that is done. */
  private frameAt: number | null = 0;

  constructor(private readonly area: HTMLElement) {
    const plainly = drawsPlainly(location.search);
    const detail = plainly ? plain : fine;
    this.stage = new Stage(plainly ? 512 : 1024);
    this.figures = new FigureView(detail);
    this.objects = new ObjectView(detail);
    this.ghosts = new GhostView(detail);
    this.renderer = makeRenderer(plainly);
    area.prepend(this.renderer.domElement);
    this.panes = new Panes(area);
    this.cameras = new Cameras(this.panes.elements);
    this.labels = Object.fromEntries(viewNames.map((name) => [name, new Labels(this.panes.elements[name])])) as Record<ViewName, Labels>;
    this.gizmo = new Gizmo(this.stage.scene);
    this.stage.scene.matrixWorldAutoUpdate = false;
    this.stage.scene.add(
      this.figures.group, this.objects.group, this.ghosts.group, this.goals.group, this.frames.object, this.limits.object, this.sensors.group,
    );
  }

  /** True where something was drawn. */
  draw(model: Model, theme: Theme, gizmo: GizmoPlace | null): boolean {
    const versions = kDrawnTopics.map((topic) => model.version[topic]);
    const now = [...versions, this.cameras.version, this.panes.version, this.frameAt, theme].join();
    if (now === this.drawn) return false;
    this.drawn = now;
    this.palette = palettes[theme];
    this.renderer.setClearColor(this.palette.background);
    this.stage.dress(this.palette);
    this.updateParts(model);
    if (this.frameAt !== null && model.poseRevision >= this.frameAt && !this.bounds(model).isEmpty()) {
      this.frameAt = null;
      this.fit(model);
    }
    const rider = riderOf(model);
    this.cameras.ride(rider);
    this.panes.says("perspective", model.rides ? ("eyes" in model.rides ? `eyes of ${model.rides.eyes}` : `camera ${model.rides.camera}`) : titles.perspective.says);
    const outer = this.resize();
    const centre = this.cameras.centre("perspective");
    this.stage.shine(centre, 2.6);
    this.renderer.shadowMap.needsUpdate = true;
    const texts = labelTexts(model);
    const visible = this.panes.visible();
    const first = visible[0];
    if (first) this.gizmo.put(gizmo, this.cameras.camera(first, this.panes.rect(first)));
    this.stage.scene.updateMatrixWorld();
    for (const name of visible) this.drawPane(name, outer, texts);
    this.drawn = [...versions, this.cameras.version, this.panes.version, this.frameAt, theme].join();
    return true;
  }

  /** Draws again although nothing has changed: right after, the canvas can be read. */
  redraw(model: Model, theme: Theme): HTMLCanvasElement {
    this.drawn = "";
    this.draw(model, theme, null);
    return this.renderer.domElement;
  }

  /** A new scene stands elsewhere: frame it as soon as it is solved. */
  fitFrom(revision: number | null): void {
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

  segmentAt(name: ViewName, x: number, y: number): Hit<SegmentKey> | null {
    return this.figures.bodies.hit(this.caster(name, x, y));
  }

  objectAt(name: ViewName, x: number, y: number): Hit<string> | null {
    return this.objects.bodies.hit(this.caster(name, x, y));
  }

  private caster(name: ViewName, x: number, y: number): Raycaster {
    const rect = this.panes.rect(name);
    const camera = this.cameras.camera(name, rect);
    const ray = rayAt(camera, rect, x, y);
    const caster = new Raycaster(ray.origin, ray.direction);
    caster.camera = camera;
    return caster;
  }

  private updateParts(model: Model): void {
    this.figures.update(model, this.palette);
    this.objects.update(model, this.palette);
    this.ghosts.update(model, this.palette);
    this.goals.update(model, this.palette);
    this.frames.update(model);
    this.limits.update(model, this.palette);
    this.sensors.update(model);
  }

  /** Bodies and cubes; the sensors come and go and would make the frame jump. */
  private bounds(model: Model): Box3 {
    const box = new Box3();
    for (const [id, { segments }] of model.figures) {
      const pose = model.poses.get(id)?.worldFromSegment;
      if (pose?.length !== segments.length) continue;
      for (const [x, y, z] of pose) box.expandByPoint(new Vector3(x, y, z));
    }
    if (box.isEmpty()) return box;
    // Joints lie inside the body.
    box.expandByScalar(0.13);
    box.min.z = Math.max(box.min.z, Math.min(0, box.min.z + 0.1));
    for (const id of Object.keys(model.scene.document.goals)) {
      const target = model.goalTarget(id);
      if (target) box.expandByPoint(new Vector3(...target));
    }
    return box;
  }

  private drawPane(name: ViewName, outer: DOMRect, texts: readonly LabelText[]): void {
    const rect = this.panes.rect(name);
    if (rect.width < 1 || rect.height < 1) return;
    const camera = this.cameras.camera(name, rect);
    const left = rect.left - outer.left;
    const bottom = outer.bottom - (rect.top + rect.height);
    this.renderer.setViewport(left, bottom, rect.width, rect.height);
    this.renderer.setScissor(left, bottom, rect.width, rect.height);
    this.stage.face(name, camera, this.cameras.centre(name));
    this.goals.scaleFor(camera, rect);
    this.sensors.scaleFor(camera, rect);
    this.gizmo.face(camera);
    this.renderer.render(this.stage.scene, camera);
    this.labels[name].draw(texts.map((text) => ({ ...text, at: project(camera, rect, text.point) })), rect);
  }

  private resize(): DOMRect {
    const outer = this.area.getBoundingClientRect();
    const { width, height } = outer;
    const ratio = Math.min(window.devicePixelRatio, 2);
    const canvas = this.renderer.domElement;
    if (canvas.width === Math.floor(width * ratio) && canvas.height === Math.floor(height * ratio)) return outer;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height);
    return outer;
  }
}
