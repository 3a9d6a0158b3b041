// The colours of the drawing, in one place, for dark and for light. Left is cool, right is warm, the middle is neutral.
import type { GoalState } from "../protocol/types";

export type Theme = "dark" | "light";

export interface Palette {
  background: number;
  gridFine: number;
  gridCoarse: number;
  floorLine: number;
  shadow: number;
  outline: number;
  selected: number;
  limit: number;
  ghost: number;
  object: number;
  goals: Record<GoalState, number>;
  middle: readonly [number, number];
  left: readonly [number, number];
  right: readonly [number, number];
}

export const axisColors = { x: 0xe2665f, y: 0x6fbf73, z: 0x5b9bea } as const;

const dark: Palette = {
  background: 0x15181d,
  gridFine: 0x20252c,
  gridCoarse: 0x313843,
  floorLine: 0x5a6473,
  shadow: 0.8,
  outline: 0xf4f7fb,
  selected: 0xffd166,
  limit: 0xffd166,
  ghost: 0xaeb8c8,
  object: 0x6d7686,
  goals: { reached: 0x4fd18b, balanced: 0xf2b441, limited: 0xf08a4b, unreachable: 0xf0605a, off: 0x7d8794 },
  middle: [0xcfd3da, 0xb2b8c2],
  left: [0x8fb8de, 0x6a97c4],
  right: [0xe3b68d, 0xc9946a],
};

const light: Palette = {
  background: 0xf3f4f6,
  gridFine: 0xe4e7eb,
  gridCoarse: 0xcdd3da,
  floorLine: 0x9aa4b1,
  shadow: 0.26,
  outline: 0x1d2530,
  selected: 0xd98a00,
  limit: 0xb37100,
  ghost: 0x77818f,
  object: 0xaab2bd,
  goals: { reached: 0x1d9a5c, balanced: 0xc98500, limited: 0xd4601b, unreachable: 0xd3342e, off: 0x8b95a2 },
  middle: [0xd9dce1, 0xbcc2cb],
  left: [0x86b1da, 0x5f8fbf],
  right: [0xe6b48a, 0xcc9062],
};

export const palettes: Record<Theme, Palette> = { dark, light };

/** Neighbours along a limb differ in lightness, so that each segment reads at a glance. */
export function segmentColor(palette: Palette, name: string, depth: number): number {
  const pair = name.startsWith("left_") ? palette.left : name.startsWith("right_") ? palette.right : palette.middle;
  return pair[depth % 2] as number;
}
