// The fields of the form, and access to the fields of a case by their paths in the protos.
import { create, getOption, ScalarType, type DescField, type DescMessage } from "@bufbuild/protobuf";
import { reflect, type ReflectMessage } from "@bufbuild/protobuf/reflect";
import { CaseSchema, LatticeSchema, LoadingSchema, MaterialSchema, type Case } from "../../gen/cellcrush/v1/case_pb";
import { rules } from "../../gen/cellcrush/v1/field_pb";
import { columnsOf, rowsOf, setRows, tableText } from "./table_text";
import { entriesOf, readReal, readWhole, type TypedNumber } from "./typed_number";

export type LatticeKind = DescField & { fieldKind: "message" };

export const kLatticeKinds = LatticeSchema.oneofs.find(({ name }) => name === "kind")!.fields.filter(
  (field): field is LatticeKind => field.fieldKind === "message");

/** Whether the walls of a kind are listed one by one, which a form cannot do. */
export const isListed = (kind: LatticeKind): boolean =>
  kind.message.fields.some((field) => field.fieldKind === "list" && getOption(field, rules).required);

/** A group that is not open is folded until the case, or a problem, has something of it. */
export interface Group { title: string; paths: string[]; isOpen: boolean }

const singleFields = (message: DescMessage): string[] => message.fields.filter(({ fieldKind }) =>
  fieldKind === "scalar" || fieldKind === "enum").map(({ name }) => name);

const kMaterial = ["named", "youngs_modulus_mpa", "yield_stress_mpa", "density_kg_per_m3", "hardening_modulus_mpa"];
const kCrush = ["direction", "speed_m_per_s", "quasi_static", "kinetic_share", "end_strain", "ramp_strain"];

/** The groups of the form for a kind of lattice. What a kind has at a place of its own is not in its loading. */
export function groupsOf(kind: LatticeKind): Group[] {
  const ofKind = singleFields(kind.message);
  const further = singleFields(LoadingSchema).filter((name) => !kCrush.includes(name) && !ofKind.includes(name));
  const under = (parent: string, names: string[]): string[] => names.map((name) => `${parent}.${name}`);
  const groups = [
    { title: "Lattice", isOpen: true, paths: [...under(`lattice.${kind.name}`, ofKind), "depth_mm"] },
    { title: "Material", isOpen: true, paths: under("material", kMaterial) },
    { title: "Crush", isOpen: !isListed(kind), paths: [...under("loading", kCrush), "plates.friction"] },
    { title: "Further loads and ends", isOpen: false, paths: [...under("loading", further), "loading.sides.kind",
      "loading.sides.friction", "loading.sides.fixed_width",
      ...(kind.name === "network" ? ["loading.sides.period_mm"] : [])] },
    { title: "Imperfection", isOpen: false, paths: isListed(kind) ? []
      : under("lattice.imperfection", ["amplitude_mm", "seed", "bow_mm"]) },
    { title: "Defects and rotation", isOpen: false, paths: isListed(kind) ? []
      : [...under("lattice.defects", ["missing_walls", "thickness_scatter", "seed"]), "lattice.rotation_degrees"] },
    { title: "Grading and outline", isOpen: false, paths: isListed(kind) ? []
      : [...under("lattice.grading", ["axis", "thickness_steps", "thickness_polynomial", "size_steps",
        "size_polynomial"]), ...under("lattice.outline", ["corners_mm", "edge_wall_thickness_mm"])] },
    { title: "Material, further", isOpen: false, paths: under("material", [...singleFields(MaterialSchema).filter(
      (name) => !kMaterial.includes(name)), "hardening_table", "hardening_table.beyond", "rate_table"]) },
    { title: "Mesh and section", isOpen: false, paths: ["numerics.fidelity", "elements_per_wall",
      ...under("section", ["formulation", "axial_points", "depth_points", "depth_rule", "area_rule",
                        "shear_deformation", "shear_factor", "coupled_bending"])] },
    { title: "Contact", isOpen: false, paths: under("contact", ["friction", "stiffness_factor", "damping_ratio",
      "search", "impact_speed_m_per_s"]) },
    { title: "Run", isOpen: false, paths: [...under("numerics", ["threads", "time_step_s", "mass_damping_per_s",
      "mass_scaling", "rotary_scaling", "rigid_link_slenderness", "fibre_precision"]),
      ...under("output", ["sample_count", "frame_count"])] },
  ];
  return groups.filter(({ paths }) => paths.length > 0);
}

