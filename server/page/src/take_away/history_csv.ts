import { ScalarType, type DescMessage } from "@bufbuild/protobuf";
import { FrontSchema, SampleSchema, type Front, type Sample } from "../../gen/cellcrush/v1/sample_pb";
import { csvBlob } from "../dom/download";

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
const kColumns = [
  ...columnsOf(SampleSchema, ScalarType.DOUBLE, "", (sample) => sample),
  ...columnsOf(FrontSchema, ScalarType.DOUBLE, "front_", (sample) => sample.front),
  ...columnsOf(SampleSchema, ScalarType.INT64, "", (sample) => sample),
];

export function historyCsv(samples: Sample[]): Blob {
  return csvBlob(kColumns.map(({ name }) => name), samples.map((sample) => kColumns.map(({ value }) => value(sample))));
}
