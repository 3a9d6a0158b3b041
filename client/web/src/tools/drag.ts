// What the pointer does while a button is down.
export interface Drag {
  /** `snap`: the key that snaps, or that lets go where snapping is on. */
  move(x: number, y: number, snap: boolean): void;
  end(): void;
}
