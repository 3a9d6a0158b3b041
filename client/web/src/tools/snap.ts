// Snapping to the grid: switched on, or while its key is held; the key lets go where it is on.
import type { Vec3 } from "../protocol/types";
import type { Settings } from "../state/settings";

const kStepOfKey = 0.05;

/** Coordinates that the drag did not change stay exactly as they are. */
export function snapped({ snap }: Pick<Settings, "snap">, point: Vec3, from: Vec3, key: boolean): Vec3 {
  const step = key ? (snap > 0 ? 0 : kStepOfKey) : snap;
  if (step <= 0) return point;
  return point.map((value, i) => (Math.abs(value - from[i]!) < 1e-9 ? value : Math.round(value / step) * step)) as Vec3;
}
