// RateMeter: simulated seconds in one second of the wall, over the last second or so.
const window_ms = 1000;

export class RateMeter {
  private readonly seen: { time: number; wall: number }[] = [];

  // `time` s, simulated; `wall` ms
  add(time: number, wall: number): number {
    this.seen.push({ time, wall });
    while (this.seen.length > 2 && wall - this.seen[0]!.wall > window_ms) this.seen.shift();
    const first = this.seen[0]!;
    return wall > first.wall ? (1e3 * (time - first.time)) / (wall - first.wall) : 0;
  }
}
