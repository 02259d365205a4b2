#include "contact/find_overlaps.h"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "contact/candidate_lists.h"
#include "contact/capsule.h"
#include "contact/wide_overlaps.h"
#include "simd/target.h"

namespace cellcrush {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

std::size_t find_awake_plain(const ContactLists& lists, std::size_t first, std::size_t end, int* places) {
  std::size_t count = 0;
  for (std::size_t place = first; place < end; ++place) {
    const bool asleep = travel_of_batch(lists, place / kCandidateBatch) < lists.candidate_alarm[place];
    places[count] = static_cast<int>(place);
    count += asleep ? 0 : 1;
  }
  return count;
}

void test_awake_plain(const Scene& scene, const State& state, ContactLists& lists, std::span<const int> places,
                      std::vector<int>& found) {
  const bool sleeps = !lists.batch_group.empty();
  for (const int place : places) {
    const int segment = lists.candidate_segment[place];
    const double reach = lists.candidate_reach[place];
    const Projection foot =
        project(state.position[lists.candidate_ball[place]], state.position[scene.elements[segment].start],
                state.axis[segment], state.length[segment]);
    const double squared_distance = foot.offset.squaredNorm();
    const double travel = sleeps ? travel_of_batch(lists, static_cast<std::size_t>(place) / kCandidateBatch) : -kNever;
    const bool overlaps = squared_distance < reach * reach;
    lists.candidate_alarm[place] = overlaps ? kNever : travel + (std::sqrt(squared_distance) - reach);
    if (overlaps) {
      found.push_back(place);
    }
  }
}

/// The candidates from `first` to `end` that overlap; sets the alarms of the others that are awake.
void find_overlaps_in(const Scene& scene, const State& state, ContactLists& lists, std::size_t first, std::size_t end,
                      ContactPart& part) {
  if (part.awake.size() < end - first + kCandidateBatch) {
    part.awake.resize(end - first + kCandidateBatch);
  }
  part.found.clear();
  const bool is_wide = use_wide_kernels();
  const std::size_t count = (is_wide ? find_awake_wide : find_awake_plain)(lists, first, end, part.awake.data());
  (is_wide ? test_awake_wide : test_awake_plain)(scene, state, lists, std::span(part.awake).first(count), part.found);
}

}  // namespace

void find_overlaps(const Scene& scene, const State& state, ContactLists& lists, ContactWorkspace& workspace,
                   Workers& workers) {
  workers.share_parts(lists.candidate_ball.size(), kCandidateBatch,
                      [&](std::size_t part, std::size_t first, std::size_t end) {
                        find_overlaps_in(scene, state, lists, first, end, workspace.parts[part]);
                      });
  workspace.found.clear();
  for (const ContactPart& part : workspace.parts) {
    workspace.found.insert(workspace.found.end(), part.found.begin(), part.found.end());
  }
}

}  // namespace cellcrush
