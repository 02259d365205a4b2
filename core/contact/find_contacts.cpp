#include "contact/find_contacts.h"

#include <algorithm>
#include <cmath>

#include "contact/bucket_grid.h"
#include "contact/capsule.h"
#include "contact/wall_paths.h"

namespace cellcrush {
namespace {

struct Pair {
  int ball;
  int segment;
};

bool list_holds(const Scene& scene, const State& state) {
  if (state.searched_position.size() != state.position.size()) {
    return false;
  }
  const double limit = 0.25 * scene.contact.skin * scene.contact.skin;
  for (std::size_t i = 0; i < state.position.size(); ++i) {
    if ((state.position[i] - state.searched_position[i]).squaredNorm() > limit) {
      return false;
    }
  }
  return true;
}

bool all_finite(const std::vector<Vector2>& points) {
  return std::all_of(points.begin(), points.end(), [](const Vector2& point) { return point.allFinite(); });
}

/// Pairs closer than touch and skin, in the order of the segments.
std::vector<Pair> pairs_within_reach(const Scene& scene, const State& state) {
  double longest = 0.0;
  for (const double length : state.length) {
    longest = std::max(longest, length);
  }
  const double largest_radius = *std::max_element(scene.radius.begin(), scene.radius.end());
  const BucketGrid grid(state.position, 0.5 * longest + largest_radius + scene.contact.skin);
  std::vector<Pair> pairs;
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    const Element& element = scene.elements[e];
    const Vector2& start = state.position[element.start];
    const Vector2& end = state.position[element.end];
    const double margin = 0.5 * element.thickness + scene.contact.skin;
    const Vector2 reach = Vector2::Constant(margin + largest_radius);
    grid.visit_box(start.cwiseMin(end) - reach, start.cwiseMax(end) + reach, [&](int ball) {
      if (ball == element.start || ball == element.end) {
        return;
      }
      const double range = margin + scene.radius[ball];
      const Projection foot = project(state.position[ball], start, state.axis[e], state.length[e]);
      if (foot.offset.squaredNorm() < range * range) {
        pairs.push_back({ball, static_cast<int>(e)});
      }
    });
  }
  return pairs;
}

/// What the list at hand remembers of a pair, or a fresh candidate.
ContactCandidate candidate_for(const State& state, const Pair& pair, WallPaths& paths) {
  for (int k = state.candidate_offset[pair.ball]; k < state.candidate_offset[pair.ball + 1]; ++k) {
    if (state.candidates[k].segment == pair.segment) {
      return state.candidates[k];
    }
  }
  ContactCandidate fresh;
  fresh.ball = pair.ball;
  fresh.segment = pair.segment;
  fresh.reach = paths.reach_of(pair.ball, pair.segment);
  return fresh;
}

/// The pairs by ball, segments ascending; `offset` is into the result.
std::vector<Pair> sort_by_ball(const std::vector<Pair>& pairs, const std::vector<int>& offset) {
  std::vector<Pair> sorted(pairs.size());
  std::vector<int> next(offset.begin(), offset.end() - 1);
  for (const Pair& pair : pairs) {
    sorted[next[pair.ball]++] = pair;
  }
  return sorted;
}

}  // namespace

void find_contacts(const Scene& scene, State& state) {
  if (scene.contact.present && !list_holds(scene, state) && all_finite(state.position)) {
    search_contacts(scene, state);
  }
}

void search_contacts(const Scene& scene, State& state) {
  const std::vector<Pair> pairs = pairs_within_reach(scene, state);
  std::vector<int> offset(scene.particle_count() + 1, 0);
  for (const Pair& pair : pairs) {
    ++offset[pair.ball + 1];
  }
  for (std::size_t i = 1; i < offset.size(); ++i) {
    offset[i] += offset[i - 1];
  }
  std::vector<ContactCandidate> candidates;
  candidates.reserve(pairs.size());
  WallPaths paths(scene);
  for (const Pair& pair : sort_by_ball(pairs, offset)) {
    candidates.push_back(candidate_for(state, pair, paths));
  }
  state.candidate_offset = std::move(offset);
  state.candidates = std::move(candidates);
  state.searched_position = state.position;
  ++state.search_count;
}

}  // namespace cellcrush
