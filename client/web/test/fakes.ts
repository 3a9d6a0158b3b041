// A socket and a clock that the tests own.
import type { Clock } from "../src/protocol/connection";
import type { TextSocket } from "../src/protocol/rpc";

interface Sent {
  id?: number;
  method: string;
  params: Record<string, unknown>;
}

export class FakeSocket implements TextSocket {
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: (() => void) | null = null;
  readonly sent: Sent[] = [];
  closed = false;

  send(text: string): void {
    this.sent.push(JSON.parse(text) as Sent);
  }

  close(): void {
    this.closed = true;
  }

  say(message: object): void {
    this.onmessage?.({ data: JSON.stringify({ jsonrpc: "2.0", ...message }) });
  }

  /** Answers the newest request of a method. */
  answer(method: string, result: object): void {
    const request = this.sent.findLast((message) => message.method === method && message.id !== undefined);
    this.say({ id: request?.id, result });
  }

  methods(): string[] {
    return this.sent.map(({ method }) => method);
  }
}

export class FakeClock implements Clock {
  private time = 0;
  private timers: Array<{ at: number; run: () => void }> = [];

  now(): number {
    return this.time;
  }

  after(ms: number, run: () => void): () => void {
    const timer = { at: this.time + ms, run };
    this.timers.push(timer);
    return () => (this.timers = this.timers.filter((other) => other !== timer));
  }

  pass(ms: number): void {
    this.time += ms;
    const due = this.timers.filter(({ at }) => at <= this.time);
    this.timers = this.timers.filter(({ at }) => at > this.time);
    for (const { run } of due) run();
  }
}

/** Lets every promise that can settle do so. */
export async function settle(): Promise<void> {
  for (let i = 0; i < 30; i++) await Promise.resolve();
}
