// The points of a sweep for its chart: plateau stresses, or another number of the results, against one varied field,
// with mean and spread over seeds.
import type { SweepTable_Row, SweepTable_SeedMeans } from "../../gen/cellcrush/v1/sweep_pb";
import { kMarkShapes, type ChartData, type Series, type Spread } from "../charts/chart_data";
import { given } from "../dom/format";
import { kMeasures, unitFor, type Measure } from "../job/measures";
import { nameOf } from "../new_case/words";
import { byPoint, keyOf, meanOfField } from "./seed_means";

export const isSeed = (path: string): boolean => path.endsWith(".seed");

const nameWithUnit = (words: string, unit: string): string => (unit ? `${words} (${unit})` : words);

/** A field's name with its unit in brackets, as "speed (m/s)". */
export function axisName(path: string): string {
  const { words, unit } = nameOf(path);
  return nameWithUnit(words, unit);
}

/** The place of a field among others, or -1. A field of one lattice is the same as that of another. */
export function placeOf(path: string, fields: string[]): number {
  const common = (field: string): string => field.replace(/^lattice\.\w+\./, "lattice.");
  return fields.findIndex((field) => common(field) === common(path));
}

/** The rows of a sweep, and means over its seeds; `label` names it beside others. */
export interface Swept { label: string; rows: SweepTable_Row[]; fields: string[]; means?: SweepTable_SeedMeans[] }

/** `axis` is the place of the chart's field in the values of the rows. */
interface Group {
  label: string;
  rows: SweepTable_Row[];
  axis: number;
  /** The mean over the seeds of a row. */
  meanOf(row: SweepTable_Row, field: string): Mean | undefined;
}

// Rows with equal values of all other fields than the axis and the seed.
function groupsOf({ label: sweep, rows, fields, means = [] }: Swept, path: string): Group[] {
  const points = byPoint(means);
  const meanOf = (row: SweepTable_Row, field: string): Mean | undefined =>
    meanOfField(points.get(keyOf(row.values, fields)), field);
  const axis = placeOf(path, fields);
  const others = fields.map((_, i) => i).filter((i) => i !== axis && !isSeed(fields[i]));
  const groups = new Map<string, SweepTable_Row[]>();
  for (const row of rows) {
    const label = others.map((i) => `${axisName(fields[i])} ${given(row.values[i])}`).join(", ");
    groups.set(label, [...(groups.get(label) ?? []), row]);
  }
  return [...groups].map(([label, members]) => ({
    label: [sweep, label].filter(Boolean).join(": "), rows: members, axis, meanOf,
  }));
}

/** `interval` is half of the 95 % confidence interval of a mean of several jobs. */
interface Mean { mean: number; interval?: number }

const measureNamed = (name: string): Measure => kMeasures.find(({ field }) => field === name)!;
const [kImpact, kSupport, kShock, kGibsonAshby] = ["plateau_stress_impact_mpa", "plateau_stress_support_mpa",
  "theory.shock_mpa", "theory.gibson_ashby_mpa"].map(measureNamed);
const valueOf = ({ value }: Measure, { result }: SweepTable_Row): number | undefined =>
  result?.summary && value(result.summary);

export const kMostGroups = 6;
const kTheoryPoints = 60;

// Eq. 51 between the points of a sweep over speed, where it grows with the square of the speed above Gibson-Ashby.
function shockBetween({ rows, axis }: Group, xs: number[]): (number | null)[] | undefined {
  const row = rows.find((candidate) => valueOf(kShock, candidate) && candidate.values[axis] > 0);
  if (!row) return undefined;
  const base = valueOf(kGibsonAshby, row) ?? 0;
  const factor = (valueOf(kShock, row)! - base) / row.values[axis] ** 2;
  const values = rows.map((candidate) => candidate.values[axis]);
  const [first, last] = [Math.min(...values), Math.max(...values)];
  return xs.map((x) => (x < first || x > last ? null : base + factor * x * x));
}

