// Places in frames, as far as a viewer needs them: points carried into and out of transforms that the daemon sent.
import type { Quat, Transform, Vec3 } from "../protocol/types";

export const identity: Transform = [0, 0, 0, 0, 0, 0, 1];

export function rotate([qx, qy, qz, qw]: Quat, [x, y, z]: Vec3): Vec3 {
  const [tx, ty, tz] = [2 * (qy * z - qz * y), 2 * (qz * x - qx * z), 2 * (qx * y - qy * x)];
  return [x + qw * tx + qy * tz - qz * ty, y + qw * ty + qz * tx - qx * tz, z + qw * tz + qx * ty - qy * tx];
}

export function multiply([ax, ay, az, aw]: Quat, [bx, by, bz, bw]: Quat): Quat {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

export function conjugate([x, y, z, w]: Quat): Quat {
  return [-x, -y, -z, w];
}

export function quatOf([, , , x, y, z, w]: Transform): Quat {
  return [x, y, z, w];
}

export function originOf([x, y, z]: Transform): Vec3 {
  return [x, y, z];
}

export function add(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function subtract(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function scaled(a: Vec3, by: number): Vec3 {
  return [a[0] * by, a[1] * by, a[2] * by];
}

export function distance(a: Vec3, b: Vec3): number {
  return Math.hypot(...subtract(a, b));
}

/** From the transform's own frame to the one that it stands in. */
export function apply(transform: Transform, point: Vec3): Vec3 {
  return add(originOf(transform), rotate(quatOf(transform), point));
}

/** The other way round. */
export function into(transform: Transform, point: Vec3): Vec3 {
  return rotate(conjugate(quatOf(transform)), subtract(point, originOf(transform)));
}

export function compose(a: Transform, b: Transform): Transform {
  return [...apply(a, originOf(b)), ...multiply(quatOf(a), quatOf(b))];
}

/** Micrometres are enough for a hand, and keep the document readable. */
export function tidy<T extends number[]>(values: T): T {
  return values.map((value) => Math.round(value * 1e6) / 1e6 + 0) as T;
}

export function unit(quat: Quat): Quat {
  const length = Math.hypot(...quat) || 1;
  return quat.map((value) => value / length) as Quat;
}
