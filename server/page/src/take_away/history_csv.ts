import type { Sample } from "../../gen/cellcrush/v1/sample_pb";
import { csvBlob } from "../dom/download";

// Columns by the names of the proto.
const kColumns: [string, (sample: Sample) => number][] = [
  ["step", (s) => Number(s.step)],
  ["time_s", (s) => s.timeS],
  ["travel_mm", (s) => s.travelMm],
  ["strain", (s) => s.strain],
  ["stress_impact_mpa", (s) => s.stressImpactMpa],
  ["stress_support_mpa", (s) => s.stressSupportMpa],
  ["energy_kinetic_mj", (s) => s.energyKineticMj],
  ["energy_elastic_mj", (s) => s.energyElasticMj],
  ["energy_plastic_mj", (s) => s.energyPlasticMj],
  ["energy_contact_mj", (s) => s.energyContactMj],
  ["energy_friction_mj", (s) => s.energyFrictionMj],
  ["energy_damping_mj", (s) => s.energyDampingMj],
  ["work_external_mj", (s) => s.workExternalMj],
  ["energy_residual_mj", (s) => s.energyResidualMj],
  ["energy_contact_stored_mj", (s) => s.energyContactStoredMj],
  ["energy_contact_damping_mj", (s) => s.energyContactDampingMj],
  ["deepest_penetration", (s) => s.deepestPenetration],
  ["contact_count", (s) => Number(s.contactCount)],
  ["solid_fraction", (s) => s.solidFraction],
  ["collapsed_fraction", (s) => s.collapsedFraction],
];

export function historyCsv(samples: Sample[]): Blob {
  return csvBlob(kColumns.map(([name]) => name), samples.map((sample) => kColumns.map(([, value]) => value(sample))));
}
