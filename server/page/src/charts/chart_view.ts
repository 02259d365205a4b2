// The part of a chart that is in view, and its scales: what the user made of the data.
import type { ChartData } from "./chart_data";

export interface Range { low: number; high: number }

/** What is undefined is as the data has it. */
export interface ChartView { xLog?: boolean; yLog?: boolean; x?: Range; y?: Range }

const kDecades = 1e-4; // of the greatest value: below it a logarithmic axis of values ends

const least = (values: (number | null)[], above = 0): number =>
  values.reduce<number>((low, value) => (value !== null && value > above && value < low ? value : low), Infinity);

/** The data as they are drawn. On a logarithmic axis, what is not above 0 has no place. */
export function viewOf(data: ChartData, view: ChartView): ChartData {
  const xLog = view.xLog ?? data.xLog ?? false;
  const yLog = (view.yLog ?? data.yLog ?? false) && data.yTop > 0;
  let [xs, ...columns] = data.columns;
  let { xLow = 0, xEnd, yLow = 0, yTop } = data;
  if (xLog && xLow <= 0) {
    xLow = Math.min(least(xs), xEnd / 2);
    columns = columns.map((column) => column.map((value, i) => (xs[i]! > 0 ? value : null)));
    xs = xs.map((x) => Math.max(x!, xLow));
  }
  if (yLog) {
    yLow = Math.min(least(columns.flat(), kDecades * yTop) / 1.2, yTop / 2);
    columns = columns.map((column) => column.map((value) => (value !== null && value > 0 ? value : null)));
  }
  if (view.x) [xLow, xEnd] = [view.x.low, view.x.high];
  if (view.y) [yLow, yTop] = [view.y.low, view.y.high];
  return { ...data, columns: [xs, ...columns], xLog, yLog, xLow, xEnd, yLow, yTop };
}

/** The range within the whole one; undefined if it is all of it. */
export function within(range: Range, whole: Range): Range | undefined {
  const low = Math.max(range.low, whole.low);
  const high = Math.min(range.high, whole.high);
  const isAll = high - low > 0.999 * (whole.high - whole.low);
  return isAll || !(high > low) ? undefined : { low, high };
}
