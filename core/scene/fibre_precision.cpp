#include "scene/fibre_precision.h"

#include <algorithm>
#include <cmath>

#include "lattice/lattice.h"

namespace cellcrush {
namespace {

/// Largest strain of a wall's fibres over the nominal strain, while the lattice is elastic.
double bending_share(const SceneSpec& spec, double thickness) {
  const RegularLattice* lattice = regular_lattice_of(spec);
  return lattice == nullptr ? 1.0 : std::min(1.0, 3.0 * thickness / *lattice->side_mm);
}

}  // namespace

double steps_to_yield(const SceneSpec& spec, const MeshMeasures& mesh, const RunPlan& plan) {
  if (!plan.plates.present) {
    return static_cast<double>(plan.schedule.step_count);
  }
  const double strain =
      mesh.material.yield_stress / mesh.material.youngs_modulus / bending_share(spec, mesh.thinnest_wall);
  // In the ramp, the strain grows with the square of time, to half of what the full speed gives in the same time.
  const double ramp = spec.loading.ramp_strain;
  const double strain_at_full_speed = strain < ramp ? 2.0 * std::sqrt(strain * ramp) : strain + ramp;
  return strain_at_full_speed * mesh.length / (plan.plates.speed * plan.schedule.time_step);
}

}  // namespace cellcrush
