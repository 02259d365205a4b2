// The smoothed stresses of several jobs over one axis of strain.
import type { ChartData, Series } from "../charts/chart_data";
import { indexBefore, strainAxis } from "../charts/curves";
import { kSmoothing, smoothedStress, stressTop, type StressCurves } from "../charts/stress";
import type { JobData } from "../job/job_data";

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
