// Edits of goals on their way to the daemon: the newest of a goal wins, and only some are under way. Where nothing is, an
// edit goes at once; over a long line others follow it before it is answered, spaced, so that a figure follows a drag there too.
import { browserClock, type Clock } from "../protocol/connection";
import type { EditReply } from "../protocol/types";
import type { GoalFields } from "../state/goals";

export interface EditEvents {
  /** Nothing of this goal is in flight or waiting any more. Revision is null when the last edit was refused. */
  settled(goal: string, revision: number | null): void;
  failed(error: unknown): void;
}

/** Edits with the same text are one step to undo. */
type Gesture = { gesture?: string };

const kMostInFlight = 8;
const kSpacingMs = 30;

interface Line {
  inFlight: number;
  waiting: (GoalFields & Gesture) | null;
  sentMs: number;
  /** Of the edit that was sent last; null: refused, or not answered yet. */
  revision: number | null;
  cancel: () => void;
}

export class GoalEdits {
  private readonly lines = new Map<string, Line>();

  constructor(
    private readonly request: (method: string, params: object) => Promise<EditReply>,
    private readonly events: EditEvents,
    private readonly clock: Clock = browserClock,
  ) {}

  set(goal: string, fields: GoalFields, gesture?: string): void {
    const line = this.lines.get(goal) ?? { inFlight: 0, waiting: null, sentMs: -Infinity, revision: null, cancel: () => {} };
    this.lines.set(goal, line);
    // Fields of different kinds add up; a newer value of one field replaces the older.
    line.waiting = { ...line.waiting, ...fields, ...(gesture === undefined ? {} : { gesture }) };
    this.pump(goal, line);
  }

  busy(goal: string): boolean {
    return this.lines.has(goal);
  }

  private pump(goal: string, line: Line): void {
    if (!line.waiting || line.inFlight >= kMostInFlight) return;
    const pause = line.inFlight === 0 ? 0 : line.sentMs + kSpacingMs - this.clock.now();
    line.cancel();
    if (pause > 0) line.cancel = this.clock.after(pause, () => this.pump(goal, line));
    else void this.send(goal, line, line.waiting);
  }

  private async send(goal: string, line: Line, fields: GoalFields & Gesture): Promise<void> {
    line.waiting = null;
    line.sentMs = this.clock.now();
    line.inFlight++;
    try {
      // Replies come in the order of the edits.
      line.revision = (await this.request("goal.set", { id: goal, ...fields })).revision;
    } catch (error) {
      line.revision = null;
      this.events.failed(error);
    }
    line.inFlight--;
    this.pump(goal, line);
    if (line.inFlight > 0 || line.waiting) return;
    this.lines.delete(goal);
    this.events.settled(goal, line.revision);
  }
}
