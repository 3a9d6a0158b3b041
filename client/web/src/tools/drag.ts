// What the pointer does while a button is down.
export interface Drag {
  move(x: number, y: number): void;
  end(): void;
}
