// The wire's own names and shapes: proto/PROTOCOL.md, as far as the viewer reads it.

export type Vec3 = [number, number, number];
export type Quat = [number, number, number, number];
/** x y z qx qy qz qw */
export type Transform = [number, number, number, number, number, number, number];

export interface ErrorData {
  code?: string;
  path?: string;
  hint?: string;
}

export type Shape =
  | { kind: "capsule"; from: Vec3; to: Vec3; radius: number }
  | { kind: "ellipsoid"; center: Vec3; radii: Vec3 }
  | { kind: "box"; center: Vec3; half_size: Vec3 };

export interface JointDocument {
  name: string;
  type: "free" | "ball" | "universal" | "hinge" | "prismatic" | "fixed";
  position: Vec3;
  quat_xyzw?: Quat;
  axes?: Vec3[];
  limits?: Array<[number, number] | null>;
  swing?: { ellipse: [number, number]; center?: Vec3 } | { polygon: Vec3[] };
  twist?: [number, number];
}

export interface SegmentDocument {
  name: string;
  parent?: string;
  touch_point: Vec3;
  shape?: Shape[];
  joint?: JointDocument;
}

export interface FigureDocument {
  format: string;
  root: string;
  segments: SegmentDocument[];
  sites?: Record<string, { segment: string; point: Vec3 }>;
  mirror?: Array<[string, string]>;
}

export interface FigureReply {
  id: string;
  entity_revision: number;
  document: FigureDocument;
  q_layout?: Array<{ joint: string; type: JointDocument["type"]; at: number; size: number }>;
}

export type At = string | { segment: string; point: Vec3 };

export type Frame = "world" | { figure?: string; segment: string } | { sensor: string } | { object: string };

export type GoalKind = "position" | "orientation" | "pose" | "aim" | "plane" | "line" | "distance" | "balance" | "posture";

export interface Aim {
  axis: Vec3;
  point?: Vec3;
  direction?: Vec3;
}

/** A share of q, an angle or a length, or the paper's three numbers. */
export type JointValue = number | number[] | { halfplane: number; deviation: number; twist: number };

export interface GoalDocument {
  figure?: string;
  kind?: GoalKind;
  at?: At;
  position?: Vec3;
  orientation?: { quat_xyzw: Quat };
  aim?: Aim;
  plane?: { point: Vec3; normal: Vec3; side?: "on" | "above" };
  line?: { point: Vec3; direction: Vec3 };
  distance?: { to: At; length: number; compare?: "equal" | "at_least" | "at_most" };
  balance?: { support: At[]; margin?: number };
  posture?: { pose?: "rest" | "start"; joints?: Record<string, JointValue> };
  relative_to?: Frame;
  weight?: number | { position: number; orientation: number };
  priority?: number;
  tolerance?: number | Vec3;
  enabled?: boolean;
  label?: string;
}

export interface Filter {
  one_euro?: { min_cutoff_hz?: number; beta?: number; d_cutoff_hz?: number };
  predict_ms?: number;
}

export interface BindingDocument {
  sensor: string;
  to: { goal?: string; object?: string; joint?: string; figure?: string; camera?: string };
  axes?: string[];
  mode?: "absolute" | "relative";
  clutch?: { button: number } | null;
  buttons?: Array<{ button: number; do: "recenter" | "toggle" | "save" }>;
  scale?: number;
  filter?: Filter | null;
}

export interface ObjectDocument {
  position?: Vec3;
  quat_xyzw?: Quat;
  shape?: Shape[];
  label?: string;
}

export interface CameraDocument {
  position?: Vec3;
  quat_xyzw?: Quat;
  relative_to?: Frame;
  fov_y?: number;
}

export interface PinDocument {
  hold: "position" | "orientation" | "pose";
  position?: Vec3;
  quat_xyzw?: Quat;
}

export interface SceneFigure {
  template?: string;
  stature?: number;
  pins?: Record<string, PinDocument>;
}

