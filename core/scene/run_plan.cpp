#include "scene/run_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lattice/lattice.h"
#include "scene/check_spec.h"
#include "scene/contact_law.h"
#include "scene/quasi_static.h"
#include "scene/time_step.h"
#include "scene/unit_sets.h"

namespace cellcrush {
namespace {

/// Strain past the ramp from which a lattice is worth crushing.
constexpr double kWorthRunning = 0.05;

Plates plates_of(const SceneSpec& spec, const MeshMeasures& mesh, double stiffness) {
  const double speed = *spec.loading.speed_m_per_s * kMmPerM;
  const double ramp_time = 2.0 * spec.loading.ramp_strain * mesh.length / speed;
  Plates plates;
  plates.present = true;
  plates.axis = crush_axis_of(spec);
  plates.speed = speed;
  plates.ramp_time = ramp_time;
  plates.kinetic_share = spec.loading.quasi_static ? spec.loading.kinetic_share : 0.0;
  plates.stiffness = stiffness;
  plates.friction = spec.plates.friction;
  return plates;
}

struct End {
  double time = 0.0;  ///< s
  RunEnd reason = RunEnd::time;
};

/// The strain at which a run between plates ends. By default it ends where the lattice is closed: past that, results
/// depend on the mesh. Of a lattice that is all but closed before loading the whole run is computed.
std::pair<double, RunEnd> end_strain_of(const SceneSpec& spec, const MeshMeasures& mesh) {
  const double by_default = LoadingSpec::kDefaultEndStrain;
  const double closed = mesh.closing_strain;
  const bool ends_there =
      !spec.loading.end_strain && closed < by_default && closed > spec.loading.ramp_strain + kWorthRunning;
  return ends_there ? std::pair(closed, RunEnd::closed)
                    : std::pair(spec.loading.end_strain.value_or(by_default), RunEnd::strain);
}

/// The end at a strain, or at end_time_s where that comes first or there are no plates.
End end_of(const SceneSpec& spec, const MeshMeasures& mesh, const Plates& plates) {
  const double given = spec.loading.end_time_s.value_or(std::numeric_limits<double>::infinity());
  if (!plates.present) return {given, RunEnd::time};
  const auto [strain, reason] = end_strain_of(spec, mesh);
  const double slowing = spec.loading.quasi_static ? slowing_of_quasi_static(strain) : 1.0;
  const double time = slowing * strain * mesh.length / plates.speed + 0.5 * plates.ramp_time;
  return given < time ? End{given, RunEnd::time} : End{time, reason};
}

Schedule schedule_of(const SceneSpec& spec, const TimeStep& step, const End& end) {
  Schedule schedule;
  schedule.time_step = step.seconds;
  schedule.bound = step.bound;
  schedule.step_count = static_cast<std::int64_t>(std::ceil(end.time / schedule.time_step - 1e-9));
  schedule.end = end.reason;
  const auto interval = [&](int count) { return std::max<std::int64_t>(1, schedule.step_count / count); };
  schedule.sample_interval = interval(spec.output.sample_count);
  schedule.frame_interval = interval(spec.output.frame_count);
  schedule.end_at_rest = spec.loading.end_at_rest;
  return schedule;
}

void check_stability(const SceneSpec& spec, const MeshMeasures& mesh, Problems& problems) {
  if (spec.numerics.time_step_s > mesh.steps.stable) {
    problems.push_back({"numerics.time_step_s", to_text(spec.numerics.time_step_s),
                        "is above the largest stable step of this mesh, " + to_text(mesh.steps.stable) + " s.",
                        "Use a step of at most " + to_text(mesh.steps.accurate) + " s, or 0 for an automatic step."});
  }
}

/// Names the field responsible for a run with more steps than any machine can do.
void check_step_count(const SceneSpec& spec, double count, Problems& problems) {
  constexpr double kMostSteps = 1e10;
  if (count <= kMostSteps) {
    return;
  }
  const double fixed = spec.numerics.time_step_s;
  const std::string message = "makes " + to_text(std::round(count)) + " steps, more than 1e10.";
  if (fixed > 0.0) {
    problems.push_back(
        {"numerics.time_step_s", to_text(fixed), message, "Use a longer step, or 0 for an automatic step."});
  } else if (has_plates(spec)) {
    problems.push_back({"loading.speed_m_per_s", to_text(*spec.loading.speed_m_per_s), message,
                        "Use a higher speed. For a crush as slow as in a testing machine, give loading.quasi_static "
                        "instead: it chooses the highest speed at which inertia does not matter."});
  } else {
    problems.push_back({"loading.end_time_s", to_text(*spec.loading.end_time_s), message, "Use an earlier end time."});
  }
}

}  // namespace

RunPlan plan_run(const SceneSpec& given, const MeshMeasures& mesh, Problems& problems) {
  const SceneSpec spec = with_chosen_speed(given, mesh);
  RunPlan plan;
  check_stability(spec, mesh, problems);
  if (!problems.empty()) {
    ask_about_units_first(given, problems);
    return plan;
  }
  plan.contact = contact_law_of(spec, mesh);
  problems = mesh.misplaced;
  if (has_plates(spec)) {
    plan.plates = plates_of(spec, mesh, plan.contact.stiffness);
    if (spec.loading.quasi_static) plan.plates.end_travel = end_strain_of(spec, mesh).first * mesh.length;
  }
  const TimeStep step = time_step_of(spec, mesh, plan.contact, plan.plates);
  const End end = end_of(spec, mesh, plan.plates);
  check_step_count(spec, end.time / step.seconds, problems);
  if (problems.empty()) {
    plan.schedule = schedule_of(spec, step, end);
  }
  ask_about_units_first(given, problems);
  return plan;
}

bool prevents_meshing(const Problems& problems) {
  constexpr std::array kPaths = {"lattice",
                                 "material",
                                 "depth_mm",
                                 "elements_per_wall",
                                 "section",
                                 "loading.gravity",
                                 "loading.rigid_walls",
                                 "loading.grips",
                                 "numerics.rigid_link_slenderness"};
  return std::ranges::any_of(problems, [&](const Problem& problem) {
    return std::ranges::any_of(kPaths, [&](const char* path) { return problem.field.starts_with(path); });
  });
}

double steps_to_yield(const SceneSpec& spec, const MeshMeasures& mesh, const RunPlan& plan) {
  if (!plan.plates.present) {
    return static_cast<double>(plan.schedule.step_count);
  }
  if (plan.plates.kinetic_share > 0.0) {
    constexpr double kOfRun = 0.2;  // it starts slowly
    return kOfRun * static_cast<double>(plan.schedule.step_count);
  }
  const double strain = mesh.material.yield_stress / mesh.material.youngs_modulus / mesh.bending_share;
  // In the ramp, the strain grows with the square of time, to half of what the full speed gives in the same time.
  const double ramp = spec.loading.ramp_strain;
  const double strain_at_full_speed = strain < ramp ? 2.0 * std::sqrt(strain * ramp) : strain + ramp;
  return strain_at_full_speed * mesh.length / (plan.plates.speed * plan.schedule.time_step);
}

}  // namespace cellcrush
