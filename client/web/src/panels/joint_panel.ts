// The joint of the chosen segment: a ball's half-plane, deviation and twist on sliders, or the angles of its axes; its
// padlock and its pin.
import { html, nothing, type TemplateResult } from "lit-html";
import type { JointReply, PinDocument, Quat } from "../protocol/types";
import type { ChosenSegment, Model } from "../state/model";
import { degreesText, lengthText, plain } from "../state/words";
import { axisName, lockOf, setJoint, toggleLock, universalAngles, universalTurn } from "../tools/joints";
import type { Requests } from "../tools/requests";
import { padlock } from "./padlock";
import { Panel, clicked, section } from "./panel";
import { shownValue, slider } from "./slider";

const kReadPauseMs = 150;
const kTurns = [
  ["halfplane", "half-plane", -Math.PI, Math.PI, "Which way the limb leans: the half-plane that it swings in"],
  ["deviation", "deviation", 0, Math.PI, "How far it swings from its rest"],
  ["twist", "twist", -Math.PI, Math.PI, "Its turn about itself"],
] as const;

export class JointPanel extends Panel {
  private joint: JointReply | null = null;
  private readFor = "";
  private readMs = -Infinity;
  private reading = false;
  private readonly planes = new Map<string, number>();

  constructor(
    model: Model,
    private readonly requests: Requests,
  ) {
    super(section("joint", "joint-panel", "Joint"), model, ["scene", "pose", "local", "figures", "settings", "connection"]);
  }

  /** Joints' values come in no stream that the page asks for: the chosen one is read when the pose has changed. */
  override update(nowMs: number): void {
    const chosen = this.model.chosenSegment();
    const wanted = chosen ? [chosen.figure, chosen.document.joint?.name, this.model.version.pose].join() : "";
    if (wanted !== this.readFor && !this.reading && nowMs - this.readMs >= kReadPauseMs) void this.read(chosen, wanted, nowMs);
    super.update(nowMs);
  }

  private async read(chosen: ChosenSegment | null, wanted: string, nowMs: number): Promise<void> {
    [this.readFor, this.readMs, this.reading] = [wanted, nowMs, true];
    const joint = chosen?.document.joint;
    this.joint = (chosen && joint && (await this.requests.readJoint(chosen.figure, joint.name))) || null;
    this.reading = false;
    this.redraw();
  }

  protected template(): TemplateResult {
    const chosen = this.model.chosenSegment();
    const joint = chosen?.document.joint;
    if (!chosen || !joint) return html`<p class="empty">Click a part of the figure, or press <kbd>]</kbd>, to choose a segment and set its joint.</p>`;
    const locked = lockOf(this.model, chosen.figure, joint.name) !== null;
    const mine = this.joint?.joint === joint.name && this.joint.figure === chosen.figure ? this.joint : null;
    return html`
      <h3>${plain(chosen.segment)} <span class="dim">${plain(joint.name)}, ${joint.type}</span></h3>
      ${mine ? this.sliders(chosen, mine) : nothing}
      <div class="line wrap">
        <button type="button" class="lock" data-testid="joint-lock" aria-pressed=${locked} ?disabled=${!mine || !this.model.mayEdit || joint.type === "free" || joint.type === "fixed"}
          title="Holds this joint against the goals (J)" @click=${clicked(() => void toggleLock(this.model, this.requests, chosen.figure, joint.name))}>${padlock(locked)} ${locked ? "joint held" : "hold joint"}</button>
        ${this.pin(chosen)}
      </div>`;
  }

  private sliders(chosen: ChosenSegment, joint: JointReply): TemplateResult {
    const disabled = !this.model.mayEdit;
    const key = (name: string) => `${chosen.figure} ${joint.joint} ${name}`;
    if (typeof joint.value === "number") {
      const [low, high] = chosen.document.joint?.limits?.[0] ?? [-Math.PI, Math.PI];
      const shown = shownValue(key("value"), joint.value);
      const text = joint.type === "prismatic" ? lengthText(shown, this.model.settings.lengths) : degreesText(shown);
      return slider({
        key: key("value"), label: joint.type === "prismatic" ? "length" : "angle", testid: "joint-value", min: low, max: high, step: 0.005, value: joint.value, text, disabled,
        change: (value, gesture) => setJoint(this.model, this.requests, chosen.figure, joint.joint, value, gesture),
      });
    }
    if (joint.type === "universal") return this.universal(chosen, joint.value as Quat, key);
    if (joint.halfplane === undefined) return html`<p class="note">This joint moves freely: drag its gizmo, or give the segment a goal.</p>`;
    // Where nothing deviates there is no half-plane to read: the one that was chosen last is kept for when something does.
    if ((joint.deviation ?? 0) > 0.02) this.planes.set(key("halfplane"), joint.halfplane);
    const values = { ...joint, halfplane: this.planes.get(key("halfplane")) ?? joint.halfplane };
    const now = () => Object.fromEntries(kTurns.map(([name]) => [name, shownValue(key(name), values[name] ?? 0)])) as { halfplane: number; deviation: number; twist: number };
    return html`${kTurns.map(([name, label, min, max]) => {
      const value = values[name] ?? 0;
      return slider({
        key: key(name), label, testid: `joint-${name}`, min, max, step: 0.005, value, text: degreesText(shownValue(key(name), value)), disabled,
        change: (moved, gesture) => {
          if (name === "halfplane") this.planes.set(key(name), moved);
          setJoint(this.model, this.requests, chosen.figure, joint.joint, straightened(now()), gesture);
        },
      });
    })}`;
  }

  /** Two axes have two angles: a half-plane that is free to choose would be none of theirs. */
  private universal({ figure, document }: ChosenSegment, value: Quat, key: (name: string) => string): TemplateResult {
    const { joint, touch_point } = document;
    const axes = joint?.axes ?? [];
    const angles = universalAngles(value, axes);
    const now = () => angles.map((angle, i) => shownValue(key(`axis ${i}`), angle)) as [number, number];
    return html`${axes.map((axis, i) => {
      const name = axisName(axis, touch_point, i);
      const [min, max] = joint?.limits?.[i] ?? [-Math.PI, Math.PI];
      return slider({
        key: key(`axis ${i}`), label: name, testid: `joint-${name}`, min, max, step: 0.005, value: angles[i] ?? 0, text: degreesText(now()[i] ?? 0), disabled: !this.model.mayEdit,
        change: (_, gesture) => setJoint(this.model, this.requests, figure, joint!.name, universalTurn(now(), axes), gesture),
      });
    })}`;
  }

  private pin(chosen: ChosenSegment): TemplateResult {
    const hold = this.model.scene.document.figures[chosen.figure]?.pins?.[chosen.segment]?.hold ?? "";
    const set = (event: Event) => this.requests.pin(chosen.figure, chosen.segment, ((event.target as HTMLSelectElement).value || null) as PinDocument["hold"] | null);
    return html`<label class="field">pin <select data-testid="pin-hold" aria-label="Pin of ${plain(chosen.segment)}" ?disabled=${!this.model.mayEdit} @change=${set}>
      ${[["", "free"], ["position", "place"], ["orientation", "turn"], ["pose", "place and turn"]].map(([value, text]) => html`<option value=${value!} ?selected=${value === hold}>${text}</option>`)}
    </select></label>`;
  }
}

function straightened(value: { halfplane: number; deviation: number; twist: number }) {
  return value.deviation === 0 ? { ...value, halfplane: 0 } : value;
}
