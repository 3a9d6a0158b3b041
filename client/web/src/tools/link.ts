// A link that carries the view: cameras, panes and what is chosen, in the address behind the #. Never the token.
import type { Model } from "../state/model";
import { viewNames, type ViewName } from "../views/names";
import type { CameraState } from "../views/cameras";
import type { Split } from "../views/splitters";

export interface ViewLink {
  cameras: CameraState;
  split: Split;
  one: ViewName | null;
  goal: string | null;
}

interface Shown {
  cameras: { state: CameraState; restore(state: CameraState): void };
  panes: { split: Split; maximised: ViewName | null; toggle(name: ViewName | null): void };
  fitFrom(revision: number | null): void;
}

export function viewLink(address: string, views: Shown, model: Model): string {
  const link: ViewLink = { cameras: views.cameras.state, split: views.panes.split, one: views.panes.maximised, goal: model.selectedGoal };
  const url = new URL(address);
  url.hash = new URLSearchParams({ view: JSON.stringify(link) }).toString();
  return url.href;
}

/** What an address says of the view; null where it says nothing, or nothing that holds together. */
export function readLink(hash: string): ViewLink | null {
  try {
    const link = JSON.parse(new URLSearchParams(hash.replace(/^#/, "")).get("view") ?? "null") as ViewLink | null;
    if (!link) return null;
    const { focus, eye, target, zoom } = link.cameras;
    const numbers = [...focus, ...eye, ...target, zoom, link.split.x, link.split.y];
    const sound = numbers.length === 12 && numbers.every(Number.isFinite) && zoom > 0;
    return sound && (link.one === null || viewNames.includes(link.one)) ? link : null;
  } catch {
    return null;
  }
}

export function followLink(link: ViewLink, views: Shown, model: Model): void {
  views.fitFrom(null);
  views.panes.split = link.split;
  if (link.one !== views.panes.maximised) views.panes.toggle(link.one);
  views.cameras.restore(link.cameras);
  if (link.goal !== null) model.select(link.goal);
}
