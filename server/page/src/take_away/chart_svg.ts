// A chart as an SVG file for a paper: black on white, in the colours of the light theme.
import { legendOf, markPath, type ChartData, type Series } from "../charts/chart_data";
import { bandShapes, kHalo, markShapes, type Place, type Shape } from "../charts/chart_marks";
import { ticksOf } from "../charts/curves";
import { themeColour } from "../picture/colours";
import { svg } from "../dom/element";

const kWidth = 720;
const kPlot = { left: 64, top: 40, width: 630, height: 330 };
const kFont = { "font-family": "sans-serif", "font-size": 12, fill: "#222" };

const kPowers = Array.from({ length: 25 }, (_, i) => i - 12);

function axisTicks(low: number, high: number, isLog: boolean | undefined, most: number): number[] {
  if (!isLog) return ticksOf(low, high, most);
  const steps = high / low > 1e3 ? [1] : [1, 2, 5];
  return kPowers.flatMap((power) => steps.map((step) => Number(`${step}e${power}`)))
    .filter((value) => value >= low && value <= high);
}

function curve(data: ChartData, series: Series, column: (number | null)[], { x, y }: Place): SVGElement {
  const colour = themeColour(series.colour);
  const xs = data.columns[0] as number[];
  const points = xs.map((value, i) => [value, column[i]] as const).filter(([, value]) => value !== null)
    .map(([px, py]) => `${x(px).toFixed(2)},${y(py as number).toFixed(2)}`);
  const line = `M${points.join("L")}`;
  if (series.fill) {
    const ends = points.length ? `L${x(xs[xs.length - 1]).toFixed(2)},${y(0)}L${x(xs[0]).toFixed(2)},${y(0)}Z` : "";
    return svg("path", { d: line + ends, fill: colour });
  }
  return svg("path", {
    d: line, fill: "none", stroke: colour, "stroke-width": series.width ?? 1.5, "stroke-linejoin": "round",
    "stroke-dasharray": series.dash?.join(" "), opacity: series.opacity,
  });
}

function frame(data: ChartData, { x, y }: Place): SVGElement[] {
  const { left, top, width, height } = kPlot;
  const bottom = top + height;
  const parts: SVGElement[] = [svg("rect", { x: left, y: top, width, height, fill: "none", stroke: "#222" })];
  for (const tick of axisTicks(data.xLow ?? 0, data.xEnd, data.xLog, 8)) {
    parts.push(svg("path", { d: `M${x(tick)},${bottom}v5`, stroke: "#222" }),
               svg("text", { x: x(tick), y: bottom + 19, "text-anchor": "middle", ...kFont }, tick));
  }
  for (const tick of axisTicks(data.yLow ?? 0, data.yTop, data.yLog, 6)) {
    parts.push(svg("path", { d: `M${left},${y(tick)}h-5`, stroke: "#222" }),
               svg("text", { x: left - 9, y: y(tick) + 4, "text-anchor": "end", ...kFont }, tick));
  }
  parts.push(svg("text", { x: left + width / 2, y: bottom + 38, "text-anchor": "middle", ...kFont }, data.xLabel));
  parts.push(svg("text", { transform: `translate(16 ${top + height / 2}) rotate(-90)`, "text-anchor": "middle",
                           ...kFont }, data.yLabel));
  return parts;
}

// On paper, texts and lines that are no curves are grey.
const kPaper: Record<string, string> = { band: "#f0ede4", ink: "#444", "ink-2": "#444", "ink-3": "#777" };

function drawn(shape: Shape): SVGElement {
  const colour = kPaper[shape.colour] ?? themeColour(shape.colour);
  if ("text" in shape) {
    return svg("text", { x: shape.x, y: shape.y, "text-anchor": shape.anchor, ...kFont, fill: colour, stroke: "#fff",
                         "stroke-width": kHalo, "paint-order": "stroke" }, shape.text);
  }
  const { path, fill, width, dash } = shape;
  return svg("path", fill ? { d: path, fill: colour } : {
    d: path, fill: "none", stroke: colour, "stroke-width": width ?? 1, "stroke-dasharray": dash?.join(" ") || undefined,
  });
}

const kThick = { area: 9, line: 2.5, level: 1.5 };

function legend(data: ChartData, top: number): SVGElement[] {
  return legendOf(data).flatMap(({ label, colour: name, dash, mark, kind }, i) => {
    const x = kPlot.left + (i % 2) * 330;
    const y = top + 20 * Math.floor(i / 2);
    const colour = kind === "level" ? "#444" : themeColour(name);
    const sign = mark ? svg("path", { d: markPath(mark, 4), fill: colour, transform: `translate(${x + 15},${y})` })
      : svg("path", { d: `M${x},${y}h30`, stroke: colour, "stroke-width": kThick[kind],
                      "stroke-dasharray": dash?.join(" ") || undefined });
    return [sign, svg("text", { x: x + 38, y: y + 4, ...kFont }, label)];
  });
}

export function chartSvg(data: ChartData, title: string): Blob {
  const { left, top, width, height } = kPlot;
  const share = (value: number, low: number, high: number, isLog?: boolean): number =>
    (isLog ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
  const place: Place = {
    ...kPlot, unit: 1,
    x: (value) => left + width * share(value, data.xLow ?? 0, data.xEnd, data.xLog),
    y: (value) => top + height * (1 - share(value, data.yLow ?? 0, data.yTop, data.yLog)),
  };
  const bottom = top + height + 62;
  const legendEntries = legend(data, bottom);
  const total = bottom + 10 * Math.ceil(legendEntries.length / 2) + 12;
  const picture = svg("svg", { xmlns: "http://www.w3.org/2000/svg", viewBox: `0 0 ${kWidth} ${total}`,
                               width: kWidth, height: total },
    svg("rect", { width: kWidth, height: total, fill: "#fff" }),
    svg("text", { x: left, y: 24, ...kFont, "font-size": 15, "font-weight": 600 }, title),
    svg("clipPath", { id: "plot" }, svg("rect", { x: left, y: top, width, height })),
    svg("g", { "clip-path": "url(#plot)" }, ...bandShapes(data, place).map(drawn),
        ...data.series.map((series, i) => !series.points && curve(data, series, data.columns[i + 1], place)),
        ...markShapes(data, place).map(drawn)),
    ...frame(data, place), ...legendEntries);
  return new Blob([new XMLSerializer().serializeToString(picture)], { type: "image/svg+xml" });
}
