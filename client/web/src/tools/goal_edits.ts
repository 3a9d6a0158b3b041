// Edits of goals on their way to the daemon: at most one in flight for each goal, and the newest wins.
import type { EditReply } from "../protocol/types";
import type { GoalFields } from "../state/goals";

export interface EditEvents {
  /** Nothing of this goal is in flight or waiting any more. Revision is null when the last edit was refused. */
  settled(goal: string, revision: number | null): void;
  failed(error: unknown): void;
}

/** Edits with the same text are one step to undo. */
type Gesture = { gesture?: string };

export class GoalEdits {
  private readonly inFlight = new Set<string>();
  private readonly waiting = new Map<string, GoalFields & Gesture>();

  constructor(
    private readonly request: (method: string, params: object) => Promise<EditReply>,
    private readonly events: EditEvents,
  ) {}

  set(goal: string, fields: GoalFields, gesture?: string): void {
    // Fields of different kinds add up; a newer value of one field replaces the older.
    this.waiting.set(goal, { ...this.waiting.get(goal), ...fields, ...(gesture === undefined ? {} : { gesture }) });
    if (!this.inFlight.has(goal)) void this.send(goal);
  }

  busy(goal: string): boolean {
    return this.inFlight.has(goal);
  }

  private async send(goal: string): Promise<void> {
    this.inFlight.add(goal);
    let revision: number | null = null;
    for (let fields = this.take(goal); fields; fields = this.take(goal)) {
      try {
        revision = (await this.request("goal.set", { id: goal, ...fields })).revision;
      } catch (error) {
        revision = null;
        this.events.failed(error);
      }
    }
    this.inFlight.delete(goal);
    this.events.settled(goal, revision);
  }

  private take(goal: string): (GoalFields & Gesture) | undefined {
    const fields = this.waiting.get(goal);
    this.waiting.delete(goal);
    return fields;
  }
}
