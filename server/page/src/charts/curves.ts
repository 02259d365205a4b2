// The curves of a job from its samples, as columns.
import type { Sample } from "../../gen/cellcrush/v1/sample_pb";

/** What the curves of a job run over: strain, or for a frame of beams, whose strain is always 0, the time. */
export interface Axis {
  label: string;
  end: number;
  sample(sample: Sample): number;
  frame(frame: { strain: number; timeS: number }): number;
  text(value: number): string;
}

/** The default end of a crush. */
export const kEndStrain = 0.8;

export function strainAxis(end: number): Axis {
  return {
    label: "nominal strain", end,
    sample: (sample) => sample.strain,
    frame: (frame) => frame.strain,
    text: (value) => `strain ${value.toFixed(3)}`,
  };
}

export function timeAxis(endSeconds: number): Axis {
  return {
    label: "time (ms)", end: 1e3 * endSeconds,
    sample: (sample) => 1e3 * sample.timeS,
    frame: (frame) => 1e3 * frame.timeS,
    text: (value) => `${value.toPrecision(3)} ms`,
  };
}

/** The samples with finite values, in the order of the axis. */
export function finite(samples: Sample[], axis: Axis): Sample[] {
  return samples.filter((s) =>
    Number.isFinite(axis.sample(s) + s.stressImpactMpa + s.stressSupportMpa + s.workExternalMj));
}

/** Mean of `y` over all points within half of `window` of each x. x ascends. */
export function runningMean(x: number[], y: number[], window: number): number[] {
  const sums = new Float64Array(y.length + 1);
  for (let i = 0; i < y.length; ++i) sums[i + 1] = sums[i] + y[i];
  const means = new Array<number>(y.length);
  let begin = 0;
  let end = 0;
  for (let i = 0; i < y.length; ++i) {
    while (x[begin] < x[i] - 0.5 * window) ++begin;
    while (end < x.length && x[end] <= x[i] + 0.5 * window) ++end;
    means[i] = (sums[end] - sums[begin]) / (end - begin);
  }
  return means;
}

export function quantile(values: number[], share: number): number {
  if (values.length === 0) return 0;
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.floor(share * (sorted.length - 1))];
}

/** Index of the last item whose x, in ascending order, is at or before a value; 0 if there is none. */
export function indexBefore<T>(items: T[], value: number, xOf: (item: T) => number = Number): number {
  let low = 0;
  let high = items.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (xOf(items[middle]) <= value) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Indices of at most about `most` points, with the least and the greatest y of each run of points. */
export function thin(y: number[], most: number): number[] {
  if (y.length <= most) return [...y.keys()];
  const size = Math.ceil((2 * y.length) / most);
  const kept: number[] = [];
  for (let start = 0; start < y.length; start += size) {
    const stop = Math.min(start + size, y.length);
    let low = start;
    let high = start;
    for (let i = start; i < stop; ++i) {
      if (y[i] < y[low]) low = i;
      if (y[i] > y[high]) high = i;
    }
    if (low === high) kept.push(low);
    else kept.push(Math.min(low, high), Math.max(low, high));
  }
  return kept;
}

/** The round numbers from low to high, at most `most`: 1, 2 or 5 times a power of ten apart, as in the command line. */
export function ticksOf(low: number, high: number, most: number): number[] {
  if (!(high > low)) return [];
  const kSlack = 1e-9;
  for (let power = 10 ** Math.floor(Math.log10((high - low) / most)); ; power *= 10) {
    for (const step of [power, 2 * power, 5 * power]) {
      const first = Math.ceil(low / step - kSlack);
      const count = Math.floor(high / step + kSlack) - first + 1;
      if (count <= most) return Array.from({ length: count }, (_, i) => Number(((first + i) * step).toPrecision(12)));
    }
  }
}
