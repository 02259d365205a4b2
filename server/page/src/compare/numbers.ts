// The numbers of several jobs side by side, and all fields in which their cases differ.
import type { Summary } from "../../gen/cellcrush/v1/sample_pb";
import { idOf, pathOf } from "../api/names";
import { h } from "../dom/element";
import { number } from "../dom/format";
import { kSummaryNumbers } from "../job/results";
import type { JobData } from "../job/job_data";
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
  for (const { no, data } of message.getUnknown() ?? []) {
    yield [`${prefix}${no} (of a newer server)`, data.join(" ")];
  }
}

/** The value of every field of a case, by its path; a title names a job and is none of them. */
export function caseValues(value: Case): Map<string, string> {
  const values = new Map(valuesOf(reflect(CaseSchema, value), ""));
  values.delete("title");
  return values;
}

const kNumbers: [string, (s: Summary) => string][] = [
  ...kSummaryNumbers.map(({ name, value, text }): [string, (s: Summary) => string] => [name, (s) => text(value(s))]),
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
