// The fields of the form, and access to them by their paths in the protos.
import type { Case } from "../../gen/cellcrush/v1/case_pb";
import { CaseSchema, LatticeSchema, MaterialSchema } from "../../gen/cellcrush/v1/case_pb";
import { create, type DescField, type DescMessage } from "@bufbuild/protobuf";
import { reflect, type ReflectMessage } from "@bufbuild/protobuf/reflect";

export type LatticeKind = DescField & { fieldKind: "message" };

export interface Group { title: string; paths: string[]; isOpen: boolean }

/** All kinds of lattices of equal cells. */
export const kLatticeKinds = LatticeSchema.oneofs.find(({ name }) => name === "kind")!.fields.filter(
  (field): field is LatticeKind => field.fieldKind === "message" && field.name !== "frame");

/** The groups of the form for a kind of lattice; rarely changed fields are folded away. */
export function groupsOf(kind: LatticeKind): Group[] {
  const sizes = kind.message.fields.map(({ name }) => `lattice.${kind.name}.${name}`);
  const material = ["youngs_modulus_mpa", "yield_stress_mpa", "density_kg_per_m3", "hardening_modulus_mpa"];
  const further = MaterialSchema.fields.map(({ name }) => name).filter((name) => !material.includes(name));
  return [
    { title: "Lattice", isOpen: true, paths: [...sizes, "depth_mm"] },
    { title: "Material", isOpen: true, paths: material.map((name) => `material.${name}`) },
    { title: "Crush", isOpen: true, paths: ["loading.direction", "loading.speed_m_per_s", "loading.end_strain",
      "loading.ramp_strain", "plates.friction"] },
    { title: "Imperfection", isOpen: false, paths: ["amplitude_mm", "seed", "bow_mm"].map((name) =>
      `lattice.imperfection.${name}`) },
    { title: "Material, further", isOpen: false, paths: further.map((name) => `material.${name}`) },
    { title: "Mesh and section", isOpen: false, paths: ["numerics.fidelity", "elements_per_wall",
      "section.formulation", "section.axial_points", "section.depth_points", "section.depth_rule",
      "section.area_rule"] },
    { title: "Contact", isOpen: false, paths: ["friction", "stiffness_factor", "damping_ratio", "search",
      "impact_speed_m_per_s"].map((name) => `contact.${name}`) },
    { title: "Run", isOpen: false, paths: ["numerics.threads", "numerics.time_step_s", "numerics.mass_damping_per_s",
      "numerics.mass_scaling", "numerics.rotary_scaling", "numerics.fibre_precision", "output.sample_count",
      "output.frame_count"] },
  ];
}

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

/** The value at a path as text; empty if it is not set. */
export function readField(value: Case, path: string): string {
  const { field } = fieldAt(path);
  const holder = holderOf(value, path, false);
  if (!holder?.isSet(field)) return "";
  return String(holder.get(field));
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
  if (!holder) return false;
  if (field.fieldKind === "enum") return setValue(holder, field, Number(trimmed));
  if (field.fieldKind !== "scalar") return false;
  const plain = trimmed.replace(",", ".").replace(/\s/g, "");
  if (typeof scalarZero(field) === "bigint") return /^\d+$/.test(plain) && setValue(holder, field, BigInt(plain));
  const number = Number(plain);
  return Number.isFinite(number) && setValue(holder, field, number);
}

function scalarZero(field: DescField): unknown {
  return field.fieldKind === "scalar" && (field.scalar === 4 || field.scalar === 3) ? 0n : 0; // uint64, int64
}

function setValue(holder: ReflectMessage, field: DescField, value: number | bigint): boolean {
  try {
    holder.set(field as never, value as never);
    return true;
  } catch {
    return false; // such as a fraction for a count
  }
}
