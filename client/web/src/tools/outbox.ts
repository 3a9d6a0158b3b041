// Edits on their way to the daemon. One that the connection was lost over waits here and is sent again: the daemon knows
// each by its `once`, so that none is done twice and none is lost.
import { ConnectionLost, type Rpc } from "../protocol/rpc";
import { newId } from "./new_id";

interface Edit {
  method: string;
  params: object;
  inFlight: boolean;
  resolve: (result: never) => void;
  reject: (error: unknown) => void;
}

export class Outbox {
  private edits: Edit[] = [];

  constructor(
    private readonly rpc: () => Rpc | null,
    private readonly changed: (waiting: number) => void,
  ) {}

  edit<T>(method: string, params: object): Promise<T> {
    return new Promise<T>((resolve, reject) => {
      const edit: Edit = { method, params: { ...params, once: newId() }, inFlight: false, resolve, reject };
      this.edits.push(edit);
      void this.send(edit);
    });
  }

  /** After a hello: what waits goes out in its order. */
  resend(): void {
    for (const edit of [...this.edits]) if (!edit.inFlight) void this.send(edit);
  }

  private async send(edit: Edit): Promise<void> {
    const rpc = this.rpc();
    if (!rpc) return this.tell();
    edit.inFlight = true;
    try {
      const result = await rpc.request<never>(edit.method, edit.params);
      this.edits = this.edits.filter((other) => other !== edit);
      edit.resolve(result);
    } catch (error) {
      edit.inFlight = false;
      if (!(error instanceof ConnectionLost)) {
        this.edits = this.edits.filter((other) => other !== edit);
        edit.reject(error);
      }
    }
    this.tell();
  }

  private tell(): void {
    this.changed(this.edits.filter(({ inFlight }) => !inFlight).length);
  }
}
