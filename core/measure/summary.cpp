#include <algorithm>
#include <cmath>
#include <vector>

#include "cellcrush/simulation.h"
#include "measure/curve.h"
#include "measure/inertia.h"
#include "measure/lasting_rise.h"
#include "measure/theory.h"
#include "measure/warnings.h"
#include "push/crush.h"
#include "scene/solid_area.h"

namespace cellcrush {
namespace {

template <class Value>
double mean_of(const std::vector<const Sample*>& samples, const Value& value) {
  double sum = 0.0;
  for (const Sample* sample : samples) {
    sum += value(*sample);
  }
  return sum / static_cast<double>(samples.size());
}

/// Least-squares slope of the velocity ahead over time, mm/s^2; 0 for a single sample.
double acceleration_ahead(const std::vector<const Sample*>& samples, double mean_velocity) {
  const double time = mean_of(samples, [](const Sample& sample) { return sample.time; });
  double product = 0.0;
  double squares = 0.0;
  for (const Sample* sample : samples) {
    product += (sample->time - time) * (sample->front->velocity_ahead - mean_velocity);
    squares += (sample->time - time) * (sample->time - time);
  }
  return squares > 0.0 ? product / squares : 0.0;
}

constexpr double kAbsorbedTo = 0.5;

/// Greatest |residual| over the energy turned over by then. It counts once that is a hundredth of the final turnover;
/// before that the ratio compares two small numbers.
double energy_error_of(std::span<const Sample> samples) {
  const double threshold = 0.01 * turnover_of(samples.back());
  double error = 0.0;
  for (const Sample& sample : samples) {
    const double turnover = turnover_of(sample);
    if (turnover > threshold) {
      error = std::max(error, std::abs(sample.energies.residual) / turnover);
    }
  }
  return error;
}

/// Sets the mode that most evaluations found; of equally frequent ones, the first.
void set_crush_mode(std::span<const Sample> samples, Summary& summary) {
  const auto evaluations = [&](CrushMode mode) {
    return std::count_if(samples.begin(), samples.end(),
                         [&](const Sample& sample) { return sample.crush_mode == mode; });
  };
  for (const Sample& sample : samples) {
    if (sample.crush_mode != CrushMode::none &&
        (summary.crush_mode == CrushMode::none || evaluations(sample.crush_mode) > evaluations(summary.crush_mode))) {
      summary.crush_mode = sample.crush_mode;
      summary.crush_mode_strain = sample.strain;
    }
  }
}

/// Difference of the mean stresses at both plates over a range of strain, divided by the mean of both; nothing if there
/// is no stress.
std::optional<double> plate_difference(const Curve& impact, const Curve& support, double low, double high) {
  const auto impact_mean = impact.mean(low, high);
  const auto support_mean = support.mean(low, high);
  if (!impact_mean || !support_mean || *impact_mean + *support_mean <= 0.0) {
    return std::nullopt;
  }
  return 2.0 * std::abs(*impact_mean - *support_mean) / (*impact_mean + *support_mean);
}

double kinetic_share(std::span<const Sample> samples) {
  double share = 0.0;
  for (const Sample& sample : samples) {
    if (sample.strain >= Summary::kQuasiStaticFrom && sample.energies.plastic > sample.energies.elastic) {
      share = std::max(share, sample.energies.kinetic / sample.energies.plastic);
    }
  }
  return share;
}

std::optional<QuasiStatic> find_quasi_static(std::span<const Sample> samples, const Curve& impact,
                                             const Curve& support) {
  constexpr double kRoundOff = 1e-9;
  constexpr double kFrom = Summary::kQuasiStaticFrom;
  constexpr double kWindow = Summary::kQuasiStaticWindow;
  const double end = samples.back().strain;
  const int windows = static_cast<int>((end - kFrom) / kWindow + kRoundOff);
  const auto whole = windows > 0 ? plate_difference(impact, support, kFrom, end) : std::nullopt;
  if (!whole) {
    return std::nullopt;
  }
  QuasiStatic found{*whole, *whole, kinetic_share(samples)};
  for (int i = 0; i < windows; ++i) {
    const auto part = plate_difference(impact, support, kFrom + i * kWindow, kFrom + (i + 1) * kWindow);
    found.plate_difference_greatest = std::max(found.plate_difference_greatest, part.value_or(0.0));
  }
  return found;
}

std::optional<LargestFibreStrain> find_fibre_strain(const Scene& scene, std::span<const Sample> samples) {
  const auto most = std::ranges::max_element(samples, {}, &Sample::largest_fibre_strain);
  if (most == samples.end() || !(most->largest_fibre_strain > 0.0)) return std::nullopt;
  const int wall = scene.list_order.wall_of(static_cast<int>(most->most_strained_wall));
  const Vector2 middle = 0.5 * (scene.position[scene.walls.start[wall]] + scene.position[scene.walls.end[wall]]);
  return LargestFibreStrain{
      most->largest_fibre_strain, most->most_strained_wall, middle.x(), middle.y(), most->strain, most->time};
}

/// The peak up to a strain.
std::optional<PeakStress> find_peak(std::span<const Sample> samples, double strain) {
  PeakStress peak;
  for (const Sample& sample : samples) {
    if (sample.peak.strain <= strain) peak = sample.peak;
  }
  return peak.stress > 0.0 ? std::optional(peak) : std::nullopt;
}

/// Up to a strain.
std::optional<CrushForces> find_crush_forces(const Scene& scene, const Curve& impact,
                                             const std::optional<PeakStress>& peak, double strain) {
  if (!peak) return std::nullopt;
  const double area = scene.width * scene.depth;
  const double stroke = strain * scene.length;
  const double work = area * scene.length * impact.integral(strain);
  return CrushForces{work / stroke, area * peak->stress, stroke, work / scene.total_mass};
}

/// The secant at the end of the plateau range, or at the last sample of a shorter run.
std::optional<double> find_poissons_ratio(std::span<const Sample> samples) {
  const auto beyond = std::ranges::find_if(samples, [](const Sample& s) { return s.strain > Summary::kPlateauHigh; });
  if (beyond == samples.begin()) return std::nullopt;
  const Sample& last = *std::prev(beyond);
  return last.strain > 0.0 ? std::optional(last.lateral_strain / last.strain) : std::nullopt;
}

std::vector<RigidWallSummary> summarize_rigid_walls(std::span<const Sample> samples) {
  std::vector<RigidWallSummary> walls(samples.front().rigid_walls.size());
  for (const Sample& sample : samples) {
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const RigidWallSample& now = sample.rigid_walls[i];
      RigidWallSummary& wall = walls[i];
      if (now.normal_force > wall.peak_force) {
        wall.peak_force = now.normal_force;
        wall.peak_time = sample.time;
      }
      wall.peak_deceleration = std::max(wall.peak_deceleration, -now.acceleration);
      wall.stroke = std::max(wall.stroke, now.displacement);
      wall.speed = now.speed;
      wall.impulse = now.impulse;
      wall.work = now.work;
    }
  }
  return walls;
}

/// The samples at which the strain is greater than ever before: a mass between rigid walls rebounds.
std::vector<Sample> while_strain_grows(std::span<const Sample> samples) {
  std::vector<Sample> growing;
  for (const Sample& sample : samples) {
    if (growing.empty() || sample.strain > growing.back().strain) growing.push_back(sample);
  }
  return growing;
}

/// The samples until the lattice is closed, or the frame at `closed_step`.
std::span<const Sample> before_closing(const Scene& scene, std::span<const Sample> samples,
                                       std::optional<std::int64_t> closed_step) {
  const auto past = [&](const Sample& sample) {
    return scene.plates.present ? is_past_closing(scene, sample.strain) : closed_step && sample.step >= *closed_step;
  };
  const auto end = std::ranges::find_if(samples, past);
  return samples.first(static_cast<std::size_t>(end - samples.begin()));
}

std::optional<double> relative_error(double theory, const std::optional<double>& measured) {
  return measured && *measured > 0.0 ? std::optional(theory / *measured - 1.0) : std::nullopt;
}

}  // namespace

