// Subscriptions of one connection: routes frames to their readers and acknowledges what was drawn.
import type { Rpc } from "./rpc";
import type { StreamName } from "./types";

export interface StreamReader {
  frame(data: unknown): void;
  lost(dropped: number): void;
}

interface Subscription {
  reader: StreamReader;
  credit: boolean;
  newestSeq: number;
  ackedSeq: number;
}

export class Streams {
  private readonly subscriptions = new Map<StreamName, Subscription>();

  constructor(private readonly rpc: Rpc) {
    rpc.onNotification = (method, params) => this.route(method, params);
  }

  async subscribe(
    params: { stream: StreamName; credit?: number; max_rate_hz?: number; fields?: string[] },
    reader: StreamReader,
  ): Promise<void> {
    // The present state may arrive before the reply does, so the reader stands ready first.
    this.subscriptions.set(params.stream, {
      reader,
      credit: params.credit !== undefined,
      newestSeq: -1,
      ackedSeq: -1,
    });
    await this.rpc.request("stream.subscribe", params);
  }

  /** Called after drawing: a hidden page draws nothing, acks nothing, and wakes to the newest pose. */
  ackDrawn(): void {
    for (const [stream, subscription] of this.subscriptions) {
      if (!subscription.credit || subscription.newestSeq === subscription.ackedSeq) continue;
      subscription.ackedSeq = subscription.newestSeq;
      this.rpc.notify("stream.ack", { stream, seq: subscription.newestSeq });
    }
  }

  private route(method: string, params: unknown): void {
    const { stream, seq, data, dropped } = params as {
      stream: StreamName;
      seq?: number;
      data?: unknown;
      dropped?: number;
    };
    const subscription = this.subscriptions.get(stream);
    if (!subscription) return;
    if (method === "stream.frame") {
      // The newest, not the greatest: a subscription made anew may count from the start again.
      subscription.newestSeq = seq ?? -1;
      subscription.reader.frame(data);
    } else if (method === "stream.lost") {
      subscription.reader.lost(dropped ?? 0);
    }
  }
}
