// The numbers of a summary, for columns of tables and axes of charts: those that people ask for first, then all others.
import type { DescMessage } from "@bufbuild/protobuf";
import { SummarySchema, type Summary } from "../../gen/cellcrush/v1/sample_pb";
import { number, percent, quantity, unitBySize, type Unit } from "../dom/format";
import { nameOf } from "../new_case/words";

export interface Measure {
  /** Path in the summary. */
  field: string;
  words: string;
  /** Unit of the field, "" if it has none. */
  unit: string;
  text?: (value: number | undefined) => string;
  value(s: Summary): number | undefined;
}

// The numbers of a message and of the messages in it, by their paths; oneofs and lists are none.
function pathsOf(schema: DescMessage, prefix = ""): string[] {
  return schema.fields.flatMap((field) => {
    if (field.fieldKind === "message") return pathsOf(field.message, `${prefix}${field.name}.`);
    return field.fieldKind === "scalar" && !field.name.endsWith("_words") ? [prefix + field.name] : [];
  });
}

const localName = (name: string): string => name.replace(/_(\w)/g, (_, letter: string) => letter.toUpperCase());

function valueAt(path: string): (s: Summary) => number | undefined {
  const names = path.split(".").map(localName);
  return (s) => {
    const found = names.reduce<unknown>((part, name) => (part as Record<string, unknown> | undefined)?.[name], s);
    return found === undefined ? undefined : Number(found);
  };
}

const kWords: Record<string, string> = {
  plateau_stress_impact_mpa: "Impact plateau", plateau_stress_support_mpa: "Support plateau",
  "theory.shock_mpa": "Shock theory (Eq. 51)", "theory.gibson_ashby_mpa": "Gibson-Ashby",
  densification_strain: "Densification strain", valid_to_strain: "Valid to strain",
  other_rise_strain: "Other lasting rise of the stress", absorbed_energy_mj: "Absorbed energy",
  energy_error_relative: "Ledger error", plateau_stress_to_densification_mpa: "Mean stress to densification",
  "front.shock_mpa": "Shock theory, measured jumps (Eq. 52)",
  "theory.densification_strain": "Densification strain, theory",
};

/** Those that tables show until the user chooses others. */
export const kFirstMeasures = ["plateau_stress_impact_mpa", "plateau_stress_support_mpa", "theory.shock_mpa",
                               "densification_strain", "absorbed_energy_mj", "energy_error_relative"];
const kConstant = ["plateau_window_low", "plateau_window_high", "peak_stress_window"];

function measureOf(field: string): Measure {
  const { words, unit } = nameOf(field);
  const named = field.includes(".") ? `${field.slice(0, field.indexOf(".")).replace("_", " ")}: ${words}` : words;
  const value = valueAt(field);
  return {
    field, unit, words: kWords[field] ?? named.charAt(0).toUpperCase() + named.slice(1),
    text: /_relative$/.test(field) ? (share) => percent(share, 3) : undefined,
    // A theory of 0 is none.
    value: field.startsWith("theory.") ? (s) => value(s) || undefined : value,
  };
}

const kFields = new Set([...kFirstMeasures, ...Object.keys(kWords), ...pathsOf(SummarySchema)]);

export const kMeasures: Measure[] = [...kFields]
  .filter((field) => !kConstant.includes(field) && !/^(stage_times|warnings)\./.test(field))
  .map(measureOf);

/** The unit for all of some values, by the largest of them. */
export function unitFor({ unit }: Pick<Measure, "unit">, values: (number | undefined)[]): Unit {
  return unitBySize(unit, Math.max(0, ...values.map((value) => Math.abs(value ?? 0)).filter(Number.isFinite)));
}

/** "Impact plateau, MPa". */
export const titleOfMeasure = ({ words }: Measure, { name }: Unit): string => (name ? `${words}, ${name}` : words);

export function measureText({ text, value }: Measure, s: Summary, { factor }: Unit): string {
  const found = value(s);
  return text ? text(found) : number(found === undefined ? undefined : found * factor);
}

export const textWithUnit = ({ text, value, unit }: Measure, s: Summary): string =>
  (text ? text(value(s)) : quantity(value(s), unit));
