// window.posed: a read-only handle on what the page knows, for tests and curious people.
import { Vector3 } from "three";
import type { Vec3 } from "./protocol/types";
import type { Model } from "./state/model";
import { touchPoint } from "./tools/make_goal";
import { viewNames, type ViewName } from "./views/names";
import type { Views } from "./views/views";

export function exposeDebugHandle(model: Model, views: Views): void {
  const handle = {
    get state() {
      return {
        connection: model.connection.phase,
        revision: model.scene.revision,
        poseRevision: model.poseRevision,
        figures: Object.fromEntries(
          [...model.figures].map(([id, { segments }]) => [
            id,
            { segments: segments.map(({ name }) => name), pose: structuredClone(model.poses.get(id) ?? null) },
          ]),
        ),
        scene: structuredClone(model.scene.document),
        goals: Object.fromEntries(
          Object.keys(model.scene.document.goals).map((id) => [
            id,
            { target: model.goalTarget(id) ?? null, pose: structuredClone(model.goalPose(id) ?? null) },
          ]),
        ),
        trackers: structuredClone(model.trackers),
        sensors: Object.fromEntries(structuredClone(model.samples)),
        lost: { ...model.lost },
        role: model.hello?.role,
        session: model.hello?.session,
        waiting: model.waitingEdits,
        selected: { goal: model.selectedGoal, segment: structuredClone(model.selectedSegment) },
        rides: structuredClone(model.rides),
        cameras: structuredClone(model.cameras),
        objects: Object.fromEntries(Object.keys(model.scene.document.objects).map((id) => [id, model.objectTransform(id)])),
      };
    },
    /** Milliseconds of script that the last frames took. */
    get work() {
      return [...model.work];
    },
    /** Frames that drew, since the page began. */
    get drawn() {
      return model.frameMeter.total;
    },
    views: {
      get cameras() {
        return views.cameras.state;
      },
      names: viewNames,
      rect: (name: ViewName) => views.panes.rect(name),
      /** A world point in page pixels, as that view shows it. */
      project: (name: ViewName, point: Vec3) => views.project(name, new Vector3(...point)),
      touchPoint: (figure: string, segment: string) => touchPoint(model, figure, segment),
    },
  };
  Object.defineProperty(window, "posed", { value: Object.freeze(handle) });
}
