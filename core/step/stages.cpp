#include "step/stages.h"

#include <algorithm>
#include <span>

#include "beam/internal_forces.h"
#include "contact/contact_forces.h"
#include "contact/contact_search.h"
#include "contact/contact_tiles.h"
#include "contact/repeated_mesh.h"
#include "fracture/release.h"
#include "motion/integrate_motion.h"
#include "motion/loads.h"
#include "motion/periodic_sides.h"
#include "motion/rigid_motion.h"
#include "push/push.h"

namespace cellcrush {
namespace {

/// Moves the free particles of a band (E2) and clears the contact forces that moved them.
void move_band(StepInProgress& step, std::size_t band) {
  step.record.near[band] = integrate_motion(step.scene, step.state, step.scene.bands[band], step.record.plates.reach,
                                            step.workspace.workers, step.record.moved, step.near_plates);
}

void move_all(StepInProgress& step) {
  State& state = step.state;
  step.record.of_rigid_bodies = move_rigid_bodies(step.scene, state);
  for (const Pusher* pusher : pushers()) {
    if (pusher->move != nullptr) {
      pusher->move(step.scene, state);
    }
  }
  for (std::size_t band = 0; band < step.scene.bands.size(); ++band) {
    move_band(step, band);
  }
  move_sides(step.scene, state);
  ++state.step;
  state.time = static_cast<double>(state.step) * step.scene.schedule.time_step;
  watch_approach(step.scene, state);
}

void evaluate_band_walls(StepInProgress& step, std::size_t band) {
  evaluate_internal_forces(step.scene, step.state, step.scene.bands[band], step.workspace.walls, step.workspace.workers,
                           step.record.plastic_work.data());
}

void deform_all_walls(StepInProgress& step) {
  deform_walls(step.scene, step.state, step.workspace.walls, step.workspace.workers);
}

void respond_piece_of_walls(StepInProgress& step, std::size_t piece) {
  respond_walls(step.scene, step.state, step.workspace.walls, piece, step.record.plastic_work.data());
}

void sum_joints(StepInProgress& step) { sum_joint_forces(step.scene, step.state, step.workspace.workers); }

void find_all_contacts(StepInProgress& step) {
  if (step.scene.repeated != nullptr) {
    begin_repeated_contacts(step.scene, step.state, step.workspace.repeated);
    find_contacts(*step.scene.repeated, step.workspace.repeated, step.workspace.workers);
    return;
  }
  find_contacts(step.scene, step.state, step.workspace.workers);
  rebuild_contact_tiles(step.scene, step.state, 1);
}

void find_band_contacts(StepInProgress& step, std::size_t band) {
  const bool is_planar = cellcrush::find_band_contacts(step.scene, step.state, band, step.workspace.workers);
  step.record.has_crossed = step.record.has_crossed || !is_planar;
}

/// On the balls of a band and the segments that they touch.
void evaluate_band_contacts(StepInProgress& step, std::size_t band) {
  if (step.scene.repeated != nullptr) {
    evaluate_contact_forces(*step.scene.repeated, step.workspace.repeated, band, step.workspace.contact,
                            step.workspace.workers, step.record.contacts);
    end_repeated_contacts(step.scene, step.workspace.repeated, step.state, step.record.contacts.sides);
    return;
  }
  evaluate_contact_forces(step.scene, step.state, band, step.workspace.contact, step.workspace.workers,
                          step.record.contacts);
}

void evaluate_band_plates(StepInProgress& step, std::size_t band) {
  const std::span<const int> near(step.near_plates);
  const NearCounts& counts = step.record.near[band];
  const LatticeBand& of = step.scene.bands[band];
  const PressedBand on = {of, near.subspan(static_cast<std::size_t>(of.first_joint), counts.joints),
                          near.subspan(static_cast<std::size_t>(of.first_inner), counts.inner)};
  for (const Pusher* pusher : pushers()) {
    pusher->press(step.scene, step.state, step.record.plates, on, step.record.contacts);
  }
}

void evaluate_all_loads(StepInProgress& step) {
  evaluate_loads(step.scene, step.state);
  release_ends(step.scene, step.state);
  share_pin_forces(step.scene, step.state);
  tie_sides(step.scene, step.record.contacts.sides, step.state);
}

constexpr SplitStage kSplitWalls = {.begin = deform_all_walls,
                                    .piece_count = wall_piece_count,
                                    .piece = respond_piece_of_walls,
                                    .end = sum_joints,
                                    .reads = kGeometry | kStresses,
                                    .writes = kStresses | kInternalForces};

constexpr std::array<StageEntry, kStageCount> kList = {{
    {.stage = Stage::integrate_motion,
     .reads = kMotion | kInternalForces | kContactForces | kLoads,
     .writes = kMotion | kContactForces,
     .on_band = move_band,
     .on_whole = move_all},
    {.stage = Stage::evaluate_internal_forces,
     .reads = kMotion | kGeometry | kStresses,
     .writes = kGeometry | kStresses | kInternalForces,
     .on_band = evaluate_band_walls,
     .split = &kSplitWalls},
    {.stage = Stage::find_contacts,
     .reads = kMotion | kGeometry | kContactLists,
     .writes = kContactLists,
     .bands_behind = 1,
     .on_band = find_band_contacts,
     .on_whole = find_all_contacts},
    {.stage = Stage::evaluate_contact_forces,
     .reads = kMotion | kGeometry | kContactLists,
     .writes = kContactLists | kContactForces,
     .bands_behind = 1,
     .on_band = evaluate_band_contacts},
    {.stage = Stage::evaluate_plate_forces,
     .reads = kMotion | kGeometry,
     .writes = kContactForces,
     .bands_behind = 1,
     .on_band = evaluate_band_plates},
    {.stage = Stage::evaluate_loads,
     .reads = kMotion | kGeometry | kInternalForces | kContactForces,
     .writes = kLoads | kInternalForces | kContactForces,
     .on_whole = evaluate_all_loads},
}};

constexpr bool has_every_stage_in_order() {
  for (std::size_t i = 0; i < kList.size(); ++i) {
    if (kList[i].stage != static_cast<Stage>(i)) {
      return false;
    }
  }
  return true;
}
static_assert(has_every_stage_in_order());
static_assert(runs_beside(kList[static_cast<std::size_t>(Stage::evaluate_plate_forces)], kSplitWalls));
static_assert(!runs_beside(kList[static_cast<std::size_t>(Stage::evaluate_loads)], kSplitWalls));

}  // namespace

const std::array<StageEntry, kStageCount> kStages = kList;

void watch_approach(const Scene& scene, State& state) {
  if (state.fastest_step.empty()) {
    return;
  }
  Vector2 low = state.velocity[0];
  Vector2 high = low;
  for (const Vector2& velocity : state.velocity) {
    low = low.cwiseMin(velocity);
    high = high.cwiseMax(velocity);
  }
  const double travel = scene.schedule.time_step * (high - low).norm();
  FastestStep& fastest = state.fastest_step.front();
  if (travel > fastest.travel) {
    const Vector2 middle = 0.5 * (low + high);
    const auto slower = [&](const Vector2& a, const Vector2& b) {
      return (a - middle).squaredNorm() < (b - middle).squaredNorm();
    };
    const auto particle = std::max_element(state.velocity.begin(), state.velocity.end(), slower);
    fastest = {travel, state.step, particle - state.velocity.begin()};
  }
}

}  // namespace cellcrush
