// Goals of every kind for the chosen segment, each met as the figure stands.
import { html, type TemplateResult } from "lit-html";
import type { GoalKind } from "../protocol/types";
import type { Model } from "../state/model";
import { plain } from "../state/words";
import { makeGoalOfKind } from "../tools/make_goal";
import type { Requests } from "../tools/requests";

const kKinds: ReadonlyArray<readonly [GoalKind | "pole", string]> = [
  ["position", "place"], ["orientation", "turn"], ["pose", "place and turn"], ["aim", "aim at a point"], ["plane", "on a plane"], ["line", "on a line"],
  ["distance", "distance to its twin"], ["pole", "elbow or knee: pole"],
];

export function addGoalMenu(model: Model, requests: Requests): TemplateResult {
  const chosen = model.selectedSegment;
  const add = (event: Event) => {
    const select = event.target as HTMLSelectElement;
    if (chosen && select.value) makeGoalOfKind(model, requests, chosen.figure, chosen.segment, select.value as GoalKind | "pole");
    select.value = "";
    select.blur();
  };
  return html`<select class="add" data-testid="add-goal" aria-label="Add a goal to the chosen segment" ?disabled=${!chosen || !model.mayEdit} @change=${add}>
    <option value="">${chosen ? `+ goal for ${plain(chosen.segment)}` : "choose a segment…"}</option>
    ${kKinds.map(([kind, says]) => html`<option value=${kind}>${says}</option>`)}
  </select>`;
}
