// How fast a moving picture is drawn, and what a reader is told when it is slow.

const kShare = 0.15; // of the last interval in the mean
const kSlowMs = 70;

export class Pace {
  private last: number | undefined;
  private mean: number | undefined; // ms between pictures

  /** To be called for each picture of a moving crush, with the time in ms. Empty while it moves smoothly. */
  note(now: number): string {
    if (this.last !== undefined) {
      const interval = now - this.last;
      this.mean = this.mean === undefined ? interval : this.mean + kShare * (interval - this.mean);
    }
    this.last = now;
    if (this.mean === undefined || this.mean < kSlowMs) return "";
    const rate = 1000 / this.mean;
    return `slow drawing: ${rate.toFixed(rate < 2 ? 1 : 0)} per second`;
  }

  stop(): void {
    this.last = this.mean = undefined;
  }
}