/** Whether a field holds one number, such as the axis of a sweep can. */
export const isNumber = (path: string): boolean => typedAt(path, "") !== undefined;

/** Whether a field is a table of numbers, whose text has one row a point. */
export const isTable = (path: string): boolean => columnsOf(fieldAt(path).field).length > 0;

export interface Place { field: DescField; parent: DescMessage }

/** The field at a path and the message it belongs to. */
export function fieldAt(path: string): Place {
  let parent: DescMessage = CaseSchema;
  const names = path.split(".");
  for (const [i, name] of names.entries()) {
    const field = parent.fields.find((candidate) => candidate.name === name);
    if (!field) throw new Error(`There is no field ${path}.`);
    if (i === names.length - 1) return { field, parent };
    if (field.fieldKind !== "message") throw new Error(`${name} has no fields.`);
    parent = field.message;
  }
  throw new Error("An empty path has no field.");
}

// The message that holds the field at a path; messages on the way are made if wanted.
function holderOf(value: Case, path: string, makes: boolean): ReflectMessage | undefined {
  let message = reflect(CaseSchema, value);
  for (const name of path.split(".").slice(0, -1)) {
    const field = message.fields.find((candidate) => candidate.name === name);
    if (field?.fieldKind !== "message") return undefined;
    if (!message.isSet(field)) {
      if (!makes) return undefined;
      message.set(field, reflect(field.message, create(field.message)));
    }
    message = message.get(field) as ReflectMessage;
  }
  return message;
}

// One entry of a list: a message in one line, or a value.
const entryText = (entry: unknown): string => typeof entry !== "object" || entry === null ? String(entry)
  : [...valuesOf(entry as ReflectMessage, "")].map(([name, text]) => `${name} ${text}`).join(" ");

function textOf(message: ReflectMessage, field: DescField): string {
  if (field.fieldKind === "list") return [...message.get(field)].map(entryText).join(", ");
  if (field.fieldKind === "message") return entryText(message.get(field));
  if (field.fieldKind === "enum") return field.enum.value[message.get(field)]?.name ?? "unknown";
  return String(message.get(field));
}

// All that is set, by its path; lists are one value.
function* valuesOf(message: ReflectMessage, prefix: string): Generator<[string, string]> {
  for (const field of message.fields) {
    if (!message.isSet(field)) continue;
    const path = prefix + field.name;
    if (field.fieldKind === "message") yield* valuesOf(message.get(field), `${path}.`);
    else yield [path, textOf(message, field)];
  }
  for (const { no, data } of message.getUnknown() ?? []) yield [`${prefix}${no} (of a newer server)`, data.join(" ")];
}

/** The value of every field of a case, by its path; a title names a job and is none of them. */
export function caseValues(value: Case): Map<string, string> {
  const values = new Map(valuesOf(reflect(CaseSchema, value), ""));
  values.delete("title");
  return values;
}

/** The paths of what a case has beside the title and the fields of a form: of messages, if they have none of these. */
export function pathsBeside(value: Case, inForm: string[]): string[] {
  const walk = (message: ReflectMessage, prefix: string): string[] => message.fields.flatMap((field) => {
    const path = prefix + field.name;
    if (!message.isSet(field) || inForm.includes(path) || path === "title") return [];
    const isSplit = field.fieldKind === "message" && inForm.some((each) => each.startsWith(`${path}.`));
    return isSplit ? walk(message.get(field) as ReflectMessage, `${path}.`) : [path];
  });
  return walk(reflect(CaseSchema, value), "");
}

