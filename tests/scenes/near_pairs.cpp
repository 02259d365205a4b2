#include "scenes/near_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "contact/contact_forces.h"
#include "contact/contact_tiles.h"
#include "contact/contact_workspace.h"
#include "contact/search/pair_search.h"
#include "contact/topology/bands.h"
#include "contact/topology/face_loops.h"

namespace cellcrush::scenes {
namespace {

double distance_between(const Vector2& point, Vector2 a, Vector2 b) {
  for (int i = 0; i < 60; ++i) {
    ((point - a).squaredNorm() < (point - b).squaredNorm() ? b : a) = 0.5 * (a + b);
  }
  return (point - a).norm();
}

/// Twice the signed area of a, b, c.
double orientation(const Vector2& a, const Vector2& b, const Vector2& c) { return cross(b - a, c - a); }

bool cross_each_other(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0.0 && orientation(c, d, a) * orientation(c, d, b) < 0.0;
}

}  // namespace

void evaluate_wall_contacts(const Scene& scene, State& state, ContactWorkspace& workspace, Workers& workers) {
  ContactSums sums = begin_contact_sums(state);
  evaluate_contact_forces(scene, state, 0, workspace, workers, sums);
  state.contact_totals = sums.walls;
}

Pairs listed_pairs(const State& state) {
  Pairs pairs;
  std::int64_t count = 0;
  for (const ContactLists& lists : state.contacts) {
    for (std::size_t k = 0; k < lists.candidate_ball.size(); ++k) {
      if (lists.candidate_reach[k] > 0.0) {
        EXPECT_TRUE(pairs.emplace(lists.candidate_ball[k], lists.candidate_segment[k]).second) << "listed twice";
      }
    }
    count += lists.candidate_count;
  }
  EXPECT_EQ(static_cast<std::int64_t>(pairs.size()), count);
  return pairs;
}

Pairs near_pairs(const Scene& scene, const State& state, double margin) {
  Pairs pairs;
  for (int ball = 0; ball < static_cast<int>(scene.particle_count()); ++ball) {
    for (int e = 0; e < static_cast<int>(scene.element_count()); ++e) {
      const Element& element = scene.elements[e];
      if (ball != element.start && ball != element.end &&
          distance_between(state.position[ball], state.position[element.start], state.position[element.end]) <
              scene.reach_of(ball, e) + margin) {
        pairs.emplace(ball, e);
      }
    }
  }
  return pairs;
}

std::vector<Overlap> overlaps_by_buckets(const Scene& scene, const State& state) {
  State copy;
  copy.position = state.position;
  copy.axis = state.axis;
  copy.length = state.length;
  list_by_buckets(scene, copy, copy.contacts.front());
  std::vector<Overlap> overlaps;
  for (std::size_t k = 0; k < copy.contacts.front().candidate_ball.size(); ++k) {
    const Element& element = scene.elements[copy.contacts.front().candidate_segment[k]];
    const double depth = copy.contacts.front().candidate_reach[k] -
                         distance_between(copy.position[copy.contacts.front().candidate_ball[k]],
                                          copy.position[element.start], copy.position[element.end]);
    if (depth > 0.0) {
      overlaps.push_back({copy.contacts.front().candidate_ball[k], copy.contacts.front().candidate_segment[k], depth});
    }
  }
  return overlaps;
}

void follow_positions(const Scene& scene, State& state) {
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    const Vector2 span = state.position[scene.elements[e].end] - state.position[scene.elements[e].start];
    state.length[e] = span.norm();
    state.axis[e] = state.length[e] > 0.0 ? Vector2(span / state.length[e]) : Vector2(1.0, 0.0);
  }
}

FaceNeighbours::FaceNeighbours(const Scene& scene)
    : faces_of_particle_(scene.particle_count()), faces_of_element_(scene.element_count()) {
  const std::vector<FaceLoop> loops = trace_loops(scene.position, scene.elements);
  for (std::size_t face = 0; face < loops.size(); ++face) {
    for (std::size_t k = 0; k < loops[face].corners; ++k) {
      faces_of_particle_[loops[face].particle[k]].insert(static_cast<int>(face));
      faces_of_element_[loops[face].element[k]].insert(static_cast<int>(face));
    }
  }
  const std::vector<std::set<int>> bordered = faces_of_element_;
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    for (const int end : {scene.elements[e].start, scene.elements[e].end}) {
      for (const int face : faces_of_particle_[end]) {
        double thickest_wall = 0.0;
        for (int k = scene.incidence_offset[end]; k < scene.incidence_offset[end + 1]; ++k) {
          if (bordered[scene.incidence[k]].count(face) > 0) {
            thickest_wall = std::max(thickest_wall, scene.elements[scene.incidence[k]].thickness);
          }
        }
        if (scene.elements[e].thickness > thickest_wall) {
          faces_of_element_[e].insert(face);
        }
      }
    }
  }
}

bool FaceNeighbours::share_a_face(int ball, int segment) const {
  return std::any_of(faces_of_particle_[ball].begin(), faces_of_particle_[ball].end(),
                     [&](int face) { return faces_of_element_[segment].count(face) > 0; });
}

std::vector<std::pair<int, int>> find_crossings(const Scene& scene, const State& state) {
  const auto low = [&](int e) {
    return std::min(state.position[scene.elements[e].start].x(), state.position[scene.elements[e].end].x());
  };
  const auto high = [&](int e) {
    return std::max(state.position[scene.elements[e].start].x(), state.position[scene.elements[e].end].x());
  };
  std::vector<int> order(scene.element_count());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return low(a) < low(b); });
  std::vector<std::pair<int, int>> found;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Element& first = scene.elements[order[i]];
    for (std::size_t j = i + 1; j < order.size() && low(order[j]) <= high(order[i]); ++j) {
      const Element& second = scene.elements[order[j]];
      const bool joined = first.start == second.start || first.start == second.end || first.end == second.start ||
                          first.end == second.end;
      if (!joined && cross_each_other(state.position[first.start], state.position[first.end],
                                      state.position[second.start], state.position[second.end])) {
        found.emplace_back(order[i], order[j]);
      }
    }
  }
  return found;
}

}  // namespace cellcrush::scenes
