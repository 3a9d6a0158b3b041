// Who else is in the scene, what they hold, and what they have just edited.
import type { PatchOperation, SessionInfo } from "../protocol/types";

const kActiveMs = 2500;
const kMostGoals = 2;

interface Touch {
  session: string;
  untilMs: number;
}

export class People {
  me = "";
  sessions: SessionInfo[] = [];
  /** The goal that is in this page's own hand. */
  holding: string | null = null;
  /** By goal, as the daemon says it: a name. */
  private holds = new Map<string, string>();
  private touched = new Map<string, Touch>();

  get others(): SessionInfo[] {
    return this.sessions.filter(({ session, user, client }) => session !== this.me && (user || client?.name));
  }

  /** What people call a session. */
  nameOf(session: string): string {
    const found = this.sessions.find((other) => other.session === session);
    return found?.user || session;
  }

  setHolds(holds: ReadonlyMap<string, string>): void {
    this.holds = new Map(holds);
  }

  /** Who else. */
  holder(goal: string): string | undefined {
    return goal === this.holding ? undefined : this.holds.get(goal);
  }

  /** Notes an edit of others; true where it was one. */
  edited(by: string | undefined, patch: readonly PatchOperation[], nowMs: number): boolean {
    if (by === undefined || by === this.me || by === "") return false;
    const goals = new Set(patch.flatMap(({ path }) => (/^\/goals\/[^/]+/.test(path) ? [path.split("/")[2] as string] : [])));
    // A hand edits one thing or two; a whole scene that changes is no news of each of its goals.
    if (goals.size <= kMostGoals) for (const id of goals) this.touched.set(id, { session: by, untilMs: nowMs + kActiveMs });
    return true;
  }

  /** Who has just edited this goal. */
  editing(goal: string, nowMs: number): string | undefined {
    const touch = this.touched.get(goal);
    if (!touch || touch.untilMs < nowMs) return undefined;
    return this.nameOf(touch.session);
  }

  quiet(nowMs: number): boolean {
    for (const [goal, { untilMs }] of this.touched) if (untilMs < nowMs) this.touched.delete(goal);
    return this.touched.size === 0;
  }
}
