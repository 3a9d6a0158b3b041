// The cameras of the scene: what each stands on, how wide it sees, and whether the perspective view looks through it.
import { html, nothing, type TemplateResult } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { repeat } from "lit-html/directives/repeat.js";
import type { CameraDocument, Quat, Vec3 } from "../protocol/types";
import type { Model } from "../state/model";
import { frameText } from "../state/words";
import { kCamera, lookThrough, seat, seatOf, seatsOf } from "../tools/scene_cameras";
import type { Requests } from "../tools/requests";
import { clicked } from "./panel";

const kDegrees = 180 / Math.PI;

/** Where the perspective view looks from now. */
export type Here = () => { position: Vec3; quat_xyzw: Quat };

export function cameraRows(model: Model, requests: Requests, here: Here): TemplateResult {
  const { cameras } = model.scene.document;
  const world = seatsOf(model)[0]!;
  return html`<h2>Cameras <span class="grow"></span>
      ${kCamera in cameras ? nothing : html`<button type="button" data-testid="camera-add" title="A camera where the perspective view is" ?disabled=${!model.mayEdit} @click=${clicked(() => seat(requests, kCamera, world, here()))}>+ camera</button>`}</h2>
    <div class="rows">${repeat(Object.entries(cameras).sort(([a], [b]) => (a < b ? -1 : 1)), ([id]) => id, ([id, camera]) => row(model, requests, here, id, camera))}</div>`;
}

function row(model: Model, requests: Requests, here: Here, id: string, camera: CameraDocument): TemplateResult {
  const [disabled, now] = [!model.mayEdit, seatOf(model, camera)];
  const through = model.rides !== null && "camera" in model.rides && model.rides.camera === id;
  const sit = (event: Event) => {
    const chosen = seatsOf(model).find(({ key }) => key === (event.target as HTMLSelectElement).value);
    if (chosen) seat(requests, id, chosen, here());
  };
  const widen = (event: Event) => {
    const degrees = (event.target as HTMLInputElement).valueAsNumber;
    if (Number.isFinite(degrees)) void requests.edit("camera.set", { id, fov_y: Math.min(Math.max(degrees, 5), 150) / kDegrees });
  };
  return html`<div class="row" data-testid="camera-${id}">
    <div class="line"><span class="grow strong">${id}</span>
      <label class="field"><input type="checkbox" data-testid="camera-through" .checked=${live(through)} @change=${(event: Event) => lookThrough(model, (event.target as HTMLInputElement).checked ? id : null)} /> look through</label>
      <button type="button" class="quiet" data-testid="camera-remove" aria-label="Remove camera ${id}" ?disabled=${disabled} @click=${clicked(() => void requests.edit("camera.remove", { id }))}>×</button></div>
    <div class="line wrap">
      <label class="field">on <select data-testid="camera-seat" ?disabled=${disabled} @change=${sit}>
        ${now ? nothing : html`<option selected value="">${frameText(camera.relative_to)}</option>`}
        ${seatsOf(model).map(({ key, says }) => html`<option value=${key} ?selected=${key === now?.key}>${says}</option>`)}
      </select></label>
      <label class="field">sees <input type="number" min="5" max="150" step="1" data-testid="camera-fov" .value=${String(Math.round((camera.fov_y ?? 50 / kDegrees) * kDegrees))} ?disabled=${disabled} @change=${widen} />°</label>
      <button type="button" class="small" data-testid="camera-here" title="Put it where the perspective view is" ?disabled=${disabled || through} @click=${clicked(() => seat(requests, id, seatsOf(model)[0]!, here()))}>Here</button>
    </div>
  </div>`;
}