const kLines = 3;

/** What is set at a path in lines: the first entries of a list, or a value. */
export function linesOf(value: Case, path: string): string[] {
  const { field } = fieldAt(path);
  const holder = holderOf(value, path, false)!;
  if (field.fieldKind !== "list") return [textOf(holder, field)];
  const entries = [...holder.get(field)];
  const more = entries.length - kLines;
  return [...entries.slice(0, kLines).map(entryText), ...(more > 0 ? [`and ${more} more`] : [])];
}

/** The value at a path as text; empty if it is not set. */
export function readField(value: Case, path: string): string {
  const { field } = fieldAt(path);
  const holder = holderOf(value, path, false);
  if (!holder?.isSet(field)) return "";
  const columns = columnsOf(field);
  return columns.length ? tableText(holder.get(field) as ReflectMessage, columns) : textOf(holder, field);
}

/** Sets the value at a path from text; an empty text clears it. Returns whether the text is a value of the field. */
export function writeField(value: Case, path: string, text: string): boolean {
  const { field } = fieldAt(path);
  const trimmed = text.trim();
  const holder = holderOf(value, path, trimmed !== "");
  if (trimmed === "") {
    holder?.clear(field);
    return true;
  }
  if (field.fieldKind === "list") return holder !== undefined && writeNumbers(holder, field, trimmed);
  if (field.fieldKind === "message") return writeTable(value, path, trimmed);
  const parsed = parse(field, trimmed);
  if (!holder || parsed === undefined) return false;
  try {
    holder.set(field as never, parsed as never);
    return true;
  } catch {
    return false; // such as a fraction for a count
  }
}

function writeNumbers(holder: ReflectMessage, field: DescField & { fieldKind: "list" }, text: string): boolean {
  const numbers = entriesOf(text).map((entry) => readReal(entry).plain);
  if (field.listKind !== "scalar" || field.scalar !== ScalarType.DOUBLE || numbers.includes(undefined)) return false;
  const list = holder.get(field);
  list.clear();
  for (const number of numbers) list.add(Number(number));
  return true;
}

// What a table has beside its rows stays.
function writeTable(value: Case, path: string, text: string): boolean {
  const columns = columnsOf(fieldAt(path).field);
  const rows = rowsOf(text, columns.length);
  if (columns.length === 0 || typeof rows === "string") return false;
  setRows(holderOf(value, `${path}.${columns[0].name}`, true)!, columns, rows);
  return true;
}

function parse(field: DescField, text: string): unknown {
  if (field.fieldKind === "enum") return field.enum.values.find(({ name }) => name === text)?.number;
  if (field.fieldKind !== "scalar") return undefined;
  const typed = typedFor(field, text);
  switch (field.scalar) {
    case ScalarType.STRING: return text;
    case ScalarType.BOOL: return text === "true";
    case ScalarType.INT64:
    case ScalarType.UINT64: return typed?.plain && BigInt(typed.plain);
    default: return typed?.plain && Number(typed.plain);
  }
}

function typedFor(field: DescField, text: string): TypedNumber | undefined {
  if (field.fieldKind === "list") {
    const faulty = entriesOf(text).find((entry) => readReal(entry).problem);
    if (faulty === undefined) return undefined;
    return { problem: `has an entry, “${faulty}”, that ${readReal(faulty).problem}` };
  }
  if (field.fieldKind === "message") {
    const rows = rowsOf(text, columnsOf(field).length);
    return typeof rows === "string" ? { problem: rows } : undefined;
  }
  switch (field.fieldKind === "scalar" ? field.scalar : undefined) {
    case ScalarType.DOUBLE: return readReal(text);
    case ScalarType.INT32:
    case ScalarType.INT64:
    case ScalarType.UINT64: return readWhole(text);
    default: return undefined;
  }
}

/** What a text is for the field at a path, if that is a number; of a list or a table, only what is wrong with it. */
export const typedAt = (path: string, text: string): TypedNumber | undefined => typedFor(fieldAt(path).field, text);
