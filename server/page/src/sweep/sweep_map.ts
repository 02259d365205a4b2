// The map of a sweep over two fields or more: a measure as the colour of each pair of values, which leads to its jobs,
// and as contour lines.
import type { SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { contours, kMostLevels } from "../charts/contours";
import { ticksOf } from "../charts/curves";
import { given, idOf, number, plural } from "../dom/format";
import { h, replaceChildren, type Child } from "../dom/element";
import { isDark, onThemeChange } from "../dom/preferences";
import { titleOfMeasure, unitFor, type Measure } from "../job/measures";
import { stateWord } from "../jobs/states";
import { colourTable, cssColour, kShades, wallColour } from "../picture/colours";
import { MapAxes, valuesOf } from "./map_axes";
import { axisName } from "./points";
import { byPoint, jobsLink, keyOf, meanOfField } from "./seed_means";
import type { TableData } from "./table";

const [kHeadWidth, kLeastWidth] = [92, 40]; // pixels: of the heads of the rows, and of a cell

interface Cell { rows: SweepTable_Row[]; mean: number | undefined }

// Black or white, whichever contrasts more (WCAG 2).
function inkOn(colour: [number, number, number]): string {
  const [r, g, b] = colour.map((value) => ((value / 255 + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? "#000" : "#fff";
}

export class SweepMap {
  readonly element = h("section", { class: "card sweep-map", hidden: true });
  private readonly axes = new MapAxes();
  private readonly map = h("div");
  private redraw = (): void => undefined;
  private readonly ignoreTheme = onThemeChange(() => this.redraw());

  constructor() {
    this.element.append(this.axes.element, this.map);
    this.axes.changes.add(() => this.redraw());
  }

  update(data: TableData, measure: Measure): void {
    this.axes.update(data.rows, data.fields);
    this.element.hidden = !this.axes.areTwo;
    this.redraw = () => this.axes.areTwo && this.draw(data, measure);
    this.redraw();
  }

  // Colours and contours are those of the whole sweep, also where the map holds a field.
  private draw({ rows: all, fields, means: averages }: TableData, measure: Measure): void {
    const points = byPoint(averages);
    const numberOf = (row: SweepTable_Row): number | undefined =>
      meanOfField(points.get(keyOf(row.values, fields)), measure.field)?.mean ??
      (row.result?.summary && measure.value(row.result.summary));
    const numbers = all.map(numberOf);
    const unit = unitFor(measure, numbers);
    const known = numbers.filter((value) => value !== undefined).map((value) => value * unit.factor);
    const [low, high] = [Math.min(...known), Math.max(...known)];
    const { x, y } = this.axes;
    const rows = all.filter((row) => this.axes.shows(row));
    const [xs, ys] = [valuesOf(rows, x), valuesOf(rows, y).reverse()];
    const cells = ys.map((up) => xs.map((across): Cell => {
      const members = rows.filter(({ values }) => values[x] === across && values[y] === up);
      const value = members.map(numberOf).find((found) => found !== undefined);
      return { rows: members, mean: value && value * unit.factor };
    }));
    const levels = ticksOf(low, high, kMostLevels);
    const drawing = contours(cells.map((row) => row.map(({ mean }) => mean)), levels);
    const title = titleOfMeasure(measure, unit);
    const table = h("table", { class: "map", "aria-label": title },
      h("tbody", {}, ...ys.map((value, i) => h("tr", {},
        i === 0 && h("th", { scope: "rowgroup", rowspan: ys.length, class: "y-name" }, h("span", {},
          axisName(fields[y]))),
        h("th", { scope: "row", class: "figure" }, given(value)),
        ...cells[i].map((cell, at) => h("td", {}, i + at === 0 && drawing,
          linkOf(cell, (mean) => (mean - low) / (high - low || 1))))))),
      h("tfoot", {},
        h("tr", {}, h("td", { colspan: 2 }), ...xs.map((value) => h("th", { scope: "col" }, given(value)))),
        h("tr", {}, h("td", { colspan: 2 }), h("th", { scope: "colgroup", colspan: xs.length },
          axisName(fields[x])))));
    table.style.minWidth = `${kHeadWidth + kLeastWidth * xs.length}px`;
    replaceChildren(this.map,
      h("div", { class: "picture-head" }, h("h2", {}, title), h("span", { class: "spacer" }),
        levels.length > 1 && h("span", { class: "faint" },
          `contours every ${given(levels[1] - levels[0])} ${unit.name}`),
        known.length > 0 && legend(low, high)),
      h("div", { class: "table-scroll" }, table));
  }

  destroy(): void {
    this.ignoreTheme();
  }
}

function legend(low: number, high: number): HTMLElement {
  const canvas = h("canvas", { width: kShades, height: 1, class: "map", "aria-hidden": "true" });
  const colours = new ImageData(new Uint8ClampedArray(colourTable(isDark())), kShades, 1);
  canvas.getContext("2d")!.putImageData(colours, 0, 0);
  return h("div", { class: "colour-legend" }, h("span", {}, number(low)), canvas, h("span", {}, number(high)));
}

// One job is opened, several seeds are compared.
function linkOf({ rows, mean }: Cell, shareOf: (mean: number) => number): Child {
  if (!rows.length) return undefined;
  const { result } = rows[0];
  const text = mean !== undefined ? number(mean) : result ? stateWord(result.state) : "–";
  const of = rows.length === 1 ? `job ${idOf(rows[0].job)}` : `mean of ${plural(rows.length, "job")}`;
  const link = h("a", { href: jobsLink(rows), title: `${of}: ${text}` }, h("span", {}, text));
  if (mean !== undefined) {
    const colour = wallColour(shareOf(mean), isDark());
    link.style.background = cssColour(colour);
    link.style.color = inkOn(colour);
  }
  return link;
}
