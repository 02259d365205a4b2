// Bands behind the curves of a chart; points, levels, spreads, marked places and all labels over them: as shapes that
// the screen and an SVG file draw alike.
import type uPlot from "uplot";
import { themeColour } from "../picture/colours";
import { markPath, type ChartData } from "./chart_data";

const kPointRadius = 4; // CSS pixels
export const kHalo = 3; // of labels over curves

/** Where a chart is drawn: from values to its pixels, of which `unit` are one CSS pixel. */
export interface Place {
  left: number;
  top: number;
  width: number;
  height: number;
  unit: number;
  x(value: number): number;
  y(value: number): number;
}

/** A path, as the data of an SVG path, or a text; widths in CSS pixels. `colour` names a colour of the style sheet. */
export type Shape = { colour: string } & (
  { path: string; fill?: boolean; width?: number; dash?: number[] } |
  { text: string; x: number; y: number; anchor: "start" | "middle" | "end" });

// The bands that are in view, from left to right.
const bandsIn = ({ bands = [] }: ChartData, { left, width, x }: Place): (readonly [number, number, string])[] =>
  bands.map(({ from, to, label }) => [Math.max(x(from), left), Math.min(x(to), left + width), label] as const)
    .filter(([x0, x1]) => x1 > x0);

export function bandShapes(data: ChartData, place: Place): Shape[] {
  return bandsIn(data, place).map(([x0, x1]) =>
    ({ path: `M${x0},${place.top}H${x1}v${place.height}H${x0}Z`, fill: true, colour: "band" }));
}

export function markShapes(data: ChartData, place: Place): Shape[] {
  const { left, top, width, height, unit, x, y } = place;
  const shapes: Shape[] = [];
  data.series.forEach(({ points, mark, colour }, i) => {
    if (points) data.columns[i + 1].forEach((value, k) => {
      if (value === null) return;
      const path = markPath(mark ?? "circle", kPointRadius * unit, x(data.columns[0][k]!), y(value));
      shapes.push({ path, fill: true, colour });
    });
  });
  for (const { value, from, to, colour, dash } of data.levels ?? []) {
    const at = y(value);
    if (at < top || at > top + height) continue;
    const [x0, x1] = [from === undefined ? left : x(from), to === undefined ? left + width : x(to)];
    shapes.push({ path: `M${x0},${at}H${x1}`, colour, dash, width: 1.4 });
  }
  for (const { x: at, low, high, colour } of data.spreads ?? []) {
    const half = 5 * unit;
    const bar = `M${x(at) - half},${y(low)}h${2 * half}m${-half},0V${y(high)}m${-half},0h${2 * half}`;
    shapes.push({ path: bar, colour, width: 1.5 });
  }
  for (const [x0, x1, text] of bandsIn(data, place)) {
    shapes.push({ text, x: 0.5 * (x0 + x1), y: top + 13 * unit, anchor: "middle", colour: "ink-3" });
  }
  for (const [i, mark] of (data.marks ?? []).entries()) {
    const at = x(mark.at);
    const isRight = at > left + 0.7 * width;
    shapes.push({ path: `M${at},${top}v${height}`, colour: "ink-3", dash: [2, 3] },
                { text: mark.label, x: at + (isRight ? -5 : 5) * unit, y: top + (28 + 15 * i) * unit,
                  anchor: isRight ? "end" : "start", colour: "ink-3" });
  }
  return shapes;
}

/** Draws on the canvas of a plot what a function makes of its data. */
export function drawShapes(plot: uPlot, data: ChartData, shapesOf: typeof bandShapes): void {
  const { ctx, bbox } = plot;
  const unit = devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  const margin = 1.4 * kPointRadius * unit; // points on the edge are whole
  ctx.rect(bbox.left - margin, bbox.top - margin, bbox.width + 2 * margin, bbox.height + 2 * margin);
  ctx.clip();
  const [x, y] = ["x", "y"].map((scale) => (value: number): number => plot.valToPos(value, scale, true));
  for (const shape of shapesOf(data, { ...bbox, unit, x, y })) {
    ctx.fillStyle = ctx.strokeStyle = themeColour(shape.colour);
    if ("text" in shape) {
      ctx.font = `${11 * unit}px ${themeColour("font")}`;
      ctx.textAlign = shape.anchor === "middle" ? "center" : shape.anchor;
      ctx.strokeStyle = themeColour("card");
      ctx.lineWidth = kHalo * unit;
      ctx.lineJoin = "round";
      ctx.setLineDash([]);
      ctx.strokeText(shape.text, shape.x, shape.y);
      ctx.fillText(shape.text, shape.x, shape.y);
    } else if (shape.fill) {
      ctx.fill(new Path2D(shape.path));
    } else {
      ctx.lineWidth = (shape.width ?? 1) * unit;
      ctx.setLineDash((shape.dash ?? []).map((length) => length * unit));
      ctx.stroke(new Path2D(shape.path));
    }
  }
  ctx.restore();
}
