// The points of a sweep for its chart: plateau stresses against one varied field, with mean and spread over seeds.
import type { SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import type { ChartData, Series, Spread } from "../charts/chart_data";

export const isSeed = (path: string): boolean => path.endsWith(".seed");
export const shortName = (path: string): string => path.slice(path.lastIndexOf(".") + 1);

/** A field's name with its unit in brackets, as "speed (m/s)". */
export function axisName(path: string): string {
  const units: [RegExp, string][] = [[/_m_per_s$/, "m/s"], [/_kg_per_m3$/, "kg/m³"], [/_mm$/, "mm"], [/_mpa$/, "MPa"],
                                     [/_per_s$/, "1/s"], [/_s$/, "s"]];
  const name = shortName(path);
  const unit = units.find(([pattern]) => pattern.test(name));
  const words = (unit ? name.replace(unit[0], "") : name).replaceAll("_", " ");
  return unit ? `${words} (${unit[1]})` : words;
}

interface Group { label: string; rows: SweepTable_Row[] }

// Rows with equal values of all other fields than the axis and the seed.
function groupsOf(rows: SweepTable_Row[], fields: string[], axis: number): Group[] {
  const others = fields.map((_, i) => i).filter((i) => i !== axis && !isSeed(fields[i]));
  const groups = new Map<string, SweepTable_Row[]>();
  for (const row of rows) {
    const label = others.map((i) => `${axisName(fields[i])} ${row.values[i]}`).join(", ");
    groups.set(label, [...(groups.get(label) ?? []), row]);
  }
  return [...groups].map(([label, members]) => ({ label, rows: members }));
}

interface Mean { mean: number; deviation: number; count: number }

function meanOf(values: number[]): Mean | undefined {
  if (values.length === 0) return undefined;
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const squares = values.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  return { mean, deviation: values.length > 1 ? Math.sqrt(squares / (values.length - 1)) : 0, count: values.length };
}

type Quantity = (row: SweepTable_Row) => number | undefined;
const kImpact: Quantity = (row) => row.result?.summary?.plateauStressImpactMpa;
const kSupport: Quantity = (row) => row.result?.summary?.plateauStressSupportMpa;
const kShock: Quantity = (row) => row.result?.summary?.theory?.shockMpa || undefined;
const kGibsonAshby: Quantity = (row) => row.result?.summary?.theory?.gibsonAshbyMpa || undefined;

const kMostGroups = 6;
const kTheoryPoints = 60;

// Eq. 51 between the points of a sweep over speed, where it grows with the square of the speed above Gibson-Ashby.
function shockBetween(rows: SweepTable_Row[], axis: number, xs: number[]): (number | null)[] | undefined {
  const row = rows.find((candidate) => kShock(candidate) && candidate.values[axis] > 0);
  if (!row) return undefined;
  const base = kGibsonAshby(row) ?? 0;
  const factor = (kShock(row)! - base) / row.values[axis] ** 2;
  return xs.map((x) => base + factor * x * x);
}

export function sweepChart(rows: SweepTable_Row[], fields: string[], axis: number): ChartData {
  const points = [...new Set(rows.map((row) => row.values[axis]))].sort((a, b) => a - b);
  const [first, last] = [points[0] ?? 0, points[points.length - 1] ?? 1];
  const isSpeed = fields[axis]?.endsWith(".speed_m_per_s") ?? false;
  const between = Array.from({ length: isSpeed ? kTheoryPoints : 0 }, (_, i) =>
    first + ((last - first) * (i + 1)) / (kTheoryPoints + 1));
  const xs = [...new Set([...points, ...between])].sort((a, b) => a - b);
  const groups = groupsOf(rows, fields, axis);
  const series: Series[] = [];
  const columns: (number | null)[][] = [xs];
  const spreads: Spread[] = [];
  let top = 0;
  const add = (members: SweepTable_Row[], quantity: Quantity, look: Series, withSpread: boolean): void => {
    const means = xs.map((x) => meanOf(members.filter((row) => row.values[axis] === x).map(quantity)
      .filter((value): value is number => value !== undefined)));
    if (!means.some(Boolean)) return;
    series.push(look);
    columns.push(means.map((mean) => mean?.mean ?? null));
    means.forEach((mean, i) => {
      if (!mean) return;
      top = Math.max(top, mean.mean + mean.deviation);
      const { mean: middle, deviation } = mean;
      if (withSpread && mean.count > 1) {
        spreads.push({ x: xs[i], low: middle - deviation, high: middle + deviation, colour: look.colour });
      }
    });
  };
  groups.slice(0, kMostGroups).forEach((group, i) => {
    const isOnly = groups.length === 1;
    const of = isOnly ? "" : `: ${group.label}`;
    add(group.rows, kShock, { label: `shock theory (Eq. 51)${of}`, colour: isOnly ? "ink-2" : `series-${i}`,
                              dash: [8, 4], width: 1.4, quiet: !isOnly }, false);
    const curve = isSpeed ? shockBetween(group.rows, axis, xs) : undefined;
    if (curve) columns[columns.length - 1] = curve;
    add(group.rows, kGibsonAshby, { label: `quasi-static theory (Gibson-Ashby)${of}`,
                                    colour: isOnly ? "ink-2" : `series-${i}`, dash: [2, 3], width: 1.4,
                                    quiet: !isOnly }, false);
    add(group.rows, kImpact, { label: `impact plate${of}`, colour: isOnly ? "impact" : `series-${i}`, points: true },
        true);
    if (isOnly) add(group.rows, kSupport, { label: "support plate", colour: "support", points: true }, true);
  });
  const isLog = first > 0 && last / first > 20;
  const room = 0.05 * (last - first || Math.abs(last) || 1);
  return {
    series, columns, spreads, xLabel: axisName(fields[axis] ?? ""), yLabel: "plateau stress (MPa)",
    xLow: isLog ? first / 1.2 : first >= 0 && first < 0.35 * last ? 0 : first - room,
    xEnd: isLog ? last * 1.2 : last + room, xLog: isLog, yTop: top > 0 ? 1.08 * top : 1,
    note: noteOf(groups.length, spreads.length > 0),
  };
}

function noteOf(groupCount: number, hasSpread: boolean): string {
  const notes = ["mean stress from 20 to 40 % strain"];
  if (hasSpread) notes.push("bars: standard deviation between crushes");
  if (groupCount > 1) notes.push("at the impact plate; dashed: shock theory (Eq. 51), dotted: Gibson-Ashby");
  if (groupCount > kMostGroups) notes.push(`the first ${kMostGroups} of ${groupCount} combinations`);
  return notes.join("; ");
}