/** The chart of sweeps over the field `path`, which each of them varies: of a measure, or of the plateau stresses. */
export function sweepChart(sweeps: Swept[], path: string, measure?: Measure): ChartData {
  const groups = sweeps.flatMap((swept) => groupsOf(swept, path));
  const values = groups.flatMap((group) => group.rows.map((row) => row.values[group.axis]));
  const points = [...new Set(values)].sort((a, b) => a - b);
  const [first, last] = [points[0] ?? 0, points[points.length - 1] ?? 1];
  const isSpeed = path.endsWith(".speed_m_per_s");
  const between = Array.from({ length: isSpeed ? kTheoryPoints : 0 }, (_, i) =>
    first + ((last - first) * (i + 1)) / (kTheoryPoints + 1));
  const xs = [...new Set([...points, ...between])].sort((a, b) => a - b);
  const series: Series[] = [];
  const columns: (number | null)[][] = [xs];
  const spreads: Spread[] = [];
  let [low, top] = [0, 0];
  const shown = measure ? [measure] : [kImpact, kSupport, kShock];
  const rows = sweeps.flatMap((swept) => swept.rows);
  const unit = unitFor(measure ?? { unit: "MPa" }, rows.flatMap((row) => shown.map((of) => valueOf(of, row))));
  const add = ({ rows, axis, meanOf }: Group, of: Measure, look: Series): void => {
    const members = xs.map((x) => rows.filter((row) => row.values[axis] === x && valueOf(of, row) !== undefined));
    // A job alone, or the mean over seeds that the server gives.
    const means = members.map(([row, ...more]): Mean | undefined =>
      row && (meanOf(row, of.field) ?? (more.length ? undefined : { mean: valueOf(of, row)! })));
    if (!means.some(Boolean)) return;
    series.push(look.points ? { ...look, jobs: members.map((at) => at.map(({ job }) => job)) } : look);
    columns.push(means.map((mean) => (mean ? mean.mean * unit.factor : null)));
    means.forEach((each, i) => {
      if (!each) return;
      const [mean, interval] = [each.mean * unit.factor, (each.interval ?? 0) * unit.factor];
      top = Math.max(top, mean + interval);
      low = Math.min(low, mean - interval);
      if (look.points && interval > 0) {
        spreads.push({ x: xs[i], low: mean - interval, high: mean + interval, colour: look.colour });
      }
    });
  };
  groups.slice(0, kMostGroups).forEach((group, i) => {
    const isOnly = groups.length === 1;
    const of = isOnly ? "" : `: ${group.label}`;
    const points = { points: true, mark: kMarkShapes[i] };
    if (measure) {
      const look = { label: isOnly ? measure.words : group.label, colour: `series-${i}` };
      return add(group, measure, { ...look, ...points });
    }
    add(group, kShock, { label: `shock theory (Eq. 51)${of}`, colour: isOnly ? "ink-2" : `series-${i}`,
                              dash: [8, 4], width: 1.4, quiet: !isOnly });
    const curve = isSpeed ? shockBetween(group, xs) : undefined;
    if (curve) columns[columns.length - 1] = curve.map((value) => value && value * unit.factor);
    add(group, kGibsonAshby, { label: `quasi-static theory (Gibson-Ashby)${of}`,
                                    colour: isOnly ? "ink-2" : `series-${i}`, dash: [2, 3], width: 1.4,
                                    quiet: !isOnly });
    add(group, kImpact, { label: isOnly ? "impact plate" : group.label, colour: isOnly ? "impact" : `series-${i}`,
                          ...points });
    if (isOnly) add(group, kSupport, { label: "support plate", colour: "support", points: true, mark: "square" });
  });
  const isLog = first > 0 && last / first > 20;
  const room = 0.05 * (last - first || Math.abs(last) || 1);
  return {
    series, columns, spreads, xLabel: axisName(path),
    yLabel: nameWithUnit(measure?.words ?? "plateau stress", unit.name),
    xLow: isLog ? first / 1.2 : first >= 0 && first < 0.35 * last ? 0 : first - room,
    xEnd: isLog ? last * 1.2 : last + room, xLog: isLog, yLow: 1.08 * low,
    yTop: top > 0 ? 1.08 * top : low < 0 ? 0 : 1,
    note: noteOf(groups.length, spreads.length > 0, measure),
  };
}

function noteOf(groupCount: number, hasSpread: boolean, measure: Measure | undefined): string {
  const notes = measure ? [] : ["mean stress from 20 to 40 % strain"];
  if (hasSpread) notes.push("bars: 95 % confidence interval of the mean over seeds");
  const hasTheory = groupCount > 1 && !measure;
  if (hasTheory) notes.push("at the impact plate; dashed: shock theory (Eq. 51), dotted: Gibson-Ashby");
  if (groupCount > kMostGroups) notes.push(`the first ${kMostGroups} of ${groupCount} curves`);
  return notes.join("; ");
}
