// The four views of the paper's Figure 2: their names, bases and what their titles say.
import type { Vec3 } from "../protocol/types";

export type ViewName = "top" | "perspective" | "front" | "side";
export type OrthoName = Exclude<ViewName, "perspective">;

/** Reading order of the grid: the top view stands over the front view, so that Y runs the same way in both. */
export const viewNames: readonly ViewName[] = ["top", "perspective", "front", "side"];

export const orthoNames: readonly OrthoName[] = ["top", "front", "side"];

/** World directions of the screen's right, the screen's up, and out of the screen. */
export interface Basis {
  right: Vec3;
  up: Vec3;
  back: Vec3;
}

export const orthoBases: Record<OrthoName, Basis> = {
  top: { right: [0, 1, 0], up: [-1, 0, 0], back: [0, 0, 1] },
  front: { right: [0, 1, 0], up: [0, 0, 1], back: [1, 0, 0] },
  side: { right: [1, 0, 0], up: [0, 0, 1], back: [0, -1, 0] },
};

export interface Title {
  key: string;
  name: string;
  /** Axis name and arrow pairs; the axis names its colour. */
  axes: Array<["x" | "y" | "z", string]>;
  says: string;
}

export const titles: Record<ViewName, Title> = {
  top: { key: "1", name: "Top", axes: [["y", "→"], ["x", "↓"]], says: "from above, along −Z" },
  front: { key: "2", name: "Front", axes: [["y", "→"], ["z", "↑"]], says: "at the face, along −X" },
  side: { key: "3", name: "Side", axes: [["x", "→"], ["z", "↑"]], says: "from the right, along +Y" },
  perspective: { key: "4", name: "Perspective", axes: [], says: "drag to orbit" },
};

export function isOrtho(name: ViewName): name is OrthoName {
  return name !== "perspective";
}
