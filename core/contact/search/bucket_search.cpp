#include <algorithm>
#include <span>

#include "contact/search/candidate_lists.h"
#include "contact/search/pair_search.h"
#include "contact/start_overlaps.h"
#include "contact/thickening.h"
#include "contact/topology/wall_paths.h"
#include "contact/touch_geometry-inl.h"
#include "geometry/bucket_grid.h"

namespace cellcrush {
namespace {

bool list_holds(const Scene& scene, const State& state, const ContactLists& lists) {
  const double left = std::max(0.0, scene.contact.skin - (lists.reach_growth - lists.searched_growth));
  const double limit = 0.25 * left * left;
  const auto has_stayed = [limit](const Vector2& now, const Vector2& then) {
    return !((now - then).squaredNorm() > limit);
  };
  return std::equal(state.position.begin(), state.position.end(), lists.searched_position.begin(),
                    lists.searched_position.end(), has_stayed);
}

/// Whether an element has a broken end (E6g). Nothing tells on which side of its neighbours that is.
bool has_broken_end(const Scene& scene, const State& state, const Element& element) {
  const int end = scene.joint_count;
  const int first = end - static_cast<int>(state.breaks.size());
  return (element.start >= first && element.start < end) || (element.end >= first && element.end < end);
}

/// Whether an element that ends in the ball crosses the segment, other than by a broken end.
bool crosses_segment(const Scene& scene, const State& state, int ball, int segment) {
  const auto first = scene.incidence.begin() + scene.incidence_offset[ball];
  const auto end = scene.incidence.begin() + scene.incidence_offset[ball + 1];
  return std::any_of(first, end, [&](int e) {
    return cross_each_other(state, scene.elements[e], scene.elements[segment]) &&
           !has_broken_end(scene, state, scene.elements[e]) &&
           !has_broken_end(scene, state, scene.elements[segment]);
  });
}

}  // namespace

bool search_buckets(const Scene& scene, const State& state, ContactLists& lists) {
  lists.reach_growth += growth_of_reach(scene, state, 0, scene.bands.size());
  return list_holds(scene, state, lists) || !all_finite(state.position) || list_by_buckets(scene, state, lists);
}

bool list_by_buckets(const Scene& scene, const State& state, ContactLists& lists) {
  clear_candidates(lists);
  lists.candidate_count = 0;
  bool is_planar = true;
  const double longest = *std::max_element(state.length.begin(), state.length.end());
  const double skin = scene.contact.skin;
  const auto count = scene.ball_count > 0 ? static_cast<std::size_t>(scene.ball_count) : scene.particle_count();
  const auto balls = std::span(state.position).subspan(static_cast<std::size_t>(scene.first_ball), count);
  const BucketGrid grid(balls, 0.5 * longest + scene.greatest_radius() + skin);
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    const Element& element = scene.elements[e];
    const Vector2& start = state.position[element.start];
    const Vector2& end = state.position[element.end];
    const double half_thickness = half_thickness_now(scene, state, static_cast<int>(e));
    const Vector2 margin = Vector2::Constant(half_thickness + scene.greatest_radius() + skin);
    grid.visit_box(start.cwiseMin(end) - margin, start.cwiseMax(end) + margin, [&](int found) {
      const int ball = scene.first_ball + found;
      const double range = radius_now(scene, state, ball) + half_thickness + skin;
      const Vector2 from_start = state.position[ball] - start;
      const Vector2& axis = state.axis[e];
      // Inlined: a call of project() would take a fifth of the time of the search.
      const auto off =
          HWY_NAMESPACE::project_clamped(from_start.x(), from_start.y(), axis.x(), axis.y(), state.length[e]);
      const bool is_near = off.x * off.x + off.y * off.y < range * range;
      if (ball != element.start && ball != element.end && is_near && has_elements(scene, ball)) {
        const int segment = static_cast<int>(e);
        add_candidate(lists, {ball, segment, reach_now(scene, state, ball, segment)});
        is_planar = is_planar && !crosses_segment(scene, state, ball, segment);
      }
    });
  }
  fill_batch(lists);
  lists.searched_position = state.position;
  lists.searched_growth = lists.reach_growth;
  ++lists.search_count;
  return is_planar;
}

}  // namespace cellcrush
