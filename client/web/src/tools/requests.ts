// What the user's hands ask of the daemon. Every refusal becomes a toast with the daemon's own hint.
import { ConnectionLost, RpcError } from "../protocol/rpc";
import type { At, BindingDocument, EditReply, FigureReply, GoalDocument, JointReply, PinDocument, Quat, Vec3 } from "../protocol/types";
import type { Session } from "../session";
import { movedTo, turnedTo, type GoalFields } from "../state/goals";
import type { Model } from "../state/model";
import { goalName } from "../state/words";
import { GoalEdits } from "./goal_edits";
import { newId } from "./new_id";
import { Outbox } from "./outbox";

export interface Edit {
  method: string;
  params: object;
}

export class Requests {
  readonly outbox: Outbox;
  private readonly edits: GoalEdits;
  private gesture = "";

  constructor(
    private readonly model: Model,
    private readonly session: () => Session | null,
  ) {
    this.outbox = new Outbox(() => session()?.rpc ?? null, (waiting) => {
      model.waitingEdits = waiting;
      model.touch("connection");
    });
    this.edits = new GoalEdits((method, params) => this.outbox.edit(method, params), {
      settled: (goal, revision) => {
        if (goal !== model.people.holding) model.endLocalTarget(goal, revision);
      },
      failed: (error) => this.complain(error),
    });
  }

  setGoal(goal: string, fields: GoalFields, gesture?: string): void {
    this.edits.set(goal, fields, gesture);
  }

  /** An edit of this goal is on its way: what the document says of it is about to change. */
  busy(goal: string): boolean {
    return this.edits.busy(goal);
  }

  /** Between hold and release the cube stays under the hand whatever the daemon answers, and others keep off. */
  holdGoal(goal: string): void {
    this.model.people.holding = goal;
    this.gesture = newId();
    void this.call("goal.grab", { id: goal }).catch((error: unknown) => !(error instanceof ConnectionLost) && this.complain(error));
  }

  moveGoal(id: string, world: Vec3, gesture = this.gesture): void {
    const goal = this.model.scene.document.goals[id];
    const frame = goal && this.model.goalFrame(goal);
    if (!goal || !frame) return;
    this.model.setLocalTarget(id, world);
    this.edits.set(id, movedTo(goal, frame, world), gesture);
  }

  turnGoal(id: string, world: Quat, gesture = this.gesture): void {
    const goal = this.model.scene.document.goals[id];
    const frame = goal && this.model.goalFrame(goal);
    if (!goal || !frame) return;
    this.model.setLocalTurn(id, world);
    this.edits.set(id, turnedTo(frame, world), gesture);
  }

  releaseGoal(id: string): void {
    this.model.people.holding = null;
    const local = this.model.localTargets.get(id);
    const there = id in this.model.scene.document.goals;
    // Sent once more, so that the reply that ends the echo is surely the last one.
    if (local?.position && there) this.moveGoal(id, local.position);
    else if (local?.turn && there) this.turnGoal(id, local.turn);
    else this.model.endLocalTarget(id, null);
    void this.call("goal.release", { id }).catch(() => {});
  }

  /** `at`: null for goals of the whole figure. */
  async makeGoal(figure: string, at: At | null, payload: Partial<GoalDocument>): Promise<void> {
    const reply = await this.edit<EditReply>("goal.set", { figure, ...(at === null ? {} : { at }), ...payload });
    if (reply?.id) this.model.select(reply.id);
  }

  removeGoal(id: string): void {
    void this.edit("goal.remove", { id });
  }

  bind(id: string, fields: Partial<BindingDocument>): void {
    void this.edit("binding.set", { id, ...fields });
  }

  unbind(id: string): void {
    void this.edit("binding.remove", { id });
  }

  pin(figure: string, segment: string, hold: PinDocument["hold"] | null): void {
    void this.edit("figure.pin", { figure, segment, hold });
  }

  /** All of it or nothing, and one step to undo. */
  apply(label: string, edits: readonly Edit[], gesture?: string): Promise<EditReply | undefined> {
    return this.edit<EditReply>("edit.apply", { label, edits, ...(gesture ? { gesture } : {}) });
  }

  /** All tell the revision of the scene that is now open, or nothing when the daemon refused. */
  async newScene(template: string): Promise<number | undefined> {
    return (await this.edit<EditReply>("scene.new", { template }))?.revision;
  }

  async openScene(name: string): Promise<number | undefined> {
    return (await this.edit<EditReply>("scene.open", { name }))?.revision;
  }

  async saveScene(name: string): Promise<void> {
    if (await this.ask("scene.save", { name })) this.model.say(`Saved as ${name}`, "", true);
    await this.session()?.fetchMenu().catch(() => {});
  }

  undo(step?: number): Promise<void> {
    return this.back("edit.undo", "Undone", step);
  }

  redo(step?: number): Promise<void> {
    return this.back("edit.redo", "Done again", step);
  }

  readJoint(figure: string, joint: string): Promise<JointReply | undefined> {
    return this.call<JointReply>("joint.get", { figure, joint }).catch(() => undefined);
  }

  readPose(figure: string): Promise<{ q: number[]; world_from_segment: number[][] } | undefined> {
    return this.ask("pose.get", { figure });
  }

  /** What is asked of a tracker: no edit, so it neither waits for a lost daemon nor is undone. */
  async tracker<T>(method: string, params: object): Promise<T | undefined> {
    const reply = await this.ask<T>(method, params);
    await this.session()?.fetchTrackers().catch(() => {});
    return reply;
  }

  /** The same without a word where it fails: what keeps a hold alive. */
  keepTracker(tracker: string): void {
    void this.call("tracker.grab", { tracker }).catch(() => {});
  }

  readFigure(figure: string): Promise<FigureReply | undefined> {
    return this.ask("figure.get", { id: figure });
  }

  private async back(method: string, done: string, step: number | undefined): Promise<void> {
    const reply = await this.ask<{ entities?: string[] }>(method, step === undefined ? {} : { step });
    if (reply) this.model.say(`${done}: ${entitiesText(reply.entities ?? [])}`, "", true);
  }

  /** An edit that waits for the daemon where it has to. */
  async edit<T>(method: string, params: object): Promise<T | undefined> {
    try {
      return await this.outbox.edit<T>(method, params);
    } catch (error) {
      this.complain(error);
      return undefined;
    }
  }

  /** A question, or what makes no sense later: refused at once without a connection. */
  private async ask<T>(method: string, params: object): Promise<T | undefined> {
    try {
      return await this.call<T>(method, params);
    } catch (error) {
      this.complain(error);
      return undefined;
    }
  }

  private call<T>(method: string, params: object): Promise<T> {
    const session = this.session();
    return session ? session.rpc.request<T>(method, params) : Promise.reject(new ConnectionLost());
  }

  private complain(error: unknown): void {
    const message = error instanceof Error ? error.message : String(error);
    const hint = error instanceof RpcError ? (error.data.hint ?? "") : "";
    this.model.say(message, hint);
  }
}

/** "/goals/body.right_hand.position" as a person says it. */
export function entitiesText(entities: readonly string[]): string {
  const names = [...new Set(entities.map((path) => {
    const [, map = "", id = "", field = ""] = path.split("/");
    if (map === "figures") return field === "pins" ? `pins of ${id}` : field === "q" ? `pose of ${id}` : id;
    return goalName(id);
  }))];
  return names.length > 3 ? `${names.slice(0, 3).join(", ")} and ${names.length - 3} more` : names.join(", ");
}
