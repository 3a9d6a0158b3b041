// Keeps one socket to the daemon: opens it, and opens it again with growing pauses when it is lost.
import { Rpc, type TextSocket } from "./rpc";

export type ConnectionState =
  | { phase: "connecting" }
  | { phase: "connected" }
  | { phase: "lost"; retryAtMs: number };

/** The clock and timers are handed in, so that tests own time. */
export interface Clock {
  now(): number;
  after(ms: number, run: () => void): () => void;
}

export const browserClock: Clock = {
  now: () => performance.now(),
  after(ms, run) {
    const timer = setTimeout(run, ms);
    return () => clearTimeout(timer);
  },
};

const kFirstPauseMs = 500;
const kLongestPauseMs = 10_000;
const kGreetingMs = 15_000;

export interface ConnectionEvents {
  /** The socket is open: say hello. The connection counts as good once this resolves. */
  opened(rpc: Rpc): Promise<void>;
  changed(state: ConnectionState): void;
}

export class Connection {
  private pauseMs = kFirstPauseMs;
  private socket: TextSocket | null = null;
  private cancelRetry: () => void = () => {};

  constructor(
    private readonly open: () => TextSocket,
    private readonly events: ConnectionEvents,
    private readonly clock: Clock = browserClock,
  ) {}

  /** Also serves as "try now" while a retry is waiting. */
  connect(): void {
    this.cancelRetry();
    this.drop();
    this.events.changed({ phase: "connecting" });
    const socket = this.open();
    const rpc = new Rpc(socket);
    this.socket = socket;
    socket.onopen = () => void this.greet(socket, rpc);
    socket.onmessage = (event) => rpc.receive(String(event.data));
    socket.onclose = () => {
      rpc.fail();
      if (this.socket === socket) this.retryLater();
    };
  }

  /** For a socket that looks open but answers nothing. */
  giveUpOnSocket(): void {
    const socket = this.socket;
    if (!socket) return;
    this.socket = null;
    socket.close();
    socket.onclose?.();
    this.retryLater();
  }

  private async greet(socket: TextSocket, rpc: Rpc): Promise<void> {
    const cancel = this.clock.after(kGreetingMs, () => {
      if (this.socket === socket) this.giveUpOnSocket();
    });
    try {
      await this.events.opened(rpc);
      if (this.socket !== socket) return;
      // Only a daemon that answers resets the pause: one that accepts and dies must not be hammered.
      this.pauseMs = kFirstPauseMs;
      this.events.changed({ phase: "connected" });
    } catch {
      if (this.socket === socket) this.giveUpOnSocket();
    } finally {
      cancel();
    }
  }

  private retryLater(): void {
    this.socket = null;
    const pause = this.pauseMs;
    this.pauseMs = Math.min(pause * 2, kLongestPauseMs);
    this.events.changed({ phase: "lost", retryAtMs: this.clock.now() + pause });
    this.cancelRetry = this.clock.after(pause, () => this.connect());
  }

  private drop(): void {
    const socket = this.socket;
    this.socket = null;
    socket?.close();
  }
}
