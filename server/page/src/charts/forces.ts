// Forces of the rigid walls on a frame of beams, against time: what stress is for a lattice.
import type { Sample } from "../../gen/cellcrush/v1/sample_pb";
import type { ChartData, Series } from "./chart_data";
import type { Axis } from "./curves";
import { thin } from "./smooth";

const kMostWalls = 6;
const kMostPoints = 2000;

/** Undefined for a frame without rigid walls. */
export function forceChart(samples: Sample[], axis: Axis): ChartData | undefined {
  const walls = samples[0]?.rigidWalls.slice(0, kMostWalls) ?? [];
  if (walls.length === 0) return undefined;
  const places = thin(samples.map((s) => s.rigidWalls[0]?.normalForceN ?? 0), kMostPoints);
  const kept = places ? places.map((place) => samples[place]) : samples;
  const columns = walls.map((_, i) => kept.map((sample) => sample.rigidWalls[i]?.normalForceN ?? null));
  const top = columns.flat().reduce<number>((most, value) => Math.max(most, value ?? 0), 0);
  const series: Series[] = walls.map((wall, i) => ({ label: wall.wall, colour: `series-${i}`, width: 1.8 }));
  return {
    series, columns: [kept.map((sample) => axis.sample(sample)), ...columns],
    xLabel: axis.label, yLabel: "normal force (N)", xEnd: axis.end, yTop: top > 0 ? 1.08 * top : 1,
    note: "forces of the rigid walls on the frame, means between samples",
  };
}
