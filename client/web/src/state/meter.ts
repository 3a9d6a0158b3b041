// Events per second over the last second, with the clock handed in.
const kWindowMs = 1000;

export class Meter {
  total = 0;
  private times: number[] = [];

  count(nowMs: number): void {
    this.total++;
    this.times.push(nowMs);
    this.forget(nowMs);
  }

  perSecond(nowMs: number): number {
    this.forget(nowMs);
    return (this.times.length * 1000) / kWindowMs;
  }

  private forget(nowMs: number): void {
    const first = this.times.findIndex((time) => time > nowMs - kWindowMs);
    if (first !== 0) this.times.splice(0, first < 0 ? this.times.length : first);
  }
}