double moving_density_of(const Scene& scene) {
  return scene.mass_scaling.mass * scene.total_mass / (scene.length * scene.width * scene.depth);
}

double relative_density_of(const Scene& scene) {
  const double envelope = scene.length * scene.width * scene.depth;
  return envelope > 0.0 ? scene.total_mass / (scene.materials.front().density * envelope) : 0.0;
}

Theory theory_of(const Scene& scene) {
  if (!scene.plates.present) {
    return {};
  }
  Theory theory;
  const double relative_density = relative_density_of(scene);
  theory.gibson_ashby = scene.collapse_stress;
  theory.densification_strain = 1.0 - 1.4 * relative_density;
  if (theory.gibson_ashby > 0.0) {  // known of regular lattices only
    theory.shock = theory.gibson_ashby +
                   moving_density_of(scene) * scene.plates.speed * scene.plates.speed / theory.densification_strain;
  }
  return theory;
}

std::optional<FrontSummary> summarize_front(const Scene& scene, std::span<const Sample> samples,
                                            double stress_support) {
  std::vector<const Sample*> fronts;
  std::size_t in_window = 0;
  for (const Sample& sample : samples) {
    if (sample.strain < Summary::kPlateauLow || sample.strain > Summary::kPlateauHigh) {
      continue;
    }
    ++in_window;
    if (sample.front) {
      fronts.push_back(&sample);
    }
  }
  if (fronts.empty() || 2 * fronts.size() < in_window) {
    return std::nullopt;
  }
  FrontSummary summary;
  for (double Front::*const value :
       {&Front::position, &Front::strain_behind, &Front::strain_ahead, &Front::velocity_behind, &Front::velocity_ahead,
        &Front::solid_fraction_behind, &Front::wall_fraction_behind}) {
    summary.*value = mean_of(fronts, [value](const Sample& sample) { return (*sample.front).*value; });
  }
  summary.window_share = static_cast<double>(fronts.size()) / static_cast<double>(in_window);
  const double density = moving_density_of(scene);
  const double length_ahead = scene.length - summary.position;
  summary.stress_ahead = stress_support + density * length_ahead * acceleration_ahead(fronts, summary.velocity_ahead);
  const double velocity_jump = summary.velocity_behind - summary.velocity_ahead;
  summary.shock =
      summary.stress_ahead + density * velocity_jump * velocity_jump / (summary.strain_behind - summary.strain_ahead);
  return summary;
}

