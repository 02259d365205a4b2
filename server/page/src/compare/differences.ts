// All fields of a case, for a comparison that overlooks none.
import { ScalarType } from "@bufbuild/protobuf";
import { reflect, type ReflectMessage } from "@bufbuild/protobuf/reflect";
import { CaseSchema, type Case } from "../../gen/cellcrush/v1/case_pb";

// One entry of a list: a message in one line, or a value.
const entry = (value: unknown): string =>
  typeof value === "object" && value !== null ? [...valuesOf(value as ReflectMessage, "")]
    .map(([name, text]) => `${name} ${text}`).join(" ") : String(value);

function* valuesOf(message: ReflectMessage, prefix: string): Generator<[string, string]> {
  for (const field of message.fields) {
    if (!message.isSet(field)) continue;
    const path = prefix + field.name;
    if (field.fieldKind === "message") yield* valuesOf(message.get(field), `${path}.`);
    else if (field.fieldKind === "list") yield [path, [...message.get(field)].map(entry).join(", ")];
    else if (field.fieldKind === "enum") yield [path, field.enum.value[message.get(field)]?.name ?? "unknown"];
    else if (field.fieldKind === "scalar" && field.scalar !== ScalarType.BYTES) {
      yield [path, String(message.get(field))];
    }
  }
}

/** The value of every field of a case, by its path; a title names a job and is none of them. */
export function caseValues(value: Case): Map<string, string> {
  const values = new Map(valuesOf(reflect(CaseSchema, value), ""));
  values.delete("title");
  return values;
}
