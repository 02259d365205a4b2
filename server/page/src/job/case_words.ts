// A case in a few words.
import { Loading_Direction, Material_Plane, type Case } from "../../gen/cellcrush/v1/case_pb";
import { number } from "../dom/format";

const given = (value: number | undefined, digits = 4): string => (value === undefined ? "–" : String(Number(
  value.toPrecision(digits))));

export function latticeWords(value: Case): string {
  const kind = value.lattice?.kind;
  switch (kind?.case) {
    case "hexagon":
    case "square":
    case "triangle": {
      const noun = { hexagon: "hexagons", square: "squares", triangle: "triangles" }[kind.case];
      return `${noun}, ${given(kind.value.columns)} × ${given(kind.value.rows)} cells`;
    }
    case "frame": return `frame of ${kind.value.beams.length} beams`;
    default: return "no lattice";
  }
}

/** Whether two plates crush the lattice. Those around a frame are given by their speed. */
export function hasPlates(value: Case | undefined): boolean {
  return value?.lattice?.kind.case !== "frame" || value.loading?.speedMPerS !== undefined;
}

export function speedWords(value: Case): string {
  const { loading } = value;
  if (!loading) return "driven by its own loads";
  return `along ${loading.direction === Loading_Direction.Y ? "y" : "x"} at ${given(loading.speedMPerS)} m/s`;
}

function loadingWords(value: Case): string {
  return speedWords(value) + (value.loading ? ` to strain ${given(value.loading.endStrain ?? 0.8)}` : "");
}

/** Facts of a case, as pairs of a name and a value. */
export function caseFacts(value: Case): [string, string][] {
  const facts: [string, string][] = [["lattice", latticeWords(value)], ["crush", loadingWords(value)]];
  const kind = value.lattice?.kind;
  if (kind?.case === "hexagon" || kind?.case === "square" || kind?.case === "triangle") {
    facts.push(["side of a cell", `${given(kind.value.sideMm)} mm`]);
    facts.push(["wall thickness", `${given(kind.value.wallThicknessMm)} mm`]);
  }
  if (value.depthMm !== undefined) facts.push(["depth", `${given(value.depthMm)} mm`]);
  const { material } = value;
  if (material) {
    facts.push(["Young’s modulus", `${number(material.youngsModulusMpa, 4)} MPa`]);
    facts.push(["yield stress", `${given(material.yieldStressMpa)} MPa`]);
    facts.push(["density", `${given(material.densityKgPerM3)} kg/m³`]);
    if (material.plane === Material_Plane.STRAIN) facts.push(["state of the walls", "plane strain"]);
  }
  if (value.elementsPerWall) facts.push(["elements per wall", given(value.elementsPerWall)]);
  const { imperfection } = value.lattice ?? {};
  if (imperfection?.amplitudeMm) {
    facts.push(["offsets of joints", `up to ${given(imperfection.amplitudeMm)} mm, seed ${imperfection.seed ?? 0n}`]);
  }
  if (imperfection?.bowMm) facts.push(["bow of walls", `up to ${given(imperfection.bowMm)} mm`]);
  if (value.plates?.friction) facts.push(["friction at the plates", given(value.plates.friction)]);
  if (value.contact?.friction) facts.push(["friction between walls", given(value.contact.friction)]);
  return facts;
}

/** Width over height of the undeformed lattice; undefined for a frame. */
export function aspectOf(value: Case): number | undefined {
  const kind = value.lattice?.kind;
  if (kind?.case !== "hexagon" && kind?.case !== "square" && kind?.case !== "triangle") return undefined;
  const { columns = 1, rows = 1 } = kind.value;
  if (kind.case === "hexagon") return (Math.sqrt(3) * columns) / (1.5 * rows + 0.5);
  return kind.case === "square" ? columns / rows : (columns + 0.5) / (0.5 * Math.sqrt(3) * rows);
}
