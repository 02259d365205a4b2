import type { Case } from "../../gen/cellcrush/v1/case_pb";

/** When not to compare a lattice with theory, as sentences; empty where theory applies. */
export function theoryNote(value: Case | undefined): string {
  const { lattice } = value ?? {};
  const kind = lattice?.kind.case;
  const notes: string[] = [];
  if (kind === "square" || kind === "triangle") {
    notes.push(`${kind === "square" ? "Squares" : "Triangles"} are stretch-dominated: the quasi-static stress is the `
      + "axial yield stress of straight walls, an upper bound. If the walls buckle, the lattice crushes at a far lower "
      + "stress. Then neither the quasi-static stress nor Eq. 51, which builds on it, predicts the plateau.");
  }
  if (lattice?.inclusions?.rows.length) notes.push("The theory ignores the stiff cells.");
  return notes.join(" ");
}
