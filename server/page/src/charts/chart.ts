// A chart: uPlot in the colours of the page, with a playhead that picture and charts share, and a legend with the
// values there.
import uPlot from "uplot";
import { h, replaceChildren, setText, svg } from "../dom/element";
import { number } from "../dom/format";
import { themeColour } from "../picture/colours";
import { onThemeChange } from "../dom/preferences";
import { legendOf, markPath, type ChartData, type MarkShape, type Series } from "./chart_data";
import { bandShapes, drawShapes, markShapes } from "./chart_marks";
import { indexBefore } from "./curves";

const kFont = "11px ";

/** A mark in the colour `--colour`, for legends. */
function markSwatch(shape: MarkShape): SVGElement {
  return svg("svg", { viewBox: "-7 -7 14 14", class: "mark", "aria-hidden": "true" },
    svg("path", { d: markPath(shape, 5) }));
}

export class Chart {
  readonly element: HTMLElement;
  private readonly place = h("div", { class: "plot" });
  private readonly legend = h("div", { class: "legend" });
  private readonly note = h("p", { class: "note faint" });
  private readonly playhead = h("div", { class: "playhead", hidden: true });
  private readonly ignoreTheme = onThemeChange(() => this.rebuild());
  private readonly observer = new ResizeObserver(() => this.resize());
  private plot: uPlot | undefined;
  data: ChartData | undefined;
  private values: HTMLElement[] = [];
  private head: number | undefined;
  private hoverIndex: number | null = null;

  /** `scrub` is called with the x that the user points at with a button down. */
  constructor(title: string, private readonly scrub?: (x: number) => void) {
    this.element = h("figure", { class: "chart" },
      h("figcaption", {}, h("h3", {}, title)), this.legend, this.place, this.note);
    this.observer.observe(this.place);
  }

  setTitle(title: string): void {
    setText(this.element.querySelector("h3")!, title);
  }

  /** Adds what saves or changes the chart, beside its title. */
  addTools(...tools: HTMLElement[]): void {
    this.element.querySelector("figcaption")!.append(h("span", { class: "take-away" }, ...tools));
  }

  private rebuild(): void {
    this.plot?.destroy();
    this.plot = undefined;
    this.build();
  }

  setData(data: ChartData): void {
    const key = (d: ChartData | undefined): string =>
      d ? JSON.stringify([d.series, d.xLog, d.xLabel, d.yLabel, d.levels?.map((level) => level.label)]) : "";
    const isSame = this.plot && key(this.data) === key(data);
    this.data = data;
    setText(this.note, data.note ?? "");
    if (!isSame) return this.rebuild();
    this.plot!.setData(data.columns as uPlot.AlignedData, false);
    this.plot!.setScale("y", { min: data.yLow ?? 0, max: data.yTop });
    this.plot!.setScale("x", { min: data.xLow ?? 0, max: data.xEnd });
    this.moveHead();
    this.showValues();
  }

  /** Moves the playhead. */
  setHead(x: number): void {
    this.head = x;
    this.moveHead();
    if (this.hoverIndex === null) this.showValues();
  }

  private moveHead(): void {
    const { plot, head } = this;
    this.playhead.hidden = !plot || head === undefined;
    if (plot && head !== undefined) {
      this.playhead.style.transform = `translateX(${plot.valToPos(head, "x").toFixed(1)}px)`;
    }
  }

  private resize(): void {
    const width = this.place.clientWidth;
    const height = this.place.clientHeight;
    if (!width || !height) return;
    if (!this.plot) return this.build();
    if (this.plot.width !== width || this.plot.height !== height) this.plot.setSize({ width, height });
    this.moveHead();
  }

  private build(): void {
    const { data, place } = this;
    if (!data || !place.clientWidth) return;
    const axis = (label: string, size: number): uPlot.Axis => ({
      label, size, labelSize: 18, labelGap: 0, gap: 4, font: kFont + themeColour("font"),
      labelFont: kFont + themeColour("font"),
      stroke: () => themeColour("ink-2"),
      grid: { stroke: themeColour("grid"), width: 1 },
      ticks: { stroke: themeColour("grid"), width: 1, size: 4 },
    });
    this.plot = new uPlot({
      width: place.clientWidth,
      height: place.clientHeight,
      padding: [8, 10, 0, 0],
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, points: { size: 6 }, y: false },
      scales: {
        x: { time: false, distr: data.xLog ? 3 : 1, range: () => [this.data!.xLow ?? 0, this.data!.xEnd] },
        y: { range: () => [this.data!.yLow ?? 0, this.data!.yTop] },
      },
      axes: [{ ...axis(data.xLabel, 30), values: (_, ticks) => ticks.map((tick) => String(tick ?? "")) },
             { ...axis(data.yLabel, 42), values: (_, ticks) => ticks.map(String) }],
      series: [{}, ...data.series.map((series) => this.seriesOf(series))],
      hooks: {
        drawClear: [(plot) => drawShapes(plot, this.data!, bandShapes)],
        draw: [(plot) => drawShapes(plot, this.data!, markShapes), () => this.moveHead()], // scales are known by now
        setCursor: [(plot) => {
          this.hoverIndex = plot.cursor.idx ?? null;
          this.showValues();
        }],
      },
    }, data.columns as uPlot.AlignedData, place);
    this.plot.over.append(this.playhead);
    this.addScrubbing(this.plot);
    this.buildLegend(data);
    this.moveHead();
    this.showValues();
  }

  private seriesOf(series: Series): uPlot.Series {
    const colour = themeColour(series.colour);
    return {
      stroke: colour, width: series.width ?? 1.5, dash: series.dash, alpha: series.opacity ?? 1,
      fill: series.fill ? colour : undefined,
      paths: series.points ? () => null : undefined,
      points: { show: false },
      spanGaps: true,
    };
  }

  private addScrubbing(plot: uPlot): void {
    const { scrub } = this;
    if (!scrub) return;
    plot.over.classList.add("scrub");
    const follow = (event: PointerEvent): void => {
      if (event.buttons & 1) scrub(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x"));
    };
    plot.over.addEventListener("pointerdown", (event) => {
      plot.over.setPointerCapture(event.pointerId);
      follow(event);
    });
    plot.over.addEventListener("pointermove", follow);
  }

  private buildLegend(data: ChartData): void {
    this.values = [];
    replaceChildren(this.legend, ...legendOf(data).map(({ label, colour, dash, mark, kind }) => {
      const swatch = mark ? markSwatch(mark) : h("i", { class: `swatch ${kind}` });
      swatch.style.setProperty("--colour", `var(--${colour})`);
      if (dash?.length) swatch.classList.add(dash[0] <= 2 ? "dotted" : "dashed");
      const value = h("b", {});
      if (kind !== "level") this.values.push(value);
      return h("span", { class: "entry" }, swatch, h("span", {}, label), kind !== "level" && value);
    }));
  }

  // The values of the legend: at the pointer, otherwise at the playhead.
  private showValues(): void {
    const { data } = this;
    if (!data) return;
    const x = data.columns[0] as number[];
    let index = this.hoverIndex;
    if (index === null && this.head !== undefined && x.length) index = indexBefore(x, this.head);
    let at = 0;
    data.series.forEach((series, i) => {
      if (series.quiet) return;
      const value = index === null ? undefined
        : series.legendValue ? series.legendValue(index) : data.columns[i + 1][index] ?? undefined;
      if (this.values[at]) setText(this.values[at], value === undefined ? "" : number(value));
      ++at;
    });
  }

  destroy(): void {
    this.ignoreTheme();
    this.observer.disconnect();
    this.plot?.destroy();
  }
}
