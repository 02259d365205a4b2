// Curves for the screen: moving means, and fewer points without losing peaks.

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

/** Index of the last x at or before a value; 0 if there is none. */
export function indexBefore(x: ArrayLike<number>, value: number): number {
  let low = 0;
  let high = x.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (x[middle] <= value) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Indices of at most about `most` points, with the least and the greatest y of each run of points. */
export function thin(y: number[], most: number): number[] | undefined {
  if (y.length <= most) return undefined;
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
