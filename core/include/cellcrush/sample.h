#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/breaks.h"
#include "cellcrush/ledger.h"

namespace cellcrush {

/// Displacements and rotation of a watched particle from its undeformed position: mm, mm, rad. The reactions of its
/// supports and imposed motions, of which its work is force times displacement, are means over the interval since the
/// previous sample: N, N, N mm; 0 for what is not held (E15).
struct WatchedNode {
  double ux = 0.0;
  double uy = 0.0;
  double rotation = 0.0;
  double reaction_x = 0.0;
  double reaction_y = 0.0;
  double reaction_moment = 0.0;
};

/// A rigid wall (E9f). Its forces on the lattice and its acceleration are means over the interval since the previous
/// sample.
struct RigidWallSample {
  double displacement = 0.0;      ///< mm along its normal
  double normal_force = 0.0;      ///< N along its normal, away from the wall; at least 0
  double tangential_force = 0.0;  ///< N along its tangent, the normal turned clockwise: friction
  double speed = 0.0;             ///< mm/s along its normal, half a step before
  double acceleration = 0.0;      ///< mm/s^2 along its normal
  double impulse = 0.0;           ///< N s on the lattice since the start, along its normal
  double work = 0.0;              ///< N mm on the lattice since the start
};

/// A grip (E15a). Its forces on the lattice are means over the interval since the previous sample.
struct GripSample {
  double displacement_x = 0.0;  ///< mm
  double displacement_y = 0.0;
  double force_x = 0.0;  ///< N
  double force_y = 0.0;
};

/// Where the cells of a lattice collapse; measure/crush_mode.h has the definitions.
enum class CrushMode {
  none,   ///< too few cells have collapsed to identify a mode
  x,      ///< two oblique bands that cross
  v,      ///< two oblique bands that meet in a V
  i,      ///< bands across the crush
  c,      ///< a curved band: a V with a rounded point
  mixed,  ///< none of these
};

/// What a lasting rise of the stress is; measure/lasting_rise.h has the definitions.
enum class RiseKind {
  densification,    ///< of a dense lattice
  hardening,        ///< of walls whose material hardens, without a collapse before
  second_collapse,  ///< of a lattice that has collapsed before: folded rows fold once more
  stiffening,       ///< none of these: the geometry of the lattice
};

/// A rise of the stress after the plateau that lasts to the end of the run.
struct LastingRise {
  RiseKind kind = RiseKind::densification;
  double strain = 0.0;  ///< onset
};

/// The jump across the front of a fast crush, from the motion of the cells; measure/layers.h defines when there is one.
struct Front {
  double position = 0.0;         ///< mm of the undeformed length, from the impact end
  double strain_behind = 0.0;    ///< nominal, mean from the impact end to the front
  double strain_ahead = 0.0;     ///< nominal, mean from the front to halfway to the support end
  double velocity_behind = 0.0;  ///< mm/s along the crush, mean over the mass
  double velocity_ahead = 0.0;
  /// Relative density / (1 - strain_behind); above 1, walls overlap or have shortened.
  double solid_fraction_behind = 0.0;
  /// The same with the current lengths and thicknesses of the walls: that of the model.
  double wall_fraction_behind = 0.0;
};

/// The layer across the crush that walls fill most (measure/layers.h).
struct DensestLayer {
  double solid_fraction = 0.0;  ///< length times thickness of the walls over the area of the layer
  double place = 0.0;           ///< mm of the undeformed length, from the impact end: mean of its metal
};

/// The greatest filtered stress at the impact plate up to some time (measure/peak_stress.h).
struct PeakStress {
  double stress = 0.0;  ///< MPa; 0: none yet
  double strain = 0.0;  ///< nominal, of the middle of its window
};

/// Something that does not stop a run but that a reader of its result must know. Each kind is reported once, when it is
/// first seen.
struct Warning {
  enum class Kind {
    deep_penetration,  ///< walls overlapped by more than half of the thickness of the thinner one
    energy_drift,      ///< the energy balance had an error of more than 1 % of the work done
    contact_energy,    ///< contacts had created more than 1 % of the work done
    /// Distant parts of the border of a large lattice came near each other: the contact search is slower from then on.
    borders_near,
    walls_neck,         ///< more than 1 % of the walls were stretched by more than their thickness
    denser_than_solid,  ///< walls filled a layer by more than its volume
    closed,             ///< lattice or frame was closed: from there on its stress depends on the mesh
    inertia             ///< mass that the material does not have took more than 2 % of the work
  };
  Kind kind = Kind::deep_penetration;
  std::int64_t step = 0;
  double strain = 0.0;  ///< nominal; 0 for a frame
  std::string message;  ///< what happened, when and where
  std::string remedy;   ///< what to do about it
};

/// Scalars of a run at one time. Units: mm, s, MPa, N mm (= mJ). Stresses are means over the interval since the
/// previous sample; works and dissipated energies are totals since the start.
struct Sample {
  std::int64_t step = 0;
  double time = 0.0;
  double travel = 0.0;         ///< of the impact plate
  double strain = 0.0;         ///< travel over the undeformed length
  double stress_impact = 0.0;  ///< plate force over width times depth, compression positive
  double stress_support = 0.0;
  Energies energies;
  double energy_contact_stored = 0.0;  ///< elastic energy stored in contacts now (E8b); not a term of the balance
  /// Greatest of wall contacts since the start, divided by the thickness of the thinner wall.
  double deepest_penetration = 0.0;
  std::int64_t contact_count = 0;  ///< wall contacts closed now
  /// Between plates, or rigid walls that face each other: walls before loading, joints counted once, over the volume
  /// left (scene/solid_area.h). 0 without either.
  double solid_fraction = 0.0;
  double collapsed_fraction = 0.0;  ///< fraction of the cells that have collapsed (measure/crush_mode.h)
  /// Greatest magnitude of the strain, elastic and plastic, in the outer fibres of all walls now
  /// (measure/fibre_strain.h).
  double largest_fibre_strain = 0.0;
  std::int64_t most_strained_wall = 0;  ///< which has it, by its number (MeshView::element_wall)
  PeakStress peak;                      ///< so far
  double lateral_strain = 0.0;          ///< across the crush, positive where wider (measure/lateral_strain.h)
  double absorption_efficiency =
      0.0;  ///< strain: integral of the mean stress over it, over that stress of the last 1 %
  /// Of the cells that have collapsed by now, in samples in which it was evaluated.
  CrushMode crush_mode = CrushMode::none;
  std::optional<Front> front;
  DensestLayer densest_layer;                ///< as measured last; 0 before the first time
  std::vector<WatchedNode> watched;          ///< in the order of the frame's watched nodes
  std::vector<RigidWallSample> rigid_walls;  ///< in the order of the case, then the two side walls if there are any
  std::vector<GripSample> grips;             ///< in the order of the case
  std::int64_t break_count = 0;              ///< walls broken so far (E6g)
  std::vector<Break> breaks;                 ///< since the sample before
  std::vector<Warning> warnings;             ///< of contacts, first seen at this sample

