// Labels, units, limits and help of the fields, from their names, and the options and comments of the protos.
import { getOption, ScalarType } from "@bufbuild/protobuf";
import { rules, type FieldRules } from "../../gen/cellcrush/v1/field_pb";
import help from "../../gen/help.json";
import { fieldAt, isTable } from "./fields";
import { columnsOf, type Column } from "./table_text";

const messages: Record<string, Record<string, string>> = help.messages;
const enums: Record<string, Record<string, string>> = help.enums;

/** Help of a field; `message` is its name without the package, such as "Lattice.Hexagon". */
export function fieldHelp(message: string, field: string): string {
  return messages[message]?.[field] ?? "";
}

const kUnits: [RegExp, string][] = [[/_kg_per_m3$/, "kg/m³"], [/_m_per_s2$/, "m/s²"], [/_m_per_s$/, "m/s"],
                                    [/_n_per_mm$/, "N/mm"], [/_n_mm$/, "N mm"], [/_mpa$/, "MPa"], [/_mj$/, "mJ"],
                                    [/_mm$/, "mm"], [/_per_s$/, "1/s"], [/_s$/, "s"], [/_deg(rees)?$/, "°"],
                                    [/_rad$/, "rad"], [/_g$/, "g"], [/_n$/, "N"]];

/** The last name of a path in words, and its unit: "wall thickness" in "mm". The unit may be empty. */
export function nameOf(path: string): { words: string; unit: string } {
  const name = path.slice(path.lastIndexOf(".") + 1);
  const [pattern, unit] = kUnits.find(([ending]) => ending.test(name)) ?? [/$/, ""];
  const ofFrame = path === "elements_per_wall" ? " or beam" : "";
  return { words: name.replace(pattern, "").replaceAll("_", " ") + ofFrame, unit };
}

const kLabels: Record<string, string> = {
  youngs_modulus_mpa: "Young’s modulus", poissons_ratio: "Poisson’s ratio",
  "plates.friction": "Friction at the plates",
  "contact.friction": "Friction between walls", thickness_steps: "Thickness by steps", size_steps: "Size by steps",
  thickness_polynomial: "Thickness by a polynomial", size_polynomial: "Size by a polynomial",
  "lattice.outline.corners_mm": "Corners of the outline",
  "lattice.outline.edge_wall_thickness_mm": "Thickness of walls along the outline",
  amplitude_mm: "Offset of joints, at most", bow_mm: "Bow of walls, at most",
  named: "Named material", beyond: "Hardening beyond the table",
  cowper_symonds_rate_per_s: "Cowper-Symonds rate D", cowper_symonds_exponent: "Cowper-Symonds exponent q",
  johnson_cook_coefficient: "Johnson-Cook coefficient C",
  johnson_cook_reference_rate_per_s: "Johnson-Cook reference rate",
  plane: "Plane stress or strain", direction: "Direction",
  sample_count: "Samples", frame_count: "Frames", vertical_wall_thickness_mm: "Thickness of the walls along y",
  gravity_x_m_per_s2: "Gravity along x", gravity_y_m_per_s2: "Gravity along y",
};

export const unitOf = (path: string): string => nameOf(path).unit;

export function labelOf(path: string): string {
  const name = path.slice(path.lastIndexOf(".") + 1);
  const known = kLabels[path] ?? kLabels[name];
  if (known) return known;
  const { words } = nameOf(path);
  return words.charAt(0).toUpperCase() + words.slice(1);
}

const messageName = (typeName: string): string => typeName.replace("cellcrush.v1.", "");

/** Help of the field at a path; of a table with that of its columns. */
export function helpOf(path: string): string {
  const { field, parent } = fieldAt(path);
  return [fieldHelp(messageName(parent.typeName), field.name),
          ...columnsOf(field).map(({ name }) => helpOf(`${path}.${name}`))].join(" ");
}

const rulesOf = (path: string): FieldRules => getOption(fieldAt(path).field, rules);

// "required without ...": where only some cases have to give a field.
const isSometimesRequired = ({ required, limits }: FieldRules): boolean => required && limits.startsWith("required ");

/** The default of a field, for an empty input. */
export function defaultOf(path: string): string {
  const of = rulesOf(path);
  return isSometimesRequired(of) ? "" : of.required ? "required" : of.default;
}

// What a row of a table has: "2 to 64 rows: rates in 1/s and factors".
function rowLimitsOf(columns: Column[]): string {
  const { minimum, maximum } = getOption(columns[0], rules);
  const names = columns.map(({ name }) => [nameOf(name).words, nameOf(name).unit].filter(Boolean).join(" in "));
  return `${minimum} to ${maximum} rows: ${names.join(" and ")}`;
}

/**
 * What a field may be, from its options: "Required, 2 to 10000" or "Default 0.8; 0.0001 to below 0.95". `origin` of its
 * value replaces that it is required, or its default.
 */
export function limitsOf(path: string, origin = ""): string {
  const columns = columnsOf(fieldAt(path).field);
  if (columns.length) return [origin, rowLimitsOf(columns)].filter(Boolean).join("; ");
  const of = rulesOf(path);
  const { required, default: value, minimum, maximum, below, upTo, limits } = of;
  const most = maximum === undefined ? upTo : number(maximum);
  const isList = fieldAt(path).field.fieldKind === "list";
  const range = isList ? `numbers separated by blanks, at most ${most}`
    : minimum === undefined ? "" : `${number(minimum)} to ${below ? "below " : ""}${most}`;
  if (isSometimesRequired(of)) return [`R${limits.slice(1)}`, range].filter(Boolean).join("; ");
  const all = [range, limits].filter(Boolean).join(", ");
  const start = origin || (required ? "Required" : value && `Default ${value}`);
  return [start, all].filter(Boolean).join(required && !origin ? ", " : "; ");
}

/** Where in the value of a field a problem is, to begin a sentence: "Stresses, row 2"; empty for the field itself. */
export function placeIn(path: string, place: string): string {
  const [, column, index] = place.slice(path.length).match(/^(\.\w+)?(?:\[(\d+)\])?$/) ?? [];
  const number = index !== undefined && `${isTable(path) ? "row" : "entry"} ${Number(index) + 1}`;
  return [column && labelOf(path + column), number].filter(Boolean).join(", ");
}

// As in a case file: "1e-6", "100000".
const number = (value: number): string =>
  (Math.abs(value) >= 1e6 || (value !== 0 && Math.abs(value) < 1e-4) ? value.toExponential() : String(value))
    .replace("e+", "e");

export interface Choice { value: string; label: string; help: string }

/** The values of an enum field, without the one that stands for the default, or of a field that is true or false. */
export function choicesOf(path: string): Choice[] {
  const { field } = fieldAt(path);
  if (field.fieldKind === "scalar" && field.scalar === ScalarType.BOOL) {
    return ["true", "false"].map((value) => ({ value, label: value, help: "" }));
  }
  if (field.fieldKind !== "enum") return [];
  const of = messageName(field.enum.typeName);
  return field.enum.values.filter((value) => value.number !== 0).map(({ name }) =>
    ({ value: name, label: name.toLowerCase().replaceAll("_", " "), help: enums[of]?.[name] ?? "" }));
}
