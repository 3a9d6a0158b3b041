// The scene's cameras, as the page sets them: where they stand, on what, and which one the perspective view looks through.
import type { CameraDocument, Frame, Quat, Vec3 } from "../protocol/types";
import { eyesOf } from "../state/eyes";
import type { Model } from "../state/model";
import { tidy, unit } from "../state/place";
import type { Requests } from "./requests";

export interface Seat {
  key: string;
  says: string;
  frame: Frame;
  /** Where on it a camera begins; null: where the perspective view is. */
  place: { position: Vec3; quat_xyzw: Quat } | null;
}

export const kCamera = "main";

/** What a camera can stand on: the world, a figure's eyes, an object. */
export function seatsOf(model: Model): Seat[] {
  const straight: Quat = [0, 0, 0, 1];
  const eyes = [...model.figures.keys()].flatMap((figure): Seat[] => {
    const site = eyesOf(model, figure);
    const place = site && { position: tidy([site.point[0] + 0.02, site.point[1], site.point[2]]) as Vec3, quat_xyzw: straight };
    return site ? [{ key: `eyes ${figure}`, says: `the eyes of ${figure}`, frame: { figure, segment: site.segment }, place }] : [];
  });
  const objects = Object.keys(model.scene.document.objects).map((object): Seat => ({ key: `object ${object}`, says: `object ${object}`, frame: { object }, place: { position: [0, 0, 0], quat_xyzw: straight } }));
  return [{ key: "world", says: "the world", frame: "world", place: null }, ...eyes, ...objects];
}

/** The seat that a camera is on; null: one that the page does not offer, as a sensor. */
export function seatOf(model: Model, { relative_to = "world" }: CameraDocument): Seat | null {
  const same = JSON.stringify(sorted(relative_to));
  return seatsOf(model).find(({ frame }) => JSON.stringify(sorted(frame)) === same) ?? null;
}

export function seat(requests: Requests, camera: string, { frame, place }: Seat, here: { position: Vec3; quat_xyzw: Quat }): void {
  const { position, quat_xyzw } = place ?? here;
  void requests.edit("camera.set", { id: camera, relative_to: frame, position: tidy(position), quat_xyzw: tidy(unit(quat_xyzw)) });
}

export function lookThrough(model: Model, camera: string | null): void {
  model.rides = camera === null ? null : { camera };
  model.touch("cameras");
}

function sorted(frame: Frame): unknown {
  return typeof frame === "string" ? frame : Object.entries(frame).sort(([a], [b]) => (a < b ? -1 : 1));
}
