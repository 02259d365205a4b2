// What a chart shows: curves as columns, and marks behind and over them.
export type MarkShape = "circle" | "square" | "triangle" | "diamond" | "cross" | "wedge";

/** In the order in which curves take them. */
export const kMarkShapes: MarkShape[] = ["circle", "square", "triangle", "diamond", "cross", "wedge"];

const kUnit: Record<MarkShape, [number, number][]> = {
  circle: [],
  square: [[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]],
  triangle: [[0, -1.2], [1.1, 0.75], [-1.1, 0.75]],
  diamond: [[0, -1.3], [1.1, 0], [0, 1.3], [-1.1, 0]],
  cross: [[-0.35, -1.1], [0.35, -1.1], [0.35, -0.35], [1.1, -0.35], [1.1, 0.35], [0.35, 0.35], [0.35, 1.1],
          [-0.35, 1.1], [-0.35, 0.35], [-1.1, 0.35], [-1.1, -0.35], [-0.35, -0.35]],
  wedge: [[0, 1.2], [1.1, -0.75], [-1.1, -0.75]],
};

/** Outline of a mark about a point, as the data of an SVG path. */
export function markPath(shape: MarkShape, radius: number, x = 0, y = 0): string {
  if (shape === "circle") {
    const half = (to: number): string => `a${radius},${radius} 0 1 0 ${to},0`;
    return `M${x - radius},${y}${half(2 * radius)}${half(-2 * radius)}Z`;
  }
  const corner = ([dx, dy]: [number, number]): string =>
    `${(x + radius * dx).toFixed(2)},${(y + radius * dy).toFixed(2)}`;
  return `M${kUnit[shape].map(corner).join("L")}Z`;
}

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
  /** The jobs of each point, by name. */
  jobs?: string[][];
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
  yLog?: boolean;
  note?: string;
}

/** What a legend has: curves, then levels, which have no value at a place. */
export const legendOf = ({ series, levels = [] }: ChartData) => [
  ...series.filter(({ quiet }) => !quiet).map(({ label, colour, dash, fill, points, mark = "circle" }) =>
    ({ label, colour, dash, kind: fill ? "area" as const : "line" as const, mark: points ? mark : undefined })),
  ...levels.filter(({ label }) => label).map(({ label, colour, dash }) =>
    ({ label, colour, dash, kind: "level" as const, mark: undefined })),
];
