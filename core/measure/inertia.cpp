#include "measure/inertia.h"

#include <algorithm>
#include <cmath>

#include "measure/theory.h"
#include "measure/warnings.h"
#include "scene/check_spec.h"
#include "scene/quasi_static.h"
#include "scene/solid_area.h"

namespace cellcrush {
namespace {

std::string in_two_digits(double value) {
  const double power = std::floor(std::log10(value)) - 1.0;
  const double unit = std::pow(10.0, std::abs(power));
  return to_text(power < 0.0 ? std::round(value * unit) / unit : std::round(value / unit) * unit);
}

/// The speed at which real masses have the inertia of the run, mm/s.
double speed_with_real_masses(const Scene& scene) { return std::sqrt(scene.mass_scaling.mass) * scene.plates.speed; }

double last_strain_of(const Scene& scene) {
  const Plates& plates = scene.plates;
  if (plates.kinetic_share > 0.0) return plates.end_travel / scene.length;
  const double time = static_cast<double>(scene.schedule.step_count) * scene.schedule.time_step;
  return plates.speed * std::max(0.0, time - 0.5 * plates.ramp_time) / scene.length;
}

/// The sample of the window with the greatest share; null if there is none.
const Sample* find_most_inertia(const Scene& scene, std::span<const Sample> samples) {
  if (!scene.plates.present) return nullptr;
  const InertiaWindow window = inertia_window_of(scene);
  const Sample* found = nullptr;
  for (const Sample& sample : samples) {
    if (window.holds(sample.strain) && (found == nullptr || inertia_share_of(sample) > inertia_share_of(*found))) {
      found = &sample;
    }
  }
  return found;
}

}  // namespace

InertiaWindow inertia_window_of(const Scene& scene) {
  const double closed = closing_strain_of(scene).value_or(1.0);
  const double last = std::min(last_strain_of(scene), closed > 0.0 ? closed : 1.0);
  return {std::min(Summary::kPlateauLow, 0.5 * last), std::min(Summary::kPlateauHigh, last)};
}

double inertia_share_of(const Sample& sample) {
  const double turnover = turnover_of(sample);
  return turnover > 0.0 ? sample.energies.kinetic / turnover : 0.0;
}

double unwanted_share_of(const Scene& scene, double inertia_share) {
  if (scene.plates.kinetic_share > 0.0) return inertia_share;
  return (1.0 - 1.0 / scene.mass_scaling.mass) * inertia_share;
}

std::optional<double> find_inertia_share(const Scene& scene, std::span<const Sample> samples) {
  const Sample* const found = find_most_inertia(scene, samples);
  return found != nullptr ? std::optional(inertia_share_of(*found)) : std::nullopt;
}

std::string words_of_inertia(const Scene& scene, double share) {
  if (scene.plates.kinetic_share > 0.0) {
    return "the kinetic energy is " + percent_of(share) + " of the work done, more than the " +
           percent_of(scene.plates.kinetic_share) + " of loading.kinetic_share, though the plate was slowed down";
  }
  const double speed = scene.plates.speed / kMmPerM;
  return "the kinetic energy of the added mass is " + percent_of(share) +
         " of the work done: with numerics.mass_scaling " + to_text(scene.mass_scaling.mass) + " at " + to_text(speed) +
         " m/s the lattice has the inertia of a crush at " + in_two_digits(speed_with_real_masses(scene) / kMmPerM) +
         " m/s";
}

std::string remedy_for_inertia(const Scene& scene, double share) {
  if (scene.plates.kinetic_share > 0.0) {
    return "Cells that snap move by themselves, however slow the plate is: give loading.kinetic_share as at least " +
           in_two_digits(1.1 * share) + ", use a larger specimen, or damp them by numerics.mass_damping_per_s.";
  }
  const double speed_for_it = quasi_static_speed(kRemediedInertia, relative_density_of(scene), scene.materials.front());
  const double of_speed = speed_for_it / speed_with_real_masses(scene);
  const double factor = std::min(of_speed * of_speed, kRemediedInertia / share);
  const double scaling = factor * scene.mass_scaling.mass;
  const std::string speed = "give loading.speed_m_per_s as at most " +
                            in_two_digits(std::sqrt(factor) * scene.plates.speed / kMmPerM) +
                            " with this scaling. Or give loading.quasi_static, which needs neither.";
  return scaling > 1.0
             ? "Give numerics.mass_scaling as at most " + in_two_digits(scaling) + " at this speed, or " + speed
             : "Leave out numerics.mass_scaling: real masses suit this speed. Or " + speed;
}

std::optional<Warning> warn_of_inertia(const Scene& scene, std::span<const Sample> samples) {
  const Sample* const found = find_most_inertia(scene, samples);
  if (found == nullptr) return std::nullopt;
  const double share = unwanted_share_of(scene, inertia_share_of(*found));
  const double bound = scene.plates.kinetic_share > 0.0 ? scene.plates.kinetic_share : kInertiaWarning;
  if (share <= bound) return std::nullopt;
  return Warning{Warning::Kind::inertia, found->step, found->strain,
                 "At " + moment_of(found->step, found->time) + ", " + words_of_inertia(scene, share) +
                     ". Inertia raises the stresses.",
                 remedy_for_inertia(scene, share)};
}

}  // namespace cellcrush
