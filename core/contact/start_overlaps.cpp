#include "contact/start_overlaps.h"

#include "contact/search/candidate_lists.h"
#include "contact/thickening.h"
#include "contact/touch/force_laws.h"

namespace cellcrush {
namespace {

/// Whether a ball is within the whole reach of a segment. Positions that are not finite never part.
bool is_within_reach(const Scene& scene, const State& state, int ball, int segment) {
  const Vector2& start = state.position[scene.elements[segment].start];
  const Vector2 offset = project(state.position[ball], start, state.axis[segment], state.length[segment]).offset;
  return !(offset.norm() > greatest_reach(scene, state, ball, segment));
}

/// Most walls stay as they are: their nearest segment is asked first.
bool has_parted(const Scene& scene, const State& state, const StartOverlap& pair) {
  if (is_within_reach(scene, state, pair.ball, pair.nearest)) {
    return false;
  }
  for (int segment = pair.first_segment; segment < pair.end_segment; segment += pair.stride) {
    if (scene.has(pair, segment) && is_within_reach(scene, state, pair.ball, segment)) {
      return false;
    }
  }
  return true;
}

void lengthen_reaches(const Scene& scene, State& state, const StartOverlap& pair) {
  for (ContactLists& lists : state.contacts) {
    for (std::size_t k = 0; k < lists.candidate_ball.size(); ++k) {
      const int segment = lists.candidate_segment[k];
      if (lists.candidate_ball[k] == pair.ball && lists.candidate_reach[k] > 0.0 && scene.has(pair, segment)) {
        lists.candidate_reach[k] = reach_now(scene, state, pair.ball, segment);
        wake_candidate(lists, static_cast<int>(k), pair.ball, segment);
      }
    }
  }
}

}  // namespace

void note_parted_walls(const Scene& scene, State& state) {
  if (state.step % kStepsBetweenPartings != 0) {
    return;
  }
  for (std::size_t p = 0; p < state.parted.size(); ++p) {
    const StartOverlap& pair = scene.start_overlaps.pairs[p];
    if (state.parted[p] == 0 && has_parted(scene, state, pair)) {
      state.parted[p] = 1;
      lengthen_reaches(scene, state, pair);
    }
  }
}

}  // namespace cellcrush
