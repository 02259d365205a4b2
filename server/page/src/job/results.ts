// The numbers of a result, with units, beside theory.
import { Summary_End, type Summary } from "../../gen/cellcrush/v1/sample_pb";
import { h } from "../dom/element";
import { count, duration, number, percent, quantity, strainText } from "../dom/format";
import { fieldHelp } from "../new_case/words";
import type { BrokenWalls } from "./broken_walls";

function besideTheory(value: number | undefined, theory: number | undefined, name: string): string {
  if (!value || !theory) return "";
  const ratio = theory / value - 1;
  return `${name} ${quantity(theory, "MPa")}, ${percent(Math.abs(ratio))} ${ratio >= 0 ? "higher" : "lower"}`;
}

/** `note` says when not to compare with theory. */
export function resultsList(s: Summary, note: string, hasPlates: boolean,
                            broken: BrokenWalls | undefined): HTMLElement {
  const { theory } = s;
  const list = h("dl", { class: "results" });
  const add = (name: string, field: string, value: string, beside = "", message = "Summary"): void =>
    list.append(h("div", { title: fieldHelp(message, field) }, h("dt", {}, name),
      h("dd", {}, h("b", {}, value), beside && h("span", { class: "faint beside" }, beside))));
  const compared = note ? () => "" : besideTheory;
  const impact = s.plateauStressImpactMpa;
  if (impact !== undefined || s.peakStressMpa !== undefined || theory?.gibsonAshbyMpa) {
    add("Plateau stress, impact plate", "plateau_stress_impact_mpa", quantity(impact, "MPa"),
        impact === undefined
          ? `the ${(s.validToStrain ?? 1) < 0.4 ? "lattice closed" : "run ended"} before strain 0.40`
          : compared(impact, theory?.shockMpa, "shock theory (Eq. 51)"));
    const walls = s.rigidWalls.filter((wall) => !wall.wall.startsWith("side_")).length;
    if (hasPlates || walls !== 1) { // one wall alone has no support
      add("Plateau stress, support plate", "plateau_stress_support_mpa", quantity(s.plateauStressSupportMpa, "MPa"),
          compared(s.plateauStressSupportMpa, theory?.gibsonAshbyMpa, "Gibson-Ashby"));
    }
    if (s.peakStressMpa !== undefined) {
      add("Peak stress, impact plate", "peak_stress_mpa", quantity(s.peakStressMpa, "MPa"),
          `mean over ${percent(s.peakStressWindow, 0)} strain, at strain ${strainText(s.peakStressStrain)}`);
    }
    if (s.crushForces) {
      const { meanN, peakN, efficiency, strokeMm, specificEnergyJPerG } = s.crushForces;
      add("Mean crush force", "crush_forces", quantity(meanN, "N"),
          `over a stroke of ${number(strokeMm)} mm; ${number(efficiency)} of the peak of ${quantity(peakN, "N")}`);
      add("Specific energy absorbed", "crush_forces", `${number(specificEnergyJPerG)} J/g`, "over that stroke");
    }
    add("Densification strain", "densification_strain", strainText(s.densificationStrain),
        s.densificationStrain !== undefined ? ""
          : s.otherRiseStrain !== undefined ? "the lasting rise of the stress is another"
          : "no lasting rise of the stress before the lattice closed or the run ended");
    if (s.otherRiseStrain !== undefined) {
      add("Other lasting rise", "other_rise_strain", strainText(s.otherRiseStrain), s.otherRiseWords);
    }
  }
  if (s.poissonsRatio !== undefined) {
    const elastic = theory?.poissonsRatio;
    add("Poisson's ratio", "poissons_ratio", number(s.poissonsRatio), `secant, up to strain ${s.plateauWindowHigh}`
        + (elastic === undefined ? "" : `; ${number(elastic)} of elastic walls`));
  }
  if (s.validToStrain !== undefined) {
    add("Valid to strain", "valid_to_strain", strainText(s.validToStrain),
        `the lattice is closed from there on${s.end === Summary_End.CLOSED ? "; the run ended there" : ""}`);
  }
  if (s.validToTimeS !== undefined) {
    add("Valid to time", "valid_to_time_s", quantity(s.validToTimeS, "s"), "the frame is closed from there on");
  }
  if (s.plateauStressToDensificationMpa !== undefined) {
    add("Mean stress to densification", "plateau_stress_to_densification_mpa",
        quantity(s.plateauStressToDensificationMpa, "MPa"));
  }
  const absorbed = s.absorbedEnergyMj;
  if (absorbed) {
    add("Absorbed energy", "absorbed_energy_mj", quantity(absorbed, "mJ"),
        `to strain ${strainText(Math.min(0.5, s.validToStrain ?? 0.5))}, or the end of a shorter run`);
  }
  if (theory?.gibsonAshbyMpa && s.crushModeWords) { // a frame has no cells
    add("Crush mode", "crush_mode", s.crushModeWords,
        s.crushModeStrain === undefined ? "" : `first seen at strain ${strainText(s.crushModeStrain)}`);
  }
  if (s.front) {
    add("Strain behind the front", "front", number(s.front.strainBehind),
        `shock theory, measured jumps (Eq. 52) ${quantity(s.front.shockMpa, "MPa")}`);
  }
  if (s.quasiStatic) {
    add("Difference between the plates", "quasi_static", percent(s.quasiStatic.plateDifferenceRelative),
        "of their mean; 0 if quasi-static");
  }
  if (s.inertiaShare !== undefined) {
    add("Inertia's share of the work", "inertia_share", percent(s.inertiaShare),
        "largest kinetic energy on the plateau");
  }
  if (s.fibreStrain) {
    const { largest, wall, xMm, yMm, nominalStrain, timeS } = s.fibreStrain;
    const when = nominalStrain ? `strain ${strainText(nominalStrain)}` : quantity(timeS, "s");
    add("Largest fibre strain", "fibre_strain", percent(largest),
        `wall ${wall}, at (${number(xMm)}, ${number(yMm)}) mm before loading, at ${when}`);
  }
  if (broken) add("Broken walls", "break_count", broken.count, broken.first, "Sample");
  for (const wall of s.rigidWalls) {
    const moved = wall.strokeMm > 0 || wall.endVelocityMPerS !== 0;
    add(`Rigid wall ${wall.wall}`, "rigid_walls", `${quantity(wall.peakForceN, "N")} at most`,
        `impulse ${number(wall.impulseNS)} N s` + (moved
          ? `, stroke ${number(wall.strokeMm)} mm, deceleration ${number(wall.peakDecelerationMPerS2)} m/s2 at most, `
            + `${number(wall.endVelocityMPerS)} m/s at the end, work ${quantity(wall.workMj, "mJ")}`
          : ""));
  }
  if (s.rigidLinkCount) add("Rigid links", "rigid_link_count", count(s.rigidLinkCount), "beams too short to bend");
  if (s.startOverlapCount)
    add("Overlaps before loading", "start_overlap_count", count(s.startOverlapCount), "pairs of walls");
  add("Energy ledger error", "energy_error_relative", percent(s.energyErrorRelative, 3));
  add("Deepest penetration", "deepest_penetration", percent(s.deepestPenetration),
      "of the thickness of the thinner wall");
  add("Solver time", "solver_seconds", duration(s.solverSeconds), `${count(s.stepCount)} steps`);
  return list;
}
