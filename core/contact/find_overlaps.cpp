#include "contact/find_overlaps.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>

#include "contact/capsule.h"
#include "contact/wide_overlaps.h"
#include "simd/target.h"

namespace cellcrush {
namespace {

/// Places from `first` to `end` of candidates whose capsules overlap. Few of the many do: a branch for each would be guessed
/// wrong too often, so they are written by counting on.
std::size_t find_overlapping_plain(const Scene& scene, const State& state, std::size_t first, std::size_t end,
                                   std::span<std::int64_t> found) {
  std::size_t count = 0;
  for (std::size_t k = first; k < end; ++k) {
    const int segment = state.candidate_segment[k];
    const double reach = state.candidate_reach[k];
    const Projection foot =
        project(state.position[state.candidate_ball[k]], state.position[scene.elements[segment].start],
                state.axis[segment], state.length[segment]);
    found[count] = static_cast<std::int64_t>(k);
    count += static_cast<std::size_t>(foot.offset.squaredNorm() < reach * reach);
  }
  return count;
}

/// Candidates whose capsules overlap, in the order of their places.
std::vector<Candidate> find_overlapping(const Scene& scene, const State& state) {
  constexpr std::size_t kBatch = 256;
  std::array<std::int64_t, kBatch + kSparePlaces> found;
  std::vector<Candidate> overlapping;
  const std::size_t places = state.candidate_ball.size();
  const auto find_in_batch = use_wide_kernels() ? find_overlapping_wide : find_overlapping_plain;
  for (std::size_t first = 0; first < places; first += kBatch) {
    const std::size_t count = find_in_batch(scene, state, first, std::min(first + kBatch, places), found);
    for (std::size_t i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(found[i]);
      overlapping.push_back({state.candidate_ball[k], state.candidate_segment[k], state.candidate_reach[k]});
    }
  }
  return overlapping;
}

/// By ball, segments ascending: first by lots of balls, then within each, which has few.
std::vector<Candidate> sort_by_ball(const std::vector<Candidate>& pairs, std::size_t particle_count) {
  constexpr int kBallsPerLot = 32;
  std::vector<int> end(particle_count / kBallsPerLot + 2, 0);
  for (const Candidate& pair : pairs) {
    ++end[pair.ball / kBallsPerLot + 1];
  }
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Candidate> sorted(pairs.size());
  for (const Candidate& pair : pairs) {
    sorted[end[pair.ball / kBallsPerLot]++] = pair;
  }
  const auto before = [](const Candidate& a, const Candidate& b) {
    return a.ball != b.ball ? a.ball < b.ball : a.segment < b.segment;
  };
  for (std::size_t lot = 0, first = 0; lot + 1 < end.size(); first = end[lot++]) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first), sorted.begin() + end[lot], before);
  }
  return sorted;
}

}  // namespace

std::vector<Candidate> find_overlaps(const Scene& scene, const State& state) {
  return sort_by_ball(find_overlapping(scene, state), scene.particle_count());
}

}  // namespace cellcrush
