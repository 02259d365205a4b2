#include <algorithm>
#include <cmath>
#include <sstream>

#include "cellcrush/scene.h"
#include "measure/warnings.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "stability/stability_map.h"

namespace cellcrush::stability {
namespace {

constexpr double kEndStrain = 0.6;
constexpr int kSamples = 200;

std::shared_ptr<Scene> specimen(const std::string& lattice, double speed) {
  SceneSpec spec = scenes::spec_of({lattice.c_str(), speed, 0.0}, 12, 6);
  spec.loading.end_strain = kEndStrain;
  return scenes::build(spec);
}

double lightest_of(const Scene& scene) { return *std::min_element(scene.mass.begin(), scene.mass.end()); }

/// What the solver chooses by itself at a speed.
Point default_at(const std::string& lattice, double speed) {
  const auto scene = specimen(lattice, speed);
  return {speed, scene->contact.stiffness * scene->stable_step * scene->stable_step / lightest_of(*scene),
          scene->schedule.time_step / scene->stable_step};
}

}  // namespace

std::string name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::stable: return "stable";
    case Outcome::drifting: return "drifting";
    case Outcome::lost: break;
  }
  return "lost";
}

Result crush(const std::string& lattice, const Point& point) {
  const auto scene = specimen(lattice, point.speed);
  Schedule& schedule = scene->schedule;
  const double end = static_cast<double>(schedule.step_count) * schedule.time_step;
  schedule.time_step = point.step * scene->stable_step;
  schedule.step_count = std::llround(end / schedule.time_step);
  schedule.sample_interval = std::max<std::int64_t>(1, schedule.step_count / kSamples);
  scene->contact.stiffness = scene->plates.stiffness =
      point.penalty * lightest_of(*scene) / (scene->stable_step * scene->stable_step);

  Simulation simulation(scene);
  std::vector<Sample> samples;
  scenes::watch(simulation, [&](const Sample& sample) { samples.push_back(sample); });
  Result result;
  result.point = point;
  result.status = simulation.status().kind;
  result.deepest_penetration = samples.back().deepest_penetration;
  result.end_strain = samples.back().strain;
  const double last = samples.back().energies.external;
  for (const Sample& sample : samples) {
    if (sample.energies.external > 0.01 * last) {
      result.energy_error = std::max(result.energy_error, std::abs(sample.energies.residual) / turnover_of(sample));
      result.contact_energy = std::max(result.contact_energy, -sample.energies.contact / turnover_of(sample));
    }
  }
  if (result.status != RunStatus::Kind::finished) {
    result.outcome = Outcome::lost;
  } else if (std::max(result.energy_error, result.contact_energy) > kEnergyDrift) {
    result.outcome = Outcome::drifting;
  }
  return result;
}

std::vector<Result> crush_all(const std::string& lattice, const Grid& grid,
                              const std::function<void(const Result&)>& told) {
  std::vector<Result> results;
  for (const double speed : grid.speeds) {
    for (const double penalty : grid.penalties) {
      for (const double step : grid.steps) {
        results.push_back(crush(lattice, {speed, penalty, step}));
        told(results.back());
      }
    }
  }
  return results;
}

std::vector<Result> crush_defaults(const std::string& lattice, const Grid& grid,
                                   const std::function<void(const Result&)>& told) {
  std::vector<Result> results;
  for (const double speed : grid.speeds) {
    results.push_back(crush(lattice, default_at(lattice, speed)));
    results.back().is_chosen = true;
    told(results.back());
  }
  return results;
}

std::string as_csv(const std::vector<Result>& results) {
  std::ostringstream text;
  text.precision(4);
  text << "chosen,speed_m_per_s,penalty,step,outcome,status,energy_error,contact_energy,deepest_penetration,end_"
          "strain\n";
  for (const Result& result : results) {
    text << result.is_chosen << ',' << result.point.speed << ',' << result.point.penalty << ',' << result.point.step
         << ',' << name_of(result.outcome) << ',' << scenes::name_of(result.status) << ',' << result.energy_error << ','
         << result.contact_energy << ',' << result.deepest_penetration << ',' << result.end_strain << '\n';
  }
  return text.str();
}

}  // namespace cellcrush::stability
