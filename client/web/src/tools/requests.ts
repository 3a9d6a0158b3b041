// What the user's hands ask of the daemon. Every refusal becomes a toast with the daemon's own hint.
import { ConnectionLost, RpcError } from "../protocol/rpc";
import type { BindingDocument, EditReply, Vec3 } from "../protocol/types";
import type { Session } from "../session";
import type { Model } from "../state/model";
import { GoalEdits, type GoalFields } from "./goal_edits";

export class Requests {
  private readonly edits: GoalEdits;
  private held: string | null = null;

  constructor(
    private readonly model: Model,
    private readonly session: () => Session | null,
  ) {
    this.edits = new GoalEdits((method, params) => this.request(method, params), {
      settled: (goal, revision) => {
        if (goal !== this.held) model.endLocalTarget(goal, revision);
      },
      failed: (error) => this.complain(error),
    });
  }

  setGoal(goal: string, fields: GoalFields): void {
    this.edits.set(goal, fields);
  }

  /** An edit of this goal is on its way: what the document says of it is about to change. */
  busy(goal: string): boolean {
    return this.edits.busy(goal);
  }

  /** Between hold and release the cube stays under the hand whatever the daemon answers. */
  holdGoal(goal: string): void {
    this.held = goal;
  }

  moveGoal(goal: string, position: Vec3): void {
    this.model.setLocalTarget(goal, position);
    this.edits.set(goal, { position });
  }

  releaseGoal(goal: string): void {
    this.held = null;
    const moved = this.model.localTargets.get(goal);
    // Sent once more, so that the reply that ends the echo is surely the last one.
    if (moved && goal in this.model.scene.document.goals) this.edits.set(goal, { position: moved.position });
    else this.model.endLocalTarget(goal, null);
  }

  async makeGoal(figure: string, segment: string, position: Vec3): Promise<void> {
    const reply = await this.tell<EditReply>("goal.set", { figure, at: segment, position });
    if (reply?.id) this.model.select(reply.id);
  }

  removeGoal(id: string): void {
    void this.tell("goal.remove", { id });
  }

  bind(id: string, fields: Partial<BindingDocument>): void {
    void this.tell("binding.set", { id, ...fields });
  }

  unbind(id: string): void {
    void this.tell("binding.remove", { id });
  }

  /** Both tell the revision of the scene that is now open, or nothing when the daemon refused. */
  async newScene(template: string): Promise<number | undefined> {
    return (await this.tell<EditReply>("scene.new", { template }))?.revision;
  }

  async openScene(name: string): Promise<number | undefined> {
    return (await this.tell<EditReply>("scene.open", { name }))?.revision;
  }

  resetPose(to: "rest" | "start"): void {
    for (const figure of this.model.figures.keys()) void this.tell("pose.reset", { figure, to });
  }

  private async tell<T>(method: string, params: object): Promise<T | undefined> {
    try {
      return await this.request<T>(method, params);
    } catch (error) {
      this.complain(error);
      return undefined;
    }
  }

  private request<T>(method: string, params: object): Promise<T> {
    const session = this.session();
    return session ? session.rpc.request<T>(method, params) : Promise.reject(new ConnectionLost());
  }

  private complain(error: unknown): void {
    const message = error instanceof Error ? error.message : String(error);
    const hint = error instanceof RpcError ? (error.data.hint ?? "") : "";
    this.model.say(message, hint);
  }
}
