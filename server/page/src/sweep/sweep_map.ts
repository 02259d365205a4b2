// The map of a sweep over two fields: a measure as the colour of each pair of values, which leads to its jobs.
import type { SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { given, idOf, number, plural } from "../dom/format";
import { h, replaceChildren } from "../dom/element";
import { isDark, onThemeChange } from "../dom/preferences";
import { titleOfMeasure, unitFor, type Measure } from "../job/measures";
import { stateWord } from "../jobs/states";
import { colourTable, cssColour, kShades, wallColour } from "../picture/colours";
import { axisName, isSeed } from "./points";
import { byPoint, jobsLink, keyOf, meanOfField } from "./seed_means";
import type { TableData } from "./table";

interface Cell { rows: SweepTable_Row[]; mean: number | undefined }

/** The places of the two fields of a map; undefined if the sweep varies other numbers of fields. */
export function mapAxes(rows: SweepTable_Row[], fields: string[]): [number, number] | undefined {
  const varied = fields.map((_, i) => i)
    .filter((i) => !isSeed(fields[i]) && rows.some((row) => row.values[i] !== rows[0].values[i]));
  return varied.length === 2 ? [varied[0], varied[1]] : undefined;
}

// Black or white, whichever contrasts more (WCAG 2).
function inkOn(colour: [number, number, number]): string {
  const [r, g, b] = colour.map((value) => ((value / 255 + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? "#000" : "#fff";
}

export class SweepMap {
  readonly element = h("section", { class: "card sweep-map", hidden: true });
  private redraw = (): void => undefined;
  private readonly ignoreTheme = onThemeChange(() => this.redraw());

  update(data: TableData, measure: Measure): void {
    const { rows, fields } = data;
    const axes = mapAxes(rows, fields);
    this.element.hidden = !axes;
    this.redraw = () => axes && this.draw(data, measure, axes);
    this.redraw();
  }

  private draw({ rows, fields, means: averages }: TableData, measure: Measure, [x, y]: [number, number]): void {
    const points = byPoint(averages);
    const numberOf = (row: SweepTable_Row): number | undefined =>
      meanOfField(points.get(keyOf(row.values, fields)), measure.field)?.mean ??
      (row.result?.summary && measure.value(row.result.summary));
    const unit = unitFor(measure, rows.map(numberOf));
    const cells = new Map<string, Cell>();
    for (const row of rows) {
      const key = `${row.values[x]} ${row.values[y]}`;
      const value = numberOf(row);
      cells.set(key, { rows: [...(cells.get(key)?.rows ?? []), row], mean: value && value * unit.factor });
    }
    const means = [...cells.values()].flatMap(({ mean }) => (mean === undefined ? [] : [mean]));
    const [low, high] = [Math.min(...means), Math.max(...means)];
    const valuesOf = (axis: number): number[] =>
      [...new Set(rows.map((row) => row.values[axis]))].sort((a, b) => a - b);
    const [xs, ys] = [valuesOf(x), valuesOf(y).reverse()];
    const title = titleOfMeasure(measure, unit);
    replaceChildren(this.element,
      h("div", { class: "picture-head" }, h("h3", {}, title), h("span", { class: "spacer" }),
        means.length > 0 && legend(low, high)),
      h("div", { class: "table-scroll" }, h("table", { class: "map", "aria-label": title },
        h("tbody", {}, ...ys.map((value, i) => h("tr", {},
          i === 0 && h("th", { scope: "rowgroup", rowspan: ys.length, class: "y-name" }, h("span", {},
            axisName(fields[y]))),
          h("th", { scope: "row", class: "figure" }, given(value)),
          ...xs.map((at) => cellOf(cells.get(`${at} ${value}`), (mean) => (mean - low) / (high - low || 1)))))),
        h("tfoot", {},
          h("tr", {}, h("td", { colspan: 2 }), ...xs.map((value) => h("th", { scope: "col" }, given(value)))),
          h("tr", {}, h("td", { colspan: 2 }), h("th", { scope: "colgroup", colspan: xs.length },
            axisName(fields[x])))))));
  }

  destroy(): void {
    this.ignoreTheme();
  }
}

function legend(low: number, high: number): HTMLElement {
  const canvas = h("canvas", { width: kShades, height: 1, class: "map", "aria-hidden": "true" });
  const colours = new ImageData(new Uint8ClampedArray(colourTable(isDark())), kShades, 1);
  canvas.getContext("2d")!.putImageData(colours, 0, 0);
  return h("div", { class: "colour-legend" }, h("span", {}, given(low)), canvas, h("span", {}, given(high)));
}

// One job is opened, several seeds are compared.
function cellOf(cell: Cell | undefined, shareOf: (mean: number) => number): HTMLElement {
  if (!cell) return h("td", {});
  const { rows, mean } = cell;
  const { result } = rows[0];
  const text = mean !== undefined ? number(mean) : result ? stateWord(result.state) : "–";
  const of = rows.length === 1 ? `job ${idOf(rows[0].job)}` : `mean of ${plural(rows.length, "job")}`;
  const link = h("a", { href: jobsLink(rows), title: `${of}: ${text}` }, text);
  if (mean !== undefined) {
    const colour = wallColour(shareOf(mean), isDark());
    link.style.background = cssColour(colour);
    link.style.color = inkOn(colour);
  }
  return h("td", {}, link);
}
