#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cellcrush {

/// Where a watched particle is, from its undeformed place: mm, mm, rad.
struct WatchedNode {
  double ux = 0.0;
  double uy = 0.0;
  double rotation = 0.0;
};

/// Where the cells of a lattice collapse; measure/crush_mode.h has the definitions.
enum class CrushMode {
  none,   ///< too few cells have collapsed to tell
  x,      ///< two oblique bands that cross
  v,      ///< two oblique bands that meet in a V
  i,      ///< bands across the crush
  c,      ///< a curved band: a V turned round
  mixed,  ///< none of these
};

/// The jump across the front of a fast crush, from the motion of the cells; measure/front.h says when there is one.
struct Front {
  double position = 0.0;         ///< mm of the undeformed length, from the impact end
  double strain_behind = 0.0;    ///< nominal, mean from the impact end to the front
  double strain_ahead = 0.0;     ///< nominal, mean from the front half of the way to the support end
  double velocity_behind = 0.0;  ///< mm/s along the crush, mean over the mass
  double velocity_ahead = 0.0;
  double solid_fraction_behind =
      0.0;  ///< relative density / (1 - strain_behind): over 1 walls share room or have shrunk
  double wall_fraction_behind = 0.0;  ///< the same with the walls' lengths of now: what the model holds there
};

/// What a run went on with but a reader of its result must know. Each kind is reported once, where it was first seen.
struct Warning {
  enum class Kind {
    deep_penetration,  ///< walls overlapped by more than half of the thinner one's thickness
    walls_crossed,     ///< a wall passed through another
    energy_drift,      ///< the ledger was open by more than a hundredth of the work done
    contact_energy,    ///< contacts had made more than a hundredth of the work done
    borders_near  ///< distant parts of a large lattice's border came near: contacts' search takes longer from then on
  };
  Kind kind = Kind::deep_penetration;
  std::int64_t step = 0;
  double strain = 0.0;  ///< nominal; 0 of a frame
  std::string message;  ///< what, when and where
  std::string remedy;   ///< what to do about it
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
  double energy_residual = 0.0;            ///< work_external minus all energies
  double energy_contact_stored = 0.0;      ///< sum of k D^2 / 2 now
  double energy_contact_damping = 0.0;     ///< the contacts' part of energy_damping
  double deepest_penetration = 0.0;        ///< of a wall contact since the start, over the thinner wall's thickness
  std::int64_t contact_count = 0;          ///< wall contacts closed now
  bool walls_crossed = false;              ///< found by the search by faces, which then gave over to that by buckets
  double solid_fraction = 0.0;             ///< between the plates: relative density / (1 - strain)
  double collapsed_fraction = 0.0;         ///< share of the cells that have collapsed (measure/crush_mode.h)
  CrushMode crush_mode = CrushMode::none;  ///< found from the cells that have collapsed now, where it was looked for
  std::optional<Front> front;
  std::vector<WatchedNode> watched;  ///< in the order of the frame's watched nodes
  std::vector<Warning> warnings;     ///< of contacts, first seen at this sample
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

/// The front of a fast crush over the plateau window: means of the samples that have one (measure/shock.h).
struct FrontSummary {
  double strain_behind = 0.0;  ///< the densified strain
  double strain_ahead = 0.0;
  double velocity_behind = 0.0;  ///< mm/s
  double velocity_ahead = 0.0;
  double solid_fraction_behind = 0.0;
  double wall_fraction_behind = 0.0;
  double stress_ahead = 0.0;  ///< MPa, sigma_A of Eq. 52
  double shock = 0.0;         ///< MPa, Eq. 52
  double window_share = 0.0;  ///< of the window's samples that have a front
};

/// How far a run is from a quasi-static one, beyond 5 % strain.
struct QuasiStatic {
  double plate_difference = 0.0;           ///< |impact - support| over the mean of both, of the stresses' means
  double plate_difference_greatest = 0.0;  ///< the greatest of windows of 5 % strain
  double kinetic_share = 0.0;  ///< greatest kinetic energy over plastic work, once that is more than what is elastic
};

/// What a run amounts to.
struct Summary {
  static constexpr double kPlateauLow = 0.20;  ///< nominal strains between which the plateau stress is the mean
  static constexpr double kPlateauHigh = 0.40;
  static constexpr double kQuasiStaticFrom = 0.05;    ///< strain from which the plates are compared
  static constexpr double kQuasiStaticWindow = 0.05;  ///< strain of the windows in which they are

  std::optional<double> plateau_stress_impact;  ///< MPa; absent when the run did not reach the window's end
  std::optional<double> plateau_stress_support;
  std::optional<double> densification_strain;  ///< onset; absent without a rise that lasts (measure/densification.h)
  std::optional<double> plateau_stress_to_densification;  ///< MPa, impact plate
  std::optional<double> solid_fraction_at_densification;  ///< relative density / (1 - densification_strain)
  double absorbed_energy = 0.0;                           ///< N mm, work of the impact plate up to 50 % strain
  double energy_error_relative = 0.0;                     ///< greatest |residual| over the external work done by then
  double deepest_penetration = 0.0;
  std::int64_t step_count = 0;
  CrushMode crush_mode = CrushMode::none;   ///< what most looks at the collapse say, the earlier kind of equals
  std::optional<double> crush_mode_strain;  ///< of the first look that said so
  std::optional<FrontSummary> front;        ///< absent unless half of the plateau window's samples have a front
  std::optional<QuasiStatic> quasi_static;  ///< absent when the run ended before its first window
  Theory theory;
  std::vector<Warning> warnings;  ///< of all samples, and of the ledger, by step

  /// Theory over the plateau at the impact plate, minus 1; absent with either.
  [[nodiscard]] std::optional<double> shock_error() const;        ///< of Eq. 51
  [[nodiscard]] std::optional<double> front_shock_error() const;  ///< of Eq. 52
};

}  // namespace cellcrush
