// Where a figure looks from: its site that is called eyes.
import type { Model } from "./model";

export function eyesOf(model: Model, figure: string) {
  const sites = model.figures.get(figure)?.sites ?? {};
  return Object.entries(sites).find(([name]) => name.endsWith("/eyes"))?.[1] ?? null;
}