  [[nodiscard]] double energy_damping() const { return energies.contact_damping + energies.mass_damping; }
};

/// Calls visit(name, number, scale) for each number of a front, in the order of the outputs: its name there, with the
/// unit, and what it is multiplied by to have that unit. `F`: Front or const Front.
template <class F, class Visitor>
void visit_columns_of_front(F& front, const Visitor& visit) {
  constexpr double kMPerMm = 1e-3;
  visit("position_mm", front.position, 1.0);
  visit("strain_behind", front.strain_behind, 1.0);
  visit("strain_ahead", front.strain_ahead, 1.0);
  visit("velocity_behind_m_per_s", front.velocity_behind, kMPerMm);
  visit("velocity_ahead_m_per_s", front.velocity_ahead, kMPerMm);
  visit("solid_fraction_behind", front.solid_fraction_behind, 1.0);
  visit("wall_fraction_behind", front.wall_fraction_behind, 1.0);
}

/// The columns of the history, besides those of the front: calls visit(name, number, scale) as above. The names are
/// those of the fields of cellcrush.v1.Sample, from which all outputs take theirs; a term of the ledger without a field
/// is in no output. `S`: Sample or const Sample.
template <class S, class Visitor>
void visit_columns(S& sample, const Visitor& visit) {
  visit("step", sample.step, 1.0);
  visit("time_s", sample.time, 1.0);
  visit("travel_mm", sample.travel, 1.0);
  visit("strain", sample.strain, 1.0);
  visit("stress_impact_mpa", sample.stress_impact, 1.0);
  visit("stress_support_mpa", sample.stress_support, 1.0);
  for (const LedgerTerm& term : kLedgerTerms) visit(term.name, sample.energies.*term.value, 1.0);
  visit("energy_residual_mj", sample.energies.residual, 1.0);
  visit("energy_contact_stored_mj", sample.energy_contact_stored, 1.0);
  visit("deepest_penetration", sample.deepest_penetration, 1.0);
  visit("contact_count", sample.contact_count, 1.0);
  visit("break_count", sample.break_count, 1.0);
  visit("solid_fraction", sample.solid_fraction, 1.0);
  visit("collapsed_fraction", sample.collapsed_fraction, 1.0);
  visit("largest_fibre_strain", sample.largest_fibre_strain, 1.0);
  visit("most_strained_wall", sample.most_strained_wall, 1.0);
  visit("peak_stress_mpa", sample.peak.stress, 1.0);
  visit("peak_stress_strain", sample.peak.strain, 1.0);
  visit("lateral_strain", sample.lateral_strain, 1.0);
  visit("absorption_efficiency", sample.absorption_efficiency, 1.0);
}

/// Samples in their memory representation, for the same build. A run that is resumed from a checkpoint needs those
/// taken before.
std::string bytes_of(std::span<const Sample> samples);

/// Returns nothing if the bytes are not samples.
std::optional<std::vector<Sample>> samples_of(std::string_view bytes);

/// Fields of a run at one time.
struct FieldFrame {
  int index = 0;
  double time = 0.0;
  double strain = 0.0;
  std::vector<float> position;          ///< mm, x0 y0 x1 y1 ... of N particles
  std::vector<int> broken_end;          ///< of each break so far, 2 element + 1 at its end, + 0 at its start (Break)
  std::vector<float> end_position;      ///< mm, x0 y0 x1 y1 ... of these ends: particle N + k of break k
  std::vector<float> plastic_fraction;  ///< E elements, fraction of the section area that has yielded
  std::vector<float> fibre_strain;      ///< of all walls (Scene::wall_count), as Sample::largest_fibre_strain
  std::vector<float> local_strain;      ///< of the cells beside each wall (measure/local_strain.h); empty without cells
};

/// Closed-form solutions to compare a result with.
struct Theory {
  double gibson_ashby = 0.0;          ///< MPa, quasi-static plastic collapse of the lattice
  double shock = 0.0;                 ///< MPa, Eq. 51, with the masses of the run
  double densification_strain = 0.0;  ///< used in Eq. 51: 1 - 1.4 relative density
};

/// The front of a fast crush over the plateau window: means of the samples that have one (measure/theory.h).
struct FrontSummary : Front {
  double stress_ahead = 0.0;  ///< MPa, sigma_A of Eq. 52
  double shock = 0.0;         ///< MPa, Eq. 52
  double window_share = 0.0;  ///< fraction of the samples in the window that have a front
};

/// Deviation of a run from a quasi-static one, beyond 5 % strain.
struct QuasiStatic {
  double plate_difference = 0.0;           ///< |impact - support| over the mean of both, for the mean stresses
  double plate_difference_greatest = 0.0;  ///< the same, greatest over windows of 5 % strain
  /// Greatest ratio of kinetic energy to plastic work, once plastic work exceeds elastic energy.
  double kinetic_share = 0.0;
};

/// The largest fibre strain of a run at one of its samples, up to where its result is valid.
struct LargestFibreStrain {
  double largest = 0.0;
  std::int64_t wall = 0;  ///< into Scene::walls
  double x = 0.0;         ///< mm, middle between the ends of the wall before loading
  double y = 0.0;
  double strain = 0.0;  ///< nominal; 0 for a frame
  double time = 0.0;    ///< s
};

/// A rigid wall in a whole run, from the samples.
struct RigidWallSummary {
  double peak_force = 0.0;         ///< N, greatest mean between two samples
  double peak_time = 0.0;          ///< s, of the sample that has it
  double peak_deceleration = 0.0;  ///< mm/s^2, the same of the acceleration against the normal
  double stroke = 0.0;             ///< mm, greatest displacement
  double speed = 0.0;              ///< mm/s at the end; below 0 of a mass that has rebounded
  double impulse = 0.0;            ///< N s
  double work = 0.0;               ///< N mm
};

/// The forces of a crush at the impact plate up to `stroke`.
struct CrushForces {
  double mean = 0.0;             ///< N, work over stroke
  double peak = 0.0;             ///< N, of the peak stress
  double stroke = 0.0;           ///< mm, up to the onset of densification, or to the end without one
  double specific_energy = 0.0;  ///< N mm / tonne, work over the mass of the lattice

