// The shared document as the scene stream tells it: a snapshot, then patches that must join up.
import { applyPatch, type Operation } from "fast-json-patch";
import type { SceneDocument, SceneFrame } from "../protocol/types";

/** A patch does not continue from what we have; the cure is a fresh snapshot. */
export class SceneGap extends Error {}

export interface SceneState {
  revision: number;
  document: Required<SceneDocument>;
}

export const emptyScene: SceneState = { revision: -1, document: complete({}) };

export function applySceneFrame(scene: SceneState, frame: SceneFrame): SceneState {
  if ("document" in frame) return { revision: frame.revision, document: complete(frame.document) };
  if (frame.from_revision !== scene.revision) {
    throw new SceneGap(`have revision ${scene.revision}, the patch starts at ${frame.from_revision}`);
  }
  try {
    const document = applyPatch(scene.document, frame.patch as Operation[]).newDocument;
    return { revision: frame.revision, document: complete(document) };
  } catch (error) {
    throw new SceneGap(String(error));
  }
}

/** Which figures a frame may have given another body: their shapes have to be asked for anew. */
export function touchesFigures(frame: SceneFrame): boolean {
  if ("document" in frame) return true;
  return frame.patch.some(({ path }) => {
    const [, map, , field] = path.split("/");
    return map === "" || map === undefined || (map === "figures" && field !== "q" && field !== "pins");
  });
}

function complete(document: SceneDocument): Required<SceneDocument> {
  return Object.assign(document, {
    figures: document.figures ?? {},
    goals: document.goals ?? {},
    objects: document.objects ?? {},
    bindings: document.bindings ?? {},
    cameras: document.cameras ?? {},
  });
}
