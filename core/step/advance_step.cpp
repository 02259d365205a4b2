#include "step/advance_step.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "beam/internal_forces.h"
#include "energy/ledger.h"
#include "motion/initial_state.h"
#include "motion/periodic_sides.h"
#include "push/push.h"
#include "step/advance_wavefront.h"
#include "step/execute_stages.h"
#include "step/step_record.h"

namespace cellcrush {
namespace {

StepInProgress begin_step(const Scene& scene, State& state, Workspace& workspace) {
  size_thickening_step(scene, state);
  workspace.records.resize(1);
  workspace.near_plates.resize(scene.particle_count());
  StepRecord& record = workspace.records.front();
  begin_record(scene, state, state.time, state.impact_travel, record);
  return {scene, state, record, workspace.shared, workspace.near_plates};
}

/// The forces from a stage on, without motion. REQUIRES: they are cleared.
void evaluate_forces(Stage first, StepInProgress& step) {
  StepRecord& record = step.record;
  std::iota(step.near_plates.begin(), step.near_plates.end(), 0);
  for (std::size_t band = 0; band < step.scene.bands.size(); ++band) {
    const LatticeBand& of = step.scene.bands[band];
    record.near[band] = {static_cast<std::size_t>(of.end_joint - of.first_joint),
                         static_cast<std::size_t>(of.end_inner - of.first_inner)};
  }
  execute_stages(std::span(kStages).subspan(static_cast<std::size_t>(first)), step, StageScope(nullptr));
  put_contact_sums(record.contacts, step.state);
}

}  // namespace

State make_initial_state(const Scene& scene) {
  State state = place_particles(scene);
  for (const Pusher* pusher : pushers()) {
    pusher->place(scene, state);
  }
  Workspace workspace;
  StepInProgress step = begin_step(scene, state, workspace);
  step.record.plates.travel = 0.0;
  step.record.plates.speed = plate_speed_at(scene, state, -0.5 * scene.schedule.time_step);
  evaluate_forces(Stage::evaluate_internal_forces, step);
  stagger_velocities(scene, state);
  stagger_sides(scene, state);
  for (const Pusher* pusher : pushers()) {
    if (pusher->stagger != nullptr) {
      pusher->stagger(scene, state);
    }
  }
  open_ledger(scene, state);
  return state;
}

void advance_step(const Scene& scene, State& state, Workspace& workspace, StageObserver* observer) {
  const StageScope scope(observer);
  StepInProgress step = begin_step(scene, state, workspace);
  execute_stages(kStages, step, scope);
  accumulate(scene, step.record, state);
  scope.end_step();
}

void evaluate_forces_again(Scene& scene, State& state, Workspace& workspace) {
  const double time_step = std::exchange(scene.schedule.time_step, 0.0);
  const ContactTotals before = state.contact_totals;
  sum_joint_forces(scene, state, 0, static_cast<std::size_t>(scene.joint_count));
  StepInProgress step = begin_step(scene, state, workspace);
  evaluate_forces(Stage::find_contacts, step);
  state.contact_totals.deepest_penetration =
      std::max(before.deepest_penetration, state.contact_totals.deepest_penetration);
  state.contact_totals.deepest_birth = std::max(before.deepest_birth, state.contact_totals.deepest_birth);
  scene.schedule.time_step = time_step;
}

void advance_steps(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps,
                   StageObserver* observer) {
  const std::int64_t end = state.step + steps;
  while (state.step < end) {
    if (const std::int64_t at_once = begin_wavefront(scene, state, end - state.step); at_once > 0) {
      advance_wavefront(scene, state, workspace, at_once, observer);
    } else {
      advance_step(scene, state, workspace, observer);
    }
  }
}

void advance_step(const Scene& scene, State& state, StageObserver* observer) {
  Workspace workspace;
  advance_step(scene, state, workspace, observer);
}

}  // namespace cellcrush
