// JSON-RPC 2.0 over one text socket: requests with replies, and notifications both ways.
import type { ErrorData } from "./types";

/** What the client needs of a WebSocket; tests put a fake in its place. */
export interface TextSocket {
  send(text: string): void;
  close(): void;
  onopen: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  onclose: (() => void) | null;
}

export class RpcError extends Error {
  constructor(
    message: string,
    readonly number: number,
    readonly data: ErrorData = {},
  ) {
    super(message);
    this.name = "RpcError";
  }
}

/** The socket went away before the reply came; the caller may ask again after the next hello. */
export class ConnectionLost extends Error {
  constructor() {
    super("the connection to the daemon was lost");
    this.name = "ConnectionLost";
  }
}

interface Pending {
  resolve: (result: never) => void;
  reject: (error: Error) => void;
}

interface Message {
  id?: number | string | null;
  method?: string;
  params?: unknown;
  result?: unknown;
  error?: { code: number; message: string; data?: ErrorData };
}

export class Rpc {
  onNotification: (method: string, params: unknown) => void = () => {};
  private nextId = 1;
  private readonly pending = new Map<number, Pending>();
  private closed = false;

  constructor(private readonly socket: TextSocket) {}

  request<T>(method: string, params: object = {}): Promise<T> {
    if (this.closed) return Promise.reject(new ConnectionLost());
    const id = this.nextId++;
    const reply = new Promise<T>((resolve, reject) => this.pending.set(id, { resolve, reject }));
    this.socket.send(JSON.stringify({ jsonrpc: "2.0", id, method, params }));
    return reply;
  }

  notify(method: string, params: object): void {
    if (!this.closed) this.socket.send(JSON.stringify({ jsonrpc: "2.0", method, params }));
  }

  receive(text: string): void {
    const parsed = JSON.parse(text) as Message | Message[];
    for (const message of Array.isArray(parsed) ? parsed : [parsed]) this.take(message);
  }

  /** Every promise that is still open is refused: nobody waits for a dead socket. */
  fail(): void {
    this.closed = true;
    const waiting = [...this.pending.values()];
    this.pending.clear();
    for (const { reject } of waiting) reject(new ConnectionLost());
  }

  private take(message: Message): void {
    if (message.method !== undefined) {
      this.onNotification(message.method, message.params);
      return;
    }
    const waiting = typeof message.id === "number" ? this.pending.get(message.id) : undefined;
    if (!waiting) return;
    this.pending.delete(message.id as number);
    const { error } = message;
    if (error) waiting.reject(new RpcError(error.message, error.code, error.data));
    else waiting.resolve(message.result as never);
  }
}
