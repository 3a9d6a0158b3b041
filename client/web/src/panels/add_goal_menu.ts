// Goals of every kind for the chosen segment, each met as the figure stands, and those of a whole figure.
import { html, nothing, type TemplateResult } from "lit-html";
import type { GoalKind } from "../protocol/types";
import type { Model } from "../state/model";
import { plain } from "../state/words";
import { makeGoalOfFigure, makeGoalOfKind } from "../tools/make_goal";
import type { Requests } from "../tools/requests";

const kKinds: ReadonlyArray<readonly [GoalKind | "pole", string]> = [
  ["position", "place"], ["orientation", "turn"], ["pose", "place and turn"], ["aim", "aim at a point"], ["plane", "on a plane"], ["line", "on a line"],
  ["distance", "distance to its twin"], ["pole", "elbow or knee: pole"],
];
const kWhole = [["balance", "balance on its feet"], ["posture", "posture, as it is now"], ["rest", "posture, towards its rest"]] as const;

export function addGoalMenu(model: Model, requests: Requests): TemplateResult {
  const chosen = model.selectedSegment;
  const figure = chosen?.figure ?? (model.figures.has("body") ? "body" : [...model.figures.keys()][0]);
  const add = (event: Event) => {
    const select = event.target as HTMLSelectElement;
    const whole = kWhole.find(([kind]) => kind === select.value)?.[0];
    if (whole && figure !== undefined) void makeGoalOfFigure(model, requests, figure, whole);
    else if (chosen && select.value) makeGoalOfKind(model, requests, chosen.figure, chosen.segment, select.value as GoalKind | "pole");
    select.value = "";
    select.blur();
  };
  return html`<select class="add" data-testid="add-goal" aria-label="Add a goal" ?disabled=${figure === undefined || !model.mayEdit} @change=${add}>
    <option value="">+ goal…</option>
    ${chosen ? html`<optgroup label=${plain(chosen.segment)}>${kKinds.map(([kind, says]) => html`<option value=${kind}>${says}</option>`)}</optgroup>` : nothing}
    ${figure === undefined ? nothing : html`<optgroup label="all of ${plain(figure)}">${kWhole.map(([kind, says]) => html`<option value=${kind}>${says}</option>`)}</optgroup>`}
  </select>`;
}
