// The jobs behind the points of a chart: named at the pointer, and opened by a click.
import type uPlot from "uplot";
import { h, replaceChildren } from "../dom/element";
import { idOf, number, pathOf } from "../dom/format";
import { go } from "../router";
import type { ChartData } from "./chart_data";

const kReach = 13; // pixels

interface Point { jobs: string[]; label: string; left: number; top: number; y: number }

export class PointLinks {
  readonly element = h("div", { class: "tip point-tip", hidden: true });
  private isPinned = false;

  /** The point at a place of the plot, if it has jobs. */
  private find(plot: uPlot, data: ChartData, x: number, y: number): Point | undefined {
    let found: Point | undefined;
    let nearest = kReach;
    data.series.forEach(({ jobs, label }, i) => jobs?.forEach((names, k) => {
      const [px, value] = [data.columns[0][k], data.columns[i + 1][k]];
      if (!names.length || px === null || value === null) return;
      const [left, top] = [plot.valToPos(px, "x"), plot.valToPos(value, "y")];
      const distance = Math.hypot(left - x, top - y);
      if (distance >= nearest) return;
      nearest = distance;
      found = { jobs: names, label, left, top, y: value };
    }));
    return found;
  }

  hover(plot: uPlot, data: ChartData, x: number, y: number): void {
    if (this.isPinned) return;
    const point = this.find(plot, data, x, y);
    plot.over.classList.toggle("on-point", point !== undefined);
    this.show(plot, point);
  }

  click(plot: uPlot, data: ChartData, x: number, y: number): void {
    const point = this.find(plot, data, x, y);
    if (point?.jobs.length === 1) return go(pathOf(point.jobs[0]));
    this.isPinned = point !== undefined;
    this.show(plot, point);
  }

  hide(): void {
    this.isPinned = false;
    this.element.hidden = true;
  }

  private show(plot: uPlot, point: Point | undefined): void {
    this.element.hidden = !point;
    if (!point) return;
    const links = point.jobs.map((name) => h("a", { href: pathOf(name) }, `job ${idOf(name)}`));
    const isOne = links.length === 1;
    replaceChildren(this.element,
      h("div", {}, h("span", {}, isOne ? `job ${idOf(point.jobs[0])}` : point.label), h("b", {}, number(point.y, 4))),
      h("div", { class: "point-jobs" }, ...(this.isPinned && !isOne ? links
        : [h("span", {}, isOne ? "click to open" : `mean of ${links.length} jobs: click to list them`)])));
    this.element.classList.toggle("pinned", this.isPinned);
    const { offsetWidth, offsetHeight } = this.element;
    const isRight = point.left + offsetWidth + 14 > plot.over.clientWidth;
    const left = isRight ? point.left - offsetWidth - 12 : point.left + 12;
    const top = Math.min(Math.max(point.top - 0.5 * offsetHeight, 2), plot.over.clientHeight - offsetHeight - 2);
    this.element.style.transform = `translate(${Math.max(0, left)}px, ${top}px)`;
  }
}
