#include "step/advance_block.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "beam/wide_walls.h"
#include "contact/border_check.h"
#include "contact/bucket_search.h"
#include "contact/contact_forces.h"
#include "contact/contact_lots.h"
#include "contact/face_search.h"
#include "contact/find_contacts.h"
#include "contact/one_list.h"
#include "contact/plate_forces.h"
#include "parallel/wavefront.h"
#include "scene/bands.h"
#include "simd/target.h"
#include "step/integrate_motion.h"
#include "step/stage_teller.h"
#include "step/wide_motion.h"

namespace cellcrush {
namespace {

/// On an AMD EPYC with 32 MB of last cache, 16 times the cells of Type I, one thread, before contacts: 4, 7, 10, 20 steps at once
/// 9.3, 8.5, 8.3, 9.3 ns an element-step.
constexpr std::size_t kMostStepsAtOnce = 10;
/// More in a block, so that the next begin where the first end: as many as there are between two samples, mostly.
constexpr std::int64_t kMostSteps = 32;

/// Bands by which a step is behind the one before it. A band's step writes to its own band and to the one before, and the
/// contacts that come with it, of the band before, to one more: the band after these has been done with when they are. Side by
/// side with them it must be one more.
std::size_t lag_of(const Workspace& workspace) { return workspace.workers.count() > 1 ? kBandsBehind : 2; }

std::size_t steps_at_once(const Scene& scene, const Workspace& workspace) {
  const auto threads = static_cast<std::size_t>(workspace.workers.count());
  const std::size_t fitting = kCacheBytes / (lag_of(workspace) * bytes_of_band(scene));
  return std::max(std::min(fitting, kMostStepsAtOnce) / threads * threads, threads);
}

/// The steps of a block: the plates, which go their way whatever the lattice does, and what is summed over it.
void begin_steps(const Scene& scene, const State& state, std::span<BlockStep> steps) {
  const double dt = scene.schedule.time_step;
  double travel = state.impact_travel;
  std::int64_t before = state.step;
  double time = state.time;
  for (BlockStep& step : steps) {
    step.plates = plate_step_of(scene, time, travel);
    travel = step.plates.travel;
    time = static_cast<double>(++before) * dt;
    step.plate = {travel, scene.plates.speed_at(time - 0.5 * dt)};
    step.reach = reach_of_plates(scene, travel);
    step.sums = begin_contact_sums(state);
    step.has_crossed = false;
    step.moved.resize(moved_chunk_count(scene));
    step.plastic_work.resize(static_cast<std::size_t>(scene.walls.chunk_count()));
    step.near.resize(scene.bands.size());
  }
}

class Block {
 public:
  Block(const Scene& scene, State& state, std::vector<int>& near_plates, std::span<BlockStep> steps)
      : scene_(scene), state_(state), near_(near_plates), steps_(steps) {}

  /// A step's motion and walls of a band, if there is one, and the contacts of the band before.
  void advance(std::size_t step, std::size_t band, WorkspacePart& part, const StageTeller& teller) {
    if (band < scene_.bands.size()) {
      move(steps_[step], band, part, teller);
    }
    if (band > 0) {
      evaluate_contacts(steps_[step], band - 1, part, teller);
    }
  }

 private:
  void move(BlockStep& step, std::size_t band, WorkspacePart& part, const StageTeller& teller) {
    teller.begin(Stage::integrate_motion);
    move_band_of_particles_wide(scene_, state_, step.reach, scene_.bands[band], step.moved.data(), near_.data());
    const MovedRanges moved = moved_ranges_of(scene_, scene_.bands[band]);
    step.near[band] = {close_up(step, moved.first_of_joints, moved.end_of_joints),
                       close_up(step, moved.first_of_inner, moved.end_of_inner)};
    teller.begin(Stage::evaluate_internal_forces);
    evaluate_band_walls_wide(scene_, state_, scene_.bands[band], part.walls, step.plastic_work.data());
  }

