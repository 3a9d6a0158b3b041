// Numbers and names as the panels say them.
import type { At, GoalPose } from "../protocol/types";

const kLowest = 0.1;
const kHighest = 1000;

export function atText(at: At | undefined): string {
  if (at === undefined) return "the whole figure";
  if (typeof at === "string") return plain(at).replace("/", " / ");
  return `${plain(at.segment)} (${at.point.map((value) => value.toFixed(2)).join(", ")})`;
}

export function errorText(metres: number): string {
  const millimetres = metres * 1000;
  return `${millimetres < 100 ? millimetres.toFixed(1) : millimetres.toFixed(0)} mm`;
}

export function causesText(causes: GoalPose["causes"]): string {
  const holders = (causes ?? []).flatMap(({ goal, pin }) =>
    goal !== undefined ? [goalName(goal)] : pin !== undefined ? [`the pin of ${plain(pin)}`] : [],
  );
  const beyond = (causes ?? []).flatMap(({ beyond_m }) => (beyond_m === undefined ? [] : [`${errorText(beyond_m)} beyond reach`]));
  const limits = (causes ?? []).flatMap(({ limit, side }) => (limit === undefined ? [] : [`${plain(limit)}${side ? ` (${side})` : ""}`]));
  const limited = limits.length > 0 ? [`limited by ${limits.join(", ")}`] : [];
  return [...(holders.length > 0 ? [`held by ${holders.join(", ")}`] : []), ...limited, ...beyond].join(" · ");
}

/** A goal made without a name is called FIGURE.SEGMENT.KIND: its segment says as much. */
export function goalName(id: string): string {
  const parts = id.split(".");
  return plain(parts.length === 3 ? (parts[1] ?? id) : id);
}

function plain(name: string): string {
  return name.replaceAll("_", " ");
}

/** The slider runs over the decades from 0.1 to 1000; two digits are as fine as a hand sets it. */
export function weightFromSlider(value: number): number {
  return Number((10 ** value).toPrecision(2));
}

export function sliderFromWeight(weight: number): number {
  const within = Math.min(Math.max(weight, kLowest), kHighest);
  return Math.round(Math.log10(within) * 100) / 100;
}

export function weightText(weight: number): string {
  return String(Number(weight.toPrecision(3)));
}

/** What is less than a micrometre's worth is nothing to the eye. */
export function costText(cost: number): string {
  return cost < 1e-6 ? "0" : String(Number(cost.toPrecision(3)));
}
