// Objects that sensors lead: where the pose stream has them.
import type { PoseFrame, Transform } from "../protocol/types";

export class Led {
  private now = new Map<string, Transform>();
  /** Let go since: the document has their new place only when the disk has it. */
  private before = new Map<string, Transform>();
  private revision = -1;

  take(frame: PoseFrame, sceneRevision: number): void {
    this.before = new Map(sceneRevision < frame.revision ? [...this.before, ...this.now] : []);
    this.now = new Map(frame.objects?.map(({ object, world_from_object }) => [object, world_from_object]));
    this.revision = frame.revision;
  }

  transform(id: string, sceneRevision: number): Transform | undefined {
    return this.now.get(id) ?? (sceneRevision < this.revision ? this.before.get(id) : undefined);
  }
}
