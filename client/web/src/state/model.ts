// All that the viewer knows. Streams and replies write it; views and panels read it. No DOM, no three.
// Readers compare `version` numbers once per drawn frame instead of being called back.
import type { ConnectionState } from "../protocol/connection";
import type {
  FigureDocument,
  FigureReply,
  GoalDocument,
  GoalPose,
  HelloReply,
  PoseFrame,
  SceneFrame,
  SensorSample,
  StatsFrame,
  StreamName,
  TrackerFrame,
  TrackerInfo,
  Transform,
  Vec3,
} from "../protocol/types";
import { Meter } from "./meter";
import { applySceneFrame, emptyScene, type SceneState } from "./scene";

export type Topic = "connection" | "figures" | "pose" | "scene" | "samples" | "trackers" | "menu" | "local" | "toast";

export interface FigurePose {
  worldFromSegment: Transform[];
  goals: GoalPose[];
  cost: number;
  status: string;
}

/** A cube under the user's hand, shown where the hand is until the daemon has caught up. */
interface LocalTarget {
  position: Vec3;
  /** Known once the last edit is answered: the echo is over when a pose of that revision is here. */
  untilRevision: number | null;
}

export class Model {
  readonly version: Record<Topic, number> = {
    connection: 0, figures: 0, pose: 0, scene: 0, samples: 0, trackers: 0, menu: 0, local: 0, toast: 0,
  };

  connection: ConnectionState = { phase: "connecting" };
  hello: HelloReply | null = null;
  roundTripMs: number | null = null;

  figures = new Map<string, FigureDocument>();
  poses = new Map<string, FigurePose>();
  poseRevision = -1;
  scene: SceneState = emptyScene;
  samples = new Map<string, SensorSample>();
  trackers: TrackerInfo[] = [];
  stats: StatsFrame | null = null;
  templates: string[] = [];
  saved: string[] = [];

  readonly poseMeter = new Meter();
  lost: Partial<Record<StreamName, number>> = {};

  localTargets = new Map<string, LocalTarget>();
  selectedGoal: string | null = null;
  hoveredGoal: string | null = null;
  makingGoal = false;
  toast: { message: string; hint: string } | null = null;

  touch(topic: Topic): void {
    this.version[topic]++;
  }

  setConnection(state: ConnectionState): void {
    this.connection = state;
    this.touch("connection");
  }

  /** A new session: what is only true while it streams is gone; the last poses stay to be looked at. */
  beginSession(hello: HelloReply): void {
    this.hello = hello;
    this.poseRevision = -1;
    this.localTargets.clear();
    this.samples.clear();
    this.touch("samples");
    this.touch("local");
  }

  setFigures(replies: FigureReply[]): void {
    this.figures = new Map(replies.map(({ id, document }) => [id, document]));
    for (const id of this.poses.keys()) if (!this.figures.has(id)) this.poses.delete(id);
    this.touch("figures");
  }

  takePose(frame: PoseFrame, nowMs: number): void {
    for (const figure of frame.figures) {
      this.poses.set(figure.figure, {
        worldFromSegment: figure.world_from_segment,
        goals: figure.goals ?? [],
        cost: figure.cost ?? 0,
        status: figure.status ?? "",
      });
    }
    this.poseRevision = frame.revision;
    for (const [id, local] of this.localTargets) {
      if (local.untilRevision !== null && frame.revision >= local.untilRevision) this.localTargets.delete(id);
    }
    this.poseMeter.count(nowMs);
    this.touch("pose");
  }

  /** Throws SceneGap when the patch does not join up. */
  takeScene(frame: SceneFrame): void {
    this.scene = applySceneFrame(this.scene, frame);
    const { goals } = this.scene.document;
    if (this.selectedGoal !== null && !(this.selectedGoal in goals)) this.selectedGoal = null;
    this.touch("scene");
  }

  takeTracker(frame: TrackerFrame): void {
    // A frame is complete: a sensor of this device that is not in it is absent now.
    const ofDevice = this.trackers.find(({ tracker }) => tracker === frame.device)?.sensors ?? [];
    for (const sensor of ofDevice) this.samples.delete(sensor);
    for (const sample of frame.sensors) this.samples.set(sample.sensor, sample);
    this.touch("samples");
  }

  setTrackers(trackers: TrackerInfo[]): void {
    this.trackers = trackers;
    const known = new Set(trackers.flatMap(({ sensors }) => sensors));
    for (const sensor of this.samples.keys()) if (!known.has(sensor)) this.samples.delete(sensor);
    this.touch("trackers");
  }

  countLost(stream: StreamName, dropped: number): void {
    this.lost[stream] = (this.lost[stream] ?? 0) + dropped;
  }

  setLocalTarget(goal: string, position: Vec3): void {
    this.localTargets.set(goal, { position, untilRevision: null });
    this.touch("local");
  }

  /** The hand let go and the daemon answered; null: refused, so the cube falls back at once. */
  endLocalTarget(goal: string, revision: number | null): void {
    const local = this.localTargets.get(goal);
    if (!local) return;
    if (revision === null || revision <= this.poseRevision) this.localTargets.delete(goal);
    else local.untilRevision = revision;
    this.touch("local");
  }

  select(goal: string | null): void {
    this.selectedGoal = goal;
    this.touch("local");
  }

  say(message: string, hint = ""): void {
    this.toast = { message, hint };
    this.touch("toast");
  }

  goalPose(id: string): GoalPose | undefined {
    for (const pose of this.poses.values()) {
      const found = pose.goals.find((goal) => goal.id === id);
      if (found) return found;
    }
    return undefined;
  }

  /** Where the cube is: under the hand, else where the solver pulls to, else where the document says. */
  goalTarget(id: string): Vec3 | undefined {
    const goal = this.scene.document.goals[id];
    const pose = this.goalPose(id);
    // A goal of the whole figure has no place of its own.
    if (goal?.kind === "posture" || (goal?.kind === "balance" && pose?.state === "off")) return undefined;
    const written = goal && this.movable(id) ? goal.position : undefined;
    return this.localTargets.get(id)?.position ?? pose?.target ?? written;
  }

  /** A position in the world: what a hand or a sensor can move. Other goals are only shown. */
  movable(id: string): boolean {
    const goal = this.scene.document.goals[id];
    return goal !== undefined && (goal.kind ?? "position") === "position" && (goal.relative_to ?? "world") === "world";
  }

  goalFigure(goal: GoalDocument): string | undefined {
    return goal.figure ?? (this.figures.size === 1 ? [...this.figures.keys()][0] : "body");
  }
}
