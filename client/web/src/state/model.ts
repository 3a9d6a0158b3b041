// All that the viewer knows. Streams and replies write it; views and panels read it. No DOM, no three.
// Readers compare `version` numbers once per drawn frame instead of being called back.
import type { ConnectionState } from "../protocol/connection";
import type {
  CameraFrame,
  FigureDocument,
  FigureReply,
  GoalDocument,
  GoalPose,
  HelloReply,
  HistoryStep,
  PoseFrame,
  Quat,
  SceneFrame,
  SegmentDocument,
  SensorSample,
  SessionInfo,
  StatsFrame,
  StreamName,
  TrackerFrame,
  TrackerInfo,
  Transform,
  Vec3,
} from "../protocol/types";
import { frameTransform, payloadPoint } from "./goals";
import { DaemonClock } from "./daemon_clock";
import { Led } from "./led";
import { Meter } from "./meter";
import { People } from "./people";
import { apply, identity, multiply, quatOf } from "./place";
import { applySceneFrame, emptyScene, type SceneState } from "./scene";
import { defaultSettings, type Settings } from "./settings";
import { goalName } from "./words";

const kTopics = [
  "connection", "figures", "pose", "scene", "samples", "trackers", "menu", "local", "toast", "people", "history", "ghosts", "cameras", "settings",
] as const;
export type Topic = (typeof kTopics)[number];

export interface FigurePose {
  worldFromSegment: Transform[];
  goals: GoalPose[];
  cost: number;
  status: string;
}

/** A cube under the user's hand, shown where the hand is until the daemon has caught up. */
interface LocalTarget {
  position?: Vec3;
  turn?: Quat;
  /** Known once the last edit is answered: the echo is over when a pose of that revision is here. */
  untilRevision: number | null;
}

export interface SegmentKey {
  figure: string;
  segment: string;
}

/** A segment with its place, and its parent's, in the world. */
export interface ChosenSegment extends SegmentKey {
  index: number;
  document: SegmentDocument;
  transform: Transform | null;
  parentTransform: Transform | null;
}

/** A pose that was kept, drawn beside the living one. */
export interface Ghost {
  name: string;
  figure: string;
  world_from_segment: Transform[];
}

export class Model {
  readonly version = Object.fromEntries(kTopics.map((topic) => [topic, 0])) as Record<Topic, number>;

  connection: ConnectionState = { phase: "connecting" };
  hello: HelloReply | null = null;
  roundTripMs: number | null = null;
  readonly clock = new DaemonClock();

  figures = new Map<string, FigureDocument>();
  poses = new Map<string, FigurePose>();
  private led = new Led();
  poseRevision = -1;
  /** By goal; made anew when first asked for after a pose. */
  private goalPoses = new Map<string, GoalPose>();
  private goalPosesFor = -1;
  /** Of the newest pose, on the daemon's clock. */
  poseTimeNs = 0;
  scene: SceneState = emptyScene;
  samples = new Map<string, SensorSample>();
  trackers: TrackerInfo[] = [];
  cameras: CameraFrame["cameras"] = [];
  stats: StatsFrame | null = null;
  templates: string[] = [];
  saved: string[] = [];
  readonly people = new People();
  history: HistoryStep[] = [];
  /** Edits that wait for the daemon to come back. */
  waitingEdits = 0;

  /** When the daemon heard each tracker last, on its clock. */
  readonly heardNs = new Map<string, number>();
  readonly poseMeter = new Meter();
  readonly frameMeter = new Meter();
  /** Script work of the last frames that drew, milliseconds each. */
  readonly work: number[] = [];
  lost: Partial<Record<StreamName, number>> = {};

