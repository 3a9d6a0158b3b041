// What a balance goal stands on, seen from above: the hull of its support, by the protocol's own rule of soles.
import type { At, FigureDocument, GoalDocument, Quat, SegmentDocument, Vec3 } from "../protocol/types";
import type { Model } from "./model";
import { apply, conjugate, multiply, rotate } from "./place";

/** The corners of the hull on the floor that its lowest point is on, counter-clockwise; null where nothing is known. */
export function supportHull(model: Model, goal: GoalDocument): Vec3[] | null {
  const figure = model.goalFigure(goal) ?? "";
  const document = model.figures.get(figure);
  if (!goal.balance || !document) return null;
  const points = goal.balance.support.flatMap((at) => supportPoints(document, at).flatMap(({ segment, point }) => {
    const transform = model.segmentTransform(figure, segment);
    return transform ? [apply(transform, point)] : [];
  }));
  if (points.length === 0) return null;
  const floor = Math.min(...points.map(([, , z]) => z));
  return hull(points.map(([x, y]) => [x, y])).map(([x, y]) => [x, y, floor]);
}

function supportPoints(document: FigureDocument, at: At): Array<{ segment: string; point: Vec3 }> {
  if (typeof at !== "string") return [at];
  const site = document.sites?.[at];
  if (site) return [site];
  const segment = document.segments.find(({ name }) => name === at);
  if (!segment) return [];
  const soles = (segment.shape ?? []).flatMap((shape) => (shape.kind === "box" ? sole(shape.center, shape.half_size, restTurn(document, segment)) : []));
  const touched = [segment.touch_point, ...Object.values(document.sites ?? {}).flatMap((other) => (other.segment === at ? [other.point] : []))];
  return (soles.length > 0 ? soles : touched).map((point) => ({ segment: at, point }));
}

/** The corners of the face that is lowest at rest. */
function sole(center: Vec3, half: Vec3, rest: Quat): Vec3[] {
  const down = rotate(conjugate(rest), [0, 0, -1]);
  const axis = [0, 1, 2].reduce((best, k) => (Math.abs(down[k]!) > Math.abs(down[best]!) ? k : best));
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  return ([[-1, -1], [1, -1], [1, 1], [-1, 1]] as const).map(([a, b]) => {
    const corner: Vec3 = [...center];
    corner[axis]! += down[axis]! < 0 ? -half[axis]! : half[axis]!;
    corner[u]! += a * half[u]!;
    corner[v]! += b * half[v]!;
    return corner;
  });
}

function restTurn(document: FigureDocument, segment: SegmentDocument): Quat {
  const own: Quat = segment.joint?.quat_xyzw ?? [0, 0, 0, 1];
  const parent = document.segments.find(({ name }) => name === segment.parent);
  return parent ? multiply(restTurn(document, parent), own) : own;
}

type Vec2 = [number, number];

/** Andrew's monotone chain. */
export function hull(points: readonly Vec2[]): Vec2[] {
  const sorted = [...points].sort(([ax, ay], [bx, by]) => ax - bx || ay - by);
  const half = (all: readonly Vec2[]) => {
    const chain: Vec2[] = [];
    for (const p of all) {
      while (chain.length >= 2 && turn(chain.at(-2)!, chain.at(-1)!, p) <= 0) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return sorted.length < 3 ? sorted : [...half(sorted), ...half(sorted.reverse())];
}

function turn(a: Vec2, b: Vec2, c: Vec2): number {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
