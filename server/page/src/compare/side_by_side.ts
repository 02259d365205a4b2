// Several jobs side by side: their smoothed stresses over one axis of strain, their numbers, and all fields in which
// their cases differ.
import type { ChartData, Series } from "../charts/chart_data";
import { indexBefore, strainAxis } from "../charts/curves";
import { kSmoothing, smoothedStress, stressTop, type StressCurves } from "../charts/stress";
import { h } from "../dom/element";
import { given, idOf, pathOf, unitBySize } from "../dom/format";
import type { JobData } from "../job/job_data";
import { kFirstMeasures, kMeasures, measureText, titleOfMeasure, unitFor } from "../job/measures";
import { caseValues } from "../new_case/fields";

const kPoints = 1200;

// The curve at a strain, between its points; null beyond its end.
function at(strain: number[], stress: number[], x: number): number | null {
  const last = strain.length - 1;
  if (last < 0 || x > strain[last]) return null;
  const i = indexBefore(strain, x);
  if (i === last || x <= strain[0]) return stress[i];
  const mix = (x - strain[i]) / (strain[i + 1] - strain[i] || 1);
  return stress[i] + mix * (stress[i + 1] - stress[i]);
}

export function comparisonChart(jobs: JobData[], names: string[], end: number): ChartData {
  const xs = Array.from({ length: kPoints + 1 }, (_, i) => (end * i) / kPoints);
  const curves: StressCurves[] = jobs.map((data) => smoothedStress(data.samples, strainAxis(end)));
  const series: Series[] = [];
  const columns: (number | null)[][] = [xs];
  let top = 0;
  curves.forEach((curve, i) => {
    const colour = `series-${i}`;
    series.push({ label: names[i], colour, width: 2 }, { label: "", colour, width: 1.4, dash: [5, 3], quiet: true });
    columns.push(xs.map((x) => at(curve.strain, curve.impact, x)), xs.map((x) => at(curve.strain, curve.support, x)));
    if (curve.strain.length) top = Math.max(top, stressTop(curve, jobs[i].job?.summary, undefined));
  });
  const { name, factor } = unitBySize("MPa", top);
  return {
    series, columns: [xs, ...columns.slice(1).map((column) => column.map((stress) => stress && stress * factor))],
    xLabel: "nominal strain", yLabel: `nominal stress (${name})`, xEnd: end, yTop: top * factor || 1,
    bands: [{ from: 0.2, to: 0.4, label: "plateau window" }],
    note: `solid: impact plate, dashed: support plate; moving mean over ${100 * kSmoothing} % strain`,
  };
}

const kLongest = 60; // characters of a list, such as the nodes of a frame
const kLongNumber = 10;

// Of a long number six digits; the title has all.
function shortened(text: string): string {
  if (text.length > kLongNumber && /[.e]/.test(text) && !Number.isNaN(Number(text))) return given(Number(text));
  return text.length > kLongest ? `${text.slice(0, kLongest)}…` : text;
}

interface Line { name: string; values: (string | undefined)[] }
const differs = ({ values }: Line): boolean => new Set(values).size > 1;

function caseLines(jobs: JobData[]): Line[] {
  const facts = jobs.map((data) => {
    const value = data.check?.completedCase ?? data.job?.case;
    return value ? caseValues(value) : new Map<string, string>();
  });
  const names = [...new Set(facts.flatMap((map) => [...map.keys()]))];
  return names.map((name) => ({ name, values: facts.map((map) => map.get(name)) }));
}

function resultLines(jobs: JobData[]): Line[] {
  const summaries = jobs.map(({ job }) => job?.summary);
  const numbers = kMeasures.map((measure) => {
    const unit = unitFor(measure, summaries.map((summary) => summary && measure.value(summary)));
    return { name: titleOfMeasure(measure, unit),
             values: summaries.map((summary) => summary && measureText(measure, summary, unit)) };
  });
  return [...numbers.slice(0, kFirstMeasures.length),
          { name: "Crush mode", values: summaries.map((summary) => summary?.crushModeWords || undefined) },
          ...numbers.slice(kFirstMeasures.length)];
}

/** The fields of the cases and the numbers of the results: all, or those in which the jobs differ. */
export function comparisonTable(jobs: JobData[], all: boolean): HTMLElement {
  const rows = (lines: Line[]): HTMLElement[] => lines.filter((line) => all || differs(line)).map(({ name, values }) =>
    h("tr", {}, h("th", { scope: "row" }, name),
      ...values.map((value) => h("td", { class: "figure", title: value }, value ? shortened(value) : "–"))));
  const none = h("tr", {}, h("td", { colspan: jobs.length + 1, class: "faint" }, "no difference"));
  const group = (name: string, lines: HTMLElement[]): HTMLElement =>
    h("tbody", {}, h("tr", { class: "group" }, h("th", { scope: "rowgroup", colspan: jobs.length + 1 }, name)),
      ...(lines.length ? lines : [none.cloneNode(true)]));
  return h("div", { class: "table-scroll" }, h("table", { class: "rows" },
    h("thead", {}, h("tr", {}, h("td", {}), ...jobs.map((data) =>
      h("th", { scope: "col", class: "figure" }, h("a", { href: pathOf(data.name) }, `job ${idOf(data.name)}`))))),
    group("Case", rows(caseLines(jobs))), group("Result", rows(resultLines(jobs)))));
}
