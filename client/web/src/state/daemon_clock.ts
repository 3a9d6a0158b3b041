// The daemon's clock as this page's: from pings, of which the quickest is the most exact.
const kKept = 20;

export class DaemonClock {
  private trips: Array<{ tripMs: number; aheadMs: number }> = [];

  /** Times of the page in milliseconds, of the daemon in nanoseconds. */
  heard(sentMs: number, receivedMs: number, daemonReceiveNs: number, daemonSendNs: number): void {
    const inside = (daemonSendNs - daemonReceiveNs) / 1e6;
    const aheadMs = (daemonReceiveNs + daemonSendNs) / 2e6 - (sentMs + receivedMs) / 2;
    this.trips.push({ tripMs: receivedMs - sentMs - inside, aheadMs });
    if (this.trips.length > kKept) this.trips.shift();
  }

  forget(): void {
    this.trips = [];
  }

  /** How old something of the daemon's is now; null before the first ping. */
  ageMs(timeNs: number, nowMs: number): number | null {
    const best = this.trips.reduce<{ tripMs: number; aheadMs: number } | null>((a, b) => (a && a.tripMs <= b.tripMs ? a : b), null);
    return best && Math.max(0, nowMs + best.aheadMs - timeNs / 1e6);
  }
}