  settings: Settings = { ...defaultSettings };
  ghosts: Ghost[] = [];
  localTargets = new Map<string, LocalTarget>();
  selectedGoal: string | null = null;
  hoveredGoal: string | null = null;
  selectedSegment: SegmentKey | null = null;
  hoveredSegment: SegmentKey | null = null;
  /** The point or site that a click would take, with its name. */
  hoveredPlace: { point: Vec3; text: string } | null = null;
  makingGoal = false;
  /** The view that the pointer was in last: what the arrow keys go by. */
  activeView: "top" | "perspective" | "front" | "side" = "front";
  /** What leads the perspective view: nothing, a figure's eyes, or a camera of the scene. */
  rides: { eyes: string } | { camera: string } | null = null;
  toast: { message: string; hint: string; good: boolean } | null = null;

  touch(topic: Topic): void {
    this.version[topic]++;
  }

  /** Who may not edit sees everything and can touch nothing. */
  get mayEdit(): boolean {
    return this.hello?.role !== "viewer" && this.hello?.role !== "none";
  }

  /** Trackers are for operators: settings and calibrations outlast the scene. */
  get mayOperate(): boolean {
    return this.mayEdit && this.hello?.role !== "editor";
  }

  setConnection(state: ConnectionState): void {
    this.connection = state;
    this.touch("connection");
  }

  change(settings: Partial<Settings>): void {
    this.settings = { ...this.settings, ...settings };
    this.touch("settings");
  }

  /** A new session: what is only true while it streams is gone; the last poses, and what is under the hand, stay. */
  beginSession(hello: HelloReply): void {
    this.hello = hello;
    this.poseRevision = -1;
    this.led = new Led();
    this.samples.clear();
    this.heardNs.clear();
    this.clock.forget();
    this.people.me = hello.session;
    for (const topic of ["samples", "local", "people"] as const) this.touch(topic);
  }

  setFigures(replies: FigureReply[]): void {
    this.figures = new Map(replies.map(({ id, document }) => [id, document]));
    for (const id of this.poses.keys()) if (!this.figures.has(id)) this.poses.delete(id);
    this.goalPosesFor = -1;
    if (this.selectedSegment && !this.chosenSegment()) this.selectedSegment = null;
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
    this.led.take(frame, this.scene.revision);
    this.poseRevision = frame.revision;
    this.poseTimeNs = frame.t_ns;
    for (const [id, local] of this.localTargets) {
      if (local.untilRevision !== null && frame.revision >= local.untilRevision) this.localTargets.delete(id);
    }
    this.poseMeter.count(nowMs);
    this.touch("pose");
  }

  /** Throws SceneGap when the patch does not join up. */
  takeScene(frame: SceneFrame, nowMs = 0): void {
    this.scene = applySceneFrame(this.scene, frame);
    const { goals } = this.scene.document;
    if (this.selectedGoal !== null && !(this.selectedGoal in goals)) {
      const by = "by" in frame && frame.by && frame.by !== this.people.me ? this.people.nameOf(frame.by) : "";
      if (by) this.say(`${by} removed the goal ${goalName(this.selectedGoal)}`);
      this.selectedGoal = null;
    }
    if ("patch" in frame && this.people.edited(frame.by, frame.patch, nowMs)) this.touch("people");
    this.touch("scene");
  }

  takeTracker(frame: TrackerFrame): void {
    // A frame is complete: a sensor of this device that is not in it is absent now.
    const ofDevice = this.trackers.find(({ tracker }) => tracker === frame.device)?.sensors ?? [];
    for (const sensor of ofDevice) this.samples.delete(sensor);
    for (const sample of frame.sensors) this.samples.set(sample.sensor, sample);
    this.heardNs.set(frame.device, frame.t_ns);
    this.touch("samples");
  }

  takeCameras(frame: CameraFrame): void {
    this.cameras = frame.cameras;
    this.touch("cameras");
  }

  setTrackers(trackers: TrackerInfo[]): void {
    this.trackers = trackers;
    const known = new Set(trackers.flatMap(({ sensors }) => sensors));
    for (const sensor of this.samples.keys()) if (!known.has(sensor)) this.samples.delete(sensor);
    this.touch("trackers");
  }

  setPeople(sessions: SessionInfo[]): void {
    this.people.sessions = sessions;
    this.touch("people");
  }

  countLost(stream: StreamName, dropped: number): void {
    this.lost[stream] = (this.lost[stream] ?? 0) + dropped;
  }

