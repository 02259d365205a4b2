// Any number of the samples of a job over its axis.
import { ScalarType, type DescMessage } from "@bufbuild/protobuf";
import { FrontSchema, SampleSchema, type Front, type Sample } from "../../gen/cellcrush/v1/sample_pb";
import { unitBySize } from "../dom/format";
import { nameOf } from "../new_case/words";
import type { ChartData } from "./chart_data";
import { finite, thin, type Axis } from "./curves";

const kMostPoints = 3000;

interface Column { name: string; value: (sample: Sample) => number | undefined }

function columnsOf(schema: DescMessage, scalar: ScalarType, prefix: string,
                   part: (sample: Sample) => Sample | Front | undefined): Column[] {
  return schema.fields.filter((field) => field.fieldKind === "scalar" && field.scalar === scalar).map((field) => ({
    name: prefix + field.name,
    value: (sample) => {
      const numbers = part(sample) as Record<string, unknown> | undefined;
      return numbers && Number(numbers[field.localName]);
    },
  }));
}

// Every number of a sample and its front, as in /history of result.h5; the counts last.
export const kSampleColumns: Column[] = [
  ...columnsOf(SampleSchema, ScalarType.DOUBLE, "", (sample) => sample),
  ...columnsOf(FrontSchema, ScalarType.DOUBLE, "front_", (sample) => sample.front),
  ...columnsOf(SampleSchema, ScalarType.INT64, "", (sample) => sample),
];

/** "front strain behind" and its unit. */
export const wordsOfColumn = (name: string): string => nameOf(name).words;

export function sampleChart(samples: Sample[], axis: Axis, name: string): ChartData {
  const { words, unit } = nameOf(name);
  const { value } = kSampleColumns.find((column) => column.name === name)!;
  const all = finite(samples, axis);
  const numbers = all.map((sample) => value(sample) ?? NaN);
  const places = thin(numbers.map((each) => (Number.isFinite(each) ? each : 0)), kMostPoints);
  const known = numbers.filter(Number.isFinite);
  const [low, high] = known.reduce(([least, most], each) => [Math.min(least, each), Math.max(most, each)], [0, 0]);
  const { name: unitName, factor } = unitBySize(unit, Math.max(-low, high));
  return {
    series: [{ label: words, colour: "series-0", width: 1.5 }],
    columns: [places.map((i) => axis.sample(all[i])),
              places.map((i) => (Number.isFinite(numbers[i]) ? numbers[i] * factor : null))],
    xLabel: axis.label, yLabel: unitName ? `${words} (${unitName})` : words, xEnd: axis.end,
    yLow: 1.06 * low * factor, yTop: high > low ? 1.06 * high * factor : 1,
  };
}