  /// Moves what chunks have noted of particles near a plate together, and returns how many there are.
  std::size_t close_up(const BlockStep& step, std::size_t first_chunk, std::size_t end_chunk) {
    std::size_t count = 0;
    for (std::size_t c = first_chunk; c < end_chunk; ++c) {
      const MovedChunk& chunk = step.moved[c];
      std::copy_n(&near_[chunk.first], chunk.near_count, &near_[step.moved[first_chunk].first + count]);
      count += chunk.near_count;
    }
    return count;
  }

  void evaluate_contacts(BlockStep& step, std::size_t b, WorkspacePart& part, const StageTeller& teller) {
    const LatticeBand& band = scene_.bands[b];
    teller.begin(Stage::find_contacts);
    const bool is_planar = search_faces(scene_, state_, band, scene_.faces.bands[b], state_.contacts[b], part.alone);
    step.has_crossed = step.has_crossed || !is_planar;
    teller.begin(Stage::evaluate_contact_forces);
    evaluate_contact_forces(scene_, state_, b, part.contact, part.alone, step.sums);
    teller.begin(Stage::evaluate_plate_forces);
    const std::span<const int> near(near_);
    evaluate_plate_forces(scene_, state_, step.plate, band, near.subspan(band.first_joint, step.near[b].joints),
                          step.sums);
    evaluate_plate_forces(scene_, state_, step.plate, band, near.subspan(band.first_inner, step.near[b].inner),
                          step.sums);
  }

  const Scene& scene_;
  State& state_;
  std::vector<int>& near_;
  std::span<BlockStep> steps_;
};

/// Books what a step's forces have done, as integrate_motion and evaluate_internal_forces do.
void book(const Scene& scene, const BlockStep& step, State& state) {
  for (const MovedChunk& chunk : step.moved) {
    chunk.works.book(state.ledger);
  }
  book_plates(scene, step.plates, state);
  for (const double work : step.plastic_work) {
    state.ledger.plastic += work;
  }
  const ContactTotals before = state.contact_totals;
  put_contact_sums(step.sums, state);
  state.contact_totals.deepest_penetration =
      std::max(before.deepest_penetration, state.contact_totals.deepest_penetration);
  state.contact_totals.deepest_birth = std::max(before.deepest_birth, state.contact_totals.deepest_birth);
}

}  // namespace

bool can_advance_blocks(const Scene& scene, const State& state) {
  return scene.bands.size() > 1 && use_wide_kernels() && have_wide_motion(scene) && has_vector_kernel(scene.section) &&
         searches_faces(scene, state);
}

std::int64_t steps_in_block(std::int64_t steps) {
  const std::int64_t blocks = (steps + kMostSteps - 1) / kMostSteps;
  return (steps + blocks - 1) / blocks;
}

void advance_block(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps,
                   StageObserver* observer) {
  const StageTeller teller(observer);
  const std::int64_t first = state.step;
  workspace.prepare_block(scene.particle_count(), static_cast<std::size_t>(steps));
  const std::span<BlockStep> block_steps = workspace.block;
  begin_steps(scene, state, block_steps);
  renew_contact_lots(scene, state, steps);
  state.step += steps;
  Block block(scene, state, workspace.motion.near_plates, block_steps);
  Wavefront wavefront(block_steps.size(), scene.bands.size() + 1, lag_of(workspace), steps_at_once(scene, workspace));
  workspace.workers.share_parts(
      static_cast<std::size_t>(workspace.workers.count()), 1, [&](std::size_t part, std::size_t, std::size_t) {
        const StageTeller of_part = part == 0 ? teller : StageTeller(nullptr);
        wavefront.advance(
            [&](std::size_t step, std::size_t band) { block.advance(step, band, workspace.parts[part], of_part); });
      });
  for (const BlockStep& step : block_steps) {
    book(scene, step, state);
  }
  state.time = static_cast<double>(state.step) * scene.schedule.time_step;
  const auto crossed =
      std::find_if(block_steps.begin(), block_steps.end(), [](const BlockStep& step) { return step.has_crossed; });
  if (crossed != block_steps.end()) {
    state.crossing_step = first + 1 + (crossed - block_steps.begin());
    put_into_one_list(state);
  } else if (!borders_are_apart(scene, state, kMostSteps)) {
    put_into_one_list(state);
    search_buckets(scene, state, state.contacts.front());
  }
  teller.end_step();
}

}  // namespace cellcrush
