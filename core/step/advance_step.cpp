#include "step/advance_step.h"

#include <numeric>
#include <span>

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

}  // namespace

State make_initial_state(const Scene& scene) {
  State state = place_particles(scene);
  for (const Pusher* pusher : pushers()) {
    pusher->place(scene, state);
  }
  Workspace workspace;
  StepInProgress step = begin_step(scene, state, workspace);
  StepRecord& record = step.record;
  record.plates.travel = 0.0;
  record.plates.speed = plate_speed_at(scene, state, -0.5 * scene.schedule.time_step);
  std::iota(workspace.near_plates.begin(), workspace.near_plates.end(), 0);
  for (std::size_t band = 0; band < scene.bands.size(); ++band) {
    const LatticeBand& of = scene.bands[band];
    record.near[band] = {static_cast<std::size_t>(of.end_joint - of.first_joint),
                         static_cast<std::size_t>(of.end_inner - of.first_inner)};
  }
  execute_stages(std::span(kStages).subspan(1), step, StageScope(nullptr));  // the forces, without motion
  put_contact_sums(record.contacts, state);
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

void advance_steps(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps,
                   StageObserver* observer) {
  const std::int64_t end = state.step + steps;
  while (state.step < end) {
    if (can_advance_wavefronts(scene, state)) {
      advance_wavefront(scene, state, workspace, steps_in_wavefront(end - state.step), observer);
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
