// Several jobs side by side: their smoothed stresses over one axis of strain, their numbers, and all fields in which
// their cases differ.
import type { Summary } from "../../gen/cellcrush/v1/sample_pb";
import type { ChartData, Series } from "../charts/chart_data";
import { indexBefore, strainAxis } from "../charts/curves";
import { kSmoothing, smoothedStress, stressTop, type StressCurves } from "../charts/stress";
import { h } from "../dom/element";
import { idOf, number, pathOf } from "../dom/format";
import type { JobData } from "../job/job_data";
import { kSummaryNumbers, summaryText } from "../job/results";
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
  return {
    series, columns, xLabel: "nominal strain", yLabel: "nominal stress (MPa)", xEnd: end, yTop: top || 1,
    bands: [{ from: 0.2, to: 0.4, label: "plateau window" }],
    note: `solid: impact plate, dashed: support plate; moving mean over ${100 * kSmoothing} % strain`,
  };
}

const kNumbers: [string, (s: Summary) => string][] = [
  ...kSummaryNumbers.map((of): [string, (s: Summary) => string] => [of.name, (s) => summaryText(of, s)]),
  ["Gibson-Ashby, MPa", (s) => number(s.theory?.gibsonAshbyMpa)],
  ["Crush mode", (s) => s.crushModeWords || "–"],
];

const kLongest = 60; // characters of a list, such as the nodes of a frame
const shortened = (text: string): string => (text.length > kLongest ? `${text.slice(0, kLongest)}…` : text);

export function comparisonTable(jobs: JobData[]): HTMLElement {
  const facts = jobs.map((data) => {
    const value = data.check?.completedCase ?? data.job?.case;
    return value ? caseValues(value) : new Map<string, string>();
  });
  const names = [...new Set(facts.flatMap((map) => [...map.keys()]))];
  const differing = names.filter((name) => new Set(facts.map((map) => map.get(name))).size > 1);
  const row = (name: string, values: (string | undefined)[]): HTMLElement =>
    h("tr", {}, h("th", { scope: "row" }, name),
      ...values.map((value) => h("td", { class: "figure", title: value }, value ? shortened(value) : "–")));
  return h("div", { class: "table-scroll" }, h("table", { class: "rows" },
    h("thead", {}, h("tr", {}, h("td", {}), ...jobs.map((data) =>
      h("th", { scope: "col", class: "figure" }, h("a", { href: pathOf(data.name) }, `job ${idOf(data.name)}`))))),
    h("tbody", {}, ...differing.map((name) => row(name, facts.map((map) => map.get(name)))),
      ...kNumbers.map(([name, text]) => row(name, jobs.map((data) =>
        data.job?.summary && text(data.job.summary)))))));
}
