#include "validation/crush_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "measure/curve.h"
#include "scenes/near_pairs.h"
#include "scenes/state_hash.h"

namespace cellcrush::validation {
namespace {

constexpr double kFlowing = 0.10;  ///< strain at which every lattice of the presets has begun to collapse
constexpr double kSettled = 0.05;  ///< strain from which a crush is asked to be quasi-static

std::shared_ptr<const Scene> build(const SceneSpec& spec) {
  const SceneResult result = build_scene(spec);
  std::string text;
  for (const Problem& problem : result.problems) {
    text += problem.field + " = " + problem.value + ": " + problem.message + " " + problem.remedy + "\n";
  }
  if (!result.scene) {
    throw std::invalid_argument(text);
  }
  return result.scene;
}

/// Mean of the two plates' stresses, smoothed over 0.005 of strain.
class MeanStress {
 public:
  explicit MeanStress(std::span<const Sample> samples)
      : impact_(samples, &Sample::stress_impact), support_(samples, &Sample::stress_support) {}

  static constexpr double kHalfWindow = 0.0025;

  [[nodiscard]] double at(double strain) const {
    const auto integral = [&](double to) { return 0.5 * (impact_.integral(to) + support_.integral(to)); };
    return (integral(strain + kHalfWindow) - integral(strain - kHalfWindow)) / (2.0 * kHalfWindow);
  }

 private:
  Curve impact_;
  Curve support_;
};

Limit find_limit(std::span<const Sample> samples) {
  const MeanStress stress(samples);
  const double last = samples.back().strain - MeanStress::kHalfWindow;
  Limit limit;
  for (const Sample& sample : samples) {
    if (sample.strain >= 0.02 && sample.strain <= std::min(0.20, last) && stress.at(sample.strain) > limit.stress) {
      limit.stress = stress.at(sample.strain);
      limit.strain = sample.strain;
    }
  }
  limit.least_after = limit.stress;
  for (const Sample& sample : samples) {
    if (sample.strain > limit.strain && sample.strain <= std::min(0.14, last)) {
      limit.least_after = std::min(limit.least_after, stress.at(sample.strain));
    }
  }
  return limit;
}

/// Relative difference of the plates' mean stresses beyond `kSettled`.
double plate_force_difference(std::span<const Sample> samples) {
  const double last = samples.back().strain;
  const auto impact = Curve(samples, &Sample::stress_impact).mean(kSettled, last);
  const auto support = Curve(samples, &Sample::stress_support).mean(kSettled, last);
  return impact && last > kSettled ? std::abs(*impact - *support) / *impact : 0.0;
}

double least_contact_work_share(std::span<const Sample> samples) {
  double least = 0.0;
  for (const Sample& sample : samples) {
    if (sample.energies.external > 0.0) {
      least = std::min(least, sample.energies.contact / sample.energies.external);
    }
  }
  return least;
}

/// Greatest kinetic energy over another energy of the same moment, beyond a strain.
double greatest_kinetic_share(std::span<const Sample> samples, double Energies::*energy, double from) {
  double greatest = 0.0;
  for (const Sample& sample : samples) {
    if (sample.strain > from && sample.energies.*energy > 0.0) {
      greatest = std::max(greatest, sample.energies.kinetic / (sample.energies.*energy));
    }
  }
  return greatest;
}

}  // namespace

CrushRun run_crush(const SceneSpec& spec, double until, const CrushWatch& watch) {
  const auto scene = build(spec);
  if (watch.on_start) {
    watch.on_start(*scene);
  }
  CrushRun run;
  run.facts = facts_of(*scene);
  const auto start = std::chrono::steady_clock::now();
  Simulation simulation(scene);
  int frames = 0;
  const auto take_frame = [&] {
    if (watch.on_frame) {
      watch.on_frame(simulation.take_frame(frames));
    }
    ++frames;
  };
  take_frame();
  while (simulation.status().kind == RunStatus::Kind::running && simulation.strain() < until) {
    const std::clock_t before = std::clock();
    simulation.advance(run.facts.sample_interval);
    run.samples.push_back(simulation.take_sample());
    run.processor_seconds += static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    if (watch.on_sample) {
      watch.on_sample(run.samples.back());
    }
    if (simulation.step() >= frames * run.facts.frame_interval) {
      take_frame();
      run.crossings += static_cast<std::int64_t>(scenes::find_crossings(*scene, simulation.state()).size());
    }
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.status = simulation.status();
  run.summary = summarize(*scene, run.samples);
  run.limit = find_limit(run.samples);
  run.deepest_birth = simulation.state().contact_totals.deepest_birth;
  run.contact_work_share = least_contact_work_share(run.samples);
  run.plate_force_difference = plate_force_difference(run.samples);
  run.kinetic_over_work = greatest_kinetic_share(run.samples, &Energies::external, kSettled);
  run.kinetic_over_plastic = greatest_kinetic_share(run.samples, &Energies::plastic, kSettled);
  run.kinetic_over_plastic_flowing = greatest_kinetic_share(run.samples, &Energies::plastic, kFlowing);
  run.state_hash = scenes::hash_of(simulation.state());
  return run;
}

}  // namespace cellcrush::validation
