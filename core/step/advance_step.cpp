#include "step/advance_step.h"

#include <numeric>

#include "beam/internal_forces.h"
#include "beam/joint_forces.h"
#include "cellcrush/tuning.h"
#include "contact/contact_search.h"
#include "contact/contact_tiles.h"
#include "energy/ledger.h"
#include "motion/initial_state.h"
#include "motion/loads.h"
#include "motion/pin_forces.h"
#include "motion/rigid_motion.h"
#include "step/advance_wavefront.h"
#include "step/stages.h"
#include "step/watch_approach.h"

namespace cellcrush {
namespace {

bool overlaps_contacts(const Scene& scene, const Workspace& workspace) {
  return workspace.shared.workers.count() > 1 && scene.element_count() <= kMostElementsOverlapped;
}

/// Finds contacts and evaluates the forces of contacts and plates. They need axes and lengths, but no stresses.
void evaluate_contacts(const Scene& scene, State& state, Workspace& workspace, const StageScope& stage) {
  StepRecord& record = workspace.records.front();
  stage.begin(Stage::find_contacts);
  find_contacts(scene, state, workspace.shared.workers);
  rebuild_contact_tiles(scene, state, 1);
  for (std::size_t band = 0; band < scene.bands.size(); ++band) {
    stage.begin(Stage::evaluate_contact_forces);
    evaluate_band_contacts(scene, state, band, record, workspace.shared);
    stage.begin(Stage::evaluate_plate_forces);
    evaluate_band_plates(scene, state, band, record, workspace.near_plates);
  }
}

/// Evaluates the forces at the time of the state, from the positions and velocities at that time.
void evaluate_forces(const Scene& scene, State& state, Workspace& workspace, const StageScope& stage) {
  StepRecord& record = workspace.records.front();
  StageWorkspace& shared = workspace.shared;
  stage.begin(Stage::evaluate_internal_forces);
  if (overlaps_contacts(scene, workspace)) {
    deform_walls(scene, state, shared.walls, shared.workers);
    const auto respond = [&](std::size_t piece) {
      respond_walls(scene, state, shared.walls, piece, record.plastic_work.data());
    };
    shared.workers.parallel_overlap(wall_piece_count(scene), respond,
                                    [&] { evaluate_contacts(scene, state, workspace, stage); });
    stage.begin(Stage::evaluate_internal_forces);
    sum_joint_forces(scene, state, shared.workers);
  } else {
    for (std::size_t band = 0; band < scene.bands.size(); ++band) {
      evaluate_band_walls(scene, state, band, record, shared);
    }
    evaluate_contacts(scene, state, workspace, stage);
  }
  stage.begin(Stage::evaluate_loads);
  evaluate_loads(scene, state);
  share_pin_forces(scene, state);
}

void begin_step(const Scene& scene, State& state, Workspace& workspace) {
  size_thickening_step(scene, state);
  workspace.records.resize(1);
  workspace.near_plates.resize(scene.particle_count());
  begin_record(scene, state, state.time, state.impact_travel, workspace.records.front());
}

}  // namespace

State make_initial_state(const Scene& scene) {
  State state = place_particles(scene);
  Workspace workspace;
  begin_step(scene, state, workspace);
  StepRecord& record = workspace.records.front();
  record.plate = {0.0, scene.plates.speed_at(-0.5 * scene.schedule.time_step)};
  std::iota(workspace.near_plates.begin(), workspace.near_plates.end(), 0);
  for (std::size_t band = 0; band < scene.bands.size(); ++band) {
    const LatticeBand& of = scene.bands[band];
    record.near[band] = {static_cast<std::size_t>(of.end_joint - of.first_joint),
                         static_cast<std::size_t>(of.end_inner - of.first_inner)};
  }
  evaluate_forces(scene, state, workspace, StageScope(nullptr));
  put_contact_sums(record.contacts, state);
  stagger_velocities(scene, state);
  open_ledger(scene, state);
  return state;
}

void advance_step(const Scene& scene, State& state, Workspace& workspace, StageObserver* observer) {
  const StageScope stage(observer);
  begin_step(scene, state, workspace);
  StepRecord& record = workspace.records.front();

  stage.begin(Stage::integrate_motion);
  record.of_rigid_bodies = move_rigid_bodies(scene, state);
  for (std::size_t band = 0; band < scene.bands.size(); ++band) {
    move_band(scene, state, band, record, workspace.shared, workspace.near_plates);
  }
  ++state.step;
  state.time = static_cast<double>(state.step) * scene.schedule.time_step;
  watch_approach(scene, state);

  evaluate_forces(scene, state, workspace, stage);

  accumulate(scene, record, state);
  stage.end_step();
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
