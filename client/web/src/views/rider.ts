// Who leads the perspective camera: a figure's eyes, or a camera of the scene as the daemon streams it.
import { eyesOf } from "../state/eyes";
import type { Model } from "../state/model";
import { apply, quatOf } from "../state/place";
import type { Rider } from "./cameras";

/** About what one sees without turning the eyes. */
const kEyesFieldOfView = 1.2;

export function riderOf(model: Model): Rider | null {
  const { rides } = model;
  if (!rides) return null;
  if ("camera" in rides) return model.cameras.find(({ camera }) => camera === rides.camera) ?? null;
  const site = eyesOf(model, rides.eyes);
  const head = site && model.segmentTransform(rides.eyes, site.segment);
  if (!site || !head) return null;
  // A little before the eyes, so that the head is not looked at from inside.
  return { position: apply(head, [site.point[0] + 0.02, site.point[1], site.point[2]]), quat_xyzw: quatOf(head), fov_y: kEyesFieldOfView };
}
