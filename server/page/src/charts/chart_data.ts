// What a chart shows: curves as columns, and marks behind and over them.
import type { MarkShape } from "./mark_shapes";

export interface Series {
  label: string;
  /** Name of a colour variable of the style sheet. */
  colour: string;
  width?: number;
  dash?: number[];
  /** Filled down to 0. */
  fill?: boolean;
  opacity?: number;
  points?: boolean;
  /** Shape of the points. Default a circle. */
  mark?: MarkShape;
  /** Left out of the legend. */
  quiet?: boolean;
  /** The value of the legend, if it is not that of the curve. */
  legendValue?: (index: number) => number | undefined;
}

/** A line across the chart at a level, or a shaded band. */
export interface Level { value: number; colour: string; dash: number[]; label: string; from?: number; to?: number }
export interface Band { from: number; to: number; label: string }
export interface Mark { at: number; label: string }
/** A vertical bar from low to high, for the spread of a mean. */
export interface Spread { x: number; low: number; high: number; colour: string }

export interface ChartData {
  series: Series[];
  /** x, then the values of each series. */
  columns: (number | null)[][];
  xLabel: string;
  yLabel: string;
  xEnd: number;
  yLow?: number;
  yTop: number;
  levels?: Level[];
  bands?: Band[];
  marks?: Mark[];
  spreads?: Spread[];
  xLow?: number;
  xLog?: boolean;
  note?: string;
}
