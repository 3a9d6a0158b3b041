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

export interface SegmentDocument {
  name: string;
  parent?: string;
  touch_point: Vec3;
  shape?: Shape[];
}

export interface FigureDocument {
  format: string;
  root: string;
  segments: SegmentDocument[];
  sites?: Record<string, { segment: string; point: Vec3 }>;
}

export interface FigureReply {
  id: string;
  entity_revision: number;
  document: FigureDocument;
}

export type At = string | { segment: string; point: Vec3 };

export interface GoalDocument {
  figure?: string;
  /** position orientation pose aim plane line distance balance posture; the viewer moves the first, and shows the others. */
  kind?: string;
  at?: At;
  position?: Vec3;
  relative_to?: "world" | { figure?: string; segment: string } | { sensor: string };
  weight?: number | { position: number; orientation: number };
  enabled?: boolean;
  label?: string;
}

export interface BindingDocument {
  sensor: string;
  to: { goal?: string };
  axes?: string[];
  mode?: "absolute" | "relative";
  scale?: number;
}

export interface SceneDocument {
  figures?: Record<string, unknown>;
  goals?: Record<string, GoalDocument>;
  bindings?: Record<string, BindingDocument>;
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
  state: GoalState;
  causes?: Array<{ goal?: string; beyond_m?: number; limit?: string; side?: string; pin?: string; figure?: string }>;
}

export interface PoseFrame {
  t_ns: number;
  revision: number;
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
}

export interface HelloReply {
  protocol: number;
  daemon: { name: string; version: string };
  session: string;
  boot: string;
}

export interface EditReply {
  id?: string;
  revision: number;
  entity_revision?: number;
}

export type StreamName = "pose" | "tracker" | "scene" | "stats";
