// The colours of the drawing, in one place. Left is cool, right is warm, the middle is neutral.
import type { GoalState } from "../protocol/types";

export const background = 0x14171c;
export const gridFine = 0x20252d;
export const gridCoarse = 0x303742;
export const floorLine = 0x56606f;

export const axisColors = { x: 0xe2665f, y: 0x6fbf73, z: 0x5b9bea } as const;

export const goalColors: Record<GoalState, number> = {
  reached: 0x4fd18b,
  balanced: 0xf2b441,
  limited: 0xe5805f,
  unreachable: 0xf0605a,
  off: 0x7d8794,
};

const middle = [0xc9ccd2, 0xb3b7c0];
const left = [0x8fb4d6, 0x7299c0];
const right = [0xdcb18c, 0xc69670];

/** Neighbours along a limb differ in lightness, so that each segment reads at a glance. */
export function segmentColor(name: string, depth: number): number {
  const pair = name.startsWith("left_") ? left : name.startsWith("right_") ? right : middle;
  return pair[depth % 2] as number;
}
