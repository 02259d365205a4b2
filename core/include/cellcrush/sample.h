#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace cellcrush {

/// Where a watched particle is, from its undeformed place: mm, mm, rad.
struct WatchedNode {
  double ux = 0.0;
  double uy = 0.0;
  double rotation = 0.0;
};

/// The scalars of a run at one moment. Units: mm, s, MPa, N mm (= mJ). Stresses are means over the interval since the
/// sample before; energies are totals since the start.
struct Sample {
  std::int64_t step = 0;
  double time = 0.0;
  double travel = 0.0;         ///< of the impact plate
  double strain = 0.0;         ///< travel over the undeformed length
  double stress_impact = 0.0;  ///< plate force over width times depth, compression positive
  double stress_support = 0.0;
  double energy_kinetic = 0.0;
  double energy_elastic = 0.0;
  double energy_plastic = 0.0;
  double energy_contact = 0.0;  ///< accumulated work against the elastic normal forces
  double energy_friction = 0.0;
  double energy_damping = 0.0;  ///< contact damping and mass damping
  double work_external = 0.0;
  double energy_residual = 0.0;         ///< work_external minus all energies
  double energy_contact_stored = 0.0;   ///< sum of k D^2 / 2 now
  double energy_contact_damping = 0.0;  ///< the contacts' part of energy_damping
  double deepest_penetration = 0.0;     ///< of a wall contact since the start, over the thinner wall's thickness
  std::int64_t contact_count = 0;       ///< wall contacts closed now
  std::vector<WatchedNode> watched;     ///< in the order of the frame's watched nodes
};

/// The fields of a run at one moment.
struct FieldFrame {
  int index = 0;
  double time = 0.0;
  double strain = 0.0;
  std::vector<float> position;          ///< mm, x0 y0 x1 y1 ... of N particles
  std::vector<float> plastic_fraction;  ///< share of yielded section area, of E elements
};

/// Closed forms to hold a result against.
struct Theory {
  double gibson_ashby = 0.0;          ///< MPa, quasi-static plastic collapse of the lattice
  double shock = 0.0;                 ///< MPa, Eq. 51
  double densification_strain = 0.0;  ///< used in Eq. 51: 1 - 1.4 relative density
};

/// What a run amounts to.
struct Summary {
  static constexpr double kPlateauLow = 0.20;  ///< nominal strains between which the plateau stress is the mean
  static constexpr double kPlateauHigh = 0.40;

  std::optional<double> plateau_stress_impact;  ///< MPa; absent when the run did not reach the window's end
  std::optional<double> plateau_stress_support;
  std::optional<double> densification_strain;  ///< absent while the efficiency has not fallen by 5 % after its maximum
  std::optional<double> plateau_stress_to_densification;  ///< MPa, impact plate
  double absorbed_energy = 0.0;                           ///< N mm, work of the impact plate up to 50 % strain
  double energy_error_relative = 0.0;                     ///< greatest |residual| over the external work done by then
  double deepest_penetration = 0.0;
  std::int64_t step_count = 0;
  Theory theory;
};

}  // namespace cellcrush
