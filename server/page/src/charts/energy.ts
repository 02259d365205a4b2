// The energy ledger as stacked areas: what became of the work of the plates.
import { getOption, hasOption } from "@bufbuild/protobuf";
import { term } from "../../gen/cellcrush/v1/field_pb";
import { SampleSchema, type Sample } from "../../gen/cellcrush/v1/sample_pb";
import { unitBySize } from "../dom/format";
import type { ChartData, Series } from "./chart_data";
import { finite, thin, type Axis } from "./curves";

interface Term { label: string; colour: string; value(sample: Sample): number }

const kColours = 8; // --energy-1 and on
const valueOf = (sample: Sample, localName: string): number =>
  Number((sample as unknown as Record<string, unknown>)[localName]);

// The numbers of a sample that have the option `term`, the lowest area first.
const kTerms: Term[] = SampleSchema.fields.filter((field) => hasOption(field, term))
  .map((field) => ({ field, of: getOption(field, term) })).sort((a, b) => a.of.place - b.of.place)
  .map(({ field, of }) => {
    const part = SampleSchema.fields.find(({ name }) => name === of.without);
    return {
      label: of.label, colour: `energy-${(of.place - 1) % kColours + 1}`,
      value: (sample) => valueOf(sample, field.localName) - (part ? valueOf(sample, part.localName) : 0),
    };
  });
const kVisibleShare = 0.002; // a term that stays below this part of the work is left out
const kMostPoints = 1500;

export function energyChart(samples: Sample[], axis: Axis, workOf = "work of the plates"): ChartData {
  const all = finite(samples, axis);
  const kept = thin(all.map((s) => s.energyKineticMj), kMostPoints).map((place) => all[place]);
  const most = kept.reduce((value, s) => Math.max(value, s.workExternalMj), 0);
  const { name: unit, factor: perMj } = unitBySize("mJ", most);
  const terms = kTerms.filter((term) => kept.some((s) => Math.abs(term.value(s)) > kVisibleShare * most));
  const sums = kept.map(() => 0);
  let low = 0;
  let high = most * perMj;
  const stacked = terms.map((term) => kept.map((sample, i) => {
    sums[i] += term.value(sample) * perMj;
    low = Math.min(low, sums[i]);
    high = Math.max(high, sums[i]);
    return sums[i];
  }));
  // The highest area comes first, so that the lower ones cover it.
  const areas: Series[] = terms.map((term) => ({
    label: term.label, colour: term.colour, width: 0, fill: true,
    legendValue: (i) => (kept[i] ? term.value(kept[i]) * perMj : undefined),
  }));
  return {
    series: [...areas.reverse(), { label: workOf, colour: "ink", width: 1.5 }],
    columns: [kept.map((s) => axis.sample(s)), ...stacked.reverse(), kept.map((s) => s.workExternalMj * perMj)],
    xLabel: axis.label, yLabel: `energy (${unit})`, xEnd: axis.end,
    yLow: low < 0 ? 1.1 * low : 0, yTop: high > 0 ? 1.06 * high : 1,
    note: "totals since the start; the gap between the areas and the work is the residual",
  };
}
