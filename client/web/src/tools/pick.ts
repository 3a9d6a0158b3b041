// Which goal lies under the pointer: by its distance on the screen.
import { Vector3 } from "three";
import type { Model } from "../state/model";
import type { ViewName } from "../views/names";
import type { Views } from "../views/views";

const kReachPixels = 14;

export function pickGoal(views: Views, model: Model, name: ViewName, x: number, y: number): string | null {
  let best: string | null = null;
  let nearest = Infinity;
  for (const id of Object.keys(model.scene.document.goals)) {
    const target = model.goalTarget(id);
    if (!target) continue;
    const at = views.project(name, new Vector3(...target));
    const distance = Math.hypot(at.x - x, at.y - y);
    if (distance > kReachPixels || Math.abs(at.depth) > 1) continue;
    // Cubes that hide each other on the screen: the one that is nearer to the viewer.
    const rank = Math.round(distance / 4) + (at.depth + 1) / 2;
    if (rank < nearest) [nearest, best] = [rank, id];
  }
  return best;
}
