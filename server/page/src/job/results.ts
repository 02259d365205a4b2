// The numbers of a result, with units, beside theory.
import type { Summary, Theory } from "../../gen/cellcrush/v1/sample_pb";
import { h } from "../dom/element";
import { count, duration, number, percent, strainText } from "../dom/format";
import { fieldHelp } from "../help";

interface Result { name: string; field: string; value: string; unit?: string; beside?: string }

function besideTheory(value: number | undefined, theory: number | undefined, name: string): string {
  if (!value || !theory) return "";
  const ratio = theory / value - 1;
  return `${name} ${number(theory)} MPa, ${percent(Math.abs(ratio))} ${ratio >= 0 ? "higher" : "lower"}`;
}

function energy(mj: number): [string, string] {
  return mj < 1000 ? [number(mj), "mJ"] : [number(mj / 1000), "J"];
}

function resultsOf(s: Summary, theory: Theory | undefined, note: string): Result[] {
  const beside = note ? () => "" : besideTheory;
  const results: Result[] = [];
  if (s.plateauStressImpactMpa !== undefined || theory?.gibsonAshbyMpa) {
    results.push(
      { name: "Plateau stress, impact plate", field: "plateau_stress_impact_mpa",
        value: number(s.plateauStressImpactMpa), unit: "MPa",
        beside: s.plateauStressImpactMpa === undefined ? "the run ended before strain 0.40"
          : beside(s.plateauStressImpactMpa, theory?.shockMpa, "shock theory (Eq. 51)") },
      { name: "Plateau stress, support plate", field: "plateau_stress_support_mpa",
        value: number(s.plateauStressSupportMpa), unit: "MPa",
        beside: beside(s.plateauStressSupportMpa, theory?.gibsonAshbyMpa, "Gibson-Ashby") },
      { name: "Densification strain", field: "densification_strain",
        value: s.densificationStrain === undefined ? "–" : strainText(s.densificationStrain),
        beside: s.densificationStrain === undefined ? "no lasting rise of the stress" : "" });
  }
  if (s.plateauStressToDensificationMpa !== undefined) {
    results.push({ name: "Mean stress to densification", field: "plateau_stress_to_densification_mpa",
                   value: number(s.plateauStressToDensificationMpa), unit: "MPa" });
  }
  const [absorbed, unit] = energy(s.absorbedEnergyMj);
  if (s.absorbedEnergyMj) {
    results.push({ name: "Absorbed energy", field: "absorbed_energy_mj", value: absorbed, unit,
                   beside: "to strain 0.50, or the end of a shorter run" });
  }
  const mode = theory?.gibsonAshbyMpa ? s.crushModeWords : undefined; // a frame has no cells
  if (mode) {
    const since = s.crushModeStrain === undefined ? "" : `first seen at strain ${strainText(s.crushModeStrain)}`;
    results.push({ name: "Crush mode", field: "crush_mode", value: mode, beside: since });
  }
  if (s.front) {
    results.push({ name: "Strain behind the front", field: "front", value: number(s.front.strainBehind),
                   beside: `shock theory, measured jumps (Eq. 52) ${number(s.front.shockMpa)} MPa` });
  }
  if (s.quasiStatic) {
    results.push({ name: "Difference between the plates", field: "quasi_static",
                   value: percent(s.quasiStatic.plateDifferenceRelative), beside: "of their mean; 0 if quasi-static" });
  }
  results.push({ name: "Energy ledger error", field: "energy_error_relative",
                 value: percent(s.energyErrorRelative, 3) });
  results.push({ name: "Deepest penetration", field: "deepest_penetration", value: percent(s.deepestPenetration),
                 beside: "of the thickness of the thinner wall" });
  results.push({ name: "Solver time", field: "solver_seconds", value: duration(s.solverSeconds),
                 beside: `${count(s.stepCount)} steps` });
  return results;
}

/** `note` says when not to compare with theory. */
export function resultsList(summary: Summary, note: string): HTMLElement {
  return h("dl", { class: "results" }, ...resultsOf(summary, summary.theory, note).map((result) =>
    h("div", { title: fieldHelp("Summary", result.field) }, h("dt", {}, result.name),
      h("dd", {}, h("b", {}, result.value), result.unit ? ` ${result.unit}` : "",
        result.beside ? h("span", { class: "faint beside" }, result.beside) : null))));
}
