#pragma once

#include <set>
#include <utility>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"

namespace cellcrush::scenes {

/// Pairs of ball and segment.
using Pairs = std::set<std::pair<int, int>>;

/// The candidates that a state has; fails the test when one is listed twice.
Pairs listed_pairs(const State& state);

/// Every pair that is less than `margin` (mm) apart beyond touch, no ball against its own elements. By brute force;
/// distances by halving the segment, not by the projection of the search.
Pairs near_pairs(const Scene& scene, const State& state, double margin);

/// Pairs that overlap now, by the buckets' list of the same positions, with their depth in mm.
struct Overlap {
  int ball = 0;
  int segment = 0;
  double depth = 0.0;
};
std::vector<Overlap> overlaps_by_buckets(const Scene& scene, const State& state);

/// The contact forces between walls of a state with one list, and their totals.
void evaluate_wall_contacts(const Scene& scene, State& state, ContactWorkspace& workspace, Workers& workers);

/// Axes and lengths of a state's positions.
void follow_positions(const Scene& scene, State& state);

/// Whether a face has both a ball and a segment: a segment that borders it, or that ends at it and is thicker than its
/// walls there. By faces that are traced again from the undeformed lattice.
class FaceNeighbours {
 public:
  explicit FaceNeighbours(const Scene& scene);
  [[nodiscard]] bool share_a_face(int ball, int segment) const;

 private:
  std::vector<std::set<int>> faces_of_particle_;
  std::vector<std::set<int>> faces_of_element_;  // with those into which its round ends stand out
};

/// Pairs of elements without a common node whose mid-lines cross: the proof that a wall has passed through another.
/// Exact geometry, by itself, without anything of the solver's search.
std::vector<std::pair<int, int>> find_crossings(const Scene& scene, const State& state);

}  // namespace cellcrush::scenes
