#include "step/advance_wavefront.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "beam/internal_forces.h"
#include "contact/contact_search.h"
#include "contact/contact_tiles.h"
#include "contact/topology/bands.h"
#include "parallel/workers.h"
#include "step/execute_stages.h"

namespace cellcrush {
namespace {

/// Bands by which a step follows the step before. A step of a band writes to that band and to the one before. The
/// contacts and plates of the band before, which it also evaluates, write to one more. Two bands behind, the next step
/// therefore finds its band complete. If threads do both steps side by side, it must be three bands behind.
std::size_t lag_of(const Workspace& workspace) { return workspace.shared.workers.count() > 1 ? kBandsBehind : 2; }

std::size_t steps_at_once(const Scene& scene, const Workspace& workspace) {
  const auto threads = static_cast<std::size_t>(workspace.shared.workers.count());
  const std::size_t for_bands = last_cache_bytes() / 8 * 7;
  const std::size_t fitting = for_bands / (lag_of(workspace) * bytes_of_band(scene));
  return std::max(std::min(fitting, kMostStepsAtOnce) / threads * threads, threads);
}

/// Prepares the records of a wavefront's steps: the plates move independently of the lattice.
void begin_steps(const Scene& scene, const State& state, std::span<StepRecord> records) {
  double travel = state.impact_travel;
  double time = state.time;
  std::int64_t step = state.step;
  for (StepRecord& record : records) {
    begin_record(scene, state, time, travel, record);
    travel = record.plates.travel;
    time = static_cast<double>(++step) * scene.schedule.time_step;
  }
}

/// Places of a wavefront: the bands, and those by which the last stage is behind the first.
std::size_t place_count(const Scene& scene) {
  return scene.bands.size() + std::ranges::max(kStages, {}, &StageEntry::bands_behind).bands_behind;
}

/// Switches to a search by buckets if walls have crossed.
void check_walls(const Scene& scene, State& state, std::int64_t first, std::span<const StepRecord> records) {
  const auto crossed =
      std::find_if(records.begin(), records.end(), [](const StepRecord& record) { return record.has_crossed; });
  if (crossed != records.end()) {
    change_topology(scene, state, TopologyChange::walls_crossed, first + 1 + (crossed - records.begin()));
  }
}

}  // namespace

bool can_advance_wavefronts(const Scene& scene, const State& state) {
  return scene.bands.size() > 1 && searches_faces(scene, state);
}

std::int64_t begin_wavefront(const Scene& scene, State& state, std::int64_t steps) {
  if (!can_advance_wavefronts(scene, state)) return 0;
  const std::int64_t wavefronts = (steps + kMostStepsInWavefront - 1) / kMostStepsInWavefront;
  const std::int64_t even = (steps + wavefronts - 1) / wavefronts;
  const std::int64_t apart = steps_with_borders_apart(scene, state, even);
  if (apart == even || apart >= kFewestStepsInWavefront) return apart;
  change_topology(scene, state, TopologyChange::borders_near, state.step);
  return 0;
}

void advance_wavefront(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps,
                       StageObserver* observer) {
  const StageScope scope(observer);
  const std::int64_t first = state.step;
  Workers& workers = workspace.shared.workers;
  workspace.records.resize(static_cast<std::size_t>(steps));
  workspace.near_plates.resize(scene.particle_count());
  while (workspace.bands.size() < static_cast<std::size_t>(workers.count())) {
    workspace.bands.emplace_back();
  }
  const std::span<StepRecord> records = workspace.records;
  begin_steps(scene, state, records);
  size_thickening_step(scene, state);
  rebuild_contact_tiles(scene, state, steps);
  state.step += steps;
  Wavefront wavefront(records.size(), place_count(scene), lag_of(workspace), steps_at_once(scene, workspace));
  workers.parallel_ranges(
      static_cast<std::size_t>(workers.count()), 1, [&](std::size_t part, std::size_t, std::size_t) {
        const StageScope of_part = part == 0 ? scope : StageScope(nullptr);
        wavefront.advance([&](std::size_t number, std::size_t band) {
          StepInProgress step = {scene, state, records[number], workspace.bands[part], workspace.near_plates};
          execute_band_stages(kStages, step, band, of_part);
        });
      });
  for (const StepRecord& record : records) {
    accumulate(scene, record, state);
  }
  state.time = static_cast<double>(state.step) * scene.schedule.time_step;
  watch_approach(scene, state);
  check_walls(scene, state, first, records);
  scope.end_step();
}

}  // namespace cellcrush