  /// Crush force efficiency.
  [[nodiscard]] double efficiency() const { return mean / peak; }
};

/// What ends a run that nothing stops.
enum class RunEnd {
  strain,  ///< loading.end_strain, or its default
  closed,  ///< the lattice is closed before the default of loading.end_strain (scene/solid_area.h)
  time,    ///< loading.end_time_s
  at_rest  ///< loading.end_at_rest
};

/// The first wall to break.
struct FirstBreak {
  double time = 0.0;    ///< s
  double strain = 0.0;  ///< nominal, at the sample that followed
};

/// Results of a whole run. Stresses, energies, the front and the onset of densification are those of the part before
/// `valid_to_strain`.
struct Summary {
  static constexpr double kPlateauLow = 0.20;  ///< range of nominal strain over which the plateau stress is averaged
  static constexpr double kPlateauHigh = 0.40;
  static constexpr double kPeakWindow = 0.01;         ///< strain over which the peak stress is a mean
  static constexpr double kQuasiStaticFrom = 0.05;    ///< strain from which the plates are compared
  static constexpr double kQuasiStaticWindow = 0.05;  ///< range of strain of each window of comparison

  /// Nominal strain from which the lattice is closed, so that stress and work depend on mesh and contact stiffness
  /// (scene/solid_area.h); absent without plates.
  std::optional<double> valid_to_strain;
  std::optional<double> valid_to_time;  ///< s, the same of a frame between rigid walls, if it has closed
  RunEnd end = RunEnd::time;
  /// Greatest kinetic energy over the work done by then, over the plateau window (measure/inertia.h); absent without
  /// plates, or if the run ended before.
  std::optional<double> inertia_share;
  std::optional<double> plateau_stress_impact;  ///< MPa; absent if the run ended before the end of the range
  std::optional<double> plateau_stress_support;
  /// Up to the onset of densification, or to the end without one; absent before the first window is complete.
  std::optional<PeakStress> peak;
  std::optional<CrushForces> crush_forces;     ///< absent without a peak or a support
  std::optional<double> poissons_ratio;        ///< lateral strain over strain, at the end of the plateau range
  std::optional<double> densification_strain;  ///< onset; absent without a lasting rise of a dense lattice
  std::optional<LastingRise> other_rise;       ///< one that is not densification
  std::optional<double> plateau_stress_to_densification;  ///< MPa, impact plate
  std::optional<double> solid_fraction_at_densification;  ///< Sample::solid_fraction there
  /// N mm, work of the impact plate up to 50 % strain or valid_to_strain; 0 without a support.
  double absorbed_energy = 0.0;
  /// Greatest |residual| over the energy turned over by then: the work done, or the energy that was there at the start.
  double energy_error_relative = 0.0;
  double deepest_penetration = 0.0;
  std::int64_t step_count = 0;
  std::int64_t rigid_link_count = 0;     ///< beams of a frame that were rigid (scene/rigid_links.h)
  std::int64_t start_overlap_count = 0;  ///< pairs of walls that overlapped before loading (StartOverlaps)
  /// The mode that most evaluations found; of equally frequent ones, the first.
  CrushMode crush_mode = CrushMode::none;
  std::optional<double> crush_mode_strain;  ///< strain of the first evaluation that found it
  std::optional<FrontSummary> front;        ///< absent unless half of the samples in the plateau range have a front
  std::optional<QuasiStatic> quasi_static;  ///< absent if the run ended before the end of its first window
  std::optional<LargestFibreStrain> fibre_strain;  ///< absent if no wall was strained
  std::vector<RigidWallSummary> rigid_walls;       ///< in the order of the samples
  std::int64_t break_count = 0;                    ///< walls broken (E6g)
  std::optional<FirstBreak> first_break;           ///< absent if none has
  Theory theory;
  std::vector<Warning> warnings;  ///< of all samples and of the ledger, in order of steps

  /// Theory over the plateau stress at the impact plate, minus 1; absent if either is.
  [[nodiscard]] std::optional<double> shock_error() const;        ///< of Eq. 51
  [[nodiscard]] std::optional<double> front_shock_error() const;  ///< of Eq. 52
};

}  // namespace cellcrush