export interface SceneDocument {
  figures?: Record<string, SceneFigure>;
  goals?: Record<string, GoalDocument>;
  objects?: Record<string, ObjectDocument>;
  bindings?: Record<string, BindingDocument>;
  cameras?: Record<string, CameraDocument>;
}

export interface PatchOperation {
  op: "add" | "remove" | "replace" | "move" | "copy" | "test";
  path: string;
  from?: string;
  value?: unknown;
}

export type SceneFrame =
  | { revision: number; document: SceneDocument }
  | { from_revision: number; revision: number; by?: string; patch: PatchOperation[] };

export type GoalState = "off" | "reached" | "balanced" | "unreachable" | "limited";

export interface GoalPose {
  id: string;
  touch: Vec3;
  target: Vec3;
  error: number;
  force?: Vec3;
  state: GoalState;
  causes?: Array<{ goal?: string; beyond_m?: number; limit?: string; side?: string; pin?: string; figure?: string }>;
}

export interface PoseFrame {
  t_ns: number;
  revision: number;
  /** Those that sensors lead. */
  objects?: Array<{ object: string; world_from_object: Transform }>;
  figures: Array<{
    figure: string;
    world_from_segment: Transform[];
    goals?: GoalPose[];
    cost?: number;
    status?: string;
    branch_changed?: boolean;
  }>;
}

export interface SensorSample {
  sensor: string;
  position: Vec3;
  quat_xyzw: Quat;
  buttons?: number;
  flags?: string[];
}

export interface TrackerFrame {
  t_ns: number;
  device: string;
  sensors: SensorSample[];
}

export interface StatsFrame {
  frames?: number;
  solves?: number;
  solve_us?: unknown;
  connections?: number;
  dropped?: number;
  trackers?: Array<{ tracker: string; rate_hz: number; jitter_us: number; lag_us: number }>;
}

export interface TrackerInfo {
  tracker: string;
  kind: string;
  state: "searching" | "starting" | "streaming" | "silent" | "failed";
  message?: string;
  rate_hz?: number;
  frames?: number;
  bad_bytes?: number;
  sensors: string[];
  held_by?: string;
  /** The one that counts now; absent: none. */
  calibration?: string;
  calibrations?: Calibration[];
}

/** Where a tracker stands, as it was measured. */
export interface Calibration {
  tracker: string;
  name: string;
  author?: string;
  residual_m: number;
  points: Array<{ source: Vec3; world: Vec3; residual_m: number }>;
  /** By station, "1". */
  sensors: Record<string, { tip?: { offset: Vec3; residual_m: number; samples: number }; boresight?: Quat }>;
}

/** A sensor's tip, held still and measured. */
export interface TouchReply {
  sensor: string;
  samples: number;
  position: Vec3;
  quat_xyzw: Quat;
  source: Vec3;
  spread_m: number;
  off_m?: number;
}

export interface HelloReply {
  protocol: number;
  daemon: { name: string; version: string };
  session: string;
  resume?: string;
  boot: string;
  features?: string[];
  role?: "none" | "viewer" | "editor" | "operator";
  clock?: { t_ns: number; utc_ns: number };
}

export interface PingReply {
  receive_t_ns: number;
  send_t_ns: number;
}

export interface SessionInfo {
  session: string;
  user?: string;
  face?: string;
  client?: { name: string };
}

export interface HistoryStep {
  step: number;
  revision: number;
  t_ns: number;
  user?: string;
  session: string;
  method: string;
  label?: string;
  entities: string[];
  mine: boolean;
  undone: boolean;
}

export interface CameraFrame {
  t_ns: number;
  cameras: Array<{ camera: string; position: Vec3; quat_xyzw: Quat; fov_y: number }>;
}

export interface JointReply {
  figure: string;
  joint: string;
  type: string;
  value: number | number[];
  halfplane?: number;
  deviation?: number;
  twist?: number;
}

export interface EditReply {
  id?: string;
  revision: number;
  entity_revision?: number;
}

export type StreamName = "pose" | "tracker" | "scene" | "stats" | "camera";
