#include "contact/find_overlaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/capsule.h"
#include "contact/wide_overlaps.h"
#include "simd/target.h"

namespace cellcrush {
namespace {

/// Notes the places of a batch that overlap, from found[0] on; returns how many, and the least gap of the others.
std::size_t test_batch(const Scene& scene, const State& state, std::size_t batch, std::int64_t* found,
                       double& least_gap) {
  std::size_t count = 0;
  least_gap = std::numeric_limits<double>::infinity();
  for (std::size_t k = batch * kCandidateBatch; k < (batch + 1) * kCandidateBatch; ++k) {
    const double reach = state.candidate_reach[k];
    if (reach == 0.0) {
      continue;
    }
    const int segment = state.candidate_segment[k];
    const Projection foot =
        project(state.position[state.candidate_ball[k]], state.position[scene.elements[segment].start],
                state.axis[segment], state.length[segment]);
    const double squared_distance = foot.offset.squaredNorm();
    if (squared_distance < reach * reach) {
      found[count++] = static_cast<std::int64_t>(k);
    } else {
      least_gap = std::min(least_gap, std::sqrt(squared_distance) - reach);
    }
  }
  return count;
}

std::size_t find_overlapping_plain(const Scene& scene, State& state, std::size_t first, std::size_t end,
                                   std::int64_t* found) {
  std::size_t count = 0;
  const bool sleeps = !state.batch_alarm.empty();
  for (std::size_t batch = first; batch < end; ++batch) {
    const double travel = sleeps ? state.group_travel[state.batch_group[batch]] : 0.0;
    if (sleeps && travel < state.batch_alarm[batch]) {
      continue;
    }
    double least_gap = 0.0;
    const std::size_t overlaps = test_batch(scene, state, batch, found + count, least_gap);
    if (sleeps) {
      state.batch_alarm[batch] = overlaps > 0 ? 0.0 : travel + least_gap;
    }
    count += overlaps;
  }
  return count;
}

}  // namespace

void find_overlaps(const Scene& scene, State& state, ContactWorkspace& workspace) {
  workspace.overlapping.resize(state.candidate_ball.size() + kSparePlaces);
  const auto find_overlapping = use_wide_kernels() ? find_overlapping_wide : find_overlapping_plain;
  workspace.overlap_count =
      find_overlapping(scene, state, 0, state.candidate_ball.size() / kCandidateBatch, workspace.overlapping.data());
}

}  // namespace cellcrush
