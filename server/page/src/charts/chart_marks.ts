// Bands behind the curves of a chart; levels, spreads and marked places over them.
import type uPlot from "uplot";
import { themeColour } from "../picture/colours";
import type { ChartData, Level, Mark, Series, Spread } from "./chart_data";
import { markPath } from "./mark_shapes";

const kPointRadius = 4; // CSS pixels

function label(plot: uPlot, text: string, x: number, y: number, align: CanvasTextAlign): void {
  const { ctx } = plot;
  ctx.font = `${11 * devicePixelRatio}px ${themeColour("font")}`;
  ctx.fillStyle = themeColour("ink-3");
  ctx.textAlign = align;
  ctx.fillText(text, x, y);
}

export function drawBands(plot: uPlot, data: ChartData): void {
  const { ctx, bbox } = plot;
  for (const band of data.bands ?? []) {
    const x0 = Math.max(plot.valToPos(band.from, "x", true), bbox.left);
    const x1 = Math.min(plot.valToPos(band.to, "x", true), bbox.left + bbox.width);
    if (x1 <= x0) continue;
    ctx.fillStyle = themeColour("band");
    ctx.fillRect(x0, bbox.top, x1 - x0, bbox.height);
    label(plot, band.label, 0.5 * (x0 + x1), bbox.top + 13 * devicePixelRatio, "center");
  }
}

function drawLevel(plot: uPlot, level: Level): void {
  const { ctx, bbox } = plot;
  const y = plot.valToPos(level.value, "y", true);
  if (y < bbox.top || y > bbox.top + bbox.height) return;
  ctx.strokeStyle = themeColour(level.colour);
  ctx.lineWidth = 1.4 * devicePixelRatio;
  ctx.setLineDash(level.dash.map((length) => length * devicePixelRatio));
  ctx.beginPath();
  ctx.moveTo(level.from === undefined ? bbox.left : plot.valToPos(level.from, "x", true), y);
  ctx.lineTo(level.to === undefined ? bbox.left + bbox.width : plot.valToPos(level.to, "x", true), y);
  ctx.stroke();
}

function drawSpread(plot: uPlot, spread: Spread): void {
  const { ctx } = plot;
  const [x, y0, y1] = [plot.valToPos(spread.x, "x", true), plot.valToPos(spread.low, "y", true),
                       plot.valToPos(spread.high, "y", true)];
  const half = 5 * devicePixelRatio;
  ctx.strokeStyle = themeColour(spread.colour);
  ctx.lineWidth = 1.5 * devicePixelRatio;
  ctx.setLineDash([]);
  ctx.beginPath();
  for (const y of [y0, y1]) {
    ctx.moveTo(x - half, y);
    ctx.lineTo(x + half, y);
  }
  ctx.moveTo(x, y0);
  ctx.lineTo(x, y1);
  ctx.stroke();
}

function drawMark(plot: uPlot, mark: Mark): void {
  const { ctx, bbox } = plot;
  const x = plot.valToPos(mark.at, "x", true);
  ctx.strokeStyle = themeColour("ink-3");
  ctx.setLineDash([2 * devicePixelRatio, 3 * devicePixelRatio]);
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  const isRight = x > bbox.left + 0.7 * bbox.width;
  label(plot, mark.label, x + (isRight ? -5 : 5) * devicePixelRatio, bbox.top + 28 * devicePixelRatio,
        isRight ? "right" : "left");
}

function drawPoints(plot: uPlot, series: Series, xs: number[], column: (number | null)[]): void {
  const { ctx } = plot;
  const mark = new Path2D(markPath(series.mark ?? "circle", kPointRadius * devicePixelRatio));
  ctx.fillStyle = themeColour(series.colour);
  column.forEach((value, i) => {
    if (value === null) return;
    ctx.save();
    ctx.translate(plot.valToPos(xs[i], "x", true), plot.valToPos(value, "y", true));
    ctx.fill(mark);
    ctx.restore();
  });
}

export function drawMarks(plot: uPlot, data: ChartData): void {
  plot.ctx.save();
  data.series.forEach((series, i) => {
    if (series.points) drawPoints(plot, series, data.columns[0] as number[], data.columns[i + 1]);
  });
  for (const level of data.levels ?? []) drawLevel(plot, level);
  for (const spread of data.spreads ?? []) drawSpread(plot, spread);
  for (const mark of data.marks ?? []) drawMark(plot, mark);
  plot.ctx.restore();
}