std::optional<double> Summary::shock_error() const {
  return theory.shock > 0.0 ? relative_error(theory.shock, plateau_stress_impact) : std::nullopt;
}

std::optional<double> Summary::front_shock_error() const {
  return front ? relative_error(front->shock, plateau_stress_impact) : std::nullopt;
}

Summary summarize(const Scene& scene, std::span<const Sample> all) {
  Summary summary;
  summary.theory = theory_of(scene);
  summary.valid_to_strain = closing_strain_of(scene);
  if (all.empty()) {
    return summary;
  }
  summary.step_count = all.back().step;
  summary.rigid_link_count = static_cast<std::int64_t>(scene.rigid.links);
  summary.start_overlap_count = std::ssize(scene.start_overlaps.walls());
  const bool has_travelled = scene.plates.kinetic_share > 0.0 ? all.back().travel >= scene.plates.end_travel
                                                              : all.back().step >= scene.schedule.step_count;
  const bool is_crushed_enough = scene.schedule.end_strain > 0.0 && all.back().strain >= scene.schedule.end_strain;
  summary.end = is_crushed_enough ? RunEnd::strain : has_travelled ? scene.schedule.end : RunEnd::at_rest;
  summary.deepest_penetration = all.back().deepest_penetration;
  summary.energy_error_relative = energy_error_of(all);
  summary.warnings = collect_warnings(scene, all);
  summary.inertia_share = find_inertia_share(scene, all);
  summary.rigid_walls = summarize_rigid_walls(all);
  summary.break_count = all.back().break_count;
  const auto broken = std::ranges::find_if(all, [](const Sample& sample) { return !sample.breaks.empty(); });
  if (broken != all.end()) summary.first_break = FirstBreak{broken->breaks.front().time, broken->strain};
  std::optional<std::int64_t> closed_step;
  const auto closed = std::ranges::find(summary.warnings, Warning::Kind::closed, &Warning::kind);
  if (!scene.plates.present && closed != summary.warnings.end()) {
    closed_step = closed->step;
    summary.valid_to_time = static_cast<double>(closed->step) * scene.schedule.time_step;
  }
  const std::span<const Sample> valid = before_closing(scene, all, closed_step);
  summary.fibre_strain = find_fibre_strain(scene, valid);
  if (!is_crushed(scene) || valid.empty()) {
    return summary;
  }
  const std::vector<Sample> grown = scene.crushing_walls ? while_strain_grows(valid) : std::vector<Sample>();
  const std::span<const Sample> samples = scene.crushing_walls ? std::span(grown) : valid;
  const Curve impact(samples, &Sample::stress_impact);
  const Curve support(samples, &Sample::stress_support);
  summary.plateau_stress_impact = impact.mean(Summary::kPlateauLow, Summary::kPlateauHigh);
  if (has_support(scene)) {
    summary.plateau_stress_support = support.mean(Summary::kPlateauLow, Summary::kPlateauHigh);
    summary.quasi_static = find_quasi_static(samples, impact, support);
    // Without a support the lattice moves as a whole: force over shortening is not what it absorbs.
    summary.absorbed_energy =
        scene.length * scene.width * scene.depth * impact.integral(std::min(kAbsorbedTo, samples.back().strain));
  }
  if (summary.plateau_stress_support) {
    summary.front = summarize_front(scene, samples, *summary.plateau_stress_support);
  }
  const std::optional<LastingRise> rise = find_lasting_rise(scene, samples);
  if (rise && rise->kind != RiseKind::densification) {
    summary.other_rise = rise;
  } else if (rise) {
    summary.densification_strain = rise->strain;
    summary.plateau_stress_to_densification = impact.mean(0.0, *summary.densification_strain);
    summary.solid_fraction_at_densification = solid_fraction_at(scene, *summary.densification_strain);
  }
  summary.peak = find_peak(scene.plates.present ? all : valid, summary.densification_strain.value_or(1.0));
  if (has_support(scene)) {
    summary.crush_forces =
        find_crush_forces(scene, impact, summary.peak, summary.densification_strain.value_or(samples.back().strain));
  }
  summary.poissons_ratio = find_poissons_ratio(samples);
  set_crush_mode(samples, summary);
  return summary;
}

}  // namespace cellcrush
