#include "contact/find_overlaps.h"

#include <cmath>
#include <limits>

#include "contact/candidate_lists.h"
#include "contact/capsule.h"
#include "contact/wide_overlaps.h"
#include "simd/target.h"

namespace cellcrush {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

std::size_t find_awake_plain(const State& state, std::size_t first, std::size_t end, int* places) {
  std::size_t count = 0;
  for (std::size_t place = first; place < end; ++place) {
    const bool asleep = travel_of_batch(state, place / kCandidateBatch) < state.candidate_alarm[place];
    places[count] = static_cast<int>(place);
    count += asleep ? 0 : 1;
  }
  return count;
}

void test_awake_plain(const Scene& scene, const State& state, AwakeCandidates& awake) {
  for (std::size_t i = 0; i < awake.count; ++i) {
    const int segment = awake.segment[i];
    const double reach = awake.reach[i];
    const Projection foot = project(state.position[awake.ball[i]], state.position[scene.elements[segment].start],
                                    state.axis[segment], state.length[segment]);
    const double squared_distance = foot.offset.squaredNorm();
    const double gap = std::sqrt(squared_distance) - reach;
    awake.alarm[i] = squared_distance < reach * reach ? kNever : awake.travel[i] + gap;
  }
}

/// What the test reads of the candidates that are awake.
void collect(const State& state, AwakeCandidates& awake) {
  const bool sleeps = !state.batch_group.empty();
  for (std::size_t i = 0; i < awake.count; ++i) {
    const auto place = static_cast<std::size_t>(awake.place[i]);
    awake.ball[i] = state.candidate_ball[place];
    awake.segment[i] = state.candidate_segment[place];
    awake.reach[i] = state.candidate_reach[place];
    awake.travel[i] = sleeps ? travel_of_batch(state, place / kCandidateBatch) : -kNever;
  }
}

/// The candidates from `first` to `end` that overlap; sets the alarms of the others that are awake.
void find_overlaps_in(const Scene& scene, State& state, std::size_t first, std::size_t end, ContactPart& part) {
  AwakeCandidates& awake = part.awake;
  awake.make_room(end - first);
  const bool is_wide = use_wide_kernels();
  awake.count = (is_wide ? find_awake_wide : find_awake_plain)(state, first, end, awake.place.data());
  collect(state, awake);
  (is_wide ? test_awake_wide : test_awake_plain)(scene, state, awake);
  part.found.clear();
  for (std::size_t i = 0; i < awake.count; ++i) {
    state.candidate_alarm[awake.place[i]] = awake.alarm[i];
    if (awake.alarm[i] == kNever) {
      part.found.push_back(awake.place[i]);
    }
  }
}

}  // namespace

void find_overlaps(const Scene& scene, State& state, ContactWorkspace& workspace, Workers& workers) {
  workers.share_parts(state.candidate_ball.size(), kCandidateBatch,
                      [&](std::size_t part, std::size_t first, std::size_t end) {
                        find_overlaps_in(scene, state, first, end, workspace.parts[part]);
                      });
  workspace.found.clear();
  for (const ContactPart& part : workspace.parts) {
    workspace.found.insert(workspace.found.end(), part.found.begin(), part.found.end());
  }
}

}  // namespace cellcrush
