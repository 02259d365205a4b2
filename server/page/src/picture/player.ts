// The place in a crush that is shown: one value, the strain (or for a frame of beams the time), for picture and curves.
import { Listeners } from "../dom/calls";

export const kRates = [0.1, 0.2, 0.5, 1, 2, 5, 10];
const kSecondsAtOne = 10; // a whole crush at rate 1

/** The place that a URL names, if it is a number. */
export function placeIn(query: URLSearchParams): number | undefined {
  const place = Number.parseFloat(query.get("strain") ?? "");
  return Number.isFinite(place) ? place : undefined;
}

export class Player {
  value = 0;
  /** The last value so far. */
  end = 0;
  /** The value at the end of the whole run. */
  fullEnd = 1;
  playing = false;
  /** Shows the newest frame of a running job. */
  following = false;
  /** Where to be once the crush has come so far, such as the place of a URL; what the user does ends it. */
  wanted: number | undefined;
  rate = 1;
  readonly changes = new Listeners<void>();
  private lastTick = 0;
  private frame = 0;

  /** `isLast`: the end will not move any further. */
  setEnd(end: number, isLast = false): void {
    this.end = end;
    if (this.following) this.value = end;
    if (this.wanted !== undefined) {
      this.following = false;
      this.value = Math.min(Math.max(this.wanted, 0), end);
      if (this.wanted <= end || isLast) this.wanted = undefined;
    }
    this.changes.tell();
  }

  seek(value: number): void {
    this.stopPlaying();
    this.following = false;
    this.wanted = undefined;
    this.value = Math.min(Math.max(value, 0), this.end);
    this.changes.tell();
  }

  follow(): void {
    this.stopPlaying();
    this.following = true;
    this.wanted = undefined;
    this.value = this.end;
    this.changes.tell();
  }

  setRate(rate: number): void {
    this.rate = rate;
    this.changes.tell();
  }

  toggle(): void {
    if (this.playing) {
      this.stopPlaying();
    } else {
      if (this.value >= this.end) this.value = 0;
      this.following = false;
      this.wanted = undefined;
      this.playing = true;
      this.lastTick = performance.now();
      this.frame = requestAnimationFrame(this.tick);
    }
    this.changes.tell();
  }

  private readonly tick = (now: number): void => {
    this.value += (Math.max(0, now - this.lastTick) / 1000) * this.rate * (this.fullEnd / kSecondsAtOne);
    this.lastTick = now;
    if (this.value >= this.end) {
      this.value = this.end;
      this.playing = false;
    } else {
      this.frame = requestAnimationFrame(this.tick);
    }
    this.changes.tell();
  };

  private stopPlaying(): void {
    this.playing = false;
    cancelAnimationFrame(this.frame);
  }

  destroy(): void {
    this.stopPlaying();
  }
}

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
