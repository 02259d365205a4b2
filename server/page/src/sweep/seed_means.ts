// Means over the seeds, which the server computes: which jobs are behind each, and the columns of their table.
import type { SweepTable_Mean, SweepTable_Row, SweepTable_SeedMeans } from "../../gen/cellcrush/v1/sweep_pb";
import { h } from "../dom/element";
import { given, idOf, number } from "../dom/format";
import type { CellColumn } from "../dom/table_view";
import { kFirstMeasures, kMeasures, titleOfMeasure, unitFor, type Measure } from "../job/measures";
import { axisName, isSeed } from "./points";
import type { TableData } from "./table";
import { urlOf } from "../dom/base";

const kMostCompared = 6;
type Means = SweepTable_SeedMeans;

/** The values of a row without its seed, as one text. */
export function keyOf(values: number[], fields: string[]): string {
  return values.filter((_, i) => !isSeed(fields[i])).join();
}

/** The means by the values of their points. */
export const byPoint = (means: Means[]): Map<string, Means> => new Map(means.map((each) => [each.values.join(), each]));

export function meanOfField(means: Means | undefined, field: string): SweepTable_Mean | undefined {
  return means?.results.find((result) => result.field === field);
}

/** The page of a job, or the comparison of as many as fit. */
export function jobsLink(rows: SweepTable_Row[]): string {
  const ids = rows.map(({ job }) => idOf(job));
  return ids.length === 1 ? urlOf(`/jobs/${ids[0]}`) : urlOf(`/compare?jobs=${ids.slice(0, kMostCompared).join(",")}`);
}

function ofMeasure(measure: Measure, all: Means[]): CellColumn<Means> {
  const find = (means: Means): SweepTable_Mean | undefined => meanOfField(means, measure.field);
  const unit = unitFor(measure, all.map((means) => find(means)?.mean));
  const text = (value: number, digits = 3): string => measure.text?.(value) ?? number(value * unit.factor, digits);
  return {
    key: measure.field, name: titleOfMeasure(measure, unit), figure: true,
    shown: kFirstMeasures.includes(measure.field), value: (means) => find(means)?.mean,
    cell: (means) => {
      const found = find(means);
      if (!found) return "–";
      const title = `mean of ${found.jobCount}, 95 % confidence interval`;
      return h("span", { title }, text(found.mean),
               found.interval !== undefined && h("span", { class: "faint" }, ` ± ${text(found.interval, 2)}`));
    },
  };
}

export function meanColumns({ rows, fields, means }: TableData): CellColumn<Means>[] {
  const jobs = new Map<string, SweepTable_Row[]>();
  for (const row of rows) {
    const key = keyOf(row.values, fields);
    jobs.set(key, [...(jobs.get(key) ?? []), row]);
  }
  const has = ({ field }: Measure): boolean => means.some((each) => meanOfField(each, field));
  return [
    ...fields.filter((field) => !isSeed(field)).map((field, i): CellColumn<Means> => ({
      key: field, name: axisName(field), figure: true, shown: "always", value: ({ values }) => values[i],
      cell: ({ values }) => given(values[i]) })),
    { key: "jobs", name: "Seeds", shown: "always", value: ({ succeededCount }) => succeededCount,
      cell: ({ values, succeededCount, jobCount, failedCount, warnedCount }) => h("a", {
        href: jobsLink(jobs.get(values.join()) ?? []),
        title: `${failedCount} failed, ${warnedCount} with warnings` }, `${succeededCount} of ${jobCount}`) },
    ...kMeasures.filter((measure) => kFirstMeasures.includes(measure.field) || has(measure))
      .map((measure) => ofMeasure(measure, means)),
  ];
}
