// Stress at both plates against strain, beside theory; without plates, forces of the rigid walls.
import { Warning_Kind, type Sample, type Summary, type Theory } from "../../gen/cellcrush/v1/sample_pb";
import { number, unitBySize, type Unit } from "../dom/format";
import type { Band, ChartData, Level, Mark, Series } from "./chart_data";
import { finite, quantile, runningMean, thin, type Axis } from "./curves";

export const kSmoothing = 0.02; // of strain
const kMostPoints = 3000;
const kFirstWave = 0.1; // strain; the first wave of a fast crush is far above all that follows

export interface StressCurves { strain: number[]; impact: number[]; support: number[] }

export function smoothedStress(samples: Sample[], axis: Axis): StressCurves {
  const kept = finite(samples, axis);
  const strain = kept.map((sample) => axis.sample(sample));
  return {
    strain,
    impact: runningMean(strain, kept.map((sample) => sample.stressImpactMpa), kSmoothing),
    support: runningMean(strain, kept.map((sample) => sample.stressSupportMpa), kSmoothing),
  };
}

/** The upper end of the stress axis: it follows the plateau, not the first wave nor the densified specimen. */
export function stressTop(smooth: StressCurves, summary: Summary | undefined, theory: Theory | undefined): number {
  const last = smooth.strain[smooth.strain.length - 1] ?? 0;
  const solid = Math.min(summary?.densificationStrain ?? summary?.otherRiseStrain ?? 0.65, summary?.validToStrain ?? 1);
  const crushing: number[] = [];
  smooth.strain.forEach((strain, i) => {
    const inFirstWave = strain < kFirstWave && last > 2 * kFirstWave;
    if (strain <= solid && !inFirstWave) crushing.push(Math.max(smooth.impact[i], smooth.support[i]));
  });
  const top = Math.max(1.3 * quantile(crushing, 0.95), 1.2 * (theory?.shockMpa ?? 0),
                       1.6 * (summary?.plateauStressImpactMpa ?? 0), 1.6 * (summary?.plateauStressSupportMpa ?? 0));
  return top > 0 ? top : 1;
}

function levelsOf(summary: Summary | undefined, theory: Theory | undefined, top: number, unit: Unit): Level[] {
  const levels: Level[] = [];
  const add = (value: number | undefined, label: string, dash: number[]): void => {
    if (!value) return;
    const beyond = value > top ? ", beyond the chart" : "";
    const shown = value * unit.factor;
    levels.push({ value: shown, colour: "ink-2", dash, label: `${label}: ${number(shown)} ${unit.name}${beyond}` });
  };
  add(theory?.shockMpa, "shock theory (Eq. 51)", [8, 4]);
  add(summary?.front?.shockMpa, "shock theory, measured jumps (Eq. 52)", [10, 3, 2, 3]);
  add(theory?.gibsonAshbyMpa, "quasi-static theory (Gibson-Ashby)", [2, 3]);
  const [from, to] = [summary?.plateauWindowLow, summary?.plateauWindowHigh];
  const plateau = { colour: "ink", dash: [], label: "", from, to };
  for (const value of [summary?.plateauStressImpactMpa, summary?.plateauStressSupportMpa]) {
    if (value !== undefined) levels.push({ ...plateau, value: value * unit.factor });
  }
  return levels;
}

/** Where results depend on the mesh: from a strain on, or of a frame from a time on. */
export function closedBands(samples: Sample[], axis: Axis, summary: Summary | undefined): Band[] {
  const from = summary?.validToStrain ?? summary?.validToTimeS ?? Infinity;
  const last = samples.length > 0 ? axis.sample(samples[samples.length - 1]) : 0;
  return last > from ? [{ from, to: last, label: "closed" }] : [];
}

/** Densification or another lasting rise, and where warnings put the result in doubt. */
function marksOf(summary: Summary | undefined): Mark[] {
  const densification = summary?.densificationStrain;
  const marks: Mark[] = densification === undefined ? [] : [{ at: densification, label: "densification" }];
  if (summary?.otherRiseStrain !== undefined) {
    marks.push({ at: summary.otherRiseStrain, label: summary.otherRiseWords });
  }
  for (const { kind, strain } of summary?.warnings ?? []) {
    // Borders cost time only; what is closed is a band.
    if (kind === Warning_Kind.BORDERS_NEAR || kind === Warning_Kind.CLOSED || strain <= 0) continue;
    marks.push({ at: strain, label: `in doubt: ${Warning_Kind[kind].toLowerCase().replaceAll("_", " ")}` });
  }
  return marks;
}

/** `note` says when not to compare with theory. */
export function stressChart(samples: Sample[], axis: Axis, summary: Summary | undefined, theory: Theory | undefined,
                            note: string): ChartData {
  const kept = finite(samples, axis);
  const smooth = smoothedStress(samples, axis);
  const top = stressTop(smooth, summary, note ? undefined : theory);
  const unit = unitBySize("MPa", top);
  const stresses = [kept.map((s) => s.stressImpactMpa), kept.map((s) => s.stressSupportMpa), smooth.impact,
                    smooth.support].map((column) => column.map((stress) => stress * unit.factor));
  const curves = [smooth.strain, ...stresses];
  const places = thin(curves[1], kMostPoints);
  const columns = curves.map((column) => places.map((place) => column[place]));
  const peak = kept.reduce((most, s) => Math.max(most, s.stressImpactMpa, s.stressSupportMpa), 0);
  const bands: Band[] = [{ from: 0.2, to: 0.4, label: "plateau window" }];
  const beyond = peak > 1.001 * top
    ? `; single samples reach ${number(peak * unit.factor, 2)} ${unit.name}, off the chart` : "";
  return {
    series: [
      { label: "", colour: "impact", width: 0.8, opacity: 0.3, quiet: true },
      { label: "", colour: "support", width: 0.8, opacity: 0.3, quiet: true },
      { label: "impact plate", colour: "impact", width: 2 },
      { label: "support plate", colour: "support", width: 2 },
    ],
    columns, xLabel: axis.label, yLabel: `nominal stress (${unit.name})`, xEnd: axis.end,
    yTop: top * unit.factor, levels: levelsOf(summary, theory, top, unit), bands, marks: marksOf(summary),
    note: `moving mean over ${100 * kSmoothing} % strain; thin: every sample${beyond}${note ? `. ${note}` : ""}`,
  };
}

const kMostWalls = 6;
const kMostForces = 2000;

/** Undefined without rigid walls. */
export function forceChart(samples: Sample[], axis: Axis): ChartData | undefined {
  const walls = samples[0]?.rigidWalls.slice(0, kMostWalls) ?? [];
  if (walls.length === 0) return undefined;
  const places = thin(samples.map((s) => s.rigidWalls[0]?.normalForceN ?? 0), kMostForces);
  const kept = places.map((place) => samples[place]);
  const columns = walls.map((_, i) => kept.map((sample) => sample.rigidWalls[i]?.normalForceN ?? null));
  const top = columns.flat().reduce<number>((most, value) => Math.max(most, value ?? 0), 0);
  const series: Series[] = walls.map((wall, i) => ({ label: wall.wall, colour: `series-${i}`, width: 1.8 }));
  return {
    series, columns: [kept.map((sample) => axis.sample(sample)), ...columns],
    xLabel: axis.label, yLabel: "normal force (N)", xEnd: axis.end, yTop: top > 0 ? 1.08 * top : 1,
    note: "forces of the rigid walls on the lattice, means between samples",
  };
}
