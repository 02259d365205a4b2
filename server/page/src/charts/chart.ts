// A chart: uPlot in the colours of the page, with a playhead that picture and charts share, a legend with the values
// there, and scales that the user chooses.
import uPlot from "uplot";
import { button, h, replaceChildren, setText, svg } from "../dom/element";
import { given, number } from "../dom/format";
import { themeColour } from "../picture/colours";
import { onThemeChange } from "../dom/preferences";
import { legendOf, markPath, type ChartData, type MarkShape, type Series } from "./chart_data";
import { addChartGestures } from "./chart_gestures";
import { viewOf, within, type ChartView } from "./chart_view";
import { bandShapes, drawShapes, markShapes } from "./chart_marks";
import { indexBefore } from "./curves";
import { PointLinks } from "./point_links";

const kFont = "11px ";

// "linear" is the default of most charts; the data of others name their own.
const kScales = [
  { name: "linear", x: false, y: false }, { name: "log x", x: true, y: false },
  { name: "log y", x: false, y: true }, { name: "log x and y", x: true, y: true },
];

const tickText = (tick: number): string => (tick !== 0 && (Math.abs(tick) < 1e-3 || Math.abs(tick) >= 1e6)
  ? tick.toExponential().replace("e+", "e") : given(tick));

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
  private readonly links = new PointLinks();
  private readonly scales = h("select", { "aria-label": "Scales" }, ...kScales.map(({ name }, i) =>
    h("option", { value: i }, name)));
  private readonly all = button("Show all", () => this.reset(), { hidden: true });
  private readonly tools = h("span", { class: "take-away" }, this.all, this.scales);
  private plot: uPlot | undefined;
  private view: ChartView = {};
  private whole: ChartData | undefined;
  private shown: ChartData | undefined;
  private values: HTMLElement[] = [];
  private head: number | undefined;
  private hoverIndex: number | null = null;

  /** `scrub` is called with the x to which the user moves the playhead. */
  constructor(title: string, private readonly scrub?: (x: number) => void) {
    this.element = h("figure", { class: "chart" },
      h("figcaption", {}, h("h2", {}, title), this.tools), this.legend, this.place, this.note);
    this.scales.addEventListener("change", () => {
      const { x, y } = kScales[Number(this.scales.value)];
      this.view = { xLog: x, yLog: y };
      if (this.whole) this.setData(this.whole);
    });
    this.observer.observe(this.place);
  }

  setTitle(title: string): void {
    setText(this.element.querySelector("h2")!, title);
  }

  /** Adds what saves or changes the chart, beside its title. */
  addTools(...tools: HTMLElement[]): void {
    this.tools.append(...tools);
  }

  private rebuild(): void {
    this.plot?.destroy();
    this.plot = undefined;
    this.build();
  }

  /** What is in view, as it is drawn. */
  get data(): ChartData | undefined {
    return this.shown;
  }

  setData(whole: ChartData): void {
    const key = (d: ChartData | undefined): string =>
      d ? JSON.stringify([d.series.map((series) => ({ ...series, jobs: 0 })), d.xLog, d.yLog, d.xLabel, d.yLabel,
                          d.levels?.map((level) => level.label)]) : "";
    if (this.whole && this.whole.yLabel !== whole.yLabel) this.view = { ...this.view, y: undefined };
    this.whole = whole;
    const areas = whole.series.some(({ fill }) => fill);
    const data = viewOf(whole, areas ? { ...this.view, yLog: false } : this.view);
    const isSame = this.plot && key(this.shown) === key(data);
    this.shown = data;
    this.showScales(areas);
    setText(this.note, data.note ?? "");
    if (!isSame) return this.rebuild();
    this.plot!.setData(data.columns as uPlot.AlignedData, false);
    this.plot!.setScale("y", { min: data.yLow ?? 0, max: data.yTop });
    this.plot!.setScale("x", { min: data.xLow ?? 0, max: data.xEnd });
    this.moveHead();
    this.showValues();
  }

  // Stacked areas have no logarithmic heights.
  private showScales(areas: boolean): void {
    const { xLog = false, yLog = false } = this.shown!;
    this.scales.value = String(kScales.findIndex(({ x, y }) => x === xLog && y === yLog));
    kScales.forEach(({ y }, i) => (this.scales.options[i].disabled = y && areas));
    this.all.hidden = !this.view.x && !this.view.y;
  }

  private zoom(view: Pick<ChartView, "x" | "y">): void {
    if (!this.whole) return;
    const { xLow = 0, xEnd, yLow = 0, yTop } = viewOf(this.whole, { ...this.view, x: undefined, y: undefined });
    if (view.x) this.view.x = within(view.x, { low: xLow, high: xEnd });
    if (view.y) this.view.y = within(view.y, { low: yLow, high: Math.max(yTop, view.y.high) });
    this.links.hide();
    this.setData(this.whole);
  }

  private reset(): void {
    this.view = { ...this.view, x: undefined, y: undefined };
    if (this.whole) this.setData(this.whole);
  }

  /** Moves the playhead. */
  setHead(x: number): void {
    this.head = x;
    this.moveHead();
    if (this.hoverIndex === null) this.showValues();
  }

  private moveHead(): void {
    const { plot, head } = this;
    const left = plot && head !== undefined ? plot.valToPos(head, "x") : NaN;
    this.playhead.hidden = !(left >= -1 && left <= plot!.over.clientWidth + 1);
    if (!this.playhead.hidden) this.playhead.style.transform = `translateX(${left.toFixed(1)}px)`;
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
    const { shown: data, place } = this;
    if (!data || !place.clientWidth) return;
    const axis = (label: string, size: number): uPlot.Axis => ({
      label, size, labelSize: 18, labelGap: 0, gap: 4, font: kFont + themeColour("font"),
      labelFont: kFont + themeColour("font"),
      stroke: () => themeColour("ink-2"),
      grid: { stroke: themeColour("grid"), width: 1 },
      ticks: { stroke: themeColour("grid"), width: 1, size: 4 },
      values: (_, ticks) => ticks.map((tick) => (tick === null ? "" : tickText(tick))),
    });
    this.plot = new uPlot({
      width: place.clientWidth,
      height: place.clientHeight,
      padding: [8, 10, 0, 0],
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, points: { size: 6 }, y: false },
      scales: {
        x: { time: false, distr: data.xLog ? 3 : 1, range: () => [this.shown!.xLow ?? 0, this.shown!.xEnd] },
        y: { distr: data.yLog ? 3 : 1, range: () => [this.shown!.yLow ?? 0, this.shown!.yTop] },
      },
      axes: [axis(data.xLabel, 30), axis(data.yLabel, 46)],
      series: [{}, ...data.series.map((series) => this.seriesOf(series))],
      hooks: {
        drawClear: [(plot) => drawShapes(plot, this.shown!, bandShapes)],
        draw: [(plot) => drawShapes(plot, this.shown!, markShapes), () => this.moveHead()], // scales are known by now
        setCursor: [(plot) => {
          this.hoverIndex = plot.cursor.idx ?? null;
          this.showValues();
          const { left = -1, top = -1 } = plot.cursor;
          this.links.hover(plot, this.shown!, left, top);
        }],
      },
    }, data.columns as uPlot.AlignedData, place);
    this.plot.over.append(this.playhead, this.links.element);
    this.addGestures(this.plot);
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

  private addGestures(plot: uPlot): void {
    plot.over.setAttribute("aria-label", `${this.element.querySelector("h2")!.textContent}: + and - zoom, 0 shows all`);
    plot.over.setAttribute("role", "img");
    if (this.scrub) plot.over.classList.add("scrub");
    addChartGestures(plot, {
      zoom: (x, y) => this.zoom({ x, y }),
      isZoomed: () => this.view.x !== undefined || this.view.y !== undefined,
      reset: () => this.reset(),
      playhead: () => (this.head === undefined ? undefined : plot.valToPos(this.head, "x")),
      scrub: this.scrub,
      click: (left, top) => this.links.click(plot, this.shown!, left, top),
    });
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
    const { shown: data } = this;
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