  setLocalTarget(goal: string, position: Vec3): void {
    this.localTargets.set(goal, { ...this.localTargets.get(goal), position, untilRevision: null });
    this.touch("local");
  }

  setLocalTurn(goal: string, turn: Quat): void {
    this.localTargets.set(goal, { ...this.localTargets.get(goal), turn, untilRevision: null });
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
    if (goal !== null) this.selectedSegment = null;
    this.touch("local");
  }

  choose(segment: SegmentKey | null): void {
    this.selectedSegment = segment;
    if (segment !== null) this.selectedGoal = null;
    this.touch("local");
  }

  say(message: string, hint = "", good = false): void {
    this.toast = { message, hint, good };
    this.touch("toast");
  }

  goalPose(id: string): GoalPose | undefined {
    if (this.goalPosesFor !== this.version.pose) {
      this.goalPosesFor = this.version.pose;
      this.goalPoses = new Map([...this.poses.values()].flatMap(({ goals }) => goals.map((goal) => [goal.id, goal] as const)));
    }
    return this.goalPoses.get(id);
  }

  /** Where the cube is: under the hand, else where the solver pulls to, else where the document says. */
  goalTarget(id: string): Vec3 | undefined {
    const goal = this.scene.document.goals[id];
    if (!goal) return undefined;
    const local = this.localTargets.get(id)?.position;
    if (local) return local;
    const pose = this.goalPose(id);
    // A goal of the whole figure has no place of its own.
    if (goal.kind === "posture" || (goal.kind === "balance" && this.goalPose(id)?.state === "off")) return undefined;
    // What a daemon says of a goal that is off may be of another time.
    if (pose && pose.state !== "off") return pose.target;
    const [point, frame] = [payloadPoint(goal), this.goalFrame(goal)];
    return point && frame ? apply(frame, point) : pose?.target;
  }

  /** How an orientation or pose goal is turned, in the world. */
  goalTurn(id: string): Quat | undefined {
    const goal = this.scene.document.goals[id];
    const frame = goal?.orientation && this.goalFrame(goal);
    if (!goal?.orientation || !frame) return undefined;
    return this.localTargets.get(id)?.turn ?? multiply(quatOf(frame), goal.orientation.quat_xyzw);
  }

  goalFrame(goal: GoalDocument): Transform | null {
    return frameTransform(this, goal.relative_to, this.goalFigure(goal));
  }

  /** It has a point that a hand can move, and nobody else's hand is on it. */
  movable(id: string): boolean {
    const goal = this.scene.document.goals[id];
    return goal !== undefined && payloadPoint(goal) !== undefined && this.goalFrame(goal) !== null && this.mayEdit && !this.people.holder(id);
  }

  /** Where a thing stands now: where a sensor has it, or else where the document says. */
  objectTransform(id: string): Transform | null {
    const led = this.led.transform(id, this.scene.revision);
    const object = this.scene.document.objects[id];
    return led ?? (object ? [...(object.position ?? [0, 0, 0]), ...(object.quat_xyzw ?? [0, 0, 0, 1])] as Transform : null);
  }

  goalFigure(goal: GoalDocument): string | undefined {
    return goal.figure ?? (this.figures.size === 1 ? [...this.figures.keys()][0] : "body");
  }

  segmentTransform(figure: string, segment: string): Transform | null {
    const index = this.figures.get(figure)?.segments.findIndex(({ name }) => name === segment) ?? -1;
    return this.poses.get(figure)?.worldFromSegment[index] ?? null;
  }

  chosenSegment(key: SegmentKey | null = this.selectedSegment): ChosenSegment | null {
    if (!key) return null;
    const segments = this.figures.get(key.figure)?.segments ?? [];
    const index = segments.findIndex(({ name }) => name === key.segment);
    const document = segments[index];
    if (!document) return null;
    const parentTransform = document.parent === undefined ? identity : this.segmentTransform(key.figure, document.parent);
    return { ...key, index, document, transform: this.segmentTransform(key.figure, key.segment), parentTransform };
  }
}
