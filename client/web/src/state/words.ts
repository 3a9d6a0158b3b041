// Numbers and names as people read them.
import type { At, Frame, GoalDocument, GoalKind, GoalPose } from "../protocol/types";

const kLowest = 0.1;
const kHighest = 1000;

export function atText(at: At | undefined): string {
  if (at === undefined) return "the whole figure";
  if (typeof at === "string") return plain(at).replace("/", " / ");
  return `${plain(at.segment)} (${at.point.map((value) => value.toFixed(2)).join(", ")})`;
}

export function lengthText(metres: number, unit: "mm" | "m"): string {
  if (unit === "m") return `${metres.toFixed(3)} m`;
  const millimetres = metres * 1000;
  return `${millimetres < 100 ? millimetres.toFixed(1) : millimetres.toFixed(0)} mm`;
}

/** Where a goal counts from, when that is not the world. */
export function frameText(frame: Frame | undefined): string {
  if (frame === undefined || frame === "world") return "";
  if ("object" in frame) return `on ${plain(frame.object)}`;
  if ("sensor" in frame) return `with ${frame.sensor}`;
  return `with ${frame.figure ? `${plain(frame.figure)}'s ` : ""}${plain(frame.segment)}`;
}

/** The error of these is an angle, told as arc on the figure's lever. */
export function isAngle(kind: GoalKind | undefined): boolean {
  return kind === "orientation" || kind === "aim" || kind === "posture";
}

export function degreesText(radians: number): string {
  return `${((radians * 180) / Math.PI).toFixed(1)}°`;
}

/** What stands in a goal's way, in plain words: "right elbow at its limit; 120 mm beyond reach". */
export function causesText(causes: GoalPose["causes"], unit: "mm" | "m"): string {
  const all = causes ?? [];
  const whose = (figure: string | undefined) => (figure ? ` of ${plain(figure)}` : "");
  const holders = all.flatMap(({ goal }) => (goal === undefined ? [] : [goalName(goal)]));
  const pins = all.flatMap(({ pin, figure }) => (pin === undefined ? [] : [plain(pin) + whose(figure)]));
  const limits = [...new Set(all.flatMap(({ limit, figure }) => (limit === undefined ? [] : [plain(limit) + whose(figure)])))];
  const beyond = all.flatMap(({ beyond_m }) => (beyond_m === undefined ? [] : [`${lengthText(beyond_m, unit)} beyond reach`]));
  return [
    holders.length > 0 ? `held by ${listed(holders)}` : "",
    pins.length > 0 ? `${listed(pins)} pinned` : "",
    limits.length > 0 ? `${listed(limits)} at ${limits.length > 1 ? "their limits" : "its limit"}` : "",
    ...beyond,
  ].filter(Boolean).join("; ");
}

function listed(names: readonly string[]): string {
  return names.length < 2 ? (names[0] ?? "") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;
}

/** A goal made without a name is called FIGURE.SEGMENT.KIND: its segment says as much. */
export function goalName(id: string): string {
  const parts = id.split(".");
  return plain(parts.length === 3 ? (parts[1] ?? id) : id);
}

export function plain(name: string): string {
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

export function weightText(weight: GoalDocument["weight"]): string {
  if (typeof weight === "object") return `${digits(weight.position)} and ${digits(weight.orientation)}`;
  return digits(weight ?? 10);
}

function digits(value: number): string {
  return String(Number(value.toPrecision(3)));
}

/** What is less than a micrometre's worth is nothing to the eye. */
export function costText(cost: number): string {
  return cost < 1e-6 ? "0" : String(Number(cost.toPrecision(3)));
}
